"""A mechanism as rigid bodies and hinges at one closed configuration, with a spanning tree of the hinges.

Simulators take trees of bodies, and constraints that close the loops. The tree holds the driven joints and the
slides; each hinge outside it is cut, and `synth.making.simulation.connections` says what holds it together. Lengths are
metres, in the axes of the coordinates; the base of the tree stays where it is.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import isfinite, pi
from pathlib import Path
from typing import Any

import numpy as np

from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.files.formats import read
from graphs.geometry import frame_about
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids, LinkShape
from graphs.printing import plain
from graphs.tolerances import DOUBLE, leading
from graphs.types import Floats, JointId, LinkId
from synth.analysis.compliance.springs import Springs
from synth.analysis.folding.configuration import SheetConfiguration
from synth.analysis.motion.closure import corrected
from synth.analysis.motion.configuration import Configuration
from synth.analysis.motion.driven_motion import DrivenMotion, MotionOptions, driven_from
from synth.analysis.motion.linkage import Linkage, moved, placed_links
from synth.analysis.moving._configuration_of import Movable, configuration_of
from synth.making.simulation.bodies import Bar, Body, Hinge, MassProperties, Plate, Polyhedron, Shape, Shell, TreeJoint
from synth.making.simulation.connections import CutHinge, Parting, connections
from synth.making.simulation.shells import shells_of
from synth.making.templates.template import unit_of
from synth.making.templates.unfolding import Plane

FRAMES = 40
"""Frames of the motion that comes with the bodies."""
DENSITY = 1000.0
"""Default density, kilograms per cubic metre."""
_METRE = 1000.0
_THIN = 0.01
"""Default thickness, as part of the extent."""
_PIN = 0.1
"""Half the length of a hinge of links that are no panels, as part of the extent."""
_LOOKED_AT = 8
"""Configurations of the motion at which loops are examined."""
_IMPROBABLE = 50.0
"""Metres: an extent from which on a unit that nothing states was probably no metre."""
_LARGEST, _NAME = 1e6, 60


@dataclass(frozen=True, slots=True)
class AssemblyOptions:
    """How bodies are made.

    Attributes
    ----------
    thickness : float, optional
        Of panels, and diameter of bars, in millimetres; by default a hundredth of the extent.
    density : float, optional
        Kilograms per cubic metre.
    scale, size : float, optional
        Millimetres per unit of the coordinates, by default that of the file's unit, or 1000: the unit is a metre;
        or longest side of the mechanism in millimetres.
    drive : mapping of joint id to float, optional
        As for `synth.move`: these joints get actuators. By default the joint that moves most.
    branch : int or str, optional
        Motion branch, as for `synth.move`.
    springs : Springs, optional
        Newton metres per radian, and constant moments at joints in newton metres.
    shapes : tuple of LinkShape, optional
        Solids of links, in the unit of the axes; by default bars between hinges.

    Examples
    --------
    >>> AssemblyOptions(thickness=2.0, size=300.0).density
    1000.0
    """

    thickness: float | None = None
    density: float = DENSITY
    scale: float | None = None
    size: float | None = None
    drive: Mapping[JointId, float] = field(default_factory=dict)
    branch: int | str | None = None
    springs: Springs = field(default_factory=Springs)
    shapes: tuple[LinkShape, ...] = ()

    def __post_init__(self) -> None:
        for name in ("thickness", "density", "scale", "size"):
            value = getattr(self, name)
            if value is not None and not (isfinite(value) and 0.0 < value <= _LARGEST):
                raise InvariantError(name, f"{name} {value!r}", f"a positive number, at most {_LARGEST:g}")
        if self.scale is not None and self.size is not None:
            raise InvariantError("scale", "both a scale and a size", "one of them")


@dataclass(frozen=True, eq=False)
class Assembly:
    """Bodies and hinges at a closed configuration.

    Attributes
    ----------
    configuration : Configuration
        The mechanism that it was made of, where its motion began.
    options : AssemblyOptions
    bodies : tuple of Body
    hinges : tuple of Hinge
        In the order of the joints of the mechanism.
    tree : tuple of TreeJoint
        From the base outwards, so that each body is carried before it carries.
    bases : tuple of int
        Bodies that stay: one for each part of the mechanism.
    cuts : tuple of CutHinge
        The hinges outside the tree.
    path : float[F, hinges]
        Joint angles of the motion on which it was made, radians, lengths of slides metres; a single row if nothing
        moves.
    driven : tuple of int
        Hinges that get actuators.
    closing : float[tree, rank]
        An orthonormal basis of the equations that close the loops, in rates of the tree; lengths are in extents.
    residual : float
        Loop-closure residual.
    size, thickness : float
        Extent of the mechanism, and thickness of panels or diameter of bars, metres.
    notes : tuple of str
        What was chosen, and what is missing.

    Examples
    --------
    >>> import synth
    >>> bennett = assembly_of(synth.generate("bennett").mechanism)
    >>> len(bennett.bodies), len(bennett.tree), len(bennett.cuts), bennett.freedoms
    (4, 3, 1, 1)
    """

    configuration: Configuration
    options: AssemblyOptions
    bodies: tuple[Body, ...]
    hinges: tuple[Hinge, ...]
    tree: tuple[TreeJoint, ...]
    bases: tuple[int, ...]
    cuts: tuple[CutHinge, ...]
    path: Floats
    driven: tuple[int, ...]
    closing: Floats
    residual: float
    size: float
    thickness: float
    notes: tuple[str, ...] = ()

    @property
    def freedoms(self) -> int:
        """Degrees of freedom of the tree with its loops closed, by rank at the configuration."""
        return len(self.tree) - int(self.closing.shape[1])

    def origin(self, body: int) -> Floats:
        """Return the origin of the frame of a body, float[3]: a point of the hinge that carries it."""
        return self._origins.get(body, np.zeros(3))

    @cached_property
    def _origins(self) -> dict[int, Floats]:
        return {joint.child: self.hinges[joint.hinge].point for joint in self.tree}

    def neighbours(self) -> list[tuple[int, int]]:
        """Return the pairs of bodies that share a point of a hinge or a corner: they touch at all times."""
        touching: dict[tuple[int, ...], set[int]] = {}
        grain = max(self.thickness, DOUBLE.meant * self.size)
        for hinge in self.hinges:
            for end in (-hinge.reach, hinge.reach):
                key = tuple(np.round((hinge.point + end * hinge.direction) / grain).astype(int).tolist())
                touching.setdefault(key, set()).update((hinge.first, hinge.second))
        pairs = {(min(h.first, h.second), max(h.first, h.second)) for h in self.hinges}
        for bodies in touching.values():
            pairs |= {(a, b) for a in bodies for b in bodies if a < b}
        return sorted(pairs)


def assembly_of(mechanism: Movable, options: AssemblyOptions | None = None) -> Assembly:
    """Return a mechanism as rigid bodies and hinges, with a spanning tree and what closes the loops.

    A regular configuration is kept; from a singular one, such as a flat sheet, it is taken along the motion that
    `synth.move` makes, to the middle.

    Parameters
    ----------
    mechanism : anything that `synth.analysis.moving._configuration_of.configuration_of` takes
    options : AssemblyOptions, optional

    Raises
    ------
    UnsolvableError
        If it has no coordinates or nothing solid, driven joints cannot be driven, slides close a loop without a
        hinge, or a panel is not planar.
    InvariantError
        If there is no such joint or branch.

    Examples
    --------
    >>> import synth
    >>> miura = assembly_of(synth.generate("miura").mechanism, AssemblyOptions(size=300, thickness=1))
    >>> miura.freedoms, len(miura.cuts), [len(cut.connects) for cut in miura.cuts]
    (1, 4, [1, 1, 1, 1])
    """
    if isinstance(mechanism, str | Path):
        mechanism = read(mechanism)
    options = in_unit_of(mechanism, options or AssemblyOptions())
    at = configuration_of(mechanism, slides=True)
    options.springs.check_joints(at.joints)
    if not at.joints and not isinstance(at, SheetConfiguration):
        raise UnsolvableError(
            "nothing is solid: links without panels get their shape from their joints, and there are none"
        )
    driven, notes = _motion(at, options)
    linkage = at.linkage
    path = linkage.angles[None] if driven is None else driven.path.angles
    regular = at.branches is not None and at.branches.regular
    here = linkage.angles if regular or driven is None else path[len(path) // 2]
    there = corrected(at.closure, here)
    angles, residual = there.angles, there.error
    linkage = moved(linkage, angles)
    unit_length = _unit(linkage, at, options)
    metre = linkage.extent * unit_length
    if options.size is None and options.scale is None and unit_length == 1.0 and metre >= _IMPROBABLE:
        notes = (*notes, f"coordinates are taken as metres: an extent of {metre:.3g} m; --scale or --size changes it")
    thickness = _thickness(options, metre)
    drivers = () if driven is None else tuple(driven.places)
    hinges = _hinges(at, linkage, metre, options, unit_length)
    on_surface = shells_of(mechanism if at.given is None else at.given, linkage, angles, metre, thickness)
    bodies = _bodies(at, linkage, hinges, angles, metre, options.density, thickness, on_surface, options.shapes)
    lengths = np.where(np.isin(np.arange(len(hinges)), linkage.slides), metre, 1.0)
    tree, bases, cut = spanning_tree(at, hinges, drivers)
    few = path[:: max(1, len(path) // _LOOKED_AT)]
    on_the_way = [_hinges(at, moved(linkage, each), metre, options, unit_length) for each in few]
    cuts, closing = connections([hinges, *on_the_way], tree, cut, len(bodies), metre, at.tolerances.singular)
    freedoms = len(tree) - closing.shape[1]
    alone = len(bodies) - len({body for hinge in hinges for body in (hinge.first, hinge.second)})
    if alone and not isinstance(at, SheetConfiguration):
        notes = (*notes, f"{numbered(alone, 'link')} without joints: of unknown shape, a bar in the file")
    if driven is not None and freedoms > len(drivers):
        notes = (*notes, f"{freedoms} degrees of freedom, {len(drivers)} driven: others are free")
    return Assembly(
        at,
        options,
        bodies,
        hinges,
        tree,
        bases,
        cuts,
        path * lengths,
        drivers,
        closing,
        residual,
        metre,
        thickness,
        notes,
    )


def in_unit_of(mechanism: object, options: AssemblyOptions) -> AssemblyOptions:
    """Return options with the scale of the unit that the file of a sheet names, unless they state a scale or a size."""
    if options.scale is not None or options.size is not None or not isinstance(mechanism, Sheet):
        return options
    return replace(options, scale=unit_of(mechanism))


def _motion(at: Configuration, options: AssemblyOptions) -> tuple[DrivenMotion | None, tuple[str, ...]]:
    """Return the motion that a mechanism makes, None if nothing moves, with a line that says why it ended."""
    wanted = MotionOptions(options.drive, branch=options.branch, frames=FRAMES)
    if not at.joints:
        return None, ("no joints: nothing moves",)
    try:
        driven = driven_from(at, wanted)
    except UnsolvableError as error:
        if options.drive or options.branch is not None:
            raise
        return None, (f"no actuators: {error}",)
    notes = [f"the motion ends before its goal: {driven.path.stopped}"] if driven.path.stopped else []
    if turns_back(driven.path.angles[:, list(driven.places)]):
        notes.append(
            "the driven joint turns back on the way, so a motor at it cannot drive the whole motion; try another joint"
        )
    return driven, tuple(notes)


def turns_back(values: Floats) -> bool:
    """Check whether one joint, float[F] or float[F, 1], goes back on its way; False for several joints."""
    steps = np.diff(values.reshape(len(values), -1), axis=0)
    return steps.shape[1] == 1 and bool((steps < 0.0).any() and (steps > 0.0).any())


def _unit(linkage: Linkage, at: Configuration, options: AssemblyOptions) -> float:
    """Return metres per unit of the coordinates."""
    if options.size is None:
        return (_METRE if options.scale is None else options.scale) / _METRE
    points = linkage.points * linkage.extent
    if isinstance(at, SheetConfiguration):
        points = np.array([[*corner, 0.0][:3] for corner in at.sheet.coordinates or ()])
    longest = float(np.ptp(points, axis=0).max(initial=0.0)) or linkage.extent
    return options.size / _METRE / longest


def _thickness(options: AssemblyOptions, metre: float) -> float:
    """Return the thickness of panels and bars, metres; UnsolvableError where it is none beside the extent."""
    if options.thickness is None:
        return metre * _THIN
    thickness = options.thickness / _METRE
    if thickness <= DOUBLE.same_point * metre:
        sizes = f"the thickness is {options.thickness:g} mm at an extent of {_METRE * metre:.3g} mm"
        raise UnsolvableError(f"nothing is solid: {sizes}; try a larger thickness")
    return thickness


def _hinges(
    at: Configuration, linkage: Linkage, metre: float, options: AssemblyOptions, unit_length: float
) -> tuple[Hinge, ...]:
    number = {link: place for place, link in enumerate(linkage.graph.nodes)}
    points, reaches = _places(at, linkage)
    middle = linkage.middle * unit_length
    springs, names = options.springs, _names("joint", linkage.graph.joints)
    hinges, limits = [], _limits(at)
    for place, (joint, (first, second)) in enumerate(linkage.graph.joints.items()):
        slide = place in linkage.slides
        angle = float(linkage.angles[place]) * (metre if slide else 1.0)
        hinges.append(
            Hinge(
                names[place], joint, number[first], number[second], points[place] * metre + middle,
                linkage.directions[place], float(reaches[place]) * metre, angle, slide, limits[place],
                springs.stiffness.get(joint, 0.0), springs.rest.get(joint, angle), springs.moments.get(joint, 0.0),
            )
        )  # fmt: skip
    return tuple(hinges)


def _limits(at: Configuration) -> list[tuple[float, float] | None]:
    """Return the least and the greatest angle of each joint, None for joints that turn all round.

    Panels end where they lie on each other. The material of two solid panels at a hinge lets it turn to one side
    only, from the flat state.
    """
    if not at.limited:
        return [None] * len(at.linkage.angles)
    senses = at.marks.tolist() if isinstance(at.given, HingedSolids) else [0.0] * len(at.linkage.angles)
    return [(min(sense, 0.0) * pi, max(sense, 0.0) * pi) if sense else (-pi, pi) for sense in senses]


def _names(kind: str, ids: Iterable[object]) -> list[str]:
    """Return different names for ids, fit for any file: without spaces, at which MuJoCo splits lists of names."""
    names: list[str] = []
    for one in ids:
        name = "_".join(plain(f"{kind}_{one}", _NAME).split())
        while name in names:
            name += "_"
        names.append(name)
    return names


def _places(at: Configuration, linkage: Linkage) -> tuple[Floats, Floats]:
    """Return where hinges are on their axes, float[J, 3], and half their lengths, float[J], in extents.

    A crease is where its edge is. Of other axes a point is known: where those of two joints of a link coincide,
    both go outwards along their axes.
    """
    if isinstance(at, SheetConfiguration):
        corners = np.array([[*corner, 0.0][:3] for corner in at.sheet.coordinates or ()])
        hinges: Mapping[JointId, Any] = at.mechanism.hinges  # type: ignore[assignment]  # numbers of edges
        ends = np.array([hinges[joint] for joint in linkage.graph.joints], dtype=np.int64).reshape(-1, 2)
        return linkage.points, np.linalg.norm(corners[ends[:, 1]] - corners[ends[:, 0]], axis=1) / (
            2.0 * linkage.extent
        )
    of_link: dict[LinkId, list[int]] = {link: [] for link in linkage.graph.nodes}
    for place, ends_of in enumerate(linkage.graph.joints.values()):
        for link in ends_of:
            of_link[link].append(place)
    points = linkage.points
    all_one = float(np.ptp(points, axis=0).max(initial=0.0)) <= DOUBLE.same_point
    out = np.zeros(len(points))
    for places in of_link.values():
        for one in places:
            for other in places:
                if one != other and np.linalg.norm(points[one] - points[other]) <= DOUBLE.same_point:
                    out[one] = 1.0 if all_one else 2.0 * _PIN
    return points + out[:, None] * linkage.directions, np.full(len(points), _PIN)


def _bodies(
    at: Configuration, linkage: Linkage, hinges: Sequence[Hinge], angles: Floats, metre: float, density: float,
    thickness: float, shells: Mapping[LinkId, Shell], solids: Sequence[LinkShape],
) -> tuple[Body, ...]:  # fmt: skip
    names = _names("link", linkage.graph.nodes)
    bodies = []
    turns, shifts = (part[0] for part in placed_links(at.linkage, angles[None]))
    for number, link in enumerate(linkage.graph.nodes):
        if link in shells:
            shapes: list[Shape] = [shells[link]]
        elif any(solid.link == link for solid in solids):
            own = [solid for solid in solids if solid.link == link]
            shapes = _polyhedra(at, own, (turns[number], shifts[number]), metre)
        elif isinstance(at, SheetConfiguration):
            shapes = _plates(at, number, (turns[number], shifts[number]), metre, thickness)
        else:
            shapes = _bars([hinge for hinge in hinges if number in (hinge.first, hinge.second)], metre, thickness)
        parts = [shape.properties(density) for shape in shapes]
        bodies.append(Body(names[number], link, tuple(shapes), MassProperties.together(parts)))
    return tuple(bodies)


def _plates(
    at: SheetConfiguration, link: int, place: tuple[Floats, Floats], metre: float, thickness: float
) -> list[Shape]:
    """Return the panels of a link at a place: its rotation and its shift."""
    linkage, sheet, (rotation, shift) = at.linkage, at.sheet, place
    corners = (np.array([[*corner, 0.0][:3] for corner in sheet.coordinates or ()]) - linkage.middle) / linkage.extent
    there = (corners @ rotation.T + shift) * metre + linkage.middle * (metre / linkage.extent)
    return [Plate(Plane(there[list(sheet.faces[face])], face), thickness) for face in at.mechanism.panels[link]]


def _polyhedra(
    at: Configuration, solids: Sequence[LinkShape], place: tuple[Floats, Floats], metre: float
) -> list[Shape]:
    """Return the solids of a link at a place: its rotation and its shift."""
    linkage, (rotation, shift) = at.linkage, place
    shapes: list[Shape] = []
    for solid in solids:
        corners = (np.array(solid.corners) - linkage.middle) / linkage.extent
        there = (corners @ rotation.T + shift) * metre + linkage.middle * (metre / linkage.extent)
        shapes.append(Polyhedron(there, np.array(solid.triangles)))
    return shapes


def _bars(hinges: Sequence[Hinge], metre: float, thickness: float) -> list[Shape]:
    """Return a link that is known by its hinges: a pin along each, and bars from their middle to each."""
    radius, bars = thickness / 2.0, list[Shape]()
    points = np.array([hinge.point for hinge in hinges]).reshape(-1, 3)
    for hinge in hinges:
        half = hinge.reach * hinge.direction
        bars.append(Bar(hinge.point - half, hinge.point + half, radius))
    if len(points) == 1:  # an arm across the hinge
        arm = 2.0 * _PIN * metre * frame_about(hinges[0].direction)[0]
        return [*bars, Bar(points[0], points[0] + arm, radius)]
    if not len(points):
        return [Bar(np.zeros(3), np.array([_PIN * metre, 0.0, 0.0]), radius)]
    hub = points.mean(axis=0)
    spokes = [(points[0], points[1])] if len(points) == 2 else [(hub, point) for point in points]
    long = [(a, b) for a, b in spokes if np.linalg.norm(a - b) > DOUBLE.same_point * metre]
    return [*bars, *(Bar(a, b, radius) for a, b in long)]


def spanning_tree(
    at: Configuration, hinges: Sequence[Hinge], driven: Sequence[int]
) -> tuple[tuple[TreeJoint, ...], tuple[int, ...], tuple[int, ...]]:
    """Return a tree of the hinges, broad first, the bodies where it begins, and the hinges that it leaves out.

    Slides, driven hinges and those with springs or moments come first: a hinge that is cut has no place for these.
    """
    graph = at.linkage.graph
    around: list[list[int]] = [[] for _ in graph.nodes]
    for number, hinge in enumerate(hinges):
        around[hinge.first].append(number)
        around[hinge.second].append(number)
    forced = _forest(hinges, [*(n for n, h in enumerate(hinges) if h.slide), *driven], len(around))
    missing = [number for number, hinge in enumerate(hinges) if hinge.slide and number not in forced]
    if missing:
        raise UnsolvableError(f"the slides of a loop have no hinge among them: joint {shown(hinges[missing[0]].joint)}")
    left_out = [number for number in driven if number not in forced]
    if left_out:
        raise UnsolvableError(f"the driven joints form a loop: joint {shown(hinges[left_out[0]].joint)}")
    loaded = [number for number, hinge in enumerate(hinges) if hinge.stiffness or hinge.moment]
    forced |= _forest(hinges, [*sorted(forced), *loaded], len(around))
    degree = np.array([len(numbers) for numbers in around], dtype=float)
    first = list(graph.nodes).index(graph.ground) if graph.ground is not None else leading(degree) if len(degree) else 0
    carried, tree, bases = set[int](), list[TreeJoint](), list[int]()
    for root in (first, *range(len(around))):
        if root in carried:
            continue
        bases.append(root)
        _grow(root, hinges, around, forced, carried, tree)
    within = {joint.hinge for joint in tree}
    return tuple(tree), tuple(bases), tuple(number for number in range(len(hinges)) if number not in within)


def _grow(
    root: int, hinges: Sequence[Hinge], around: Sequence[Sequence[int]], forced: set[int], carried: set[int],
    tree: list[TreeJoint],
) -> None:  # fmt: skip
    """Grow a tree from a body: of what a body carries, all that forced hinges join comes with it."""
    waiting = list[int]()

    def carry(body: int) -> None:
        together = [body]
        carried.add(body)
        for inner in together:
            waiting.append(inner)
            for number in around[inner]:
                other = _other_end(hinges[number], inner)
                if number in forced and other not in carried:
                    tree.append(_joint(hinges[number], number, inner))
                    carried.add(other)
                    together.append(other)

    carry(root)
    for inner in waiting:
        for number in around[inner]:
            other = _other_end(hinges[number], inner)
            if other not in carried:
                tree.append(_joint(hinges[number], number, inner))
                carry(other)


def _other_end(hinge: Hinge, body: int) -> int:
    return hinge.second if hinge.first == body else hinge.first


def _joint(hinge: Hinge, number: int, parent: int) -> TreeJoint:
    return TreeJoint(number, parent, _other_end(hinge, parent), 1.0 if hinge.first == parent else -1.0)


def _forest(hinges: Sequence[Hinge], numbers: Sequence[int], bodies: int) -> set[int]:
    """Return those of some hinges that make no circle with those before them."""
    part, kept = list(range(bodies)), set[int]()
    for number in numbers:
        a, b = part[hinges[number].first], part[hinges[number].second]
        if a != b:
            kept.add(number)
            part = [a if each == b else each for each in part]
    return kept


def driven_inertia(assembly: Assembly, number: int) -> float:
    """Return the inertia that a driven hinge has to move at the configuration, kg m2 (of a slide kg).

    The whole mechanism moves with it, at the least rates of the tree that the loops allow.
    """
    parting = Parting(assembly.hinges, assembly.tree, len(assembly.bodies), assembly.size)
    wanted = np.zeros(len(assembly.tree))
    wanted[[joint.hinge for joint in assembly.tree].index(number)] = 1.0
    rates = wanted - assembly.closing @ (assembly.closing.T @ wanted)
    rates /= wanted @ rates * (assembly.size if assembly.hinges[number].slide else 1.0)
    inertia = 0.0
    for body, twist in zip(assembly.bodies, parting.twists(rates), strict=True):
        spin, properties = twist[:3], body.properties
        velocity = twist[3:] + np.cross(spin, properties.centre)
        inertia += properties.mass * velocity @ velocity + spin @ properties.inertia @ spin
    return float(inertia)
