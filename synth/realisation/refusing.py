"""Types that no flat sheet has: creases round a hole whose centre is outside it, and panels of few sides.

Round a hole the directions in which creases leave it turn once, against the rays from a centre outside it too. In
a panel with k sides between two such creases, away from the hole, they turn by at most k - 1 half turns against
the rays, and by none where they meet in the centre: along a side the direction crosses rays one way, at each
corner it turns by less than half a turn. Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from graphs.errors import UnsolvableError, shown
from graphs.mechanism.sheet import sides_of_face
from synth.realisation.pattern import Pattern, Pointing

__all__ = ["check_holes", "half_turns"]


def check_holes(pattern: Pattern) -> None:
    """Raise `UnsolvableError` for a hole round which creases cannot turn once, their centre being outside it.

    The message names the panels round the hole and what each allows.
    """
    for one in pattern.pointings:
        known = [turns for turns in (half_turns(pattern, one, hole) for hole in one.holes) if turns is not None]
        short = [turns for turns in known if sum(turns.values()) < 2]
        if len(short) > (not one.infinite and one.vertex is None):  # such a centre may lie in one of the holes
            raise UnsolvableError(_told(pattern, short[-1]))


def _told(pattern: Pattern, turns: dict[int, int]) -> str:
    names = ", ".join(shown(pattern.links[panel]) for panel in turns)
    parts = " + ".join(map(str, turns.values()))
    return (
        f"flat, the directions of creases would turn by 2 half turns round the hole between panel(s) {names}, "
        f"whose centre is outside it; they can turn by {sum(turns.values())} there: by {parts}"
    )


def half_turns(pattern: Pattern, one: Pointing, hole: int) -> dict[int, int] | None:
    """Return by how many half turns at most creases turn in each panel round a hole.

    The pointing is to a centre outside the hole, which is a place in ``pattern.holes``. None where something hangs
    into the hole: the panels round it are not just those between its creases.
    """
    ring = pattern.holes[hole]
    inside = {panel: _sides_in(around, ring) for panel, around in enumerate(pattern.panels)}
    inside = {panel: sides for panel, sides in inside.items() if sides}
    reaching = [place for place, ends in enumerate(pattern.creases) if one.vertex in ends]
    creases = [crease for crease in (*one.creases, *reaching) if set(pattern.creases[crease]) & set(ring)]
    if len(creases) != len(inside):
        return None
    return {panel: max(len(pattern.panels[panel]) - 2 - sides - 1, 0) for panel, sides in inside.items()}


def _sides_in(panel: tuple[int, ...], ring: tuple[int, ...]) -> int:
    """Return how many open edges a panel has round a hole."""
    border = {frozenset(side) for side in sides_of_face(ring)}
    return sum(frozenset(side) in border for side in sides_of_face(panel))
