"""A crease pattern with panels of a thickness: hinged solids, their verdict, and their fold angles.

Theory: docs/theory/thick-panels.md.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse
import shapely

from graphs.errors import InvariantError, UnsolvableError, numbered
from graphs.files.formats import write
from graphs.files.mechanism_like import MechanismLike, mechanism_for
from graphs.files.outputs import check_writable, write_as
from graphs.geometry import unit
from graphs.least_squares.gauss_newton import GaussNewton, find_root
from graphs.mechanism.precision import in_space, keeping
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import Axis, HingedSolids, LinkShape
from graphs.printing import Block, Printed, TableBlock
from graphs.rank.singular_values import rank_of
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.analysis.folding.configuration import SheetConfiguration
from synth.analysis.folding.mending.fitting import MeantAngles, VertexPlaces
from synth.analysis.folding.symmetric_motion import folded_towards
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.configuration import Configuration
from synth.analysis.motion.driven_motion import MotionOptions
from synth.analysis.motion.motion import motion_of
from synth.analysis.motion.singular.motion_near_rates import begun_near
from synth.analysis.motion.singular.sampling import rates_towards
from synth.analysis.motion.tangent import TangentSpace
from synth.analysis.moving._configuration_of import configuration_of
from synth.analysis.verdict._mobility import verdict_of_motion
from synth.analysis.verdict.verdict import Verdict
from synth.exporters import EXPORTERS
from synth.making.templates.solids import Solids
from synth.making.templates.template import GREATEST, Template
from synth.making.thickening.fittings import HINGES, Bores, bored, bores_of, drilled, parts_of
from synth.making.thickening.heights import HingeHeights, hinge_heights, needs_motion, thick_vertices
from synth.making.thickening.plates import Plates, ThickPlates, cut_back, hinge_lines, thick_plates
from synth.making.thickening.solid_collisions import FirstContact, FoldCourse, MovingPieces, body_poses
from synth.making.thickening.techniques import (
    HingeSeat,
    TaperedPlates,
    TechniqueFigures,
    offset_plates,
    strip_plates,
    tapered_plates,
    trims_of,
)

_CLEARANCE = 0.02
"""Default clearance of panels that no hinge joins, as a part of the thickness."""
_DENSITY = 700.0
"""Kilograms per cubic metre, of plywood."""
_KEPT = "Mobile along the motion of the thin sheet that the heights keep: {} there, up to {:.6g}°."
_APART = "no heights keep the symmetric motion of the thin sheet; vertices have those of each by itself"
_FREEDOMS = ("degree of freedom", "degrees of freedom")
_MUCH = 0.1
"""A part of the volume: the answer warns if more than this is cut away so that panels do not meet."""
TECHNIQUES = ("spatial", "tapered", "offset", "hinge")
"""Ways to give panels a thickness."""
_GREATEST_ANGLES = {"spatial": 179.0, "tapered": 150.0, "offset": 179.0, "hinge": 150.0}
"""Default greatest fold angles, degrees."""
_MEETING = GaussNewton(
    most_steps=8,  # angles are off by rounding errors, and these are squared: two or three steps are enough
    solved=DOUBLE.closed,
)
"""To where angles that are meant to be alike are so."""
_FRAMES = 40
"""Frames of a motion that is not that of the thin sheet: hinges may turn by a whole turn."""
_STEPS = (1.5, 0.5)
"""Degrees between places of the motion at which panels are cut back: finer ones if solids still meet."""
_RANGES = (180.0, 165.0, 150.0, 135.0, 120.0, 105.0, 90.0, 75.0, 60.0, 45.0, 30.0, 15.0)
"""Greatest fold angles, degrees, up to which panels are cut back: the first at which each hinge keeps a part."""


@dataclass(frozen=True)
class Collisions:
    """Whether the solids meet on the motion.

    Attributes
    ----------
    meeting : FirstContact
        The first place at which solids meet, swept: no configuration is left out.
    overlaps : float[F]
        The volume that solids have in common in each frame, cubic millimetres.
    clearance : float
        Between panels that no hinge joins, millimetres.

    Examples
    --------
    >>> import synth
    >>> thick = synth.thicken(synth.generate("miura", rows=2, columns=2).mechanism, thickness=0.05)
    >>> thick.collisions.meeting.panels, float(thick.collisions.overlaps.max())
    (None, 0.0)
    """

    meeting: FirstContact
    overlaps: Floats
    clearance: float


@dataclass(frozen=True, eq=False, repr=False)
class ThickSheet(Printed):
    """A crease pattern with panels of a thickness.

    Attributes
    ----------
    solids : HingedSolids
        Links are the panels; axes in millimetres, in the flat state.
    heights : HingeHeights
        In units of the thickness.
    plates : Plates
        The solids in the flat state.
    thickness : float
        Millimetres.
    verdict : Verdict
        Of the hinged solids, by their closure equations.
    angles : float[F, J]
        Joint angles of a motion of the solids from flat, radians.
    keeps_angles : bool
        Whether the fold angles are those of the thin sheet.
    residual : float
        The largest loop-closure residual of the solids on the motion.
    hinge_lines : mapping of joint to list of (float[2], float[2])
        The parts of each axis at which both panels have material, by their ends in the plane, millimetres.
    valleys : set of int
        The creases that are valleys.
    how : str
        ``spatial``, ``tapered``, ``offset`` or ``hinge``.
    collisions : Collisions, optional
        None if they were not looked for.
    comparison : tuple of TechniqueFigures
        Of all techniques, if the best was wanted.
    hinges : str
        What joins panels: ``screws`` or ``tape``; ``strip`` where ``how`` is ``hinge``.
    bores : mapping of joint to list of (int, float[2])
        Panel and centre of each bore for a screw, millimetres.
    clearance : float
        Of panels that no hinge joins, and of screws in bores, millimetres.
    freedoms : int, optional
        The degrees of freedom of the solids in the middle of the motion that they keep; None if vertices had not to
        agree on one.

    Examples
    --------
    >>> import synth
    >>> thick = synth.thicken(synth.generate("miura").mechanism, thickness=0.05, collisions=False)
    >>> thick.solids
    <HingedSolids: 9 links, 12 joints>
    """

    solids: HingedSolids
    heights: HingeHeights
    plates: Plates
    thickness: float
    verdict: Verdict
    angles: Floats
    keeps_angles: bool
    residual: float
    hinge_lines: Mapping[int, Sequence[tuple[Floats, Floats]]]
    valleys: frozenset[int]
    how: str = "spatial"
    collisions: Collisions | None = None
    comparison: tuple[TechniqueFigures, ...] = ()
    hinges: str = "tape"
    bores: Bores = field(default_factory=dict)
    clearance: float = 0.0
    freedoms: int | None = None

    def panel_motions(self) -> tuple[Floats, Floats]:
        """Return rotations, float[F, P, 3, 3], and translations, float[F, P, 3], of panels; panel 0 rests."""
        return body_poses(len(self.solids.chain), *_hinges(self.solids), self.angles)

    def blocks(self) -> list[Block]:
        """Return the sentence and the heights that are printed."""
        kinds = [one.linkage for one in self.heights.vertices]
        linkages = ", ".join(numbered(kinds.count(kind), f"{kind or 'other'} vertex", f"{kind or 'other'} vertices")
                             for kind in ("Bennett", "Myard", "Bricard", "") if kind in kinds)  # fmt: skip
        angles = "those of the thin sheet" if self.keeps_angles else "not those of the thin sheet"
        rows = [(str(joint), f"{height * self.thickness + 0.0:.6g}") for joint, height in self.heights.hinges.items()]
        most = float(np.degrees(np.abs(self.angles).max(initial=0.0)))
        columns = ("technique", "greatest angle", "stowed box in mm", "thinnest part in mm", "mass in g")
        compared = TableBlock(columns, [one.row() for one in self.comparison], columns[1:])
        return [
            *([_KEPT.format(numbered(self.freedoms, *_FREEDOMS), most)] if self.freedoms is not None else []),
            str(self.verdict),
            *([compared] if self.comparison else []),
            *([f"vertices: {linkages or 'none inside the sheet'}"] if self.how == "spatial" else []),
            *([_APART] if needs_motion(self.heights.vertices) and not self.heights.of_motion else []),
            f"fold angles: {angles}, up to {most:.6g}°; loop-closure residual {self.residual:.1g}",
            *self._collision_lines(),
            TableBlock(("crease", "height in mm"), rows, ("crease", "height in mm")),
        ]

    def _collision_lines(self) -> list[str]:
        if self.collisions is None:
            return ["collisions of the solids: not checked"]
        meeting, volume = self.collisions.meeting, self.plates.volume
        angle = f"{np.degrees(meeting.angle):.6g}°"
        met = "" if meeting.panels is None else "panels {} and {} meet at ".format(*meeting.panels)
        first = f"collisions of the solids: {met or 'none up to '}{angle} (largest fold angle; swept, without gaps)"
        most = float(self.collisions.overlaps.max(initial=0.0)) / volume
        cut = sum(self.plates.cut.values())
        lines = [first, f"overlap in {numbered(len(self.angles), 'frame')}: at most {most:.1g} of the volume"]
        if cut:
            part = f"{100.0 * cut / (volume + cut):.2g} percent of the volume"
            clearance = f"clearance {self.collisions.clearance:.3g} mm"
            lines.append(f"cut back: {numbered(len(self.plates.cut), 'panel')}, {part}; {clearance}")
        if cut > _MUCH * (volume + cut):
            advice = "try a smaller --thickness, or --how offset"
            lines.append(f"warning: more than {100.0 * _MUCH:g} percent of the volume is cut away; {advice}")
        return lines

    def to_json(self) -> dict[str, Any]:
        """Return plain data: lengths in millimetres, angles in degrees, volumes in cubic millimetres."""
        return {
            "how": self.how,
            "thickness": self.thickness,
            "verdict": self.verdict.to_json(),
            "heights": [
                {"joint": joint, "height": height * self.thickness} for joint, height in self.heights.hinges.items()
            ],
            "undersides": [height * self.thickness for height in self.heights.undersides],
            "vertices": [
                {"vertex": one.vertex, "linkage": one.linkage, "joints": list(one.joints)}
                for one in self.heights.vertices
            ],
            "keeps_angles": self.keeps_angles,
            "freedoms_on_the_motion": self.freedoms,
            "residual": self.residual,
            "angles_deg": np.degrees(self.angles).tolist(),
            "hinges": self.hinges,
            "bores": [
                {"joint": joint, "panel": panel, "centre": centre.tolist()}
                for joint, holes in self.bores.items()
                for panel, centre in holes
            ],
            "volume": self.plates.volume,
            "cut": [{"panel": panel, "volume": volume} for panel, volume in sorted(self.plates.cut.items())],
            "collisions": None
            if self.collisions is None
            else {
                **self.collisions.meeting.to_json(),
                "overlaps": self.collisions.overlaps.tolist(),
                "clearance": self.collisions.clearance,
            },
            **({"comparison": [one.to_json() for one in self.comparison]} if self.comparison else {}),
        }

    def seats(self) -> list[HingeSeat]:
        """Return where panels are joined."""
        turned = dict(zip(self.solids.chain.joints, np.abs(self.angles).max(axis=0, initial=0.0), strict=True))
        seats = []
        for joint, (one, other) in self.solids.chain.joints.items():
            number, half = int(str(joint)), float(turned[joint]) / 2.0
            seats.append(
                HingeSeat(
                    number, number in self.valleys, self.heights.hinges[number] * self.thickness,
                    (int(str(one)), int(str(other))), self.hinge_lines[number],
                    half if self.how == "tapered" else 0.0,
                    self.thickness * float(np.tan(half)) if self.how == "hinge" else 0.0,
                )
            )  # fmt: skip
        return seats

    def template(self) -> Template:
        """Return outlines of all plies at full size, with hinges, holes and heights, and the parts list."""
        title = f"{self.how} panels of {self.thickness:g} mm"
        pieces, steps = parts_of(
            self.plates, self.seats(), self.thickness, title, self.hinges, self.bores, self.clearance
        )
        return Template(tuple(pieces), None, configuration_of(self.solids), title, (), steps)

    def write(self, path: str | Path, *, force: bool = False) -> tuple[str, ...]:
        """Write the hinged solids (.json) or the solids (.stl, .3mf, .obj; .gltf with the motion); return losses."""
        if Path(path).suffix == ".json":
            write(self.solids, path, force=force)
            return ()
        check_writable(path, EXPORTERS["solids"], force=force)
        rotations, shifts = self.panel_motions()
        panels = list(self.plates.panels)
        solids = Solids(self.plates.meshes, "thick panels", (rotations[:, panels], shifts[:, panels]))
        return write_as(solids, path, EXPORTERS["solids"], force=force)


def thicken(
    mechanism: MechanismLike,
    *,
    thickness: float,
    how: str = "spatial",
    scale: float = 1.0,
    angle: float | None = None,
    clearance: float | None = None,
    collisions: bool = True,
    hinges: str = "screws",
) -> ThickSheet:
    """Give the panels of a flat crease pattern a thickness, in such a way that it still folds.

    Parameters
    ----------
    mechanism : Sheet, str or Path
        A flat crease pattern of mountains and valleys.
    thickness : float
        Of panels, millimetres.
    how : str, optional
        ``spatial``: hinges are moved off the plane of the sheet, so that vertices become overconstrained linkages.
        ``tapered``: sides of panels are planes through hinges in the plane. ``offset``: panels are stepped away from
        that plane by a layer order. ``hinge``: panels are apart, and a flexible strip bridges the gap. ``best``:
        that with the greatest fold angle, then the smallest stowed box, the thickest thinnest part, the least mass.
    scale : float, optional
        Millimetres per unit of the coordinates.
    angle : float, optional
        The greatest fold angle, radians; by default 179 degrees, for tapered panels and hinge strips 150.
    clearance : float, optional
        Between panels that no hinge joins, millimetres; by default a fiftieth of the thickness.
    collisions : bool, optional
        Cut panels back where they would meet, and find up to which fold angle none meet.
    hinges : str, optional
        What joins panels: ``screws`` in bores through the plies that reach the axis, or through both sides of
        tapered panels, wider than the screws by the clearance; or ``tape``, which takes no material. Where ``how`` is
        ``hinge`` a flexible strip over each gap joins panels instead.

    Returns
    -------
    ThickSheet

    Raises
    ------
    InvariantError
        If the thickness, the scale, the angle or the clearance is out of range, or the technique unknown.
    UnsolvableError
        If the sheet is not flat, has no assignment, a vertex suits no overconstrained linkage, conditions exclude
        each other, a panel is too narrow, there is no layer order, or nothing moves.

    Examples
    --------
    >>> import synth
    >>> thick = synth.thicken(synth.generate("miura").mechanism, thickness=0.1, collisions=False)
    >>> thick.keeps_angles, thick.residual < 1e-9
    (True, True)
    """
    sheet = mechanism_for("thicken", mechanism, Sheet)
    for name, value in (("thickness", thickness), ("scale", scale)):
        if not 0 < value <= GREATEST:
            raise InvariantError(name, f"{name} {value!r}", f"a positive number, at most {GREATEST:g}")
    between = _CLEARANCE * thickness if clearance is None else clearance
    if not 0 < between <= thickness:
        raise InvariantError("clearance", f"clearance {between!r}", "a positive number, at most the thickness")
    if how not in (*TECHNIQUES, "best"):
        raise InvariantError("how", f"{how!r}", f"one of {', '.join(TECHNIQUES)} and best")
    if angle is not None and not 0 < angle < pi:
        raise InvariantError("angle", f"angle {np.degrees(angle):.6g} degrees", "more than 0 and less than 180")
    if hinges not in HINGES:
        raise InvariantError("hinges", f"hinges {hinges!r}", f"one of {', '.join(HINGES)}")
    at = _flat_configuration(sheet)
    wishes = _Wishes(thickness, scale, angle, between, collisions, hinges)
    return _best(at, wishes) if how == "best" else _thickened(at, how, wishes)


@dataclass(frozen=True)
class _Wishes:
    thickness: float
    scale: float
    angle: float | None
    clearance: float
    collisions: bool
    hinges: str


def _best(at: SheetConfiguration, wishes: _Wishes) -> ThickSheet:
    """Return the best of all techniques with a comparison; an error if none suits the sheet."""
    sheets: dict[str, ThickSheet] = {}
    figures = []
    for how in TECHNIQUES:
        try:
            sheets[how] = _thickened(at, how, replace(wishes, collisions=True))
            figures.append(_figures(sheets[how]))
        except UnsolvableError as error:
            figures.append(TechniqueFigures(how, fault=str(error)))
    if not sheets:
        raise UnsolvableError(
            "no technique suits the sheet: " + "; ".join(f"{one.how}: {one.fault}" for one in figures)
        )
    best = min((one for one in figures if not one.fault), key=lambda one: one.rank)
    return replace(sheets[best.how], comparison=tuple(figures))


def _figures(thick: ThickSheet) -> TechniqueFigures:
    """Return what a thick sheet is like: its box where solids meet, in directions of the least area on panel 0."""
    assert thick.collisions is not None
    course = FoldCourse(configuration_of(thick.solids).closure, thick.angles)
    angles = course.at(np.array([thick.collisions.meeting.place]))
    turns, shifts = body_poses(len(thick.solids.chain), *_hinges(thick.solids), angles)
    corners = np.concatenate([mesh.corners for mesh in thick.plates.placed(turns[0], shifts[0])])
    around = shapely.MultiPoint(corners[:, :2]).minimum_rotated_rectangle
    ring = np.array(around.exterior.coords)
    sides = [*np.linalg.norm(np.diff(ring[:3], axis=0), axis=1).tolist(), float(np.ptp(corners[:, 2]))]
    stowed = tuple(sorted(sides, reverse=True))
    mass = thick.plates.volume * _DENSITY * 1e-6
    meeting = thick.collisions.meeting
    return TechniqueFigures(thick.how, meeting.angle, stowed, thick.plates.thinnest, mass)


def _thickened(at: SheetConfiguration, how: str, wishes: _Wishes) -> ThickSheet:
    """Return the thick sheet of a technique."""
    thickness, scale, clearance = wishes.thickness, wishes.scale, wishes.clearance
    greatest = wishes.angle or np.radians(_GREATEST_ANGLES[how])
    joints = [int(str(joint)) for joint in at.mechanism.sc.joints]
    if how == "spatial":
        at = _exact(at)
    # What excludes heights is a better reason than that nothing moves, so it comes first.
    spatial, thin = _spatial_heights(at, greatest) if how == "spatial" else (None, None)
    if thin is None:
        thin = FoldCourse(at.closure, motion_of(at, MotionOptions()).path.angles).up_to(greatest)
    turned = thin.frames[-1]
    plates: Plates
    heights = HingeHeights(dict.fromkeys(joints, 0.0), (-0.5,) * len(at.mechanism.panels), (), 0.0)
    if spatial is not None:
        heights = spatial
        plates = thick_plates(at.sheet, at.mechanism, heights, thickness, scale)
    elif how == "offset":
        plates, heights = offset_plates(at, thickness, scale, clearance)
    elif how == "tapered":
        plates = tapered_plates(at, trims_of(joints, turned), thickness, scale, clearance, greatest)
    else:
        plates = strip_plates(at, trims_of(joints, turned), thickness, scale, greatest)
    solids = _hinged_solids(at, heights, thickness, scale)
    thick = configuration_of(solids)
    verdict = verdict_of_motion(thick)
    course, keeps = FoldCourse(thick.closure, thin.frames), True
    if heights.of_motion:  # the thin sheet has other motions beside this one, the solids have not
        course = course.up_to(greatest)
    residual = _residual(thick.closure, course.frames)
    if not residual <= thick.tolerances.closed:
        course, keeps = _course_of_solids(at, thick, thin, greatest)
        residual = _residual(thick.closure, course.frames)
    lines = _CreaseLines(at, heights, thickness, scale)
    found = None
    if wishes.collisions:
        plates, found = _swept(plates, solids, course, clearance, lines, keep_risers=how == "offset")
    kept = lines.lines(plates) if isinstance(plates, ThickPlates) and how != "hinge" else lines.whole()
    valleys = frozenset(joint for joint in joints if at.sheet.assignments[joint] == "V")
    return _fitted(ThickSheet(
        solids, heights, plates, thickness, verdict, course.frames, keeps, residual, kept, valleys, how, found,
        hinges="strip" if how == "hinge" else wishes.hinges, clearance=clearance,
        freedoms=_freedoms(thick.closure, course) if heights.of_motion else None,
    ))  # fmt: skip


def _exact(at: SheetConfiguration) -> SheetConfiguration:
    """Return a sheet whose angles that are meant to be alike are so to double precision.

    Opposite sectors at a vertex of Bennett add up to 180 degrees within the precision, and vertices agree on the
    heights of hinges that they share; rounded coordinates would leave the loops of the solids open by as much.
    """
    places = VertexPlaces(at.sheet, at.mechanism, at.linkage)
    meant = MeantAngles(places, max(at.precision.size, DOUBLE.same_point))
    shifts = find_root(_MeantIterate(places, meant, np.zeros(places.unknowns)), _MEETING).at.shifts
    if not shifts.any():
        return at
    written = places.moved(shifts) * at.linkage.extent + at.linkage.middle
    sheet = replace(at.sheet, coordinates=tuple(map(tuple, written.tolist())))
    return _flat_configuration(keeping(sheet, at.precision))


@dataclass(frozen=True)
class _MeantIterate:
    """Shifts of vertices, float[unknowns], with which angles are to be as they are meant, and creases straight."""

    places: VertexPlaces
    meant: MeantAngles
    shifts: Floats

    @cached_property
    def _corners(self) -> Floats:
        return self.places.moved(self.shifts)

    @cached_property
    def _residual(self) -> Floats:
        return np.concatenate([self.meant.residual(self._corners), self.places.line_residual(self._corners)[0]])

    @property
    def error(self) -> float:
        """The largest difference of an angle, or distance from a line."""
        return float(np.abs(self._residual).max(initial=0.0))

    def onwards(self) -> _MeantIterate:
        """Return the vertices moved as little as may be; conditions that follow from others are met with them."""
        by_axes = self.meant.by_axes() @ self.places.motions_of_axes(self._corners)
        jacobian = scipy.sparse.vstack([by_axes, self.places.line_residual(self._corners)[1]], format="csr")
        return replace(self, shifts=self.shifts + TangentSpace(jacobian).step(self._residual))


def _spatial_heights(at: SheetConfiguration, greatest: float) -> tuple[HingeHeights, FoldCourse | None]:
    """Return heights, and the motion of the thin sheet that they keep if vertices have to agree on one."""
    vertices = thick_vertices(at.sheet, at.mechanism, at.tolerances)
    hopeless = any(one.fault and not one.of_motion for one in vertices)
    if hopeless or not needs_motion(vertices):
        return hinge_heights(at.sheet, at.mechanism, at.tolerances), None
    try:
        motion = folded_towards(at.sheet, greatest, _FRAMES)
        places = [motion.configuration.joints.index(joint) for joint in at.mechanism.sc.joints]
        angles = motion.path.angles[:, places]
        return hinge_heights(at.sheet, at.mechanism, at.tolerances, angles), FoldCourse(at.closure, angles)
    except UnsolvableError:  # each vertex by itself, if it is of a known linkage
        return hinge_heights(at.sheet, at.mechanism, at.tolerances), None


def _fitted(thick: ThickSheet) -> ThickSheet:
    """Return a thick sheet with the bores of its hinges, and its solids as shapes of links."""
    seats, plates = thick.seats(), thick.plates
    bores = bores_of(plates, seats, thick.thickness) if thick.hinges == "screws" else {}
    if isinstance(plates, TaperedPlates):
        plates = bored(plates, bores, thick.thickness)
    elif isinstance(plates, ThickPlates):
        plates = drilled(plates, seats, bores, thick.thickness) if bores else plates
    solids = replace(thick.solids, shapes=_shapes(thick.solids, plates))
    return replace(thick, plates=plates, bores=bores, solids=solids)


def _shapes(solids: HingedSolids, plates: Plates) -> tuple[LinkShape, ...]:
    """Return the solids of panels as shapes of links."""
    links, shapes = list(solids.chain.nodes), []
    for mesh, panel in zip(plates.meshes, plates.panels, strict=True):
        corners, triangles = (tuple(map(tuple, rows.tolist())) for rows in (mesh.corners, mesh.triangles))
        shapes.append(LinkShape(links[panel], mesh.name, corners, triangles))
    return tuple(shapes)


def _course_of_solids(
    at: SheetConfiguration, thick: Configuration, thin: FoldCourse, greatest: float
) -> tuple[FoldCourse, bool]:
    """Return the motion of solids by themselves, and whether the thin sheet closes at its angles too.

    Of several branches that is taken which begins nearest to the thin sheet's motion.
    """
    towards = thin.frames[min(1, len(thin.frames) - 1)]
    if thick.branches is None:
        rates = begun_near(thick.closure, thick.linkage, towards).rates
    else:
        every = [rates_towards(branch.space, towards) for branch in thick.branches.branches]
        sizes = [float(np.linalg.norm(rates)) for rates in every]
        near = [float(one @ towards) / size if size else -np.inf for one, size in zip(every, sizes, strict=True)]
        rates = every[int(np.argmax(near))] if every else None
    if rates is None:
        raise UnsolvableError("the solids do not move: no motion begins near that of the thin sheet")
    along = dict(zip(thick.joints, rates.tolist(), strict=True))
    path = motion_of(thick, MotionOptions(along=along, frames=_FRAMES)).path
    course = FoldCourse(thick.closure, path.angles).up_to(greatest)
    return course, _residual(at.closure, course.frames) <= at.tolerances.closed


class _CreaseLines:
    """The creases of a sheet, their panels and heights, as `hinge_lines` takes them."""

    def __init__(self, at: SheetConfiguration, heights: HingeHeights, thickness: float, scale: float) -> None:
        corners = in_space(at.sheet.coordinates or ())[:, :2] * scale
        joints = at.mechanism.sc.joints
        self.ends = {int(str(j)): [corners[list(piece)] for piece in at.mechanism.pieces[int(str(j))]] for j in joints}
        self.panels = {int(str(joint)): [int(str(link)) for link in links] for joint, links in joints.items()}
        self.heights = {joint: height * thickness for joint, height in heights.hinges.items()}

    def whole(self) -> dict[int, list[tuple[Floats, Floats]]]:
        """Return creases from end to end."""
        return {joint: [(piece[0], piece[1]) for piece in pieces] for joint, pieces in self.ends.items()}

    def lines(self, plates: ThickPlates) -> dict[int, list[tuple[Floats, Floats]]]:
        """Return where both panels of each hinge have material."""
        return hinge_lines(plates, self.ends, self.panels, self.heights)


def _swept(
    plates: Plates, solids: HingedSolids, course: FoldCourse, clearance: float, joints: _CreaseLines,
    *, keep_risers: bool = False,
) -> tuple[Plates, Collisions]:  # fmt: skip
    """Return plates, stacks of plies cut back, and whether they meet.

    They are cut for the largest range that leaves a part of each hinge, then again in finer steps if they still meet.
    """
    cut, part, meeting = plates, course, None
    for greatest in _RANGES if isinstance(plates, ThickPlates) else ():
        part = course.up_to(np.radians(greatest))
        for step in np.radians(_STEPS):
            assert isinstance(cut, ThickPlates)
            tried = cut_back(cut, *_moving(cut, solids, part), clearance, step, keep_risers=keep_risers)
            if any(joints.lines(cut)[joint] and not kept for joint, kept in joints.lines(tried).items()):
                break
            cut = tried
            meeting = _moving(cut, solids, part)[0].first_meeting()
            if meeting.panels is None:
                break
        if cut is not plates:
            break
    moving, _ = _moving(cut, solids, course)
    if meeting is None or part is not course:
        meeting = moving.first_meeting()
    return cut, Collisions(meeting, moving.overlaps(np.arange(len(course.frames), dtype=float)), clearance)


def _moving(plates: Plates, solids: HingedSolids, course: FoldCourse) -> tuple[MovingPieces, Any]:
    """Return the solids as pieces on their hinges, and the ply of each piece."""
    pieces, of_ply = plates.pieces()
    return MovingPieces(pieces, *_hinges(solids), course), of_ply


def _hinges(solids: HingedSolids) -> tuple[list[tuple[int, int]], Floats, Floats]:
    """Return the bodies of each hinge, by their places, and its axis: points and unit directions, float[J, 3]."""
    number = {link: place for place, link in enumerate(solids.chain.nodes)}
    pairs = [(number[one], number[other]) for one, other in solids.chain.joints.values()]
    axes = np.array([solids.axes[joint] for joint in solids.chain.joints]).reshape(-1, 2, 3)
    return pairs, axes[:, 0], unit(axes[:, 1])


def _freedoms(closure: ClosureEquations, course: FoldCourse) -> int:
    """Return the degrees of freedom in the middle of a motion, to first order: there it is regular."""
    angles = course.at(np.array([course.end / 2.0]))[0]
    return closure.joints - rank_of(closure.dense(angles))


def _residual(closure: ClosureEquations, angles: Floats) -> float:
    return max((float(np.abs(closure.at(row)[0]).max(initial=0.0)) for row in angles), default=0.0)


def _flat_configuration(sheet: Sheet) -> SheetConfiguration:
    """Return the configuration of a sheet; refuse one that is folded, or without an assignment."""
    at = configuration_of(sheet)
    assert isinstance(at, SheetConfiguration)
    if not at.flat:
        raise UnsolvableError("the sheet is folded; expected a flat one, with mountains and valleys")
    for joint in at.mechanism.sc.joints:
        letter = at.sheet.assignments[int(str(joint))]
        if letter not in "MV":
            branch = "try `synth edit --assign-branch` with a branch that `synth fold --branches` lists"
            raise UnsolvableError(f"crease {joint} has the assignment {letter}; expected M or V; {branch}")
    if np.ptp(at.linkage.points[:, 2], axis=0) > at.tolerances.meant:
        raise UnsolvableError("the sheet is not in a plane z = constant; expected a flat crease pattern")
    return at


def _hinged_solids(at: SheetConfiguration, heights: HingeHeights, thickness: float, scale: float) -> HingedSolids:
    """Return the panels as links and their hinges at their heights."""
    linkage = at.linkage
    places = (linkage.points * linkage.extent + linkage.middle) * scale
    axes: dict[Any, Axis] = {}
    for place, joint in enumerate(at.mechanism.sc.joints):
        x, y, _ = places[place].tolist()
        u, v, w = linkage.directions[place].tolist()
        axes[joint] = (x, y, heights.hinges[int(str(joint))] * thickness), (u, v, w)
    return HingedSolids(SCGraph(at.mechanism.sc.nodes, at.mechanism.sc.joints), axes)
