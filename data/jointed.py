"""Linkages with joints of all kinds, for data/joints/: slider-cranks, legs C-R-S, a rod between two balls, Roberts' seven-bar.

They have the types that the papers name; where they have places, these are chosen here.
"""

from __future__ import annotations

from dataclasses import replace

from graphs.convert.conversions import Mechanism
from graphs.joints.linkage import JointedLinkage, JointPlace
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids

UP = (0.0, 0.0, 1.0)


def ring(kinds: str, *loops: Loop) -> JointedLinkage:
    """Return one loop of joints, of a kind each, without places."""
    n = len(kinds)
    chain = SCGraph(n, [(i, (i + 1) % n) for i in range(n)], loops, ground=0)
    return JointedLinkage(chain, dict(enumerate(kinds)))


def slider_crank() -> JointedLinkage:
    """Return a slider-crank where it lies: crank from (0, 0) to (1, 1), rod to (3, 0), where it slides along x."""
    points = ((0.0, 0.0, 0.0), (1.0, 1.0, 0.0), (3.0, 0.0, 0.0), (3.0, 0.0, 0.0))
    axes = (UP, UP, UP, (1.0, 0.0, 0.0))
    places = {joint: JointPlace(points[joint], (axes[joint],)) for joint in range(4)}
    return replace(ring("RRRP", Loop(range(4), "infinite")), places=places)


def stretched_four_bar() -> HingedSolids:
    """Return a planar four-bar of lengths 1, 0.7, 1.3, 3: it closes stretched out, and in no other way."""
    graph = SCGraph(4, [(i, (i + 1) % 4) for i in range(4)])
    return HingedSolids(graph, {joint: ((x, 0.0, 0.0), UP) for joint, x in enumerate((0.0, 1.0, 1.7, 3.0))})


def legs_crs(one_point: bool) -> JointedLinkage:
    """Return three legs C-R-S from a base: to a platform, or all to one point, two balls between three links there."""
    links = ["base", *(f"{side}{leg}" for leg in range(3) for side in "ab")]
    joints = {f"C{leg}": ("base", f"a{leg}") for leg in range(3)}
    joints |= {f"R{leg}": (f"a{leg}", f"b{leg}") for leg in range(3)}
    if one_point:
        joints |= {"S0": ("b0", "b1"), "S1": ("b1", "b2")}
    else:
        links.append("platform")
        joints |= {f"S{leg}": (f"b{leg}", "platform") for leg in range(3)}
    return JointedLinkage(SCGraph(links, joints, ground="base"), {joint: joint[0] for joint in joints})


def roberts() -> HingedSolids:
    """Return two cognates of a planar four-bar, with their common coupler point as a joint."""
    o1, a, b, o2, p = complex(0, 0), complex(0.4, 1.0), complex(1.9, 1.3), complex(2.3, 0.1), complex(1.0, 2.2)
    ratio = (p - a) / (b - a)
    points = {"O1": o1, "A": a, "B": b, "O2": o2, "O1'": o1, "A'": o1 + p - a, "P": p}
    points |= {"C": points["A'"] + ratio * (a - o1), "O3": o1 + ratio * (o2 - o1)}
    joints = {
        "O1": (0, 1), "A": (1, 2), "B": (2, 3), "O2": (3, 0), "O1'": (0, 4), "A'": (4, 5), "C": (5, 6),
        "O3": (6, 0), "P": (2, 5),
    }  # fmt: skip
    axes = {joint: ((points[joint].real, points[joint].imag, 0.0), UP) for joint in joints}
    return HingedSolids(SCGraph(7, joints), axes)


LINKAGES: dict[str, Mechanism] = {
    "slider-crank.json": ring("RRRP", Loop(range(4), "infinite")),
    "slider-crank-in-space.json": ring("RRRP"),
    "slider-crank-placed.json": slider_crank(),
    "stretched-four-bar.json": stretched_four_bar(),
    "rssr.json": ring("RSSR"),
    "legs-crs.json": legs_crs(one_point=True),
    "platform-crs.json": legs_crs(one_point=False),
    "roberts.json": roberts(),
}
