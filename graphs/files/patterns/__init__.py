"""Crease patterns as files: FOLD, .cp, SVG, OBJ; each reader makes a `Sheet`."""
