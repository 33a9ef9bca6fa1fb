"""Crease patterns by their parameters: tessellations, triangulated ones, twists, bases, tubes."""
