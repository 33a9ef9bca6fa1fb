"""What coordinates show of their precision: the digits of their text, and relations that a drawing nearly has.

`digits` reads text, `relations` finds lines, angles and lengths that nearly agree, `estimate` weighs them against
chance. `graphs.mechanism.precision` decides. Theory: docs/theory/precision.md.
"""
