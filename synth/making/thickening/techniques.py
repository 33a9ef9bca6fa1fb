"""Thick panels whose hinges stay in the plane of the sheet: tapered, stepped away by layers, or apart at hinge strips.

All fold angles are those of the thin sheet. Sources: T. Tachi, "Rigid-foldable thick origami" (2011); B. J. Edmondson,
R. J. Lang, S. P. Magleby, L. L. Howell, "An offset panel technique for thick rigidly foldable origami" (2014);
J. S. Ku, E. D. Demaine, "Folding flat crease patterns with thick materials" (2016). Theory:
docs/theory/thick-panels.md.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import degrees, pi, tan
from typing import Any

import networkx as nx
import numpy as np
import scipy.spatial
import shapely

from graphs.errors import InvariantError, UnsolvableError
from graphs.files.solids.meshes import SolidMesh
from graphs.mechanism.precision import in_space
from graphs.tolerances import DOUBLE
from graphs.types import Floats, Ints
from synth.analysis.folding.configuration import SheetConfiguration
from synth.analysis.layering._layers import layers
from synth.making.thickening.heights import HingeHeights
from synth.making.thickening.plates import Plates, Ply, ThickPlates, convex_rings, panel_outlines, thick_plates
from synth.making.thickening.solid_collisions import ConvexPieces, pieces_of

_QUARTERS = (0.25, 0.75)
"""Where on a part of a hinge screws are."""
_HALVINGS = 40
"""Until a greatest thickness is known."""

Trims = Mapping[int, float]
"""Joint to the width trimmed, as a part of half the thickness."""


@dataclass(frozen=True)
class TechniqueFigures:
    """What a technique gives for a sheet, to compare it with others.

    Attributes
    ----------
    how : str
        ``spatial``, ``tapered``, ``offset`` or ``hinge``.
    angle : float
        The largest fold angle until solids meet, radians.
    stowed : tuple of 3 float
        Sides of a box round the solids there, millimetres, the longest first: upright on panel 0.
    thinnest : float
        The least height of a slab or width of a part, millimetres.
    mass : float
        Of all panels, grams, at 700 kilograms per cubic metre (plywood).
    fault : str
        Why the technique does not suit the sheet; empty if it does.

    Examples
    --------
    >>> TechniqueFigures("tapered", fault="panel 0 allows less than 1 mm").angle
    0.0
    """

    how: str
    angle: float = 0.0
    stowed: tuple[float, float, float] = (0.0, 0.0, 0.0)
    thinnest: float = 0.0
    mass: float = 0.0
    fault: str = ""

    @property
    def rank(self) -> tuple[float, ...]:
        """Better ones come first: by greatest angle to a degree, stowed volume, thinnest part, mass."""
        angle = round(float(np.degrees(self.angle)))
        return (-angle, round(float(np.prod(self.stowed)), 3), -self.thinnest, self.mass)

    def row(self) -> tuple[str, ...]:
        """Return the row of a table."""
        if self.fault:
            return (self.how, self.fault, "", "", "")
        box = " x ".join(f"{side:.4g}" for side in self.stowed)
        return (self.how, f"{np.degrees(self.angle):.4g}°", box, f"{self.thinnest:.3g}", f"{self.mass:.4g}")

    def to_json(self) -> dict[str, Any]:
        """Return plain data: lengths in millimetres, angles in degrees, grams."""
        if self.fault:
            return {"how": self.how, "fault": self.fault}
        return {
            "how": self.how, "angle_deg": float(np.degrees(self.angle)), "stowed": list(self.stowed),
            "thinnest": self.thinnest, "mass": self.mass,
        }  # fmt: skip


@dataclass(frozen=True)
class TaperedPlates(Plates):
    """Panels whose sides are planes through the hinges, in the flat state.

    Attributes
    ----------
    parts : tuple of (int, float[n, 3])
        Panel and corners of each convex part, millimetres.
    cut : mapping of panel to float
        None of them is cut back.
    bores : tuple of (int, sequence of (float, float))
        The number of a part, and the corners of an upright bore through it, counterclockwise.

    Examples
    --------
    >>> import synth
    >>> sheet = synth.generate("miura").mechanism
    >>> plates = synth.thicken(sheet, thickness=0.05, how="tapered", angle=1.5, collisions=False).plates
    >>> len(plates.meshes), plates.thinnest
    (9, 0.025)
    """

    parts: tuple[tuple[int, Floats], ...]
    cut: Mapping[int, float]
    bores: tuple[tuple[int, Sequence[tuple[float, float]]], ...] = ()

    @property
    def thinnest(self) -> float:
        """Half the thickness, what is left at a hinge, millimetres."""
        return max(float(corners[:, 2].max()) for _, corners in self.parts)

    @cached_property
    def meshes(self) -> tuple[SolidMesh, ...]:
        """The solids, millimetres."""
        meshes, count = [], dict[int, int]()
        for place_of, (panel, corners) in enumerate(self.parts):
            number = count[panel] = count.get(panel, -1) + 1
            hull = scipy.spatial.ConvexHull(corners)
            place = np.full(len(corners), -1)
            place[hull.vertices] = np.arange(len(hull.vertices))
            triangles = hull.simplices.copy()
            sides = corners[triangles]
            normals = np.cross(sides[:, 1] - sides[:, 0], sides[:, 2] - sides[:, 0])
            inward = (normals * hull.equations[:, :3]).sum(axis=1) < 0.0
            triangles[inward] = triangles[inward][:, ::-1]
            name = f"panel {panel}" + (f" part {number}" if number else "")
            solid = SolidMesh(name, corners[hull.vertices], place[triangles])
            rings = [ring for part, ring in self.bores if part == place_of]
            meshes.append(_pierced(solid, rings, self.thinnest) if rings else solid)
        return tuple(meshes)

    @cached_property
    def panels(self) -> tuple[int, ...]:
        """The panel of each mesh."""
        return tuple(panel for panel, _ in self.parts)

    @cached_property
    def volume(self) -> float:
        """Volume of all panels in cubic millimetres."""
        whole = sum(scipy.spatial.ConvexHull(corners).volume for _, corners in self.parts)
        return float(whole - sum(shapely.Polygon(ring).area for _, ring in self.bores) * 2.0 * self.thinnest)

    def pieces(self) -> tuple[ConvexPieces, Ints]:
        """Return the convex parts, and the number of each."""
        return pieces_of([corners for _, corners in self.parts], self.panels), np.arange(len(self.parts))

    def sections(self, panel: int) -> list[tuple[float, float, Any]]:
        """Return the outlines of a panel at its underside, at the plane of the hinges and at its upper side."""
        solids = [corners for one, corners in self.parts if one == panel]
        levels = (-self.thinnest, 0.0, self.thinnest)
        return [(level, level, shapely.union_all([_section(one, level) for one in solids])) for level in levels]

    def rooms(self, panel: int) -> list[tuple[int, Any]]:
        """Return where upright bores go through both sides of a panel: the number of each part, and its outline."""
        return [
            (number, shapely.intersection(*(_section(corners, side * self.thinnest) for side in (-1.0, 1.0))))
            for number, (one, corners) in enumerate(self.parts) if one == panel
        ]  # fmt: skip


def _pierced(solid: SolidMesh, rings: Sequence[Sequence[tuple[float, float]]], half: float) -> SolidMesh:
    """Return a convex solid with upright bores from its underside to its upper side."""
    corners = solid.corners.tolist()
    triangles: list[list[int]] = []
    ends: list[dict[tuple[float, float], int]] = []
    sides = np.abs(solid.corners[:, 2, None] - np.array([-half, half])) <= DOUBLE.meant * half
    for level, on, turn in zip((-half, half), sides.T, (-1, 1), strict=True):
        flat = solid.triangles[on[solid.triangles].all(axis=1)]
        border = {a: b for a, b in _directed(flat) if (b, a) not in _directed(flat)}
        ring = [next(iter(border))]
        while border[ring[-1]] != ring[0]:
            ring.append(border[ring[-1]])
        known = {(corners[corner][0], corners[corner][1]): corner for corner in ring}
        for x, y in (corner for bore in rings for corner in bore):
            known[x, y] = len(corners)
            corners.append([x, y, level])
        outline = shapely.Polygon([corners[corner][:2] for corner in ring], rings)
        for part in shapely.constrained_delaunay_triangles(outline).geoms:
            around = shapely.orient_polygons(part).exterior.coords[:-1]
            triangles.append([known[x, y] for x, y in around][::turn])
        ends.append(known)
    triangles += solid.triangles[~sides[solid.triangles].all(axis=1).any(axis=1)].tolist()
    low, high = ends
    for bore in rings:
        for here, after in zip(bore, [*bore[1:], bore[0]], strict=True):
            triangles += [[low[after], low[here], high[here]], [low[after], high[here], high[after]]]
    return SolidMesh(solid.name, np.array(corners), np.array(triangles))


def _directed(triangles: Ints) -> set[tuple[int, int]]:
    """Return the sides of triangles as they go round them."""
    return {(int(a), int(b)) for one in triangles for a, b in zip(one, np.roll(one, -1), strict=True)}


def _section(corners: Floats, level: float) -> Any:
    """Return the outline of a convex part at a height."""
    heights = corners[:, 2] - level
    first, second = np.triu_indices(len(corners), 1)
    through = heights[first] * heights[second] < 0.0
    part = heights[first] / np.where(through, heights[first] - heights[second], 1.0)
    across = (corners[first] + part[:, None] * (corners[second] - corners[first]))[through]
    level_with = corners[np.abs(heights) <= DOUBLE.meant * np.abs(corners).max()]
    return shapely.MultiPoint(np.concatenate([level_with, across])[:, :2]).convex_hull


def tapered_plates(
    at: SheetConfiguration, trims: Trims, thickness: float, scale: float, clearance: float, angle: float
) -> TaperedPlates:
    """Return panels about the plane of the sheet, trimmed where they fold together by planes through the hinges.

    Corners at vertices inside the sheet are cut off by a clearance: all panels round one would touch there.
    """
    letters = at.sheet.assignments
    corners = in_space(at.sheet.coordinates or ())[:, :2] * scale
    creases = _creases_of_panels(at, corners)
    inner = corners[_inner_vertices(at)]
    parts: list[tuple[int, Floats]] = []
    for panel, outline in enumerate(panel_outlines(at.sheet, at.mechanism, scale)):
        rings = convex_rings(_without_corners(outline, inner, clearance))

        def trimmed(thick: float, rings: Sequence[Floats] = rings, panel: int = panel) -> list[Floats] | None:
            return _trimmed(rings, creases[panel], letters, trims, thick)

        solids = trimmed(thickness)
        if solids is None:
            raise UnsolvableError(_too_thick(panel, thickness, angle, lambda thick: trimmed(thick) is not None))
        parts += [(panel, solid) for solid in solids]
    return TaperedPlates(tuple(parts), {})


def _without_corners(outline: Any, inner: Floats, clearance: float) -> Any:
    """Return an outline without its corners at vertices: they are cut straight, squares where it is not convex."""
    ring = np.array(shapely.orient_polygons(outline).exterior.coords)[:-1]
    reach = DOUBLE.meant * float(np.abs(ring).max())
    kept: list[Floats] = []
    gone = []
    for number, here in enumerate(ring):
        before, after = ring[number - 1] - here, ring[(number + 1) % len(ring)] - here
        bend = after[0] * before[1] - after[1] * before[0]
        if not len(inner) or np.linalg.norm(inner - here, axis=1).min() > reach:
            kept.append(here)
        elif bend > reach * np.hypot(*after):
            kept += [here + 2.0 * clearance * side / np.linalg.norm(side) for side in (before, after)]
        else:
            kept.append(here)
            gone.append(shapely.Point(here).buffer(clearance, cap_style="square"))
    rest = shapely.Polygon(kept)
    return shapely.difference(rest, shapely.union_all(gone)) if gone else rest


def _trimmed(
    rings: Sequence[Floats], creases: Sequence[tuple[int, Floats]], letters: str, trims: Trims, thickness: float
) -> list[Floats] | None:
    """Return the convex parts of a panel cut by the planes of its creases; None if nothing is left of a side."""
    half, solids, left = thickness / 2.0, [], np.zeros(2)
    for ring in rings:
        solid = np.column_stack([np.tile(ring, (2, 1)), np.repeat([-half, half], len(ring))])
        for joint, (start, end) in creases:
            if not _is_side(ring, start, end):
                continue
            along = (end - start) / np.linalg.norm(end - start)
            outward = np.array([along[1], -along[0]])
            if (ring.mean(axis=0) - start) @ outward > 0.0:
                outward = -outward
            rise = trims[joint] if letters[joint] == "V" else -trims[joint]
            plane = np.array([*outward, rise, -(outward @ start)])
            solid = _halved(solid, plane)
            if len(solid) <= 3:
                return None
        for side, level in enumerate((-half, half)):
            left[side] += _section(solid, level).area
        solids.append(solid)
    return solids if (left > DOUBLE.same_point * sum(shapely.Polygon(ring).area for ring in rings)).all() else None


def _halved(corners: Floats, plane: Floats) -> Floats:
    """Return the corners of what of a convex solid lies below a plane."""
    heights = corners @ plane[:3] + plane[3]
    reach = DOUBLE.same_point * float(np.abs(corners).max())
    if heights.max() <= reach:
        return corners
    first, second = np.triu_indices(len(corners), 1)
    through = (heights[first] * heights[second] < 0.0) & (np.abs(heights[[first, second]]) > reach).all(axis=0)
    part = (heights[first] / np.where(through, heights[first] - heights[second], 1.0))[through, None]
    across = corners[first][through] + part * (corners[second] - corners[first])[through]
    kept = np.concatenate([corners[heights <= reach], across])
    if len(kept) <= 3 or np.ptp(kept, axis=0).min() <= reach:
        return kept[:0]
    return np.asarray(kept[scipy.spatial.ConvexHull(kept).vertices])


def strip_plates(at: SheetConfiguration, trims: Trims, thickness: float, scale: float, angle: float) -> ThickPlates:
    """Return panels about the plane of the sheet with gaps at the hinges, which a flexible strip bridges."""
    corners = in_space(at.sheet.coordinates or ())[:, :2] * scale
    creases = _creases_of_panels(at, corners)
    plies = []
    for panel, outline in enumerate(panel_outlines(at.sheet, at.mechanism, scale)):

        def rest(thick: float, outline: Any = outline, panel: int = panel) -> Any:
            gaps = [
                shapely.LineString([start, end]).buffer(trims[joint] * thick / 2.0, cap_style="square")
                for joint, (start, end) in creases[panel]
            ]
            return shapely.difference(outline, shapely.union_all(gaps), grid_size=DOUBLE.closed * np.abs(corners).max())

        left = rest(thickness)
        if left.is_empty:
            raise UnsolvableError(_too_thick(panel, thickness, angle, lambda thick: not rest(thick).is_empty))
        plies.append(Ply(panel, -thickness / 2.0, thickness / 2.0, left))
    return ThickPlates(tuple(plies), {})


def _too_thick(panel: int, thickness: float, angle: float, leaves: Callable[[float], bool]) -> str:
    """Return how thick a panel may be so that trimming leaves something of it."""
    low, high = 0.0, thickness
    for _ in range(_HALVINGS):
        middle = (low + high) / 2.0
        low, high = (middle, high) if leaves(middle) else (low, middle)
    allows = f"panel {panel} allows less than {high:.6g} mm at {degrees(angle):.6g} degrees"
    return f"thickness {thickness:g} mm: {allows}, else nothing is left of a side; try a smaller --thickness or --angle"


def offset_plates(
    at: SheetConfiguration, thickness: float, scale: float, clearance: float
) -> tuple[ThickPlates, HingeHeights]:
    """Return panels stepped away from the plane of the hinges by the first layer order, with stand-offs to it."""
    undersides = _levels(at, 1.0 + clearance / thickness)
    joints = [int(str(joint)) for joint in at.mechanism.sc.joints]
    heights = HingeHeights(dict.fromkeys(joints, 0.0), tuple(undersides), (), 0.0)
    return thick_plates(at.sheet, at.mechanism, heights, thickness, scale, in_turns=True), heights


def _levels(at: SheetConfiguration, apart: float) -> list[float]:
    """Return undersides in the flat state, in thicknesses, at which folded panels lie on each other in layer order."""
    folding = layers(at.sheet)
    if not folding.foldable or folding.image is None:
        raise UnsolvableError(f"no layer order: {folding.fault or 'the sheet does not fold flat'}")
    if [set(panel) for panel in folding.mechanism.panels] != [set(panel) for panel in at.mechanism.panels]:
        raise UnsolvableError("no layer order of these panels: the sheet has cuts or holes that part them otherwise")
    above = nx.DiGraph()
    above.add_nodes_from(range(len(at.mechanism.panels)))
    for (one, other), first_on_top in folding.order().above().items():
        above.add_edge(*((other, one) if first_on_top else (one, other)))
    if not nx.is_directed_acyclic_graph(above):
        raise UnsolvableError("no levels of the panels: in the layer order panels lie on each other in a circle")
    level: dict[int, int] = {}
    for panel in nx.topological_sort(above):
        level[panel] = max((level[below] + 1 for below in above.predecessors(panel)), default=0)
    # The plane of the hinges is that of the middle layers, which makes stand-offs short.
    middle = sorted(level.values())[len(level) // 2]
    flipped = folding.image.panels.flipped
    return [
        -(level[panel] - middle) * apart - 1.0 if flipped[panel] else (level[panel] - middle) * apart
        for panel in sorted(level)
    ]


def trims_of(joints: Sequence[int], greatest: Floats) -> dict[int, float]:
    """Return the width to trim at each crease, as a part of half the thickness: tan(greatest fold angle / 2)."""
    if not (np.abs(greatest) < pi).all():
        most = degrees(float(np.abs(greatest).max()))
        raise InvariantError("angle", f"a greatest fold angle of {most:.6g} degrees", "less than 180 degrees")
    return {joint: tan(abs(float(turned)) / 2.0) for joint, turned in zip(joints, greatest, strict=True)}


@dataclass(frozen=True)
class HingeSeat:
    """Where two panels are joined: what the parts list and templates say of a hinge.

    Attributes
    ----------
    joint : int
    valley : bool
    height : float
        Of the axis over the plane of the sheet, millimetres.
    panels : tuple of 2 int
    lines : sequence of (float[2], float[2])
        Parts of the axis at which there is material, millimetres.
    bevel : float
        From upright, of the sides of both panels at a tapered hinge, radians; 0 for others.
    gap : float
        Between the panels, which a strip bridges, millimetres; 0 for others.
    """

    joint: int
    valley: bool
    height: float
    panels: tuple[int, int]
    lines: Sequence[tuple[Floats, Floats]]
    bevel: float = 0.0
    gap: float = 0.0

    @property
    def length(self) -> float:
        """Length of all parts together in millimetres."""
        return float(sum(np.linalg.norm(end - start) for start, end in self.lines))

    def holes(self, outline: Any, setback: float, diameter: float) -> list[Floats]:
        """Return the centres of two screws for each part of the axis, on one side of it, where an outline has room."""
        centres = []
        room = outline.buffer(-diameter / 2.0)
        for start, end in self.lines:
            along = (end - start) / np.linalg.norm(end - start)
            for part in _QUARTERS:
                for side in (1.0, -1.0):
                    at = start + part * (end - start) + side * setback * np.array([-along[1], along[0]])
                    if shapely.contains(room, shapely.Point(at)):
                        centres.append(at)
        return centres


def _creases_of_panels(at: SheetConfiguration, corners: Floats) -> list[list[tuple[int, Floats]]]:
    """Return the creases of each panel with the ends of their pieces, float[2, 2]."""
    creases: list[list[tuple[int, Floats]]] = [[] for _ in at.mechanism.panels]
    for joint, links in at.mechanism.sc.joints.items():
        for panel in (int(str(link)) for link in links):
            for piece in at.mechanism.pieces[int(str(joint))]:
                creases[panel].append((int(str(joint)), corners[list(piece)]))
    return creases


def _inner_vertices(at: SheetConfiguration) -> list[int]:
    """Return the ends of creases at which two or more creases of the sheet meet."""
    count: dict[int, int] = {}
    for pieces in at.mechanism.pieces.values():
        for piece in pieces:
            for vertex in piece:
                count[vertex] = count.get(vertex, 0) + 1
    return sorted(vertex for vertex, creases in count.items() if creases > 1)


def _is_side(ring: Floats, start: Floats, end: Floats) -> bool:
    """Check whether a convex polygon has a side on a crease."""
    along = (end - start) / np.linalg.norm(end - start)
    away = np.abs((ring - start) @ np.array([-along[1], along[0]]))
    on = (ring - start)[away <= DOUBLE.meant * float(np.abs(ring).max())] @ along
    within = np.clip(on, 0.0, np.linalg.norm(end - start))
    return bool(len(within) > 1 and np.ptp(within) > DOUBLE.meant * float(np.abs(ring).max()))
