"""Scissors of links with a kink at their pin: rings in a plane, polyhedra."""
