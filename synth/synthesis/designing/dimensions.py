"""What may change of a mechanism: numbers from which its linkage is made, and how that depends on them.

Axes of joints (of spherical chains their directions, so arcs and angles of links), vertices of a sheet, parameters of
a generator, or azimuths on a cone with its angle. Each family of numbers gives linkages in one unit of length about
one middle, whatever the numbers are, so that closure equations of neighbouring designs compare. Theory:
docs/theory/design.md.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace
from math import inf, pi
from typing import Any, Protocol

import numpy as np
import scipy

from graphs.convert.conversions import Mechanism
from graphs.convert.duality import SheetMechanism, mechanism_of_sheet
from graphs.edit.named import known
from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.geometry import unit
from graphs.joints.linkage import JointedLinkage
from graphs.joints.revolutes import revolutes_of
from graphs.loops.loop import Centre
from graphs.mechanism.precision import in_space
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet, with_all_edges
from graphs.mechanism.solids import HingedSolids
from graphs.mechanism.surfaces import Cone, SurfaceLinkage, joint_axes
from graphs.types import Floats, Ints, JointId, LinkId
from synth.analysis.folding.derivatives import dependence_on_vertices, largest_panel
from synth.analysis.motion.derivatives import AxisDependence, dependence_on_axes, derivatives_by_parameters
from synth.analysis.motion.linkage import Linkage, linkage_of_axes, linkage_of_sheet
from synth.analysis.moving._configuration_of import Movable, configuration_of, linkage_of_closed_form, sheet_of
from synth.catalogue.patterns.generator import Generator
from synth.linkages.conformed.linkage_behaviour import OnSurface, linkage_on_surfaces
from synth.synthesis.designing.quadrilaterals import IMAGINARY, QuadrilateralSides, marched, miura_sides, sheet_of_sides

Designable = Movable | Generator
"""What `synth design` takes: a mechanism with coordinates, its file, or a generator."""

_STEEPEST = pi / 2 - 0.01
"""Radians, the largest angle of a cone: beyond it is a line."""


@dataclass(frozen=True, slots=True)
class DesignedLinkage:
    """A mechanism with certain numbers: its linkage, and the derivatives of that by the numbers.

    Attributes
    ----------
    linkage : Linkage
    dependence : AxisDependence
        Of its axes, and of joint angles at the file's configuration, by all n numbers.
    vertices, by_vertices : float[V, 3], float[V, 3, n]
        The vertices of a sheet, in units of the extent, and their derivatives; none of other mechanisms.
    """

    linkage: Linkage
    dependence: AxisDependence
    vertices: Floats
    by_vertices: Floats


class Dimensions(Protocol):
    """A family of mechanisms by numbers.

    Attributes
    ----------
    names : tuple of str
        The dimensions: joints whose axis may change, vertices, parameters.
    of : int[n]
        The dimension to which each number belongs.
    start : float[n]
    bounds : (float[n], float[n])
    scales : float[n]
        What 1 is for each number, where it is varied at random.
    sheet : Sheet or None
        The sheet at the start, of a mechanism of panels.
    ground : link
        The link that stays.
    """

    names: tuple[str, ...]
    of: Ints
    start: Floats
    bounds: tuple[Floats, Floats]
    scales: Floats
    sheet: Sheet | None
    ground: LinkId

    def linkage(self, numbers: Floats) -> DesignedLinkage:
        """Return the linkage that numbers float[n] make, with its derivatives."""

    def mechanism(self, numbers: Floats) -> Mechanism:
        """Return the mechanism that numbers float[n] make, to be judged and written."""


def dimensions_of(
    mechanism: Designable,
    *,
    fixed: Collection[str] = (),
    parameters: Mapping[str, float] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    closed_form: bool = False,
    ground: LinkId | None = None,
) -> Dimensions:
    """Return what may change of a mechanism.

    Parameters
    ----------
    mechanism : Mechanism, str, Path, Configuration, Linkage or Generator
        A sheet has its vertices, a linkage on a cone azimuths and the cone angle, a generator its parameters but
        counts; any other mechanism has the axes of its joints.
    fixed : collection of str, optional
        Dimensions that stay, by name; ``outline`` stands for all vertices on the border of a sheet.
    parameters : mapping of str to float, optional
        Of a generator: values to begin with, radians.
    bounds : mapping of str to (float, float), optional
        The least and largest value of parameters, or of azimuths and the cone angle, radians or lengths.
    closed_form : bool, optional
        Of the generator ``miura``: not its parameters may change, but corners and lengths on two sides of the sheet.
    ground : link id, optional
        The link that stays; by default the ground of the mechanism, or the largest panel of a sheet, else the first.

    Raises
    ------
    UnsolvableError
        If the mechanism has no coordinates, or nothing of it may change.
    InvariantError
        If there is no such dimension or parameter.

    Examples
    --------
    >>> from synth.catalogue.patterns import GENERATORS, generate
    >>> bennett = dimensions_of(GENERATORS["bennett"])
    >>> bennett.names
    ('first', 'twist', 'other')
    >>> dimensions_of(generate("miura", rows=2, columns=2).mechanism, fixed=["outline"]).names
    ('4',)
    """
    family: Dimensions
    if closed_form:
        if not isinstance(mechanism, Generator) or mechanism.name != "miura":
            raise UnsolvableError("closed_form is for sheets that begin as those of the generator miura")
        values = mechanism.values(parameters or {})
        rows, columns = int(values["rows"]), int(values["columns"])
        sides = miura_sides(rows, columns, values["sector"], values["straight"], values["zigzag"], 1.0)
        family = QuadrilateralDimensions(sides, fixed)
    elif isinstance(mechanism, Generator):
        family = ParameterDimensions(mechanism, parameters or {}, fixed)
    else:
        if parameters:
            raise UnsolvableError("parameters belong to generators, and this mechanism is none")
        given = mechanism if isinstance(mechanism, SurfaceLinkage | OnSurface) else configuration_of(mechanism).given
        on_cone = _on_cone(given) if isinstance(given, SurfaceLinkage | OnSurface) else None
        sheet = None if given is None or isinstance(given, SurfaceLinkage | OnSurface) else sheet_of(given)
        if on_cone is not None:
            family = ConeDimensions(on_cone, fixed)
        elif sheet is not None:
            family = VertexDimensions(sheet, fixed)
        else:
            linkage = configuration_of(mechanism).linkage
            points = linkage.points * linkage.extent + linkage.middle
            family = AxisDimensions(linkage.graph, np.hstack([points, linkage.directions]), fixed)
    if not len(family.start):
        raise UnsolvableError("nothing of the mechanism may change: all its dimensions are fixed")
    _narrow(family, bounds or {})
    if ground is not None:
        family.ground = ground
    return family


def _narrow(family: Dimensions, bounds: Mapping[str, tuple[float, float]]) -> None:
    """Keep dimensions of one number within bounds, and begin there."""
    (low, high), own = family.bounds, np.bincount(family.of, minlength=len(family.names))
    single = [name for name, numbers in zip(family.names, own, strict=True) if numbers == 1]
    for name, (least, most) in bounds.items():
        if name not in single:
            what = f"there is no dimension {shown(name)} of one number that may change"
            raise InvariantError("bounds", what, known(single, name) if single else "parameters of a generator")
        place = int(np.flatnonzero(family.of == family.names.index(name))[0])
        low[place], high[place] = max(low[place], least), min(high[place], most)
        if not low[place] < high[place]:
            raise InvariantError("bounds", f"{name} from {low[place]:g} to {high[place]:g}", "the smaller one first")
    family.start = np.clip(family.start, low, high)


def _on_cone(linkage: SurfaceLinkage | OnSurface) -> OnSurface | None:
    """Return a linkage where it lies on its one cone; None on a cylinder."""
    if isinstance(linkage, SurfaceLinkage):
        if linkage.surface is not None and not isinstance(linkage.surface, Cone):
            return None
        linkage = linkage_on_surfaces(linkage)[0]
    return linkage if isinstance(linkage.surface, Cone) else None


def _check_fixed(fixed: Collection[str], names: Sequence[str], what: str) -> None:
    for name in fixed:
        if name not in names:
            raise InvariantError("fixed", f"there is no {what} {shown(name)}", known(names, name))


def _grouped(of: Sequence[int], names: Sequence[str]) -> tuple[tuple[str, ...], Ints]:
    """Return the names of the dimensions that have numbers, and the place of each number's among these."""
    changing = sorted(set(of))
    return tuple(names[place] for place in changing), np.array([changing.index(place) for place in of], dtype=np.int64)


