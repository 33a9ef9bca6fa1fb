"""Members of a type by arrays of dimensions: arcs of links, directions or points of axes, coordinates of sheets.

Arcs bend the links of a mechanism in its configuration: each turns what comes after it in a loop about the normal of
its two axes, and joints follow until loops close. Axes, points and coordinates are those of closed configurations.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import degrees

import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError, SynthedraError, UnsolvableError, shown
from graphs.geometry import unit
from graphs.tolerances import DOUBLE
from graphs.types import Flags, Floats, Ints, JointId
from synth.analysis.assembly.family import Family, family_of
from synth.analysis.assembly.kernel import DIRECTION, POINT, SLIDE
from synth.analysis.folding.configuration import SheetConfiguration
from synth.analysis.members.member_kernel import MemberArrays, MemberType
from synth.analysis.motion.configuration import Configuration
from synth.analysis.motion.linkage import Linkage
from synth.analysis.moving._configuration_of import Movable, configuration_of
from synth.linkages.fourbar.closing import can_close

Arcs = dict[tuple[JointId, JointId], float]
MemberDimensions = Mapping[str, npt.ArrayLike | Mapping[tuple[JointId, JointId], npt.ArrayLike]]


@dataclass(frozen=True, slots=True)
class Batch:
    """Members with what is said of them: angles of all joints where each begins, float[N, J] or float[J].

    `barred`, bool[N], are those that cannot close, whatever the inputs; `why` says why, where more is known.
    """

    members: MemberArrays
    zero: Floats
    barred: Flags
    why: dict[int, str] = field(default_factory=dict)


def arcs_of(mechanism: Movable) -> Arcs:
    """Return the arcs of a linkage whose loops are spherical: between joints that follow each other in a loop.

    They are the columns of the arcs that `sweep` takes, in this order.

    Parameters
    ----------
    mechanism : Movable
        With coordinates.

    Returns
    -------
    mapping of (joint id, joint id) to float
        Radians, between 0 and pi.

    Examples
    --------
    >>> from synth.catalogue.patterns import generate
    >>> arcs = arcs_of(generate("four-bar").mechanism)
    >>> {pair: round(degrees(arc)) for pair, arc in arcs.items()}
    {(0, 1): 75, (1, 2): 80, (2, 3): 70, (3, 0): 85}
    """
    linkage = configuration_of(mechanism).linkage
    names = list(linkage.graph.joints)
    seen: dict[frozenset[int], tuple[JointId, JointId]] = {}
    arcs: Arcs = {}
    for loop in linkage.loops:
        for one, other in _links(loop.joints):
            if frozenset((one, other)) not in seen:
                pair = seen[frozenset((one, other))] = names[one], names[other]
                first, second = linkage.directions[[one, other]]
                arcs[pair] = float(np.arctan2(np.linalg.norm(np.cross(first, second)), first @ second))
    return arcs


def _links(joints: Sequence[int]) -> list[tuple[int, int]]:
    """Return which joints follow each other round a loop."""
    return list(zip(joints, [*joints[1:], *joints[:1]], strict=True))


def type_of(family: Family) -> MemberType:
    """Return the loops of a family, one after the other."""
    there = family.loops >= 0
    passages = family.loops[there]
    joint = family.axes[passages, 0]
    begin = np.concatenate([np.zeros(1, dtype=np.int64), np.cumsum(there.sum(axis=1))])
    slides = np.zeros(len(family.joints), dtype=bool)
    slides[family.axes[family.axes[:, 1] == SLIDE, 0]] = True
    curved = family.axes[family.loops[:, 0], 1] == DIRECTION
    return MemberType(begin, joint, family.signs[there], slides, family.column, curved)


def axes_of(family: Family, parameters: Floats) -> Floats:
    """Return the axis of each passage of members whose axes have parameters float[..., 2 A]: float[..., P, 3]."""
    first, second = parameters[..., ::2], parameters[..., 1::2]
    kinds, one = family.axes[:, 1], np.ones_like(first)
    direction = np.stack([np.sin(first) * np.cos(second), np.sin(first) * np.sin(second), np.cos(first)], axis=-1)
    point = np.stack([first, second, one], axis=-1)
    slide = np.stack([-np.sin(first), np.cos(first), 0.0 * one], axis=-1)
    axes = np.where((kinds == DIRECTION)[:, None], direction, np.where((kinds == POINT)[:, None], point, slide))
    return np.asarray(axes[..., family.loops[family.loops >= 0], :])


def batch_of(
    at: Configuration, family: Family, parameters: Floats, dimensions: MemberDimensions, driven: Ints
) -> Batch:
    """Return the members that have given dimensions, of one kind."""
    names = sorted(dimensions)
    if not names:  # the mechanism alone
        members = MemberArrays(axes_of(family, parameters), np.zeros(len(family.joints)))
        return Batch(members, at.linkage.angles, np.zeros(1, dtype=bool))
    if len(names) != 1 or names[0] not in ("arcs", "axes", "points", "coordinates"):
        listed = ", ".join(map(shown, names))
        raise InvariantError("parameters", f"parameters {listed}", "one of arcs, axes, points, coordinates")
    given = dimensions[names[0]]
    if names[0] == "arcs":
        return _by_arcs(at.linkage, family, parameters, given)
    array = np.asarray(given, dtype=float)
    if names[0] == "axes":
        if isinstance(at, SheetConfiguration):
            raise UnsolvableError("fold angles are not known from axes: of a crease pattern give coordinates or arcs")
        return _by_axes(at.linkage, family, array)
    if names[0] == "points":
        return _by_points(at.linkage, family, array, driven)
    return _by_coordinates(at, family, array, driven)


def _by_arcs(linkage: Linkage, family: Family, parameters: Floats, given: object) -> Batch:
    kind = type_of(family)
    if not kind.curved.all():
        raise UnsolvableError("arcs require spherical loops: of planar ones give points")
    arcs = arcs_of(linkage)
    names = list(linkage.graph.joints)
    passages = [(names[one], names[other]) for loop in linkage.loops for one, other in _links(loop.joints)]
    column = {frozenset(pair): place for place, pair in enumerate(arcs)}
    values = _columns(given, arcs)
    axes = axes_of(family, parameters)
    after = np.concatenate(
        [np.roll(axes[kind.begin[loop] : kind.begin[loop + 1]], -1, axis=0) for loop in range(len(kind.curved))]
    )
    normals = np.cross(axes, after)
    sine = np.linalg.norm(normals, axis=1)
    bends = (values - np.array(list(arcs.values())))[:, [column[frozenset(pair)] for pair in passages]]
    if (straight := (sine <= DOUBLE.parallel) & (bends != 0.0).any(axis=0)).any():
        pair = passages[int(straight.argmax())]
        raise UnsolvableError(
            f"the axes of joints {shown(pair[0])} and {shown(pair[1])} are parallel: expected a link that has a normal"
        )
    _check_bends(linkage, arcs, values)
    # what the kernel does with an axis that is not bent is to leave it
    normals = np.divide(normals, sine[:, None], out=np.zeros_like(normals), where=sine[:, None] > DOUBLE.parallel)
    barred = np.zeros(len(values), dtype=bool)
    for loop in linkage.loops:
        barred |= ~can_close(values[:, [column[frozenset((names[a], names[b]))] for a, b in _links(loop.joints)]])
    start = np.zeros(len(family.joints))
    return Batch(MemberArrays(axes, start, normals, bends), linkage.angles, barred)


def _columns(given: object, arcs: Arcs) -> Floats:
    """Return the arcs of all members, float[N, A]: those that are not named are the mechanism's."""
    if isinstance(given, Mapping):
        pairs = {frozenset(pair): pair for pair in arcs}
        unknown = [pair for pair in given if frozenset(pair) not in pairs]
        if unknown:
            listed = ", ".join(map(str, arcs))
            raise InvariantError("arcs", f"{unknown[0]} is no arc of the mechanism", f"some of {listed}")
        chosen = {pairs[frozenset(pair)]: np.asarray(values, dtype=float) for pair, values in given.items()}
        columns = np.broadcast_arrays(*(chosen.get(pair, np.asarray(arc)) for pair, arc in arcs.items()))
        values = np.stack([np.atleast_1d(column) for column in columns], axis=-1)
    else:
        values = np.asarray(given, dtype=float)
    if values.ndim != 2 or values.shape[1] != len(arcs):
        raise InvariantError("arcs", f"an array of shape {values.shape}", f"float[N, {len(arcs)}]")
    bad = ~((values > 0.0) & (values < np.pi))
    if bad.any():
        member, place = np.argwhere(bad)[0].tolist()
        listed = f"arc {place} of member {member} is {degrees(float(values[member, place])):.6g} degrees"
        raise InvariantError("arcs", listed, "between 0 and 180")
    return values


