"""The mechanisms of the source papers: how each is built, and the numbers the papers give for it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import combinations
from typing import Any

import networkx as nx

from graphs.analogues import planar_analogue
from graphs.conversion import Mechanism
from graphs.embedding import sc_from_link_joint_graph
from graphs.loops import Loop
from graphs.panels import scd_from_panels
from graphs.polyhedron import GROUND, PointConstraint, PolyhedronModel, RemoteCentre
from graphs.reconstruction import reconstruct
from graphs.sc import SCGraph
from graphs.scd import SCDGraph

SIX_BAR = [(0, 1), (1, 2), (2, 3), (3, 4), (4, 5), (5, 0)]
WATT = [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0)]
WATT_LOOPS = [Loop((0, 1, 2, 3)), Loop((3, 4, 5, 6))]
STEPHENSON = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (4, 5), (5, 2)]
STEPHENSON_LOOPS = [Loop((0, 1, 2, 3)), Loop((2, 3, 4, 5, 6))]


@dataclass(frozen=True)
class Entry:
    """One mechanism: its file, where it comes from, how it is made and what the paper says of it."""

    file: str
    source: str
    golden: str
    make: Callable[[], Mechanism]
    numbers: dict[str, Any] = field(default_factory=dict)
    choice: str = ""

    def row(self) -> dict[str, Any]:
        """Return the row of the index."""
        row: dict[str, Any] = {"file": self.file, "source": self.source, "golden": self.golden, **self.numbers}
        return row | ({"choice": self.choice} if self.choice else {})


def wiener(
    name: str, where: str, golden: str, make: Callable[[], Mechanism], numbers: str, choice: str = ""
) -> Entry:
    """Return an entry of the thesis; ``numbers`` reads ``"N 6 J 7 M 1"``."""
    return Entry(f"wiener/{name}.json", f"Wiener 2016, {where}", f"003/{golden}", make, _parsed(numbers), choice)


def wampler(
    name: str, where: str, golden: str, make: Callable[[], Mechanism], numbers: str, choice: str = ""
) -> Entry:
    """Return an entry of Wampler, Larson, Erdman 2007."""
    return Entry(f"wampler/{name}.json", f"Wampler 2007, {where}", f"004/{golden}", make, _parsed(numbers), choice)


def _parsed(numbers: str) -> dict[str, Any]:
    words = numbers.split()
    return {key: int(value) for key, value in zip(words[::2], words[1::2], strict=True)}


# ---- Wiener ---------------------------------------------------------------------------------------------


def one_remote_centre(centre: str) -> SCDGraph:
    """Return Watt's chain with an implicit centre in its first loop, finite or infinite.

    The placement of the eight open edges is the only valid one: one in each corner of the first loop, one on
    the outer side of each binary link.
    """
    rotation = {
        0: [6, 0, None, 3],
        1: [0, None, 1, None],
        2: [1, None, 2, None],
        3: [3, None, 2, 4],
        4: [4, None, 5],
        5: [5, None, 6],
    }
    loops = [Loop(WATT_LOOPS[0].joints, centre), WATT_LOOPS[1]]
    return SCDGraph(6, WATT, loops, rotation=rotation, outer=(0, "right"))


def fig15_chain() -> SCDGraph:
    """Return the three-link spatial chain of 4.1.4.3."""
    return scd_from_panels([(0, 1, 2), (1, 2, 3, 4, 5), (3, 4, 6)])


def fortune_teller() -> SCDGraph:
    """Return the fortune teller: an eight-bar loop and four ride-alongs."""
    ring = [(0, k, k % 8 + 1) for k in range(1, 9)]
    flaps = [(8, 1, 9), (1, 2, 9), (2, 3, 10), (3, 4, 10), (4, 5, 11), (5, 6, 11), (6, 7, 12), (7, 8, 12)]
    return scd_from_panels(ring + flaps)


def mesh(rows: int, columns: int) -> SCDGraph:
    """Return a mesh of rows x columns quadrilaterals."""
    wide = columns + 1
    return scd_from_panels(
        [
            (i * wide + j, i * wide + j + 1, (i + 1) * wide + j + 1, (i + 1) * wide + j)
            for i in range(rows)
            for j in range(columns)
        ]
    )


def hybrid_ten_bar() -> SCDGraph:
    """Return the spherical six-bar with a spatial chain of four links between its links 0 and 2."""
    fan = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5), (0, 5, 6), (0, 6, 1)]
    bridge = [(1, 2, 7, 8), (8, 7, 9, 10), (10, 9, 11, 12), (12, 11, 3, 4)]
    return scd_from_panels([*fan, *bridge], outer=(4, 5))


def concentric() -> SCGraph:
    """Return two eight-bar loops joined link to link: 16 links, 24 joints, ten faces with a centre each."""
    return sc_from_link_joint_graph(nx.circular_ladder_graph(8), closed=True)


THREE_LOOP_EIGHT_BAR = [(0, 1, 2, 3), (0, 1, 4), (1, 2, 5), (2, 3, 6), (3, 0, 7), (1, 4, 5), (2, 5, 6), (3, 6, 7)]
TWO_LOOP_SIX_BAR = [(0, 3, 6, 4), (0, 2, 4), (0, 1, 2), (0, 1, 3), (1, 3, 5), (1, 2, 5)]

WIENER = [
    wiener(
        "six-bar-loop-spherical", "Table 1", "table1", lambda: SCGraph(6, SIX_BAR, [Loop(range(6))]), "N 6 J 6 M 3"
    ),
    wiener(
        "six-bar-loop-planar",
        "Table 1",
        "table1",
        lambda: SCGraph(6, SIX_BAR, [Loop(range(6), "infinite")]),
        "N 6 J 6 M 3",
    ),
    wiener(
        "six-bar-loop-spatial",
        "Table 1",
        "table1",
        lambda: SCGraph(6, SIX_BAR, [Loop(range(6), "none")]),
        "N 6 J 6 M 0",
    ),
    wiener("watt", "Table 2 and 3.3.5", "watt_stephenson", lambda: SCGraph(6, WATT, WATT_LOOPS), "N 6 J 7 M 1"),
    wiener(
        "watt-planar",
        "Table 2 and 3.3.5",
        "table2",
        lambda: planar_analogue(SCGraph(6, WATT, WATT_LOOPS)),
        "N 6 J 7 M 1",
    ),
    wiener(
        "stephenson",
        "Table 2 and 3.3.5",
        "watt_stephenson",
        lambda: SCGraph(6, STEPHENSON, STEPHENSON_LOOPS),
        "N 6 J 7 M 1",
    ),
    wiener(
        "stephenson-planar",
        "Table 2 and 3.3.5",
        "table2",
        lambda: planar_analogue(SCGraph(6, STEPHENSON, STEPHENSON_LOOPS)),
        "N 6 J 7 M 1",
    ),
    wiener(
        "table3-row1",
        "Table 3, row 1",
        "table3_row1",
        lambda: scd_from_panels([(0, 3, 4), *TWO_LOOP_SIX_BAR[1:]]),
        "N 6 J 7 V 6 C 0 E_ext 11 E_int 0 M 1",
    ),
    wiener(
        "table3-row2",
        "Table 3, row 2",
        "table3_row2",
        lambda: scd_from_panels(TWO_LOOP_SIX_BAR),
        "N 6 J 7 V 7 C 0 E_ext 12 E_int 2 M 1",
        "which link is the quadrilateral is in the figure only",
    ),
    wiener(
        "table3-row3",
        "Table 3, row 3",
        "table3_row3",
        lambda: one_remote_centre("finite"),
        "N 6 J 7 V 9 C 1 E_ext 15 E_int 8 M 1",
        "the only valid placement with these counts; the figure is not at hand",
    ),
    wiener(
        "table3-row4",
        "Table 3, row 4",
        "table3_row4",
        lambda: one_remote_centre("infinite"),
        "N 6 J 7 V 9 C 1 E_ext 15 E_int 8 M 1",
        "as row 3 with the remote centre at infinity; the figure is not at hand",
    ),
    wiener(
        "six-bar",
        "4.1.4.1",
        "ex_4_1_4_1",
        lambda: scd_from_panels(TWO_LOOP_SIX_BAR),
        "N 6 J 7 V 7 C 0 E_ext 12 E_int 2 M 1",
    ),
    wiener(
        "eight-bar",
        "4.1.4.2",
        "ex_4_1_4_2",
        lambda: scd_from_panels(THREE_LOOP_EIGHT_BAR),
        "N 8 J 10 V 8 C 0 E_ext 15 E_int 2 M 1",
        "a topology that fits all printed counts; the figure is not at hand",
    ),
    wiener(
        "three-link-chain", "4.1.4.3, Fig. 15", "ex_4_1_4_3", fig15_chain, "N 3 J 2 V 7 C 0 E_ext 9 E_int 4 M 2"
    ),
    wiener("fortune-teller", "4.1.4.4", "ex_4_1_4_4", fortune_teller, "N 16 J 20 V 13 C 0 E_ext 28 E_int 0 M 5"),
    wiener(
        "nine-bar-mesh", "4.1.4.5", "ex_4_1_4_5", lambda: mesh(3, 3), "N 9 J 12 V 16 C 0 E_ext 24 E_int 18 M 0"
    ),
    wiener(
        "hybrid-ten-bar",
        "4.1.4.6",
        "ex_4_1_4_6_links_0_2",
        hybrid_ten_bar,
        "N 10 J 11 V 13 C 0 E_ext 23 E_int 8 M 2",
        "the chain joins links 0 and 2; 0 and 3 give the same counts",
    ),
    wiener(
        "concentric-loops",
        "3.3.6",
        "concentric",
        concentric,
        "N 16 J 24 M 0",
        "N and J follow from the description: two eight-bars joined link to link",
    ),
]


# ---- Wampler, Larson, Erdman ----------------------------------------------------------------------------


def body(vertices: int) -> PolyhedronModel:
    """Return a rigid body of 2 to 5 vertices."""
    rods = list(combinations(range(vertices), 2))
    return PolyhedronModel(vertices, [rod for rod in rods if vertices < 5 or rod != (3, 4)])


def fig1() -> PolyhedronModel:
    """Return two rectangles hinged on GH with triangles at either end: the mechanism of Fig. 1."""
    panels = ["BCHG", "FEHG", "AGB", "AGF", "DHC", "DHE"]
    return reconstruct(scd_from_panels({"".join(panel): tuple(panel) for panel in panels}))


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

WAMPLER = [
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
    wampler("fig12", "Fig. 12, Eq. 7", "fig12_remote", lambda: reconstruct(fig12()), "V 8 E 20 M 1"),
    wampler("fig12-scd", "Fig. 12", "fig12_remote", fig12, "N 4 J 4 V 8 C 1 E_ext 12 E_int 8 M 1"),
    wampler("fig12-open", "Fig. 12, before closing", "fig12_remote", lambda: reconstruct(fig12_open()), "V 10 E 21 M 3"),
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
]  # fmt: skip

ENTRIES = [*WIENER, *WAMPLER]
