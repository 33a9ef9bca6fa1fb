"""The mechanisms of Wampler, Larson, Erdman 2007."""

from __future__ import annotations

from itertools import combinations

import networkx as nx
from entries import entries_of
from wiener_2016 import WATT, WATT_LOOPS

from graphs.convert.panels import polyhedron_of, scd_from_panels
from graphs.loops.loop import Loop
from graphs.mechanism.polyhedron import GROUND, PointConstraint, PolyhedronModel, RemoteCentre
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph

wampler = entries_of("wampler", "Wampler 2007", "004")


def body(vertices: int) -> PolyhedronModel:
    """Return a rigid body of 2 to 5 vertices."""
    rods = list(combinations(range(vertices), 2))
    return PolyhedronModel(vertices, [rod for rod in rods if vertices < 5 or rod != (3, 4)])


def fig1() -> PolyhedronModel:
    """Return two rectangles hinged on GH with triangles at either end: the mechanism of Fig. 1."""
    panels = ["BCHG", "FEHG", "AGB", "AGF", "DHC", "DHE"]
    return polyhedron_of(scd_from_panels({"".join(panel): tuple(panel) for panel in panels}))


def rods_of(*rods: tuple[int, int]) -> PolyhedronModel:
    """Return the model of the given rods."""
    return PolyhedronModel(1 + max(v for rod in rods for v in rod), rods)


def fig12() -> SCDGraph:
    """Return the spherical four-bar whose centre its links do not reach."""
    joints = [(0, 1), (1, 2), (2, 3), (3, 0)]
    rotation = {k: [k, None, (k - 1) % 4, None] for k in range(4)}
    return SCDGraph(4, joints, [Loop(range(4), name="S")], rotation=rotation, outer=(0, "right"))


def fig12_open() -> SCDGraph:
    """Return the same four links before the last joint is closed: a chain of four."""
    rotation = {0: [0, None, None, None], 3: [2, None, None, None]}
    rotation |= {1: [1, None, 0, None], 2: [2, None, 1, None]}
    return SCDGraph(4, [(0, 1), (1, 2), (2, 3)], [], rotation=rotation)


def spherical_scissors(n: int) -> PolyhedronModel:
    """Return n scissors in a spherical loop: an inner and an outer vertex on each of n spokes."""
    elements = [(2 * k, 2 * k + 1, 2 * ((k + 1) % n), 2 * ((k + 1) % n) + 1) for k in range(n)]
    return PolyhedronModel(2 * n, centres=[RemoteCentre(4)], scissors=elements)


def spoked(skeleton: nx.Graph) -> PolyhedronModel:
    """Return a locked collapsible polyhedron: its edges, and a spoke from the centre to each vertex."""
    vertices = list(skeleton)
    return PolyhedronModel(len(vertices) + 1, [*skeleton.edges, *((v, len(vertices)) for v in vertices)])


def unlocked(skeleton: nx.Graph) -> PolyhedronModel:
    """Return it with a scissors element for each edge: one remote centre S_{+4} an independent loop."""
    number = {v: 2 * i for i, v in enumerate(skeleton)}
    loops = skeleton.number_of_edges() - len(skeleton) + 1
    elements = [(number[a], number[a] + 1, number[b], number[b] + 1) for a, b in skeleton.edges]
    return PolyhedronModel(2 * len(skeleton), centres=[RemoteCentre(4)] * loops, scissors=elements)


def cube() -> nx.Graph:
    """Return the skeleton of a cube with vertices 0 to 7."""
    return nx.convert_node_labels_to_integers(nx.hypercube_graph(3), ordering="sorted")


def crs_platform() -> PolyhedronModel:
    """Return the point held by three C-R-S legs of Fig. 16; ground is left out."""
    rods, on_line = [], []
    for k in range(3):
        a, slide, knee = f"A{k}", f"A'{k}", f"A''{k}"
        rods += [(a, slide), (a, knee), (slide, knee), (knee, "S"), (a, "S")]
        on_line += [PointConstraint(a, GROUND), PointConstraint(slide, GROUND)]
    vertices = ["S", *(f"{name}{k}" for k in range(3) for name in ("A", "A'", "A''"))]
    return PolyhedronModel(vertices, rods, on_line=on_line, ground=[])


