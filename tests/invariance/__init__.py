"""One crease pattern in many guises, and whether the verdict is the same: `python -m tests.invariance --help`."""
