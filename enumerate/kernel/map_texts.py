"""Texts of the codes of maps, many at a time: the ids of `graphs.identity.drawings`."""

from __future__ import annotations

from string import ascii_letters

import numpy as np

from enumerate.kernel.maps import END, JOINT, OPEN
from graphs.identity.drawings import map_text
from graphs.types import Bytes, Ints

__all__ = ["LABEL_LETTERS", "map_ids"]

LABEL_LETTERS = "ofis"
"""Letters of the labels of `enumerate.kernel.centre_labels`."""

_LETTERS = np.full(256, ord("?"), np.uint8)
_LETTERS[[OPEN, END]] = np.frombuffer(b"-.", np.uint8)
_LETTERS[JOINT : JOINT + len(ascii_letters)] = np.frombuffer(ascii_letters.encode("ascii"), np.uint8)


def map_ids(codes: Bytes, lengths: Ints, labels: int) -> list[str]:
    """Return the ids of codes, one in each row of uint8[r, width] with anything after it.

    A length includes the labels at the end, so many for each code, the first that of the outer face.

    >>> map_ids(np.array([[2, 3, 1, 2, 3, 1, 0, 1, 2]], np.uint8), np.array([9]), 3)
    ['m1:ab.ab;fi']
    """
    if not len(codes):
        return []
    width = codes.shape[1]
    ends = (lengths - labels).tolist()
    if codes.max() < JOINT + len(ascii_letters):
        text = _LETTERS[codes].tobytes().decode("ascii")
        found = ["m1:" + text[i * width : i * width + end - 1] for i, end in enumerate(ends)]
    else:
        found = [map_text(row[:end]) for row, end in zip(codes.tolist(), ends, strict=True)]
    if not labels:
        return found
    suffixes = [
        "".join(LABEL_LETTERS[label] for label in row[end + 1 : end + labels])
        for row, end in zip(codes.tolist(), ends, strict=True)
    ]
    return [
        f"{text};{suffix}" if set(suffix) - {"f"} else text for text, suffix in zip(found, suffixes, strict=True)
    ]
