"""Random mechanisms of 31 types as functions of what they are made of, each at a closed configuration.

Of overconstrained ones the numbers are parameters of their generator; sheets of triangles and single vertices take
any coordinates of their vertices.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from math import pi

import numpy as np
from folding_patterns import triangulated
from spherical import STEPHENSON, WATT, spherical

from graphs.convert.duality import mechanism_of_sheet
from graphs.errors import SynthedraError
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet, with_all_edges
from graphs.mechanism.solids import HingedSolids
from graphs.rank.exact import independent_cycles
from synth.analysis.folding.derivatives import SheetDerivatives, vertex_places
from synth.analysis.folding.motion import fold
from synth.analysis.motion.closure import ClosureEquations, corrected
from synth.analysis.motion.derivatives import BodyTree, Sensitivity, dependence_on_axes, derivatives_by_parameters
from synth.analysis.motion.linkage import Linkage, link_motions, linkage_of_axes, linkage_of_sheet
from synth.analysis.motion.path import driven_path
from synth.analysis.moving._configuration_of import linkage_of_closed_form
from synth.catalogue.patterns import hinged_rings, hinged_rings as five_bars
from synth.catalogue.patterns.creases import (
    chickenwire,
    fan,
    folded_miura,
    huffman_grid,
    miura,
    square_twist,
    waterbomb,
    yoshimura,
)
from synth.catalogue.patterns.hinged_rings import kaleidocycle
from synth.linkages.conformed.linkage_behaviour import loop_on_cones


@dataclass
class Made:
    """A mechanism as a function of numbers, at a closed configuration.

    `where` gives points of it that are compared: places of vertices, or of four points of each link; `forward` and
    `adjoint` are the derivatives that are tested.
    """

    linkage: Callable[[np.ndarray], Linkage]
    numbers: np.ndarray
    direction: np.ndarray
    angles: np.ndarray
    driven: list[int]
    where: Callable[[np.ndarray, np.ndarray], np.ndarray]
    forward: Callable[[np.ndarray], tuple]
    adjoint: Callable[[np.ndarray, np.ndarray], np.ndarray]
    at: Sensitivity = field(repr=False)


def random_made(kind, seed):
    """A random mechanism of a kind: of those drawn one after the other the first that moves so far."""
    for number in range(40):
        rng = np.random.default_rng((seed, number, KINDS.index(kind)))
        try:
            made = _MAKERS[kind](rng)
        except SynthedraError:
            continue
        if made is not None and _far_from_singular(made):
            return replace(made, direction=made.direction / np.linalg.norm(made.direction))
    raise AssertionError(f"no {kind} moves")


def _far_from_singular(made):
    """Where it is not, differences of any step are too coarse."""
    jacobian = made.at.closure.at(made.angles)[1].toarray()[:, np.setdiff1d(range(len(made.angles)), made.driven)]
    sizes = np.linalg.svd(jacobian, compute_uv=False)
    return sizes[sizes > 1e-9 * sizes[0]].min() > 0.01 * sizes[0]


# --- linkages by their axes


def _of_axes(linkage_of, numbers, direction, dependence, rng, drivers=1):
    """A linkage whose axes are functions of numbers; driven from its pose by a random angle."""
    linkage = linkage_of(numbers)
    closure = ClosureEquations(linkage)
    driven = sorted(rng.choice(len(linkage.angles), drivers, replace=False).tolist())
    goals = rng.choice([-1.0, 1.0], drivers) * rng.uniform(0.25, 0.6, drivers)
    path = driven_path(closure, linkage.angles, driven, [goals])
    if path.stopped or np.abs(np.diff(path.angles[-2:], axis=0)).max() > 2.0:
        return None
    angles = path.angles[-1]
    at = Sensitivity(closure, angles, driven)
    tree = BodyTree(linkage)
    bodies = tree.at(angles)
    corners = np.vstack([np.zeros(3), np.eye(3)])  # fixed in the links at the pose, in the unit of the coordinates
    local = (corners - linkage.middle) / linkage.extent
    rows = np.repeat(np.arange(len(tree.row)), 4)
    spots = np.tile(local, (len(tree.row), 1))

    def where(numbers, angles):
        one = linkage_of(numbers)
        motions = link_motions(one, angles[None])
        moved = (corners - one.middle) / one.extent
        made = [moved @ motions[link][0][0].T + motions[link][1][0] for link in one.graph.nodes]
        return np.concatenate(made) * one.extent + one.middle

    def forward(change):
        axes = dependence.forward(change)
        follows = at.forward(axes)
        twists = bodies.forward(follows.angles, axes)
        moved = bodies.places_forward(rows, spots, twists, np.zeros_like(spots)) * linkage.extent
        return follows.angles, moved, follows.residual, at.rank_residual(axes, follows)

    def adjoint(by_angles, by_places):
        wrenches, _ = bodies.places_adjoint(rows, spots, by_places * linkage.extent)
        turned, direct = bodies.adjoint(wrenches)
        return dependence.adjoint(at.adjoint(by_angles + turned) + direct)

    return Made(linkage_of, numbers, direction, angles, driven, where, forward, adjoint, at)


def _by_lines(graph, points, directions, kept_points, kept_directions, rng, drivers=1):
    """A linkage by points and directions of its axes, of which some may change."""
    numbers = np.concatenate([points, directions], axis=1).ravel()

    def linkage_of(numbers):
        lines = numbers.reshape(-1, 6)
        return linkage_of_axes(graph, {j: (one[:3], one[3:]) for j, one in zip(graph.joints, lines, strict=True)})

    mask = np.broadcast_to([*kept_points, *kept_directions], (len(points), 6)).ravel()
    direction = rng.normal(size=mask.shape) * mask
    return _of_axes(linkage_of, numbers, direction, dependence_on_axes(linkage_of(numbers)), rng, drivers)


def _about_a_point(graph):
    def make(rng):
        linkage = spherical(graph, rng)
        directions = linkage.directions
        return _by_lines(linkage.graph, np.zeros_like(directions), directions, [0] * 3, [1] * 3, rng)

    return make


def _ring(n):
    return SCGraph(n, [(i, (i + 1) % n) for i in range(n)])


def _on_cone(rng):
    linkage = linkage_of_closed_form(loop_on_cones(np.radians(rng.uniform(40, 130, 5)))[0])
    directions = linkage.directions
    return _by_lines(linkage.graph, np.zeros_like(directions), directions, [0] * 3, [1] * 3, rng, 2)


def _planar(graph, drivers=1):
    def make(rng):
        loops = [Loop(loop.joints, "infinite") for loop in independent_cycles(graph)]
        joints = len(graph.joints)
        plane = SCGraph(graph.nodes, graph.joints, loops)
        points = np.column_stack([rng.normal(size=(joints, 2)), np.zeros(joints)])
        directions = np.tile([0.0, 0.0, 1.0], (joints, 1))
        return _by_lines(plane, points, directions, [1] * 3, [0] * 3, rng, drivers)

    return make


def _spatial(n):
    def make(rng):
        points, directions = rng.normal(size=(2, n, 3))
        directions /= np.linalg.norm(directions, axis=1, keepdims=True)
        return _by_lines(_ring(n), points, directions, [1] * 3, [1] * 3, rng)

    return make


def _of_solids(generator, draw):
    """Rings of a generator: parameters to solids, along them."""

    def make(rng):
        numbers = np.array(draw(rng))

        def solids(numbers) -> HingedSolids:
            return generator(*numbers)

        def linkage_of(numbers):
            one = solids(numbers)
            return linkage_of_axes(one.chain, one.axes)

        def lines(numbers):
            axes = solids(numbers).axes.values()
            return np.array([[*point, *np.array(along) / np.linalg.norm(along)] for point, along in axes])

        dependence = dependence_on_axes(linkage_of(numbers)).after(derivatives_by_parameters(lines, numbers).matrix)
        return _of_axes(linkage_of, numbers, rng.normal(size=len(numbers)), dependence, rng)

    return make


def _line_symmetric(*numbers):
    return hinged_rings.line_symmetric(half=np.reshape(numbers, (3, 2, 3)).tolist())


# --- sheets by their vertices


def _of_sheet(sheet_of, numbers, slopes, direction, rng, angles=None):
    """A sheet whose coordinates are functions of numbers.

    Folded until a crease has a random angle, or as it is posed, or at random angles that close.
    """
    sheet: Sheet = sheet_of(numbers)
    mechanism = mechanism_of_sheet(sheet)
    linkage = linkage_of_sheet(sheet, mechanism)
    joints = list(linkage.graph.joints)
    if angles is None:
        begun = fold(sheet, frames=8)
        moving = int(np.abs(begun.path.angles[-1]).argmax())
        goal = np.sign(begun.path.angles[-1, moving]) * rng.uniform(0.5, 1.3)
        folding = fold(sheet, drive={joints[moving]: goal}, branch=begun.branch, frames=3)
        if folding.path.stopped:
            return None
        angles, driven = folding.path.angles[-1], [moving]
    elif angles == "posed":
        angles, driven = linkage.angles, [int(rng.integers(len(joints)))]
    else:
        found = corrected(ClosureEquations(linkage), rng.uniform(-1.3, 1.3, len(joints)))
        if not found.closed:
            return None
        angles, driven = found.angles, sorted(rng.choice(len(joints), 2, replace=False).tolist())
    shape = SheetDerivatives(sheet, mechanism, linkage)
    at = shape.at(angles, driven)
    per_vertex = len(sheet.coordinates[0])

    def linkage_at(numbers):
        return linkage_of_sheet(sheet_of(numbers), mechanism)

    def where(numbers, angles):
        return vertex_places(sheet_of(numbers), mechanism, linkage_at(numbers), angles[None])[0][0]

    def forward(change):
        one = at.forward((slopes @ change).reshape(-1, per_vertex))
        return one.angles, one.places, one.residual, one.rank_residual

    def adjoint(by_angles, by_places):
        return slopes.T @ at.adjoint(by_angles, by_places).ravel()

    return Made(linkage_at, numbers, direction, angles, driven, where, forward, adjoint, at.sensitivity)


def _by_parameters(generator, draw, angles=None):
    """Sheets of a generator along its parameters."""

    def make(rng):
        numbers = np.array(draw(rng))

        def sheet_of(numbers):
            return with_all_edges(generator(*numbers))

        slopes = derivatives_by_parameters(lambda numbers: np.array(sheet_of(numbers).coordinates), numbers).matrix
        return _of_sheet(sheet_of, numbers, slopes, rng.normal(size=len(numbers)), rng, angles)

    return make


def _by_vertices(draw, angles=None):
    """Sheets along any coordinates in their plane."""

    def make(rng):
        sheet = with_all_edges(draw(rng))
        numbers = np.array(sheet.coordinates).ravel()

        def sheet_of(numbers):
            places = tuple(map(tuple, np.reshape(numbers, (-1, 2)).tolist()))
            return Sheet(sheet.vertices, sheet.edges, sheet.assignments, sheet.faces, places)

        return _of_sheet(sheet_of, numbers, np.eye(len(numbers)), rng.normal(size=len(numbers)), rng, angles)

    return make


def _vertex(creases):
    def draw(rng):
        sectors = rng.dirichlet(np.full(creases, 6.0)) * 2 * pi
        while sectors.max() > 0.9 * pi:
            sectors = rng.dirichlet(np.full(creases, 6.0)) * 2 * pi
        return fan((np.cumsum(sectors) - sectors[0]).tolist())

    return _by_vertices(draw, "random" if creases > 5 else None)


def _between(*ranges):
    return lambda rng: [rng.uniform(a, b) for a, b in ranges]


_MAKERS = {
    "spherical four-bar": _about_a_point(_ring(4)),
    "spherical five-bar": _about_a_point(_ring(5)),
    "spherical six-bar": _about_a_point(_ring(6)),
    "spherical Watt": _about_a_point(WATT),
    "spherical Stephenson": _about_a_point(STEPHENSON),
    "on a cone": _on_cone,
    "planar four-bar": _planar(_ring(4)),
    "planar five-bar": _planar(_ring(5), 2),
    "planar Watt": _planar(WATT),
    "spatial 7R": _spatial(7),
    "spatial 8R": _spatial(8),
    "Bennett": _of_solids(five_bars.bennett, _between((0.5, 2.5), (0.3, 0.9), (1.1, 2.0))),
    "Goldberg": _of_solids(five_bars.goldberg, _between((0.6, 2.0), (0.4, 0.9), (1.1, 1.4), (1.7, 2.0), (0.2, 1.0))),
    "Myard": _of_solids(five_bars.myard, _between((0.6, 2.0), (0.4, 0.9))),
    "Bricard, line": _of_solids(_line_symmetric, lambda rng: rng.normal(size=18)),
    "Bricard, plane": _of_solids(hinged_rings.plane_symmetric, _between((0.0, 0.5))),
    "Bricard, trihedral": _of_solids(hinged_rings.trihedral, _between(*[(0.6, 1.6)] * 3)),
    "kaleidocycle": _of_solids(lambda tilt: kaleidocycle(6, tilt), _between((0.65, 0.9))),
    "Sarrus": _by_parameters(five_bars.sarrus, _between((0.5, 2.0), (0.8, 2.0), (0.4, 1.5)), "posed"),
    "vertex of four": _vertex(4),
    "vertex of five": _vertex(5),
    "vertex of six": _vertex(6),
    "vertex of seven": _vertex(7),
    "Miura": _by_parameters(lambda *p: miura(3, 4, *p), _between((0.6, 1.3), (0.6, 1.6), (0.6, 1.6))),
    "folded Miura": _by_parameters(
        lambda *p: folded_miura(3, 3, *p), _between((0.4, 1.1), (0.7, 1.3), (0.7, 1.4), (0.7, 1.4)), "posed"
    ),
    "chicken wire": _by_parameters(lambda *p: chickenwire(3, 3, *p), _between((0.7, 1.3), (1.5, 2.5))),
    "Huffman": _by_parameters(lambda *p: huffman_grid(2, 3, *p), _between((1.25, 1.4), (1.02, 1.12), (0.9, 1.1))),
    "square twist": _by_parameters(square_twist, _between((0.2, 0.6), (0.25, 0.45))),
    "waterbomb": _by_vertices(lambda _: waterbomb(2, 2), "random"),
    "Yoshimura": _by_vertices(lambda rng: yoshimura(3, 2, 1.0, rng.uniform(0.4, 0.9)), "random"),
    "triangles": _by_vertices(lambda rng: triangulated(3, 3, rng), "random"),
}

KINDS = list(_MAKERS)
