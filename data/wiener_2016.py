"""The mechanisms of Wiener's thesis."""

from __future__ import annotations

import networkx as nx
import patterns
from entries import entries_of

from enumerate.strings.panel_strings import chain_scd, joint_chain, strings
from graphs.convert.link_joint import sc_from_link_joint_graph
from graphs.convert.panels import scd_from_panels
from graphs.edit.analogues import planar_analogue
from graphs.edit.edits import add_loop, crease_link, lock_hinge, ride_along
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph

wiener = entries_of("wiener", "Wiener 2016", "003")

SIX_BAR = [(0, 1), (1, 2), (2, 3), (3, 4), (4, 5), (5, 0)]
WATT = [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0)]
WATT_LOOPS = [Loop((0, 1, 2, 3)), Loop((3, 4, 5, 6))]
STEPHENSON = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (4, 5), (5, 2)]
STEPHENSON_LOOPS = [Loop((0, 1, 2, 3)), Loop((2, 3, 4, 5, 6))]


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
    wiener("six-bar-loop-spherical", "Table 1", "table1", lambda: SCGraph(6, SIX_BAR, [Loop(range(6))]), "N 6 J 6 M 3"),
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
    wiener("three-link-chain", "4.1.4.3, Fig. 15", "ex_4_1_4_3", fig15_chain, "N 3 J 2 V 7 C 0 E_ext 9 E_int 4 M 2"),
    wiener("fortune-teller", "4.1.4.4", "ex_4_1_4_4", fortune_teller, "N 16 J 20 V 13 C 0 E_ext 28 E_int 0 M 5"),
    wiener("nine-bar-mesh", "4.1.4.5", "ex_4_1_4_5", lambda: mesh(3, 3), "N 9 J 12 V 16 C 0 E_ext 24 E_int 18 M 0"),
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


def adjunct_chain() -> SCDGraph:
    """Return a four-bar with three ride-alongs, each sitting on the one before."""
    scd, joint = scd_from_panels([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)]), 0
    for _ in range(3):
        scd = ride_along(scd, joint).graph
        joint = max(scd.joints) - 1  # between the two links of the ride-along just added
    return scd


def implicit_loop(n: int, centre: str = "finite") -> SCDGraph:
    """Return an n-bar of quadrilaterals that do not reach its centre, if it has one."""
    joints = [(k, (k + 1) % n) for k in range(n)]
    rotation = {k: [k, None, (k - 1) % n, None] for k in range(n)}
    return SCDGraph(n, joints, [Loop(range(n), centre)], rotation=rotation, outer=(0, "right"))


def creased_mesh(rows: int, columns: int, panels: list[int]) -> SCDGraph:
    """Return a mesh of quadrilaterals with some of them creased along a diagonal."""
    scd = mesh(rows, columns)
    for panel in panels:
        around = scd.vertices[panel]
        scd = crease_link(scd, panel, around[0], around[2]).graph
    return scd


def held_ride_along() -> SCDGraph:
    """Return a four-bar with a ride-along whose two links are held together, as one."""
    scd = ride_along(scd_from_panels(FOUR_FAN), 0).graph
    between = max(scd.joints) - 1  # the two links of the ride-along just added
    return lock_hinge(scd, between).graph


FOUR_FAN = [(0, k, k % 4 + 1) for k in range(1, 5)]


def creased_four_bar() -> SCDGraph:
    """Return Wampler's four-bar of triangles with a crease from the centre through one of them."""
    fan = scd_from_panels(FOUR_FAN)
    (centre,) = set.intersection(*map(set, fan.vertices.values()))
    return crease_link(fan, 0, centre).graph


EDITED = [
    wiener("six-bar-with-chain", "4.2.5.1", "ex_4_2_5_1",
           lambda: add_loop(SCGraph(6, SIX_BAR, [Loop(range(6))]), 0, 1, 3).graph, "N 9 J 10 M 4"),
    wiener("ride-along", "4.2.5.3", "ex_4_2_5_3",
           lambda: ride_along(scd_from_panels(FOUR_FAN), 0).graph, "N 6 J 7 V 6 C 0 E_ext 11 E_int 0 M 1"),
    wiener("adjunct-chain", "4.2.5.4", "ex_4_2_5_4", adjunct_chain, "N 10 J 13 V 8 C 0 E_ext 17 E_int 0 M 1",
           "three ride-alongs; the topology is in the figure only"),
    wiener("double-strip", "4.2.5.5", "ex_4_2_5_5", lambda: mesh(5, 2), "N 10 J 13 V 18 C 0 E_ext 27 E_int 20 M 1",
           "five by two panels"),
    wiener("creased-four-bar", "4.2.2", "crease",
           creased_four_bar, "N 5 J 5 V 6 C 0 E_ext 10 E_int 0 M 2"),
    *(
        wiener(f"remote-{n}-bar", "4.2.3", "implicit_centre", lambda n=n: implicit_loop(n),
               f"N {n} J {n} V {2 * n} C 1 E_ext {3 * n} E_int {2 * n} M {n - 3}")
        for n in range(5, 9)
    ),
    wiener("held-ride-along", "6.3.2", "lock", held_ride_along, "N 5 J 6 V 6 C 0 E_ext 10 E_int 2 M 0",
           "which mechanism is held is in the figure only: here the four-bar with a ride-along of 4.2.5.3"),
    wiener("sarrus", "6.1.4", "sarrus", lambda: implicit_loop(6, "none"), "N 6 J 6 V 12 C 0 E_ext 18 E_int 12 M 0",
           "the general member of the type; Sarrus' geometry moves with 1"),
    wiener("mesh-4x4-inner-creases", "6.1.1.2", "crease_claim", lambda: creased_mesh(4, 4, [5, 6, 9, 10]),
           "N 20 J 28 M 1"),
    wiener("mesh-4x4-edge-creases", "6.1.1.2", "crease_claim", lambda: creased_mesh(4, 4, [0, 1, 2, 3]),
           "N 20 J 28 M 1", "the count is not tight here: the mesh has 2 freedoms"),
]  # fmt: skip


CHAINS = [
    *(
        wiener(f"chain-{chain.mechanism}", f"Table 8, {chain.text}", "table8", lambda chain=chain: chain_scd(chain),
               f"N {n + 1} J {n} M {n}")
        for n in range(1, 7)
        for chain in strings(n)
    ),
    *(
        wiener(f"ups-chain-{n}-{m}", "5.2.4", "ups_chain", lambda n=n, m=m: chain_scd(joint_chain("UPS"), ends=(n, m)),
               f"N 7 J 6 V {v} E {e} M 6")
        for n, m, v, e in ((3, 3, 11, 21), (4, 5, 14, 30), (6, 3, 14, 30))
    ),
]  # fmt: skip

PATTERNS = [
    *(
        wiener(f"miura-{i}x{j}.fold", "6.1.2", "miura_h", lambda i=i, j=j: patterns.miura(i, j),
               f"N {i * j} J {2 * i * j - i - j} M {1 - (i - 2) * (j - 2)}")
        for i, j in ((2, 2), (2, 3), (3, 3), (3, 4), (4, 4), (5, 5))
    ),
    wiener("square-twist.fold", "6.1.3", "", patterns.square_twist, "N 9 J 12 M 0",
           "the mountains and valleys of Fig. 62 are not at hand"),
]  # fmt: skip

ENTRIES = [*WIENER, *EDITED, *CHAINS, *PATTERNS]
