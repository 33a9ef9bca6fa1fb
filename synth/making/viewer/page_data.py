"""What a page shows of one mechanism: its picture, verdict and report, and the motions that one can choose from.

The starts of motions are found in Python and followed in the page. A mechanism that cannot be moved is shown too,
with the reason. Theory: docs/theory/viewer.md.
"""

import json
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from graphs.convert.conversions import Mechanism
from graphs.errors import SynthedraError, UnsolvableError
from graphs.mechanism.precision import lies_flat
from graphs.mechanism.sheet import Sheet, with_all_edges
from graphs.mechanism.solids import HingedSolids
from graphs.mechanism.surfaces import SurfaceLinkage
from graphs.plain_data import fields_to_json, plain_data
from graphs.printing import plain
from graphs.tolerances import DOUBLE, leading
from graphs.types import Floats, Ints
from synth.analysis.folding.configuration import SheetConfiguration
from synth.analysis.folding.derivatives import largest_panel
from synth.analysis.layering.summary import FlatFoldability, flat_foldability
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.configuration import Configuration
from synth.analysis.motion.driven_motion import BranchChoice, beginning
from synth.analysis.motion.germ import Branch
from synth.analysis.motion.linkage import Linkage
from synth.analysis.motion.singular.sampling import walked
from synth.analysis.motion.walk.events import free_rates, independent_joints
from synth.analysis.moving._configuration_of import configuration_of
from synth.analysis.verdict._mobility import mobility, on_request, verdict_of_type
from synth.linkages.conformed.linkage_behaviour import linkage_on_surfaces
from synth.making.drawing.mechanisms.creases import places_on_page
from synth.making.drawing.mechanisms.pictures import draw
from synth.making.drawing.scene.writing import svg_text
from synth.making.viewer.flat import ShownFlat, flat_shown
from synth.making.viewer.linkage import (
    Bodies,
    ShownCentre,
    bodies_of_linkage,
    bodies_of_shapes,
    bodies_of_sheet,
    bodies_on_surface,
    centres_of,
    solver_data,
)

Report = Callable[[str, int, int], None]
"""Called with the next step in words, its number, and the number of steps."""

_BOX = (420.0, 420.0)
"""Largest width and height of the picture, points."""
_STEPS = 4
"""Number of steps that are reported; the last is that the page shows the mechanism."""
_MOST_PANELS = 1200
"""Larger sheets are shown as they are; their motion is looked for on request only."""
_LAYER_VARIABLES = 120
"""Pairs of panels that depend on each other up to which layer orders are counted: all pairs of a map of 4 x 4."""
_MOST_FRAMES = 200
"""Frames of a file up to which the flat one is looked for."""
_MOST_WAYS = 256
"""Branches that a page lists, at most, and the one that the assignment chooses."""
_MOST_DRIVERS = 40
"""Joints with a slider of their own, at most; others can be dragged."""


@dataclass(frozen=True, slots=True)
class Beginning:
    """One start of a motion, with the label that the page lists.

    `rates`, float[J], are those at the configuration, the largest 1 or -1. `drivers` are the indices of the
    driven joints, one for each degree of freedom, the fastest first; `immobile` are those of the immobile joints.
    `freedoms` is None if unknown.
    """

    label: str
    rates: Floats
    drivers: tuple[int, ...]
    immobile: tuple[int, ...] = ()
    freedoms: int | None = None

    def to_json(self) -> dict[str, Any]:
        """Return plain data: `WayData` of web/src/page/types.js."""
        return fields_to_json(self, keys={"label": "told"})


@dataclass(frozen=True, slots=True)
class Ways:
    """All starts of a motion to choose from; `taken` is the index of the first choice.

    If `singular`, the configuration has to be left at the rates of one of them; else the least rates do.
    """

    all: tuple[Beginning, ...]
    singular: bool
    taken: int