def _check_bends(linkage: Linkage, arcs: Arcs, values: Floats) -> None:
    """Refuse links three of whose arcs are named: two and the angle between them are all that is free."""
    root: dict[tuple[object, JointId], tuple[object, JointId]] = {}

    def found(node: tuple[object, JointId]) -> tuple[object, JointId]:
        while root.setdefault(node, node) != node:
            node = root[node]
        return node

    joints = linkage.graph.joints
    for place, (one, other) in enumerate(arcs):
        for link in set(joints[one]) & set(joints[other]):
            ends = found((link, one)), found((link, other))
            if ends[0] == ends[1] and np.ptp(values, axis=0)[place] > 0.0:
                raise UnsolvableError(f"arcs of link {shown(link)} determine each other: give axes or coordinates")
            root[ends[0]] = ends[1]


def checked_axes(joints: int, given: object) -> Floats:
    """Return the directions of the joints of members, float[N, J, 3]."""
    axes = np.asarray(given, dtype=float)
    if axes.ndim != 3 or axes.shape[1:] != (joints, 3):
        raise InvariantError("axes", f"an array of shape {axes.shape}", f"float[N, {joints}, 3]")
    bad = ~(np.linalg.norm(axes, axis=2) > 0.0)
    if bad.any():
        member, place = np.argwhere(bad)[0].tolist()
        raise InvariantError("axes", f"axis {place} of member {member} has no direction", "a nonzero vector")
    return axes


