"""Crease patterns: FOLD, .cp, SVG, OBJ."""
