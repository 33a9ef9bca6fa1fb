"""Special geometry: members of a type that move although counts say no.

`search` tries the `families` one after the other, flat sheets and axes in space, and follows each member by a finite
motion. Theory: docs/theory/realisation.md.
"""
