"""Mobility by count: the equations, their differences, and which of them apply."""
