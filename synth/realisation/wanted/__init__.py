"""What a flat drawing is to be besides drawn: flat-foldable, symmetric.

`wishes` says what is asked for and how well it is kept; `flat_folding` and `symmetry` make `conditions` of it, of
`walking` round vertices and holes. Theory: docs/theory/realisation.md.
"""