FIG7 = [(0, 1), (0, 2), (1, 2), (1, 3), (1, 4), (2, 3), (2, 4), (3, 4), (3, 5), (4, 5)]
FIG8 = [(0, 1), (0, 2), (0, 3), (0, 4), (1, 2), (2, 3), (3, 4)]
FIG9 = [(0, 1), (0, 3), (0, 4), (1, 2), (1, 4), (2, 3), (2, 4), (3, 4)]
FIG10 = [(0, 1), (0, 5), (0, 6), (1, 2), (1, 6), (1, 7), (2, 3), (2, 6), (2, 7), (3, 4), (3, 6), (4, 5), (4, 6),
         (4, 7), (5, 6), (5, 7)]  # fmt: skip

ENTRIES = [
    wampler("fig1", "Fig. 1", "fig1", fig1, "V 8 E 17 M 1"),
    *(
        wampler(f"fig{v}", f"Fig. {v}", "rigid_bodies", lambda v=v: body(v), f"V {v} E {e} M {m}")
        for v, e, m in ((2, 1, -1), (3, 3, 0), (4, 6, 0), (5, 9, 0))
    ),
    wampler("fig6", "Fig. 6", "fig6",
            lambda: rods_of((0, 1), (0, 2), (1, 2), (2, 3), (2, 4), (3, 4)), "V 5 E 6 M 3"),
    wampler("fig7", "Fig. 7", "fig7", lambda: rods_of(*FIG7), "V 6 E 10 M 2"),
    wampler("fig8", "Fig. 8", "fig8", lambda: rods_of(*FIG8), "V 5 E 7 M 2"),
    wampler("fig9", "Fig. 9", "fig9", lambda: rods_of(*FIG9), "V 5 E 8 M 1"),
    wampler("fig9-diagonal", "Fig. 9, with a diagonal", "fig9_diagonal",
            lambda: rods_of(*FIG9, (0, 2)), "V 5 E 9 M 0"),
    wampler("fig10", "Fig. 10", "fig10", lambda: rods_of(*FIG10), "V 8 E 16 M 2"),
    wampler("fig12", "Fig. 12, Eq. 7", "fig12_remote", lambda: polyhedron_of(fig12()), "V 8 E 20 M 1"),
    wampler("fig12-scd", "Fig. 12", "fig12_remote", fig12, "N 4 J 4 V 8 C 1 E_ext 12 E_int 8 M 1"),
    wampler("fig12-open", "Fig. 12, before closing", "fig12_remote", lambda: polyhedron_of(fig12_open()), "V 10 E 21 M 3"),
    wampler("two-centres", "text after Eq. 2", "eq2_two_centres",
            lambda: SCGraph(6, WATT, WATT_LOOPS), "N 6 J 7 M 1"),
    wampler("spherical-scissors", "Spherical Scissors Linkages", "scissors_spherical_loops",
            lambda: spherical_scissors(4), "V 8 M 2"),
    wampler("spherical-scissors-5", "Spherical Scissors Linkages", "scissors_spherical_loops",
            lambda: spherical_scissors(5), "V 10 M 3"),
    wampler("spherical-scissors-6", "Spherical Scissors Linkages", "scissors_spherical_loops",
            lambda: spherical_scissors(6), "V 12 M 4"),
    wampler("crs-platform", "Fig. 16, Eq. 10", "crs3", crs_platform, "V 10 E 15 L 6 M 3"),
    wampler("cube-locked", "Collapsible Polyhedra", "cube_locked", lambda: spoked(cube()), "V 9 E 20 M 1"),
    wampler("cube-unlocked", "Collapsible Polyhedra", "cube_unlocked", lambda: unlocked(cube()), "V 16 M 2"),
    wampler("tetrahedron-locked", "Collapsible Polyhedra", "tetra_locked",
            lambda: spoked(nx.complete_graph(4)), "V 5 E 10 M -1"),
    wampler("tetrahedron-unlocked", "Collapsible Polyhedra", "",
            lambda: unlocked(nx.complete_graph(4)), "V 8 M 0"),
    wampler("scissors", "Fig. 14, Eq. 9", "scissors_element",
            lambda: PolyhedronModel(4, scissors=[(0, 1, 2, 3)]), "V 4 M 1"),
]  # fmt: skip
