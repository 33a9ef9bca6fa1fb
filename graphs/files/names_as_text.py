"""Names of links and joints in files that hold text only: GraphML and edge lists.

An integer is written as its digits; no two names of a graph are the same text. Read, names are integers where all
of them are written as integers are.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Hashable, Iterable

__all__ = ["are_kept", "names_from_text"]

_INTEGER = re.compile(r"0|-?[1-9]\d{0,17}")
"""As Python writes one: ``01`` is another name than ``1``."""


def names_from_text(words: Iterable[str]) -> dict[str, str | int]:
    """Return word to name: integers if all are, else the words.

    >>> names_from_text(["3", "-1"]), names_from_text(["3", "a"]), names_from_text(["01", "1"])
    ({'3': 3, '-1': -1}, {'3': '3', 'a': 'a'}, {'01': '01', '1': '1'})
    """
    every = list(dict.fromkeys(words))
    whole = all(map(_INTEGER.fullmatch, every))
    return {word: int(word) if whole else word for word in every}


def are_kept(names: Collection[Hashable]) -> bool:
    """Say whether names are the same when they are written as text and read again.

    >>> are_kept([1, 2]), are_kept(["1", "2"]), are_kept([1, "a"])
    (True, False, False)
    """
    return list(names_from_text(map(str, names)).values()) == list(names)