def ways_of(configuration: Configuration) -> Ways:
    """Return the starts of motions of a mechanism with joints: one for each branch.

    Raise UnsolvableError if the mechanism is rigid, or no motion was found.
    """
    closure, branches = configuration.closure, configuration.branches
    number, rates = beginning(configuration, BranchChoice())
    rates = rates / np.abs(rates).max()
    if branches is None:  # too many joints to look for branches
        angles, first = configuration.linkage.angles, leading(rates)
        end = walked(angles, closure, rates)[0]
        moving = np.flatnonzero(np.maximum(np.abs(rates), np.abs(end - angles)) > DOUBLE.immobile)
        freedoms, drivers = _driven(closure, end, moving, first)
        nearest = Beginning("nearest to the assignment", rates, drivers, freedoms=freedoms)
        return Ways((nearest,), singular=True, taken=0)
    if number is None:
        return Ways((_start_of_branch(0, branches.branches[0], rates, closure),), singular=False, taken=0)
    listed = list(enumerate(branches.branches[:_MOST_WAYS]))
    if number >= len(listed):  # one of so many that not all are listed
        listed.append((number, branches.branch(number)))
    starts = [
        _start_of_branch(index, branch, rates if index == number else branch.rates, closure) for index, branch in listed
    ]
    return Ways(tuple(starts), singular=True, taken=[index for index, _ in listed].index(number))


def _start_of_branch(number: int, branch: Branch, rates: Floats, closure: ClosureEquations) -> Beginning:
    freedoms, first = branch.freedoms, leading(rates)
    degrees = f"{'unknown' if freedoms is None else freedoms} DOF"
    moving = np.setdiff1d(np.arange(len(rates)), np.array(branch.immobile, dtype=np.int64))
    # rates that close to first order may be more than the degrees of freedom, which are those to second order
    drivers = (first,) if not freedoms else _driven(closure, branch.sample, moving, first)[1][:freedoms]
    return Beginning(f"branch {number}: {degrees}, {branch.certainty}", rates, drivers, branch.immobile, freedoms)


def _driven(closure: ClosureEquations, angles: Floats, moving: Ints, first: int) -> tuple[int | None, tuple[int, ...]]:
    """Return the degrees of freedom at some angles, and the indices of the joints that drive them."""
    basis = free_rates(closure, angles, moving)
    if basis is None or first not in moving:
        return None, (first,)
    rows = independent_joints(basis, int(np.searchsorted(moving, first)))
    return basis.shape[1], tuple(int(moving[row]) for row in rows[:_MOST_DRIVERS])


@dataclass(frozen=True, slots=True)
class MovingLinkage:
    """A linkage with its bodies and centres; `ways` is None if it is rigid, or no motion was found.

    `ground` is the index of the fixed link; `limited`: joints end at 180 degrees.
    """

    linkage: Linkage
    bodies: Bodies
    ways: Ways | None
    centres: tuple[ShownCentre, ...]
    ground: int
    limited: bool

    def to_json(self) -> dict[str, Any]:
        """Return plain data: `MovingData` of web/src/page/types.js."""
        graph = self.linkage.graph
        number = {link: place for place, link in enumerate(graph.nodes)}
        return {
            "solver": solver_data(self.linkage, limited=self.limited, ground=list(graph.nodes)[self.ground]),
            "bodies": self.bodies.to_json(),
            "ways": plain_data(self.ways),
            "centres": plain_data(self.centres),
            "joints": [plain(joint) for joint in graph.joints],
            "links": [plain(link) for link in graph.nodes],
            "between": [[number[first], number[second]] for first, second in graph.joints.values()],
            "extent": self.linkage.extent,
            "middle": self.linkage.middle.tolist(),
        }


@dataclass(frozen=True, slots=True)
class DrawnCreases:
    """A crease pattern and its picture, so that creases can be added between places on the picture.

    Vertices have the coordinates of the file, `places` are theirs in the picture, and all edges are listed.
    """

    vertices: tuple[tuple[float, ...], ...]
    edges: tuple[tuple[int, int], ...]
    places: list[tuple[float, float]]


