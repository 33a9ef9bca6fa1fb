"""Types that no flat sheet has: creases round a hole cannot all be parallel if its panels have few sides.

Round a hole the directions in which creases leave it turn once. A panel whose creases are parallel lets them turn
by at most k - 1 half turns, k being its sides between the two away from the hole: one exterior angle at each of
k + 1 corners, each less than half a turn, the sum a whole number of half turns, half a turn of it the panel's own.
Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from graphs.errors import UnsolvableError, shown
from graphs.mechanism.sheet import sides_of_face
from synth.realisation.pattern import Pattern, Pointing

__all__ = ["check_holes", "half_turns"]


def check_holes(pattern: Pattern) -> None:
    """Refuse a pattern with a hole round which parallel creases cannot turn once.

    Parameters
    ----------
    pattern : Pattern

    Raises
    ------
    UnsolvableError
        With the panels round the hole and what each allows.

    Examples
    --------
    >>> from graphs.identity.drawings import mechanism_from_map_id
    >>> from synth.realisation.pattern import pattern_of
    >>> check_holes(pattern_of(mechanism_from_map_id("m1:a-b-.a-c-.b-d-.c-d-;i")))
    Traceback (most recent call last):
    ...
    graphs.errors.UnsolvableError: flat, the directions of creases would turn by 2 half turns round the hole \
between panel(s) 0, 1, 2, 3; parallel creases can turn by 0 there: by 0 + 0 + 0 + 0
    """
    for one in pattern.pointings:
        for hole in one.holes if one.infinite else ():
            turns = half_turns(pattern, one, hole)
            if turns is not None and sum(turns.values()) < 2:
                names = ", ".join(shown(pattern.links[panel]) for panel in turns)
                parts = " + ".join(map(str, turns.values()))
                raise UnsolvableError(
                    f"flat, the directions of creases would turn by 2 half turns round the hole between panel(s) "
                    f"{names}; parallel creases can turn by {sum(turns.values())} there: by {parts}"
                )


def half_turns(pattern: Pattern, one: Pointing, hole: int) -> dict[int, int] | None:
    """Return by how many half turns at most parallel creases turn in each panel round a hole.

    Parameters
    ----------
    pattern : Pattern
    one : Pointing
        To an infinite centre.
    hole : int
        Place of a hole that it lies across.

    Returns
    -------
    dict of int to int or None
        None where something hangs into the hole: the panels round it are not just those between its creases.
    """
    ring = pattern.holes[hole]
    inside = {panel: _sides_in(around, ring) for panel, around in enumerate(pattern.panels)}
    inside = {panel: sides for panel, sides in inside.items() if sides}
    creases = [crease for crease in one.creases if set(pattern.creases[crease]) & set(ring)]
    if len(creases) != len(inside):
        return None
    return {panel: len(pattern.panels[panel]) - 2 - sides - 1 for panel, sides in inside.items()}


def _sides_in(panel: tuple[int, ...], ring: tuple[int, ...]) -> int:
    """Return how many open edges a panel has round a hole."""
    border = {frozenset(side) for side in sides_of_face(ring)}
    return sum(frozenset(side) in border for side in sides_of_face(panel))