_NO_VERTICES = np.zeros((0, 3))


class AxisDimensions:
    """The axes of joints: a point and a direction of each, three coordinates each.

    Axes of loops about a centre keep passing through it and turn, those of planar loops stay parallel and move; an
    axis that belongs to two centres stays. Lengths of directions, and points along an axis, mean nothing.

    Parameters
    ----------
    chain : SCGraph
    lines : float[J, 6]
        A point and a unit vector of each joint.
    fixed : collection of str, optional
        Joints whose axes stay.

    Examples
    --------
    >>> from synth.catalogue.patterns import generate
    >>> ring = dimensions_of(generate("four-bar").mechanism, fixed=["0"])
    >>> ring.names, len(ring.start)
    (('1', '2', '3'), 9)
    """

    sheet: Sheet | None = None

    def __init__(self, chain: SCGraph, lines: Floats, fixed: Collection[str] = ()) -> None:
        self.chain, self._lines = chain, np.array(lines, dtype=float)
        self.ground = chain.ground if chain.ground is not None else next(iter(chain.nodes))
        self._first = linkage_of_axes(chain, _axes_of(chain, self._lines))
        names = [str(joint) for joint in chain.joints]
        _check_fixed(fixed, names, "joint")
        kept = np.zeros((len(names), 6), dtype=bool)
        for place, joint in enumerate(chain.joints):
            centres = [one.centre for one in chain.centre_classes() if joint in one.joints]
            kept[place, :3] = Centre.FINITE in centres
            kept[place, 3:] = Centre.INFINITE in centres
            if len(centres) > 1 or names[place] in fixed:
                kept[place] = True
        self._free = np.flatnonzero(~kept.ravel())
        self.start = self._lines.ravel()[self._free]
        self.names, self.of = _grouped((self._free // 6).tolist(), names)
        self.bounds = (np.full(len(self.start), -inf), np.full(len(self.start), inf))
        self.scales = np.where(self._free % 6 < 3, self._first.extent, 1.0)

    def begun_at(self, mechanism: HingedSolids) -> AxisDimensions:
        """Return the same family, in the same unit, begun at other axes of the chain: what stays are theirs too."""
        other = copy(self)
        axes = [mechanism.axes[joint] for joint in self.chain.joints]
        lines = np.array([[*point, *along] for point, along in axes], dtype=float)
        other._lines = np.hstack([lines[:, :3], unit(lines[:, 3:])])
        other.start = np.clip(other._lines.ravel()[self._free], *self.bounds)
        return other

    def _with(self, numbers: Floats) -> Floats:
        lines = self._lines.ravel().copy()
        lines[self._free] = numbers
        return lines.reshape(-1, 6)

    def linkage(self, numbers: Floats) -> DesignedLinkage:
        """Return the linkage with axes of these numbers."""
        lines, first = self._with(numbers), self._first
        points, directions = (lines[:, :3] - first.middle) / first.extent, unit(lines[:, 3:])
        by_lines = dependence_on_axes(replace(first, points=points, directions=directions))
        sizes = np.linalg.norm(lines[:, 3:], axis=1, keepdims=True)
        scale = np.hstack([np.ones_like(points), np.repeat(1.0 / sizes, 3, axis=1)]).ravel()
        twists = (by_lines.twists @ scipy.sparse.diags_array(scale)).tocsr()[:, self._free]
        dependence = AxisDependence(twists, by_lines.zeros[:, self._free])
        linkage = replace(first, points=points, directions=directions)
        return DesignedLinkage(linkage, dependence, _NO_VERTICES, np.zeros((0, 3, len(numbers))))

    def mechanism(self, numbers: Floats) -> HingedSolids:
        """Return hinged solids with axes of these numbers."""
        lines = self._with(numbers)
        lines[:, 3:] = unit(lines[:, 3:])
        return HingedSolids(self.chain, _axes_of(self.chain, lines))


def _axes_of(chain: SCGraph, lines: Floats) -> dict[JointId, Any]:
    return {joint: (tuple(line[:3]), tuple(line[3:])) for joint, line in zip(chain.joints, lines.tolist(), strict=True)}


class VertexDimensions:
    """The coordinates of the vertices of a sheet, flat or folded.

    Parameters
    ----------
    sheet : Sheet
        With coordinates.
    fixed : collection of str, optional
        Vertices that stay, by number; ``outline`` for those on the border.

    Examples
    --------
    >>> from synth.catalogue.patterns import generate
    >>> VertexDimensions(generate("miura", rows=2, columns=2).mechanism, fixed=["0"]).names
    ('1', '2', '3', '4', '5', '6', '7', '8')
    """

    def __init__(self, sheet: Sheet, fixed: Collection[str] = ()) -> None:
        sheet = with_all_edges(sheet)
        if sheet.coordinates is None:
            raise UnsolvableError("dimensions need coordinates, and the sheet has none; try synth realise")
        if len(sheet.coordinates[0]) > 2 and any(len(face) > 3 for face in sheet.faces):
            raise UnsolvableError(
                "vertices of a folded sheet whose panels have more than three corners cannot change freely; "
                "try the flat sheet, or a generator"
            )
        self.sheet: Sheet | None = sheet
        self._flat = sheet
        self._mechanism = mechanism_of_sheet(sheet)
        self._first = linkage_of_sheet(sheet, self._mechanism)
        self._places = np.array(sheet.coordinates, dtype=float)
        count, per = self._places.shape
        names = [str(vertex) for vertex in range(count)]
        _check_fixed([name for name in fixed if name != "outline"], names, "vertex")
        border = outline_of(sheet) if "outline" in fixed else set()
        free = [vertex for vertex in range(count) if names[vertex] not in fixed and vertex not in border]
        self._free = (per * np.array(free, dtype=np.int64)[:, None] + np.arange(per)).ravel()
        self.start = self._places.ravel()[self._free]
        self.names, self.of = _grouped((self._free // per).tolist(), names)
        self.bounds = (np.full(len(self.start), -inf), np.full(len(self.start), inf))
        ends = np.array([sheet.coordinates[v] for edge in sheet.edges for v in edge]).reshape(-1, 2, per)
        lengths = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
        self.scales = np.full(len(self.start), float(np.median(lengths)))
        self.ground = list(self._first.graph.nodes)[largest_panel(self._mechanism.panels)]

    def mechanism(self, numbers: Floats) -> Sheet:
        """Return the sheet with vertices at these numbers, of the same panels and assignment."""
        places = self._places.ravel().copy()
        places[self._free] = numbers
        coordinates = tuple(map(tuple, places.reshape(self._places.shape).tolist()))
        return replace(self._flat, coordinates=coordinates, frames=None, precision=None, reading=None)

    def linkage(self, numbers: Floats) -> DesignedLinkage:
        """Return the linkage of the sheet with vertices at these numbers."""
        sheet = self.mechanism(numbers)
        return sheet_linkage(sheet, self._mechanism, self._first, np.eye(self._places.size)[:, self._free])


def outline_of(sheet: Sheet) -> set[int]:
    """Return the vertices on the border of a sheet."""
    return {
        vertex for edge, letter in zip(sheet.edges, sheet.assignments, strict=True) if letter == "B" for vertex in edge
    }


def sheet_linkage(sheet: Sheet, mechanism: SheetMechanism, first: Linkage, slopes: Floats) -> DesignedLinkage:
    """Return the linkage of a sheet in the unit of a first one; slopes are of coordinates by numbers."""
    assert sheet.coordinates is not None
    own = linkage_of_sheet(sheet, mechanism)
    points = (own.points * own.extent + own.middle - first.middle) / first.extent
    linkage = replace(own, points=points, extent=first.extent, middle=first.middle)
    vertices = (in_space(sheet.coordinates) - first.middle) / first.extent
    by_vertices = np.zeros((*vertices.shape, slopes.shape[1]))
    width = len(sheet.coordinates[0])
    by_vertices[:, :width] = slopes.reshape(len(vertices), width, -1) / first.extent
    dependence = dependence_on_vertices(sheet, mechanism, linkage).after(slopes)
    return DesignedLinkage(linkage, dependence, vertices, by_vertices)


class ConeDimensions:
    """The azimuths of joints on a cone, its apex at the origin, and the cone angle.

    Parameters
    ----------
    linkage : OnSurface
        On a cone.
    fixed : collection of str, optional
        Joints that stay, and ``cone_angle``.

    Examples
    --------
    >>> from synth.linkages.conformed.linkage_behaviour import loop_on_cones
    >>> ConeDimensions(loop_on_cones(np.radians([120, 95, 45, 85]))[0]).names
    ('1', '2', '3', '4', 'cone_angle')
    """

    sheet: Sheet | None = None

    def __init__(self, linkage: OnSurface, fixed: Collection[str] = ()) -> None:
        assert isinstance(linkage.surface, Cone)
        self._first = linkage_of_closed_form(linkage)
        self.chain = self._first.graph
        self._arcs = linkage
        self.ground = self.chain.ground if self.chain.ground is not None else next(iter(self.chain.nodes))
        names = [*(str(joint) for joint in self.chain.joints), "cone_angle"]
        _check_fixed(fixed, names, "dimension")
        self._all = np.array([*linkage.places, linkage.surface.angle])
        self._free = np.array([place for place, name in enumerate(names) if name not in fixed], dtype=np.int64)
        self.start = self._all[self._free]
        self.names, self.of = _grouped(self._free.tolist(), names)
        last = self._free == len(names) - 1
        self.bounds = (np.where(last, 0.0, -inf), np.where(last, _STEEPEST, inf))
        self.scales = np.ones(len(self.start))

    def begun_at(self, mechanism: SurfaceLinkage) -> ConeDimensions:
        """Return the same family begun at another cone and other azimuths of the chain."""
        assert isinstance(mechanism.surface, Cone)
        other = copy(self)
        other._all = np.array([*linkage_on_surfaces(mechanism)[0].places, mechanism.surface.angle])
        other.start = np.clip(other._all[self._free], *self.bounds)
        return other

    def _with(self, numbers: Floats) -> Floats:
        every = self._all.copy()
        every[self._free] = numbers
        return every

    def linkage(self, numbers: Floats) -> DesignedLinkage:
        """Return the linkage at these azimuths."""
        every = self._with(numbers)
        places, angle = every[:-1], every[-1]
        directions = joint_axes(places, angle)
        linkage = replace(self._first, directions=directions)
        c, s = np.cos(angle), np.sin(angle)
        joints = len(places)
        slopes = np.zeros((joints, 6, joints + 1))
        at = np.arange(joints)
        slopes[at, 3, at], slopes[at, 5, at] = c * np.cos(places), -c * np.sin(places)
        slopes[:, 3, -1], slopes[:, 4, -1], slopes[:, 5, -1] = -s * np.sin(places), -c, -s * np.cos(places)
        dependence = dependence_on_axes(linkage).after(slopes.reshape(6 * joints, -1)[:, self._free])
        return DesignedLinkage(linkage, dependence, _NO_VERTICES, np.zeros((0, 3, len(numbers))))

    def mechanism(self, numbers: Floats) -> SurfaceLinkage:
        """Return the linkage on its cone."""
        every = self._with(numbers)
        return SurfaceLinkage.placed(self._arcs.chain, every[:-1].tolist(), Cone(float(every[-1])))


def family_begun_at(family: Dimensions, mechanism: HingedSolids | SurfaceLinkage) -> Dimensions:
    """Return the same family begun at another mechanism of its type.

    Raise UnsolvableError for families of sheets and generators: the first have rules that are read off the sheet, the
    others begin at parameters.
    """
    if isinstance(family, AxisDimensions) and isinstance(mechanism, HingedSolids):
        return family.begun_at(mechanism)
    if isinstance(family, ConeDimensions) and isinstance(mechanism, SurfaceLinkage):
        return family.begun_at(mechanism)
    raise UnsolvableError("only axes of a chain, and azimuths on a cone, can begin at another mechanism")


class ParameterDimensions:
    """The lengths and angles that a generator takes; its counts stay.

    Parameters
    ----------
    generator : Generator
    values : mapping of str to float
        Values to begin with; counts too.
    fixed : collection of str, optional

    Examples
    --------
    >>> from synth.catalogue.patterns import GENERATORS
    >>> miura = ParameterDimensions(GENERATORS["miura"], {"rows": 2, "columns": 3})
    >>> miura.names, miura.start.round(3).tolist()
    (('sector', 'straight', 'zigzag'), [1.047, 1.0, 1.0])
    """

    def __init__(self, generator: Generator, values: Mapping[str, float], fixed: Collection[str] = ()) -> None:
        self.generator, self._values = generator, generator.values(values)
        _check_fixed(fixed, list(self._values), "parameter")
        free = [one for one in generator.parameters if one.unit != "count" and one.name not in fixed]
        self.names, self.of = tuple(one.name for one in free), np.arange(len(free))
        self.start = np.array([self._values[one.name] for one in free], dtype=float)
        self.bounds = (np.array([float(one.least) for one in free]), np.array([float(one.most) for one in free]))
        self.scales = np.where(self.start == 0.0, 1.0, np.abs(self.start))
        made = self._made(self.start)
        self._panels = mechanism_of_sheet(made) if isinstance(made, Sheet) else None
        self.sheet = made if isinstance(made, Sheet) else None
        self._first = linkage_of_sheet(made, self._panels) if isinstance(made, Sheet) else _linkage_of(made)
        nodes = list(self._first.graph.nodes)
        self.ground = nodes[0] if self._panels is None else nodes[largest_panel(self._panels.panels)]

    def _made(self, numbers: Floats) -> Sheet | HingedSolids:
        values = {**self._values, **dict(zip(self.names, numbers.tolist(), strict=True))}
        made = self.generator.make(**values)
        if isinstance(made, JointedLinkage):
            made = revolutes_of(made)
        return with_all_edges(made) if isinstance(made, Sheet) else made

    def mechanism(self, numbers: Floats) -> Mechanism:
        """Return what the generator makes of these parameters; an error if one is out of range."""
        return self._made(numbers)

    def _raw(self, numbers: Floats) -> Floats:
        """Return coordinates of vertices, or points and unit vectors of axes."""
        made = self._made(numbers)
        if isinstance(made, Sheet):
            return np.array(made.coordinates, dtype=float)
        lines = np.array([[*point, *along] for point, along in made.axes.values()])
        return np.hstack([lines[:, :3], unit(lines[:, 3:])])

    def linkage(self, numbers: Floats) -> DesignedLinkage:
        """Return the linkage that the generator makes, with derivatives by its parameters."""
        made, first = self._made(numbers), self._first
        slopes = derivatives_by_parameters(self._raw, numbers).matrix
        if isinstance(made, Sheet):
            assert self._panels is not None
            return sheet_linkage(made, self._panels, first, slopes)
        lines = self._raw(numbers)
        points = (lines[:, :3] - first.middle) / first.extent
        linkage = replace(first, points=points, directions=lines[:, 3:])
        dependence = dependence_on_axes(linkage).after(slopes)
        return DesignedLinkage(linkage, dependence, _NO_VERTICES, np.zeros((0, 3, len(numbers))))


class QuadrilateralDimensions:
    """The corners and lengths on two sides of a flat-foldable sheet of quadrilaterals: all others follow.

    Whatever they are, the sheet folds rigidly (`synth.synthesis.designing.quadrilaterals`), so that no rule has to
    keep it so.

    Parameters
    ----------
    sides : QuadrilateralSides
        To begin with.
    fixed : collection of str, optional

    Examples
    --------
    >>> from synth.synthesis.designing.quadrilaterals import miura_sides
    >>> family = QuadrilateralDimensions(miura_sides(4, 4, 1.2, 1.0, 1.0, 0.5))
    >>> family.names[:2], len(family.names), family.grid
    (('left a 0', 'left a 1'), 26, (5, 5))
    """

    def __init__(self, sides: QuadrilateralSides, fixed: Collection[str] = ()) -> None:
        rows, columns = len(sides.heights), len(sides.widths)
        self.grid = (rows + 1, columns + 1)
        parts = (
            ("left a", rows + 1), ("left b", rows + 1), ("lower a", columns), ("lower b", columns), ("height", rows),
            ("width", columns),
        )  # fmt: skip
        names = [f"{part} {number}" for part, count in parts for number in range(count)]
        _check_fixed(fixed, names, "dimension")
        self._sides, self._all = sides, sides.numbers[:-1]
        self._free = np.array([place for place, name in enumerate(names) if name not in fixed], dtype=np.int64)
        self.names, self.of = _grouped(self._free.tolist(), names)
        self.start = self._all[self._free]
        corners = self._free < len(names) - rows - columns
        self.bounds = (np.zeros(len(self.start)), np.where(corners, pi, inf))
        self.scales = np.where(corners, 1.0, self.start)
        sheet = with_all_edges(sheet_of_sides(sides))
        self.sheet: Sheet | None = sheet
        self._mechanism = mechanism_of_sheet(sheet)
        self._first = linkage_of_sheet(sheet, self._mechanism)
        self.ground = list(self._first.graph.nodes)[largest_panel(self._mechanism.panels)]

    def _with(self, numbers: Floats) -> QuadrilateralSides:
        every = self._all.astype(numbers.dtype).reshape(-1, *[1] * (numbers.ndim - 1))
        every = np.repeat(every, numbers.shape[1], axis=1) if numbers.ndim > 1 else every.copy()
        every[self._free] = numbers
        return self._sides.at(np.concatenate([every, np.full((1, *numbers.shape[1:]), self._sides.fold)]))

    def mechanism(self, numbers: Floats) -> Sheet:
        """Return the flat sheet; `UnsolvableError` if its panels are not convex."""
        return with_all_edges(sheet_of_sides(self._with(numbers)))

    def linkage(self, numbers: Floats) -> DesignedLinkage:
        """Return the linkage of the sheet, with exact derivatives of its vertices."""
        moved = numbers[:, None] + 1j * IMAGINARY * np.eye(len(numbers))
        slopes = marched(self._with(moved))[0].imag / IMAGINARY
        return sheet_linkage(self.mechanism(numbers), self._mechanism, self._first, slopes.reshape(-1, len(numbers)))


def _linkage_of(solids: HingedSolids) -> Linkage:
    return linkage_of_axes(solids.chain, solids.axes)
