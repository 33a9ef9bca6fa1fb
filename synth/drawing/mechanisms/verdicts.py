"""Which creases of a pattern are still, for its picture."""

from __future__ import annotations

from dataclasses import dataclass

from graphs.ids import JointId, LinkId
from graphs.mechanism.sheet import Sheet
from synth.folding.prepared import prepared
from synth.verdict.of_motion import verdict_of_motion

__all__ = ["Stillness", "stillness_of"]


@dataclass(frozen=True, slots=True)
class Stillness:
    """Which joints are still, and which panels move as one.

    Attributes
    ----------
    still : frozenset of joint ids
    clusters : tuple of tuple of link ids
    known : str
        How that is known.
    """

    still: frozenset[JointId] = frozenset()
    clusters: tuple[tuple[LinkId, ...], ...] = ()
    known: str = ""


def stillness_of(sheet: Sheet) -> Stillness:
    """Return what the verdict on a sheet says of its joints.

    Parameters
    ----------
    sheet : Sheet
        With coordinates.

    Raises
    ------
    UnsolvableError
        If the sheet has no coordinates, or its panels do not fit at its pose.

    Examples
    --------
    Three creases that meet in a point hold each other, flat as they lie:

    >>> tent = Sheet(4, (), "", ((0, 1, 2), (0, 2, 3), (0, 3, 1)), ((0, 0), (2, 0), (-1, 2), (-1, -2)))
    >>> stillness = stillness_of(tent)
    >>> len(stillness.still), stillness.clusters, stillness.known
    (3, ((0, 1, 2),), 'proved')
    """
    verdict = verdict_of_motion(prepared(sheet))
    return Stillness(frozenset(verdict.stiff_joints), verdict.clusters, verdict.certainty)
