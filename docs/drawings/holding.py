"""Motion held: why counts are too low, what springs do, where ride-alongs end it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from math import degrees, radians
from pathlib import Path

import numpy as np

import synth
from drawings.altered import DASH, over
from drawings.examples import generated_sheet, generated_solids
from drawings.patterned import Patterned
from drawings.together import above, beside, said
from graphs.errors import numbered
from graphs.files.mechanism_like import MechanismLike
from graphs.mechanism.sheet import Sheet
from graphs.types import Floats
from synth.analysis.compliance.joint_limits import limits
from synth.analysis.compliance.springs import ElasticLinkage, Springs, equilibrium, load_path
from synth.analysis.moving._configuration_of import configuration_of
from synth.catalogue.patterns import generate
from synth.making.drawing import Scene
from synth.making.drawing.scene.frame import Plot, round_steps, signed
from synth.making.drawing.scene.shapes import (
    FINE,
    SMALL,
    STRONG,
    Disc,
    Label,
    Layer,
    Line,
    Point,
    Polygon,
    Shape,
    colour_of_class,
)
from synth.making.drawing.space.motion_files import frame_scenes

__all__ = ["DRAWINGS"]


def overconstraint() -> Scene:
    """A Miura sheet and the sets of loops that hold an idle equation each, numbered."""
    size = {"rows": 3, "columns": 4}
    found = synth.explain(generated_sheet("miura", fold=1.2, **size))
    pattern = Patterned(generated_sheet("miura", **size), 200.0)
    sets = [[_vertex_of(pattern, loop) for loop in one.loops] for one in found.sets]
    marks = [shape for number, corners in enumerate(sets) for shape in _set_of_loops(corners, number)]
    freedoms = numbered(found.freedoms, "freedom")
    (each,) = {one.idle for one in found.sets}
    return said(
        over(pattern.scene(), marks),
        f"folded: {freedoms}, M = {signed(found.count)} by count: {found.idle} equations idle,",
        f"{each} about each inner panel: in the loops of its four vertices",
    )


def _vertex_of(pattern: Patterned, loop: Sequence[object]) -> Point:
    """Return where the vertex with a loop round it lies."""
    loops = pattern.mechanism.sc.loops
    number = next(place for place, one in enumerate(loops) if set(one.joints) == set(loop))
    return pattern.places[pattern.mechanism.loop_vertices[number]]


def _set_of_loops(corners: Sequence[Point], number: int) -> list[Shape]:
    """Return the area between the vertices of a set, rings round them, its number in the middle."""
    x, y = np.mean(corners, axis=0).tolist()
    row = sorted(corners, key=lambda corner: float(np.arctan2(corner[1] - y, corner[0] - x)))
    colour = colour_of_class(number)
    rings = [Disc(corner, 5.0 + 2.5 * number, None, colour, STRONG) for corner in corners]
    return [Polygon(row, colour, None, opacity=0.25), *rings, Label((x, y), str(number + 1), SMALL, bold=True)]


def compliance() -> Scene:
    """A four-bar with a spring: energy and moment while its crank is driven once round."""
    linkage = configuration_of(generated_solids("four-bar", arc1=0.5, arc2=1.3, arc3=1.2, arc4=1.4)).linkage
    elastic = ElasticLinkage(linkage, Springs({2: 1.0}, {2: 0.5}))
    rest = equilibrium(elastic)
    start = rest.angles
    path = load_path(elastic, start, 0, start[0] + np.linspace(0.0, 2.0 * np.pi, 61)[1:])
    turned = np.degrees(np.array([one.angles[path.driver] for one in path.equilibria]) - start[0])
    moments = np.array([float(one.held[0]) for one in path.equilibria])
    energies = np.array([one.energy for one in path.equilibria])
    balanced = [(0.0, rest.stable), *_balances(turned, moments)]
    energy = _curve(
        turned, energies, "energy", [(at, float(np.interp(at, turned, energies)), ok) for at, ok in balanced]
    )
    moment = _curve(turned, moments, "moment that holds the crank", [(at, 0.0, ok) for at, ok in balanced])
    return said(
        above(energy, moment, gap=6.0), "where no moment is needed it is in balance: stable (full) or not (empty)"
    )


def _balances(angles: Floats, moments: Floats) -> Iterator[tuple[float, bool]]:
    """Yield where the moment is zero, and whether it rises there: whether the balance is stable."""
    for place in np.flatnonzero(moments[:-1] * moments[1:] < 0.0):
        low, high = moments[place], moments[place + 1]
        at = angles[place] - low * (angles[place + 1] - angles[place]) / (high - low)
        yield float(at), bool(high > low)


def _curve(angles: Floats, values: Floats, name: str, marks: Sequence[tuple[float, float, bool]]) -> Scene:
    """Return values against the turn of the crank, degrees; poses of balance are discs, full if stable."""
    reach = 1.1 * max(values.max(), -values.min())
    plot = Plot(34.0, 20.0, 300.0, 84.0, (0.0, 360.0), (min(1.1 * float(values.min()), -0.08 * reach), reach))
    shapes: list[Shape] = [Line([plot.at(0.0, 0.0), plot.at(360.0, 0.0)], "grey", FINE, DASH)]
    shapes += plot.below((0, 90, 180, 270, 360), "turn of the crank, degrees")
    shapes += plot.beside(round_steps(*plot.y, most=4), name)
    shapes.append(Line(plot.row(angles, values), "class0", STRONG))
    shapes += [Disc(plot.at(x, y), 3.4, "ink" if stable else "paper", "ink", STRONG) for x, y, stable in marks]
    return Scene(plot.left + plot.width + 14.0, plot.top + plot.height + 26.0, (Layer("curve", tuple(shapes)),))


def activating_constraints() -> Scene:
    """A cylinder with ride-alongs on its creases, opened until they are straight."""
    cylinders = [generated_sheet("deployable-cylinder", short=radians(short)) for short in (35.0, 15.0, 1.0)]
    places = np.array([cylinder.coordinates for cylinder in cylinders])
    poses = frame_scenes(cylinders[0], places, 140.0)
    words = (f"{degrees(_least_left(cylinder)):.0f}° left" for cylinder in cylinders)
    row = beside(*map(said, poses, words), gap=6.0)
    return said(row, "the triangles on the creases are ride-alongs; once they are straight, no crease can open farther")


def _least_left(cylinder: Sheet) -> float:
    """Return the least angle, radians, that a crease can turn before its ride-along is straight."""
    ends = [(one.angle, end.angle) for one in limits(cylinder).ride_alongs for end in (one.lower, one.upper) if end]
    return min(abs(angle - end) for angle, end in ends)


WISHES = Path(__file__).resolve().parent.parent.parent / "data" / "wishes" / "crank-and-follower.json"


def design() -> Scene:
    """A four-bar before and after its design: the turn of its follower against that of its crank, and two wishes."""
    found = synth.design("four-bar", WISHES, starts=1).best
    assert found is not None
    plot = Plot(40.0, 14.0, 280.0, 110.0, (0.0, 45.0), (0.0, 60.0))
    shapes: list[Shape] = [*plot.below((0, 15, 30, 45), "turn of the crank, degrees")]
    shapes += plot.beside((0, 20, 40, 60), "turn of the follower")
    shapes.append(Line(_follower(plot, generate("four-bar").mechanism), "grey", STRONG, DASH))
    shapes.append(Line(_follower(plot, found.mechanism), "class0", STRONG))
    shapes += [Disc(plot.at(*wish), 3.4, "paper", "ink", STRONG) for wish in ((20.0, 24.0), (40.0, 50.0))]
    curve = Scene(plot.left + plot.width + 14.0, plot.top + plot.height + 26.0, (Layer("curve", tuple(shapes)),))
    return said(curve, "dashed: before; full: the design, through both wishes (discs)")


def _follower(plot: Plot, mechanism: MechanismLike) -> list[Point]:
    """Return the curve of the turn of joint 3 against that of joint 0."""
    path = synth.move(mechanism, drive={0: radians(45.0)}, frames=31).path
    turned = np.abs(np.degrees(path.angles - path.angles[0]))
    return plot.row(turned[:, 0], turned[:, 3])


DRAWINGS: dict[str, Callable[[], Scene]] = {
    "design": design,
    "overconstraint": overconstraint,
    "compliance": compliance,
    "activating-constraints": activating_constraints,
}
"""Theory page to what draws its picture."""
