"""Compiled code that all enumerators share."""
