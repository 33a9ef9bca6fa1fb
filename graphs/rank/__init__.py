"""Mobility by rank: exact for a general member of a type, numerical at a pose."""