@dataclass(frozen=True, slots=True)
class Shown:
    """A mechanism as a page shows it.

    Attributes
    ----------
    name : str
    verdict : str
        A sentence.
    report : str
        Output of `synth mobility`.
    notes : tuple of str
        Repairs, and reasons why something is not shown or cannot move.
    pictures : mapping of paper to SVG
        Light and dark; empty if the mechanism cannot be drawn.
    moving : MovingLinkage or None
        None without coordinates.
    configuration : Configuration or None
        Where the motion starts; None without coordinates.
    answer : str
        Output of `synth mobility --json`, as text, since numbers of a page have 53 bits only.
    immobile, clusters : tuple
        Ids of immobile joints, and of links that move as one.
    drawn : DrawnCreases or None
        For a crease pattern that lies in a plane.
    on_request : bool
        Whether the mechanism is so large that its motion is looked for on request only.
    flat : ShownFlat or None
        For a crease pattern that folds flat, its layer orders.
    """

    name: str
    verdict: str
    report: str
    notes: tuple[str, ...]
    pictures: dict[str, str]
    moving: MovingLinkage | None
    configuration: Configuration | None
    answer: str
    immobile: tuple[str, ...]
    clusters: tuple[tuple[str, ...], ...]
    drawn: DrawnCreases | None = None
    on_request: bool = False
    flat: ShownFlat | None = None

    def to_json(self) -> dict[str, Any]:
        """Return plain data: `ShownData` of web/src/page/types.js."""
        at, ways = self.configuration, None if self.moving is None else self.moving.ways
        configuration = None if at is None else at.to_json(at.branch(None if ways is None else ways.taken))
        return {
            name: configuration if name == "configuration" else plain_data(getattr(self, name))
            for name in self.__slots__
        }


def shown_of(
    mechanism: Mechanism, name: str = "", *, motion: bool | None = None, report: Report = lambda _what, _step, _of: None
) -> Shown:
    """Return what a page shows of a mechanism.

    Parameters
    ----------
    mechanism : Sheet, SCGraph, SCDGraph, PolyhedronModel, HingedSolids, SurfaceLinkage, ...
        For a sheet with several frames, the first that has coordinates is moved.
    name : str, optional
        Name on the page, such as that of a file.
    motion : bool, optional
        Look for the motion of a crease pattern from its configuration; by default only if the pattern is not too
        large, as `synth.mobility` does.
    report : callable, optional
        Called before each step with the step in words, its number, and the number of steps.

    Raises
    ------
    UnsolvableError, FileError, InvariantError
        As `synth.mobility` does.

    Examples
    --------
    >>> corners = ((0, 0), (1, 0), (.5, 1), (-1, 0), (.5, -1))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> shown = shown_of(Sheet(5, (), "", faces, corners), "vertex")
    >>> shown.verdict, len(shown.moving.ways.all)
    ('Rigid-foldable from the flat state: 1 degree of freedom. 2 folding branches.', 2)
    """
    placed = (
        mechanism.frames.first_placed() if isinstance(mechanism, Sheet) and mechanism.frames is not None else mechanism
    )
    notes: list[str] = []
    on_request_only = isinstance(placed, Sheet) and len(placed.faces) > _MOST_PANELS and not motion
    report("finding motion branches", 1, _STEPS)
    at, moving = _moving(placed, notes, searched=not on_request_only)
    report("finding the mobility", 2, _STEPS)
    answer = mobility(placed if at is None or on_request_only else at, motion=False if on_request_only else motion)
    if on_request_only and isinstance(placed, Sheet) and motion is None and answer.infinitesimal is not None:
        answer = replace(answer, verdict=verdict_of_type(answer.report, on_request(placed)))
    verdict = answer.verdict
    report("drawing", 3, _STEPS)
    pictures = _pictures(_flat_pattern(mechanism) or (placed if at is None else at), notes)
    sheet: Sheet | None = placed if isinstance(placed, Sheet) else None
    drawn = None
    if sheet is not None and sheet.coordinates is not None and lies_flat(sheet):
        drawn = DrawnCreases(sheet.coordinates, with_all_edges(sheet).edges, places_on_page(sheet, _BOX))
    return Shown(
        plain(name),
        verdict.text,
        str(answer),
        tuple(notes),
        pictures,
        moving,
        at,
        json.dumps(answer.to_json(), indent=2, allow_nan=False),
        tuple(map(plain, verdict.immobile_joints)) if verdict.certainty != "not known" else (),
        tuple(tuple(map(plain, cluster)) for cluster in verdict.clusters),
        drawn,
        on_request_only,
        _flat(answer.flat_folding, at),
    )


