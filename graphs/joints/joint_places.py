"""Places for the joints of a linkage that has none, and slides that three parallel revolutes stand for.

A *knee* is three parallel revolutes, the middle axis at equal arms from the two beside it. It moves one end
against the other in all ways of a plane, as a slide between two parallel axes does. Theory: docs/theory/joints.md.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from graphs.geometry import across, frame_about, unit
from graphs.joints.linkage import JointedLinkage, JointKind, JointPlace, legs, plain_vector
from graphs.loops.loop import Centre
from graphs.mechanism.precision import precision_of_axes
from graphs.tolerances import Tolerances
from graphs.types import Floats, JointId

_ENDS = (JointKind.REVOLUTE, JointKind.UNIVERSAL, JointKind.SPHERICAL)


@dataclass(frozen=True, slots=True)
class KneeEnd:
    """A joint beside a slide, which is beside its first link (`place` 0) or its second (1).

    `axis` is the number of the axis that is to be across the slide, None for a spherical joint, which has any.
    """

    joint: JointId
    place: int
    axis: int | None


@dataclass(frozen=True, slots=True)
class Knee:
    """A slide, and the joints before and after it."""

    slide: JointId
    ends: tuple[KneeEnd, KneeEnd]


def placed_knees(linkage: JointedLinkage) -> list[tuple[Knee, Floats]]:
    """Return the slides of a linkage with places that knees can stand for, each with the direction of its axes."""
    points = np.array([place.point for place in linkage.places.values()])
    axes = np.array([axis for place in linkage.places.values() for axis in place.axes]).reshape(-1, 3)
    parallel = Tolerances.of(precision_of_axes(points, axes).size).parallel
    normals = ((knee, _normal(linkage, knee, parallel)) for knee in _possible(linkage))
    fitting = {knee: normal for knee, normal in normals if normal is not None}
    return [(knee, fitting[knee]) for knee in _taken_once(fitting)]


def _possible(linkage: JointedLinkage) -> Iterator[Knee]:
    """Yield the slides that have a joint of the right kind on both sides, binary links between."""
    for leg in legs(linkage.chain):
        for place in range(1, len(leg.joints) - 1):
            before, slide, after = leg.joints[place - 1 : place + 2]
            if linkage.kinds[slide] is JointKind.PRISMATIC:
                ends = _end(linkage, before, leg.links[place]), _end(linkage, after, leg.links[place + 1])
                if all(linkage.kinds[end.joint] in _ENDS for end in ends):
                    yield Knee(slide, ends)


def _end(linkage: JointedLinkage, joint: JointId, beside: object) -> KneeEnd:
    place = 0 if linkage.chain.joints[joint][0] == beside else 1
    axis = {JointKind.UNIVERSAL: place, JointKind.SPHERICAL: None}.get(linkage.kinds[joint], 0)
    return KneeEnd(joint, place, axis)


def _taken_once(knees: Iterable[Knee]) -> Iterator[Knee]:
    """Yield knees of which each joint serves one."""
    serving: set[JointId] = set()
    for knee in knees:
        joints = {end.joint for end in knee.ends}
        if not joints & serving:
            serving |= joints
            yield knee


def _normal(linkage: JointedLinkage, knee: Knee, parallel: float) -> Floats | None:
    """Return the direction across the slide that the axes beside it have in common, None if they have none."""
    slide = unit(linkage.places[knee.slide].axes[0])
    axes = [unit(linkage.places[end.joint].axes[end.axis]) for end in knee.ends if end.axis is not None]
    if not axes:
        return np.asarray(frame_about(slide)[1])
    if any(abs(axis @ slide) > parallel or np.linalg.norm(np.cross(axis, axes[0])) > parallel for axis in axes):
        return None
    return axes[0]


def placed(linkage: JointedLinkage, seed: int = 0) -> JointedLinkage:
    """Return a linkage with places for its joints: its own, or random ones if it has none.

    Axes of loops with a centre meet there; those of a planar loop are parallel, and slides are across them. Where
    joints beside a slide can turn about parallel axes across it, they do: three parallel revolutes do its work.

    Parameters
    ----------
    linkage : JointedLinkage
    seed : int, optional
        Random seed; another seed gives another realisation.

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
    for knee in _taken_once(_possible(linkage)):
        _turned(knee, linkage, points, axes)
    places = {joint: JointPlace(plain_vector(points[joint]), tuple(map(plain_vector, axes[joint]))) for joint in points}
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
    for centre_class in linkage.chain.centre_classes():
        at = unit(random.normal(size=3))
        for joint in centre_class.joints:
            meeting.setdefault(joint, []).append((centre_class.centre, at))
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
