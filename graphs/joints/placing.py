"""General members: places for the joints of a linkage that is given without any. Theory: docs/theory/joints.md."""

from __future__ import annotations

import numpy as np

from graphs.geometry import across, unit
from graphs.joints.kinds import JointKind
from graphs.joints.knees import Knee, knees_of_type
from graphs.joints.linkage import JointedLinkage, JointPlace, plain_vector
from graphs.loops.loop import Centre
from graphs.types import Floats, JointId

__all__ = ["placed"]


def placed(linkage: JointedLinkage, seed: int = 0) -> JointedLinkage:
    """Return a linkage with places for its joints: its own, or random ones where it has none.

    Axes of loops with a centre meet there; of a planar loop they are parallel, and slides are across them.
    A prismatic joint between two binary links, with joints beyond them that can turn about parallel axes across
    it, is given such axes: the usual way to build it, and three parallel revolutes do its work.

    Parameters
    ----------
    linkage : JointedLinkage
    seed : int, optional
        Another seed is another member.

    Examples
    --------
    >>> from graphs.mechanism.sc import SCGraph
    >>> door = JointedLinkage(SCGraph(2, [(0, 1)]), {0: JointKind.CYLINDRICAL})
    >>> len(placed(door).places[0].axes)
    1
    """
    if linkage.places:
        return linkage
    random = np.random.default_rng(seed)
    points: dict[JointId, Floats] = {joint: random.normal(size=3) for joint in linkage.kinds}
    axes = {joint: _axes(kind, random) for joint, kind in linkage.kinds.items()}
    _turn_to_centres(linkage, points, axes, random)
    for knee in knees_of_type(linkage):
        _turned(knee, linkage, points, axes)
    places = {
        joint: JointPlace(plain_vector(points[joint]), tuple(map(plain_vector, axes[joint]))) for joint in points
    }
    return JointedLinkage(linkage.chain, linkage.kinds, places)


def _axes(kind: JointKind, random: np.random.Generator) -> list[Floats]:
    axes: list[Floats] = [random.normal(size=3) for _ in range(kind.axes)]
    if kind is JointKind.UNIVERSAL:
        axes[1] = across(axes[1], axes[0])
    return [unit(axis) for axis in axes]


def _turn_to_centres(
    linkage: JointedLinkage,
    points: dict[JointId, Floats],
    axes: dict[JointId, list[Floats]],
    random: np.random.Generator,
) -> None:
    """Give joints of loops with a centre axes through it, those of planar loops axes across or along the plane."""
    meeting: dict[JointId, list[tuple[Centre, Floats]]] = {}
    for one in linkage.chain.centre_classes():
        at = unit(random.normal(size=3))
        for joint in one.joints:
            meeting.setdefault(joint, []).append((one.centre, at))
    for joint, centres in meeting.items():
        normals = [at for centre, at in centres if centre is Centre.INFINITE]
        if linkage.kinds[joint] is JointKind.PRISMATIC:
            along = np.cross(normals[0], normals[1]) if len(normals) > 1 else across(axes[joint][0], normals[0])
            axes[joint] = [unit(along)]
            continue
        through = [at for centre, at in centres if centre is Centre.FINITE]
        ways = [*normals, *(at - through[0] for at in through[1:])]
        axes[joint] = [unit(ways[0])] if ways else axes[joint]
        points[joint] = through[0] + random.normal() * axes[joint][0] if through else points[joint]


def _turned(
    knee: Knee, linkage: JointedLinkage, points: dict[JointId, Floats], axes: dict[JointId, list[Floats]]
) -> None:
    """Give the joints beside a slide parallel axes across it."""
    held = [(end.joint, end.axis) for end in knee.ends if end.axis is not None]
    normal = axes[held[0][0]][held[0][1]] if held else axes[knee.slide][0]
    for joint, place in held[1:]:
        axes[joint][place] = normal
        if linkage.kinds[joint] is JointKind.UNIVERSAL:
            axes[joint][1 - place] = unit(across(axes[joint][1 - place], normal))
    one, other_end = (points[end.joint] for end in knee.ends)
    axes[knee.slide] = [unit(across(other_end - one, normal))]
