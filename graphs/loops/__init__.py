"""Loops of a mechanism, and which of them share a centre."""