def checked_points(linkage: Linkage, given: object) -> Floats:
    """Return the points of the joints of members, in units of the extent, about the middle: float[N, J, 3]."""
    points, joints = np.asarray(given, dtype=float), len(linkage.graph.joints)
    if points.ndim != 3 or points.shape[1:] != (joints, 3):
        raise InvariantError("points", f"an array of shape {points.shape}", f"float[N, {joints}, 3]")
    if not np.isfinite(points).all():
        raise InvariantError("points", "the points of joints are not all numbers", "finite numbers")
    return np.asarray((points - linkage.middle) / linkage.extent)


def spatial_axes(linkage: Linkage, dimensions: MemberDimensions) -> tuple[Floats, Floats]:
    """Return directions and points of the joints of members with spatial loops, float[N, J, 3], points in extents.

    What is not given is that of the linkage.
    """
    axes = checked_axes(len(linkage.graph.joints), dimensions.get("axes", linkage.directions[None]))
    points = linkage.points[None]
    if "points" in dimensions:
        points = checked_points(linkage, dimensions["points"])
    if len(axes) != len(points) and 1 not in (len(axes), len(points)):
        raise InvariantError("parameters", f"axes of {len(axes)} members and points of {len(points)}", "as many")
    count = 0 if not len(axes) or not len(points) else max(len(axes), len(points))
    shape = (count, *axes.shape[1:])
    return np.broadcast_to(unit(axes), shape), np.broadcast_to(points, shape)


def _by_axes(linkage: Linkage, family: Family, given: object) -> Batch:
    axes = checked_axes(len(linkage.graph.joints), given)
    kind = type_of(family)
    if not kind.curved.all():
        raise UnsolvableError("axes are directions, which require spherical loops: of planar ones give points")
    place = np.array([list(linkage.graph.joints).index(joint) for joint in family.joints])
    members = MemberArrays(unit(axes[:, place[kind.joint]]), np.zeros(len(family.joints)))
    return Batch(members, linkage.angles, np.zeros(len(axes), dtype=bool))


def _by_points(linkage: Linkage, family: Family, given: object, driven: Ints) -> Batch:
    joints, points = list(linkage.graph.joints), checked_points(linkage, given)
    kind, names = type_of(family), [joints[place] for place in driven.tolist()]
    axes = np.zeros((len(points), len(kind.joint), 3))
    for member, moved in enumerate(points):
        axes[member] = axes_of(family, family_of(replace(linkage, points=moved), names)[1])
    return Batch(MemberArrays(axes, np.zeros(len(family.joints))), linkage.angles, np.zeros(len(points), dtype=bool))


def checked_coordinates(at: SheetConfiguration, given: object) -> Floats:
    """Return the vertices of members, float[N, V, 2 or 3]."""
    coordinates = np.asarray(given, dtype=float)
    wanted = len(at.sheet.coordinates or ())
    if coordinates.ndim != 3 or coordinates.shape[1] != wanted or coordinates.shape[2] not in (2, 3):
        raise InvariantError("coordinates", f"an array of shape {coordinates.shape}", f"float[N, {wanted}, 3]")
    return coordinates


def _by_coordinates(at: Configuration, family: Family, coordinates: Floats, driven: Ints) -> Batch:
    if not isinstance(at, SheetConfiguration):
        raise UnsolvableError("coordinates require a crease pattern: of other mechanisms give axes, points or arcs")
    coordinates = checked_coordinates(at, coordinates)
    names = [list(at.linkage.graph.joints)[place] for place in driven.tolist()]
    kind = type_of(family)
    axes = np.zeros((len(coordinates), len(kind.joint), 3))
    zero = np.tile(at.linkage.angles, (len(coordinates), 1))
    why: dict[int, str] = {}
    for member, corners in enumerate(coordinates):
        try:
            moved = replace(at.sheet, coordinates=tuple(map(tuple, corners.tolist())))
            linkage = configuration_of(moved, mend=False).linkage
            own, parameters = family_of(linkage, names)
        except SynthedraError as error:
            why[member] = str(error)
            continue
        axes[member], zero[member] = axes_of(own, parameters), linkage.angles
    barred = np.isin(np.arange(len(coordinates)), list(why))
    return Batch(MemberArrays(axes, np.zeros(len(family.joints))), zero, barred, why)
