"""Exhaustive enumeration: all mechanisms of a kind."""
