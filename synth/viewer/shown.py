"""What a page shows of one mechanism: its picture, how it moves, and in what words.

What cannot be moved is shown all the same, and why it cannot. Theory: docs/theory/viewer.md.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

from graphs.convert.table import Mechanism
from graphs.errors import SynthedraError, UnsolvableError
from graphs.mechanism.precision import lies_flat
from graphs.mechanism.sheet import Sheet, with_all_edges
from graphs.printing import plain
from synth.drawing.mechanisms.creases import places_on_page
from synth.drawing.mechanisms.pictures import draw
from synth.drawing.scene.svg import svg_text
from synth.folding.configuration import SheetConfiguration
from synth.folding.vertices import largest_panel
from synth.motion.configuration import Configuration
from synth.motion.linkage import PosedLinkage
from synth.moving.made import configuration_of
from synth.verdict.judged import MOST_PANELS, mobility
from synth.viewer.bodies import Bodies, bodies_of_linkage, bodies_of_sheet
from synth.viewer.centres import ShownCentre, centres_of
from synth.viewer.solver_data import solver_data
from synth.viewer.ways import Ways, ways_of

__all__ = ["Drawn", "Moving", "Report", "Shown", "shown_of"]

Report = Callable[[str, int, int], None]
"""Told what is done next, which step that is, and of how many."""

_Posed = TypeVar("_Posed")
_BOX = (420.0, 420.0)
"""Points of the picture, at most."""
_STEPS = 4
"""Of what is reported; the last is that the page puts it up."""


@dataclass(frozen=True, slots=True)
class Moving:
    """A linkage that moves, its bodies and centres; `ways` is None if nothing moves, or no motion was found.

    `ground` is the index of the fixed link; `limited`: joints end at 180 degrees.
    """

    linkage: PosedLinkage
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
            "ways": None if self.ways is None else self.ways.to_json(),
            "centres": [centre.to_json() for centre in self.centres],
            "joints": [plain(joint) for joint in graph.joints],
            "links": [plain(link) for link in graph.nodes],
            "between": [[number[one], number[other]] for one, other in graph.joints.values()],
            "extent": self.linkage.extent,
            "middle": self.linkage.middle.tolist(),
        }


@dataclass(frozen=True, slots=True)
class Drawn:
    """A crease pattern and its picture, so that creases can be added between places on the picture.

    Vertices have the coordinates of the file, `places` are theirs in the picture, and all edges are listed.
    """

    vertices: tuple[tuple[float, ...], ...]
    edges: tuple[tuple[int, int], ...]
    places: list[tuple[float, float]]

    def to_json(self) -> dict[str, Any]:
        """Return plain data: `DrawnData` of web/src/page/types.js."""
        return {"vertices": self.vertices, "edges": self.edges, "places": self.places}


@dataclass(frozen=True, slots=True)
class Shown:
    """A mechanism as a page shows it.

    Attributes
    ----------
    name : str
    verdict : str
        A sentence.
    report : str
        What `synth mobility` prints, line by line.
    notes : tuple of str
        What is not shown or cannot move, and why.
    pictures : mapping of paper to SVG
        Light and dark; empty where there is none.
    moving : Moving or None
        None of what has no pose.
    configuration : Configuration or None
        Where it moves from; None of what has no pose.
    answer : str
        JSON: what `synth mobility --json` prints. Text, since numbers of a page have 53 bits only.
    stiff, clusters : tuple
        Ids of joints that move on no way, and of links that are one.
    drawn : Drawn or None
        Of a crease pattern that lies in a plane.
    on_request : bool
        Whether it is so large that its motion is looked for on request only.
    """

    name: str
    verdict: str
    report: str
    notes: tuple[str, ...]
    pictures: dict[str, str]
    moving: Moving | None
    configuration: Configuration | None
    answer: str
    stiff: tuple[str, ...]
    clusters: tuple[tuple[str, ...], ...]
    drawn: Drawn | None = None
    on_request: bool = False

    def to_json(self) -> dict[str, Any]:
        """Return plain data: `ShownData` of web/src/page/types.js."""
        at, ways = self.configuration, None if self.moving is None else self.moving.ways
        first = None if ways is None else ways.taken
        return {
            "name": self.name,
            "verdict": self.verdict,
            "report": self.report,
            "notes": list(self.notes),
            "pictures": self.pictures,
            "moving": None if self.moving is None else self.moving.to_json(),
            "configuration": None if at is None else at.to_json(at.branch(first)),
            "answer": self.answer,
            "stiff": list(self.stiff),
            "clusters": [list(cluster) for cluster in self.clusters],
            "drawn": None if self.drawn is None else self.drawn.to_json(),
            "on_request": self.on_request,
        }


def shown_of(
    thing: Mechanism,
    name: str = "",
    *,
    motion: bool | None = None,
    report: Report = lambda _what, _step, _of: None,
) -> Shown:
    """Return what a page shows of a mechanism.

    Parameters
    ----------
    thing : Sheet, SCGraph, SCDGraph, PolyhedronModel, HingedSolids, SurfaceLinkage, ...
        Of a sheet with several frames the first that has coordinates is moved.
    name : str, optional
        What it is called on the page, such as the name of its file.
    motion : bool, optional
        Look for the motion of a crease pattern from its pose; by default of what is not too large, as
        `synth.mobility` does.
    report : callable, optional
        Called before each step.

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
    placed = thing.frames.first_placed() if isinstance(thing, Sheet) and thing.frames is not None else thing
    notes: list[str] = []
    on_request = isinstance(placed, Sheet) and len(placed.faces) > MOST_PANELS and not motion
    report("looking for ways to move", 1, _STEPS)
    at, moving = _moving(placed, notes, still=on_request)
    report("counting and judging", 2, _STEPS)
    answer = mobility(placed if at is None or on_request else at, motion=motion)
    verdict = answer.verdict
    assert verdict is not None
    report("drawing", 3, _STEPS)
    pictures = _pictures(placed if at is None else at, notes)
    return Shown(
        plain(name),
        verdict.text,
        str(answer),
        tuple(notes),
        pictures,
        moving,
        at,
        json.dumps(answer.to_json(), indent=2, allow_nan=False),
        tuple(map(plain, verdict.stiff_joints)) if verdict.certainty != "not known" else (),
        tuple(tuple(map(plain, cluster)) for cluster in verdict.clusters),
        _drawn(placed) if isinstance(placed, Sheet) else None,
        on_request,
    )


