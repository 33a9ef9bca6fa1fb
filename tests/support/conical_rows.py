"""Placements of joints round a circle, each orbit by its least."""

import numpy as np


def canonical_row(row, symmetries, slots):
    """The least placement of the orbit of a placement, as a tuple."""
    moved = np.asarray(row)[symmetries]
    moved = moved - moved[:, :1]
    return min(map(tuple, np.concatenate([moved % slots, -moved % slots]).tolist()))