def _flat(known: FlatFoldability | None, at: Configuration | None) -> ShownFlat | None:
    """Return a sheet folded flat, from the answer on its mobility unless that left its orders uncounted."""
    if known is not None and known.foldable is None and isinstance(at, SheetConfiguration):
        known = flat_foldability(at.drawn, variables=_LAYER_VARIABLES)
    return flat_shown(known.folding) if known is not None and known.foldable and known.folding is not None else None


def _moving(
    mechanism: Mechanism, notes: list[str], *, searched: bool
) -> tuple[Configuration | None, MovingLinkage | None]:
    """Return a mechanism at its configuration, and its motions if they are `searched`; note why there are none."""
    try:
        at = configuration_of(mechanism, mend=searched)
    except SynthedraError as error:
        notes.append(f"not moved: {error}")
        return None, None
    notes += [f"repaired: {repair}" for repair in at.mended]
    ways = None
    if at.joints and searched:
        try:
            ways = ways_of(at)
        except UnsolvableError as error:  # rigid: it is shown too
            notes.append(str(error))
    centres = centres_of(at) if searched else ()
    if not isinstance(at, SheetConfiguration):
        return at, MovingLinkage(at.linkage, _bodies(mechanism, at), ways, centres, ground=0, limited=at.limited)
    bodies = bodies_of_sheet(at.sheet, at.mechanism, at.linkage)
    return at, MovingLinkage(at.linkage, bodies, ways, centres, largest_panel(at.mechanism.panels), limited=True)


def _flat_pattern(mechanism: Mechanism) -> Sheet | None:
    """Return the frame of a folded sheet's file that lies flat; None if it lies flat itself, or the file has none."""
    if not isinstance(mechanism, Sheet) or mechanism.frames is None or mechanism.frames.others > _MOST_FRAMES:
        return None
    frames = [mechanism.frames.frame(number) for number in range(mechanism.frames.others + 1)]
    placed = [sheet for sheet in frames if sheet.coordinates is not None]
    if not placed or lies_flat(placed[0]):
        return None
    return next((sheet for sheet in placed if lies_flat(sheet) and len(sheet.faces) == len(placed[0].faces)), None)


def _bodies(mechanism: Mechanism, at: Configuration) -> Bodies:
    """Return the bodies of a linkage: shapes of links, curved shells on a cone or a cylinder, else by its axes."""
    if isinstance(mechanism, HingedSolids) and mechanism.shapes:
        return bodies_of_shapes(mechanism, at.linkage)
    if not isinstance(mechanism, SurfaceLinkage):
        return bodies_of_linkage(at.linkage)
    (on_surface,) = linkage_on_surfaces(mechanism)
    return bodies_on_surface(on_surface, at.linkage)


def _pictures(mechanism: Mechanism | Configuration, notes: list[str]) -> dict[str, str]:
    """Return the picture on light and on dark paper; note why there is none."""
    try:
        scene = draw(mechanism, box=_BOX, caption=None)
    except SynthedraError as error:
        notes.append(f"not drawn: {error}")
        return {}
    return {paper: svg_text(scene, paper=paper) for paper in ("light", "dark")}
