"""Panels of a thickness as plane-faced solids: slabs, and risers to hinges at another height, cut where they meet.

A panel is a stack of plies, prisms over plane outlines: a slab, and risers one thickness wide. Where panels that no
hinge joins would come nearer than a clearance on the motion, the ply that loses less volume is cut back: by all
places of the other, seen from it. Theory: docs/theory/thick-panels.md.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations, pairwise
from math import ceil, cos, pi, radians, sin
from typing import Any

import networkx as nx
import numpy as np
import shapely
from shapely.ops import substring

from graphs.convert.duality import SheetMechanism
from graphs.errors import UnsolvableError
from graphs.files.solids.meshes import SolidMesh
from graphs.geometry import unit
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import Sheet
from graphs.tolerances import DOUBLE, MARGIN
from graphs.types import Floats, Ints
from synth.making.templates.solids import pierced_plate
from synth.making.thickening.heights import HingeHeights
from synth.making.thickening.solid_collisions import ConvexPieces, MovingPieces, pieces_of, separations

_SIDES = 12
"""Sides of a bore."""
_STEP = radians(1.5)
"""Between places of the motion at which plies are compared no hinge turns by more; the clearance covers the rest."""


@dataclass(frozen=True)
class Ply:
    """A prism of a panel in the flat state, millimetres.

    Attributes
    ----------
    panel : int
    low, high : float
        Heights of its faces.
    outline : shapely geometry
        Polygons in the plane of the sheet.
    riser : bool
        Whether it leads from the slab to hinges at another height.
    """

    panel: int
    low: float
    high: float
    outline: Any
    riser: bool = False

    @property
    def volume(self) -> float:
        """Cubic millimetres."""
        return float(self.outline.area * (self.high - self.low))


def ring_about(centre: Sequence[float] | Floats, radius: float) -> list[tuple[float, float]]:
    """Return the corners of a regular polygon round a circle."""
    turns = [2.0 * pi * (side + 0.5) / _SIDES for side in range(_SIDES)]
    corner = radius / cos(pi / _SIDES)
    return [(float(centre[0] + corner * cos(turn)), float(centre[1] + corner * sin(turn))) for turn in turns]


class Plates(ABC):
    """Solids of panels in the flat state, millimetres: meshes, the panel of each, convex pieces."""

    cut: Mapping[int, float]

    @property
    @abstractmethod
    def meshes(self) -> tuple[SolidMesh, ...]:
        """The solids, millimetres."""

    @property
    @abstractmethod
    def panels(self) -> tuple[int, ...]:
        """The panel of each mesh."""

    @property
    @abstractmethod
    def volume(self) -> float:
        """Volume of all panels in cubic millimetres."""

    @property
    @abstractmethod
    def thinnest(self) -> float:
        """The width or height of the thinnest part, millimetres."""

    @abstractmethod
    def pieces(self) -> tuple[ConvexPieces, Ints]:
        """Return the solids as convex pieces, and which part each is of."""

    @abstractmethod
    def sections(self, panel: int) -> list[tuple[float, float, Any]]:
        """Return the outlines of a panel between heights, from below: float, float, shapely geometry."""

    def placed(self, rotations: Floats, shifts: Floats) -> list[SolidMesh]:
        """Return the solids where panels, rotated by float[P, 3, 3], then translated by float[P, 3], are."""
        return [
            SolidMesh(mesh.name, mesh.corners @ rotations[panel].T + shifts[panel], mesh.triangles)
            for mesh, panel in zip(self.meshes, self.panels, strict=True)
        ]


@dataclass(frozen=True)
class ThickPlates(Plates):
    """Panels as stacks of prisms, in the flat state.

    Attributes
    ----------
    plies : tuple of Ply
        Those of a panel do not overlap.
    cut : mapping of panel to float
        The volume that was cut off panels so that they do not meet, cubic millimetres.

    Examples
    --------
    >>> import synth
    >>> plates = synth.thicken(synth.generate("miura").mechanism, thickness=0.05, collisions=False).plates
    >>> len(plates.meshes) == len(plates.panels), len(set(plates.panels))
    (True, 9)
    """

    plies: tuple[Ply, ...]
    cut: Mapping[int, float]

    @cached_property
    def meshes(self) -> tuple[SolidMesh, ...]:
        """The solids, millimetres."""
        return tuple(_prism(part, ply, name) for part, ply, name in self._parts())

    @cached_property
    def panels(self) -> tuple[int, ...]:
        """The panel of each mesh."""
        return tuple(ply.panel for _, ply, _ in self._parts())

    @cached_property
    def volume(self) -> float:
        """Volume of all panels in cubic millimetres."""
        return sum(ply.volume for ply in self.plies)

    @cached_property
    def thinnest(self) -> float:
        """The least height of a slab or width of a ply, millimetres."""
        slab: dict[int, float] = defaultdict(float)
        for ply in self.plies:
            slab[ply.panel] += ply.high - ply.low
        parts = [part for ply in self.plies for part in polygons_of(ply.outline)]
        widths = 2.0 * shapely.length(shapely.maximum_inscribed_circle(np.array(parts)))
        return float(min([*slab.values(), *widths.tolist()], default=0.0))

    def sections(self, panel: int) -> list[tuple[float, float, Any]]:
        """Return the plies of a panel from below: heights of their faces, and outlines."""
        return sorted(
            ((ply.low, ply.high, ply.outline) for ply in self.plies if ply.panel == panel), key=lambda one: one[:2]
        )

    def pieces(self) -> tuple[ConvexPieces, Ints]:
        """Return plies as convex pieces, and the number of the ply that each is of, int[P]."""
        solids, bodies, of_ply = [], [], []
        for number, ply in enumerate(self.plies):
            for ring in convex_rings(ply.outline):
                solids.append(np.column_stack([np.tile(ring, (2, 1)), np.repeat([ply.low, ply.high], len(ring))]))
                bodies.append(ply.panel)
                of_ply.append(number)
        return pieces_of(solids, bodies), np.array(of_ply, dtype=np.int64)

    def _parts(self) -> list[tuple[Any, Ply, str]]:
        """Return the polygons of all plies with a name."""
        count: dict[int, int] = defaultdict(int)
        parts = []
        for ply in self.plies:
            for polygon in polygons_of(ply.outline):
                number = count[ply.panel]
                count[ply.panel] += 1
                parts.append((polygon, ply, f"panel {ply.panel}" + (f" part {number}" if number else "")))
        return parts


def thick_plates(
    sheet: Sheet, mechanism: SheetMechanism, heights: HingeHeights, thickness: float, scale: float,
    *, in_turns: bool = False,
) -> ThickPlates:  # fmt: skip
    """Return the solids of a flat sheet; risers are one thickness wide.

    Parameters
    ----------
    sheet : Sheet
    mechanism : SheetMechanism
        Of the sheet.
    heights : HingeHeights
        Of the sheet.
    thickness : float
        Millimetres.
    scale : float
        Millimetres per unit of the coordinates.
    in_turns : bool, optional
        The longer of two risers at a hinge takes the middle third of the crease, the other one the outer thirds.

    Raises
    ------
    UnsolvableError
        If a panel is not one polygon without holes, or too narrow.

    Examples
    --------
    >>> import synth
    >>> from synth.analysis.moving._configuration_of import configuration_of
    >>> at = configuration_of(synth.generate("miura").mechanism)
    >>> from synth.making.thickening.heights import hinge_heights
    >>> heights = hinge_heights(at.sheet, at.mechanism, at.tolerances)
    >>> thick_plates(at.sheet, at.mechanism, heights, 0.05, 1.0).meshes[0].name
    'panel 0'
    """
    corners = in_space(sheet.coordinates or ())[:, :2] * scale
    outlines = panel_outlines(sheet, mechanism, scale)
    parts: dict[int, list[tuple[float, float, Any]]] = {}
    for panel, outline in enumerate(outlines):
        width = 2.0 * shapely.maximum_inscribed_circle(outline).length
        if thickness > width:
            allowed = f"panel {panel} allows at most {width:.6g} mm, the diameter of its inscribed circle"
            raise UnsolvableError(
                f"thickness {thickness:g} mm: {allowed}; try a smaller --thickness, or a larger --scale"
            )
        base = heights.undersides[panel]
        parts[panel] = [(base, base + 1.0, outline)]
    for joint, links in mechanism.sc.joints.items():
        height = heights.hinges[int(str(joint))]
        leads = {int(str(link)): _lead(parts[int(str(link))][0], height) for link in links}
        longest = max(leads, key=lambda panel: (leads[panel], panel))
        for panel in leads:
            low, high, outline = parts[panel][0]
            if low - DOUBLE.meant <= height <= high + DOUBLE.meant:  # in thicknesses: on a side of the panel
                continue
            for a, b in mechanism.pieces[int(str(joint))]:
                line = shapely.LineString(corners[[a, b]])
                part = shapely.intersection(line.buffer(thickness, cap_style="flat"), outline)
                if in_turns:
                    middle = substring(line, 1.0 / 3.0, 2.0 / 3.0, normalized=True)
                    taken = middle.buffer(2.0 * thickness, cap_style="flat")
                    part = (shapely.intersection if panel == longest else shapely.difference)(part, taken)
                elif part.geom_type != "Polygon" or part.interiors:
                    raise UnsolvableError(
                        f"panel {panel} is narrower than the riser of crease {joint}, {thickness:g} mm wide; "
                        f"try a smaller --thickness"
                    )
                parts[panel].append((min(high, height), max(low, height), part))
    plies = [
        Ply(panel, low * thickness, high * thickness, outline, not solids[0][0] < (low + high) / 2.0 < solids[0][1])
        for panel, solids in parts.items() for low, high, outline in _stacked(solids)
    ]  # fmt: skip
    return ThickPlates(tuple(plies), {})


def _lead(slab: tuple[float, float, Any], height: float) -> float:
    """Return how far a hinge is from the nearer side of a slab, 0 if it is on one."""
    return max(slab[0] - height, height - slab[1], 0.0)


def panel_outlines(sheet: Sheet, mechanism: SheetMechanism, scale: float) -> list[Any]:
    """Return the outline of each panel, millimetres; refuse one with a hole or of several parts."""
    corners = in_space(sheet.coordinates or ())[:, :2] * scale
    outlines = []
    for panel, faces in enumerate(mechanism.panels):
        outline = shapely.union_all([shapely.Polygon(corners[list(sheet.faces[face])]) for face in faces])
        if outline.geom_type != "Polygon" or outline.interiors:
            raise UnsolvableError(f"panel {panel} has a hole or several parts; expected one polygon")
        outlines.append(outline)
    return outlines


def _stacked(solids: Sequence[tuple[float, float, Any]]) -> list[tuple[float, float, Any]]:
    """Return prisms that may overlap as prisms that do not: between each two levels all outlines together."""
    levels: list[float] = []
    for level in sorted({level for low, high, _ in solids for level in (low, high)}):
        if not levels or level - levels[-1] > DOUBLE.meant:
            levels.append(level)
    plies = []
    for low, high in pairwise(levels):
        middle = (low + high) / 2.0
        there = [outline for bottom, top, outline in solids if bottom < middle < top]
        if there:
            plies.append((low, high, shapely.union_all(there)))
    return plies


def cut_back(
    plates: ThickPlates, moving: MovingPieces, of_ply: Ints, clearance: float, step: float = _STEP,
    *, keep_risers: bool = False,
) -> ThickPlates:  # fmt: skip
    """Return plates cut back where plies of panels come nearer than a clearance, in millimetres, on a motion.

    Pieces of hinged panels that lie in wedges about the hinge are left out. Of two plies that one is cut that loses
    less volume. What is cut off from the rest of a panel goes. Places are looked at between which no hinge turns by
    more than a step, in radians. Risers are kept from slabs if that is wanted.
    """
    removed: dict[int, list[Any]] = defaultdict(list)
    for (one, other), (places, turns, shifts) in _meetings(moving, clearance, step).items():
        loss: list[tuple[float, int, Any]] = []
        for rest, comes, turn, shift in ((one, other, turns, shifts), (other, one, *_inverse(turns, shifts))):
            ply = plates.plies[of_ply[rest]]
            corners = moving.pieces.corners[comes] @ turn.swapaxes(1, 2) + shift[:, None]
            trace = _trace(corners, places, ply.low - clearance, ply.high + clearance)
            trace = trace.buffer(clearance, join_style="mitre")
            loss.append(
                (float(shapely.intersection(trace, ply.outline).area) * (ply.high - ply.low), of_ply[rest], trace)
            )
        risers = [plates.plies[of_ply[piece]].riser for piece in (one, other)]
        if keep_risers and risers[0] != risers[1]:
            loss[risers[0]], loss[not risers[0]] = (0.0, *loss[risers[0]][1:]), (np.inf, *loss[not risers[0]][1:])
        least = loss[0] if loss[0][0] <= (1.0 + MARGIN) * loss[1][0] else loss[1]
        if not least[2].is_empty:  # gaps across faces are less than distances: nothing may come so near
            removed[int(least[1])].append(least[2])
    plies = [
        replace(ply, outline=_without(ply.outline, removed[number], clearance)) if number in removed else ply
        for number, ply in enumerate(plates.plies)
    ]
    kept = _connected(plies)
    before, after = _volumes(plates.plies), _volumes(kept)
    lost = {panel: before[panel] - after[panel] + plates.cut.get(panel, 0.0) for panel in before}
    return replace(plates, plies=tuple(kept), cut={panel: volume for panel, volume in lost.items() if volume > 0.0})


def _meetings(
    moving: MovingPieces, clearance: float, step: float
) -> dict[tuple[int, int], tuple[Floats, Floats, Floats]]:
    """Return pairs of pieces that come nearer than a clearance: at which places, and there the pose of the second."""
    course = moving.course
    finest = max(ceil(float(np.abs(np.diff(course.frames, axis=0)).max(initial=0.0)) / step), 1)
    places = np.linspace(0.0, course.end, finest * int(course.end) + 1)
    top = np.abs(course.at(places)).max(axis=0)
    near: dict[tuple[int, int], list[float]] = defaultdict(list)
    for place in places.tolist():
        first, second = moving.near(place, clearance)
        for pair in zip(first.tolist(), second.tolist(), strict=True):
            near[pair].append(place)
    pairs = list(near)
    bodies = moving.pieces.bodies
    clear = moving.clear_of_hinges(np.array([a for a, _ in pairs], int), np.array([b for _, b in pairs], int))
    meetings = {}
    for (one, other), free in zip(pairs, clear.tolist(), strict=True):
        joint = moving.joint_of(int(bodies[one]), int(bodies[other]))
        if joint is not None and free >= top[joint] - DOUBLE.same_configuration:
            continue
        at = np.array(near[one, other])
        count = len(at)
        turns, shifts = moving.relative(at, np.full(count, bodies[one]), np.full(count, bodies[other]))
        gaps, _ = separations(moving.pieces, np.full(count, one), np.full(count, other), turns, shifts)
        close = gaps < clearance
        if close.any():
            meetings[one, other] = at[close], turns[close], shifts[close]
    return meetings


def hinge_lines(
    plates: ThickPlates, ends: Mapping[int, Sequence[Floats]], panels: Mapping[int, Sequence[int]],
    heights: Mapping[int, float],
) -> dict[int, list[tuple[Floats, Floats]]]:  # fmt: skip
    """Return the parts of the axis of each hinge at which both its panels have material, by their ends.

    Where panels bear a hinge in turns, as stand-offs do, it is all of these parts.

    `ends` are those of the pieces of each crease, float[2, 2] in the plane, heights of hinges in millimetres.
    """
    of_panel: dict[int, list[Ply]] = defaultdict(list)
    for ply in plates.plies:
        of_panel[ply.panel].append(ply)
    lines: dict[int, list[tuple[Floats, Floats]]] = {}
    for joint, pieces in ends.items():
        reach = DOUBLE.meant * float(np.abs(np.array(pieces)).max(initial=1.0))
        outlines = [
            shapely.union_all([
                ply.outline.buffer(reach) for ply in of_panel[panel]
                if ply.low - reach <= heights[joint] <= ply.high + reach
            ])
            for panel in panels[joint]
        ]  # fmt: skip
        borne = [[_stretches(piece, outline, reach) for piece in pieces] for outline in outlines]
        common = [
            [(max(low, other), min(high, end)) for low, high in first for other, end in second
             if min(high, end) - max(low, other) > 2.0 * reach]
            for first, second in zip(*borne, strict=True)
        ]  # fmt: skip
        if sum(high - low for part in common for low, high in part) <= 16.0 * reach and all(map(any, borne)):
            common = [sorted(first + second) for first, second in zip(*borne, strict=True)]
        lines[joint] = [
            (piece[0] + low * along, piece[0] + high * along)
            for piece, part in zip(pieces, common, strict=True)
            for along in [unit(piece[1] - piece[0])]
            for low, high in part
        ]
    return lines


def _stretches(piece: Floats, outline: Any, reach: float) -> list[tuple[float, float]]:
    """Return the stretches of a segment, float[2, 2], that lie on an outline: lengths from its start, in order."""
    along = unit(piece[1] - piece[0])
    inside = shapely.intersection(shapely.LineString(piece), outline)
    parts = [np.array(part.coords) for part in getattr(inside, "geoms", [inside]) if part.geom_type == "LineString"]
    ends = sorted(tuple(sorted(((part[[0, -1]] - piece[0]) @ along).tolist())) for part in parts if len(part))
    joined: list[tuple[float, float]] = []
    for low, high in ends:
        if joined and low <= joined[-1][1] + reach:
            joined[-1] = (joined[-1][0], max(high, joined[-1][1]))
        else:
            joined.append((low, high))
    return [(low, high) for low, high in joined if high - low > 2.0 * reach]


def _inverse(turns: Floats, shifts: Floats) -> tuple[Floats, Floats]:
    back = turns.swapaxes(1, 2)
    return back, -(back @ shifts[..., None])[..., 0]


def _trace(corners: Floats, places: Floats, low: float, high: float) -> Any:
    """Return the outline of all that convex pieces, float[Q, N, 3], pass between two heights, place after place."""
    footprints: list[Any] = []
    for here in corners:
        one, other = (here[list(side)] for side in zip(*combinations(range(len(here)), 2), strict=True))
        points = [here[(here[:, 2] >= low) & (here[:, 2] <= high)]]
        for level in (low, high):
            passes = (one[:, 2] - level) * (other[:, 2] - level) < 0.0
            part = (level - one[passes, 2]) / (other[passes, 2] - one[passes, 2])
            points.append(one[passes] + part[:, None] * (other[passes] - one[passes]))
        footprints.append(shapely.MultiPoint(np.concatenate(points)[:, :2]).convex_hull)
    steps = np.diff(places)
    joined = [
        shapely.union(a, b).convex_hull if step <= 1.5 * steps.min() else b
        for a, b, step in zip(footprints, footprints[1:], steps, strict=False)
    ]
    return _union([footprints[0], *joined])


def _without(outline: Any, traces: Sequence[Any], clearance: float) -> Any:
    """Return an outline less what passes through it, with few corners."""
    gone = _union(traces).buffer(clearance / 4.0, join_style="mitre").simplify(clearance / 4.0)
    rest = shapely.difference(outline, gone, grid_size=grid_of(outline))
    small = clearance * clearance
    rest = rest.buffer(-clearance / 4.0).buffer(clearance / 4.0, join_style="mitre")
    kept = [part for part in polygons_of(rest) if part.area > small]
    return shapely.intersection(_union(kept), outline, grid_size=grid_of(outline)) if kept else shapely.Polygon()


def _connected(plies: Sequence[Ply]) -> list[Ply]:
    """Return of each panel the largest part that hangs together, ply by ply."""
    graph = nx.Graph()
    for number, ply in enumerate(plies):
        for part in polygons_of(ply.outline):
            graph.add_node((number, part.wkb), part=part)
    by_panel: dict[int, list[Any]] = defaultdict(list)
    for node in graph.nodes:
        by_panel[plies[node[0]].panel].append(node)
    for nodes in by_panel.values():
        for one, other in combinations(nodes, 2):
            low, high = plies[one[0]], plies[other[0]]
            apart = min(abs(low.high - high.low), abs(high.high - low.low))
            if apart > DOUBLE.meant * (low.high - low.low):
                continue
            if shapely.intersection(graph.nodes[one]["part"], graph.nodes[other]["part"]).area > 0.0:
                graph.add_edge(one, other)
    largest: dict[int, tuple[float, set[Any]]] = {}
    for part in nx.connected_components(graph):
        panel = plies[next(iter(part))[0]].panel
        volume = sum(graph.nodes[node]["part"].area * (plies[node[0]].high - plies[node[0]].low) for node in part)
        if panel not in largest or volume > largest[panel][0]:
            largest[panel] = (volume, part)
    kept: dict[int, list[Any]] = defaultdict(list)
    for _, part in largest.values():
        for node in part:
            kept[node[0]].append(graph.nodes[node]["part"])
    return [replace(plies[number], outline=shapely.union_all(kept[number])) for number in sorted(kept)]


def _volumes(plies: Sequence[Ply]) -> dict[int, float]:
    volumes: dict[int, float] = defaultdict(float)
    for ply in plies:
        volumes[ply.panel] += ply.volume
    return volumes


def _union(outlines: Sequence[Any]) -> Any:
    """Return outlines as one; corners are rounded to a grid, without which slivers lead GEOS astray."""
    return shapely.union_all(list(outlines), grid_size=grid_of(shapely.GeometryCollection(list(outlines))))


def grid_of(outline: Any) -> float:
    """Return the grid to which corners of an outline are rounded, without which slivers lead GEOS astray."""
    return float(DOUBLE.closed * np.abs(outline.bounds).max())


def polygons_of(outline: Any) -> list[Any]:
    """Return the polygons of a shapely geometry."""
    return [part for part in getattr(outline, "geoms", [outline]) if part.geom_type == "Polygon" and not part.is_empty]


def convex_rings(outline: Any) -> list[Floats]:
    """Return corners of convex polygons: triangles, of which neighbours are joined while they stay convex."""
    rings = []
    for polygon in polygons_of(outline):
        if not polygon.interiors and _convex(polygon):
            parts = [polygon]
        else:
            parts = list(shapely.constrained_delaunay_triangles(polygon).geoms)
            joined = True
            while joined:
                joined = False
                for one, other in combinations(range(len(parts)), 2):
                    if parts[one].distance(parts[other]) > 0.0:
                        continue
                    both = shapely.union(parts[one], parts[other])
                    if both.geom_type == "Polygon" and _convex(both):
                        parts = [part for number, part in enumerate(parts) if number not in (one, other)] + [both]
                        joined = True
                        break
        rings += [np.array(shapely.orient_polygons(part).exterior.coords)[:-1] for part in parts]
    return rings


def _convex(polygon: Any) -> bool:
    return bool(polygon.convex_hull.area - polygon.area <= DOUBLE.same_point * polygon.area)


def _prism(polygon: Any, ply: Ply, name: str) -> SolidMesh:
    plate = pierced_plate(polygon, ply.high - ply.low, name)
    return SolidMesh(name, plate.corners + np.array([0.0, 0.0, (ply.low + ply.high) / 2]), plate.triangles)
