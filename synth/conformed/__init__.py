"""The conformed pose: rates, behaviour, and what holds over all angles."""
