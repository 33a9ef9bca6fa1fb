"""Closed rings of solids hinged at edges, by their parameters: overconstrained ones, and spherical ones."""