def _drawn(sheet: Sheet) -> Drawn | None:
    if sheet.coordinates is None or not lies_flat(sheet):
        return None
    return Drawn(sheet.coordinates, with_all_edges(sheet).edges, places_on_page(sheet, _BOX))


def _moving(thing: Mechanism, notes: list[str], *, still: bool) -> tuple[Configuration | None, Moving | None]:
    """Return a thing at its configuration, and what moves there unless it is still; note why there is nothing."""
    try:
        at = configuration_of(thing, mend=not still)
    except SynthedraError as error:
        notes.append(f"not moved: {error}")
        return None, None
    notes += [f"repaired: {repair}" for repair in at.mended]
    ways = None if still or not at.joints else _begun(at, notes)
    centres = () if still else centres_of(at)
    if not isinstance(at, SheetConfiguration):
        return at, Moving(at.linkage, bodies_of_linkage(at.linkage), ways, centres, ground=0, limited=False)
    bodies = bodies_of_sheet(at.sheet, at.mechanism, at.linkage)
    return at, Moving(at.linkage, bodies, ways, centres, largest_panel(at.mechanism.panels), limited=True)


def _begun(at: Configuration, notes: list[str]) -> Ways | None:
    """Return the ways to begin; note it where there are none, since what is rigid is shown too."""
    try:
        return ways_of(at)
    except UnsolvableError as error:
        notes.append(str(error))
        return None


def _pictures(thing: Mechanism | Configuration, notes: list[str]) -> dict[str, str]:
    """Return the picture on light and on dark paper; note why there is none."""
    try:
        scene = draw(thing, box=_BOX, caption=None)
    except SynthedraError as error:
        notes.append(f"not drawn: {error}")
        return {}
    return {paper: svg_text(scene, paper=paper) for paper in ("light", "dark")}
