"""Centre classes: which loops of a mechanism share their centre.

Two distinct axes cannot both join two distinct points, so two loops that share two joints have one centre
(Wiener 2016, section 3.3.5). The rule is applied to *classes* of loops, not only to loops, until nothing
changes: two classes that share two joints between them are one class though no two of their loops do.
An axis holds one point at infinity only, so two planar loops that share a single joint are one class too.
Theory: docs/theory/centre-classes.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from graphs.ids import JointId
from graphs.loops.loop import Centre, Loop
from graphs.loops.merging import FEW, Merger, merge_spherical

__all__ = ["CentreClass", "centre_classes", "class_of_loop"]


@dataclass(frozen=True, slots=True)
class CentreClass:
    """Loops with one centre.

    Attributes
    ----------
    loops : tuple of int
        Indices of the loops, ascending.
    joints : frozenset of joint ids
        Every joint whose axis passes through the centre.
    centre : Centre
        ``FINITE`` or ``INFINITE``.

    Examples
    --------
    >>> centre_classes([Loop((0, 1, 2)), Loop((1, 2, 3))])[0].loops
    (0, 1)
    """

    loops: tuple[int, ...]
    joints: frozenset[JointId]
    centre: Centre


def centre_classes(loops: Sequence[Loop]) -> tuple[CentreClass, ...]:
    """Return the most general assignment of centres to loops: as few coincidences as the joints force.

    Parameters
    ----------
    loops : sequence of Loop
        Loops without a centre are in no class.

    Returns
    -------
    tuple of CentreClass
        Ordered by their first loop.

    Raises
    ------
    InvariantError
        If a finite and an infinite centre would have to be one.

    Examples
    --------
    Watt's chain: two four-bars with one joint in common. Stephenson's: they share two.

    >>> len(centre_classes([Loop((0, 1, 2, 3)), Loop((3, 4, 5, 6))]))
    2
    >>> len(centre_classes([Loop((0, 1, 2, 3)), Loop((2, 3, 4, 5, 6))]))
    1
    """
    if _nothing_forced(loops):
        return tuple(
            CentreClass((i,), frozenset(loop.joints), loop.centre)
            for i, loop in enumerate(loops)
            if loop.has_centre
        )
    merged = Merger(loops)
    merged.merge_named()
    merged.merge_planar()
    merge_spherical(merged)
    merged.check_kinds()
    members = merged.members
    order = sorted(members, key=lambda root: min(members[root]))
    return tuple(
        CentreClass(tuple(sorted(members[root])), frozenset(merged.joints[root]), loops[min(members[root])].centre)
        for root in order
    )


def class_of_loop(classes: Sequence[CentreClass]) -> dict[int, int]:
    """Return the index of the class of each loop that has one.

    Parameters
    ----------
    classes : sequence of CentreClass

    Returns
    -------
    dict of int to int
        Index of a loop to that of its class, in the order of the classes; loops without a centre are left out.

    Examples
    --------
    >>> class_of_loop(centre_classes([Loop((0, 1, 2), "none"), Loop((2, 3, 4))]))
    {1: 0}
    """
    return {loop: index for index, one in enumerate(classes) for loop in one.loops}


def _nothing_forced(loops: Sequence[Loop]) -> bool:
    """Whether no two loops share more than a joint, and none is planar or named: so it is on most sheets.

    Not asked to the end where a joint has many loops, since pairs of them are looked at one by one.
    """
    through: dict[JointId, list[int]] = {}
    pairs: set[tuple[int, int]] = set()
    for i, loop in enumerate(loops):
        if not loop.has_centre:
            continue
        if loop.at is not None or loop.centre is Centre.INFINITE:
            return False
        for joint in loop.joints:
            others = through.setdefault(joint, [])
            for other in others:
                if (other, i) in pairs:
                    return False
                pairs.add((other, i))
            others.append(i)
            if len(others) > FEW:
                return False
    return True
