"""Types that have a form of their own: R/- strings as `strips` of panels, one centre as a linkage `on_cone`.

Theory: docs/theory/realisation.md.
"""
