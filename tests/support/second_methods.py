"""Second methods: the shadow of side links, pole axes on cones, the hoop without angles, screws of joints."""

from __future__ import annotations

from functools import cmp_to_key

import numpy as np
import numpy.typing as npt

from graphs.answer.mobility_of_joints import screws_of_joints
from graphs.joints.linkage import JointedLinkage
from graphs.loops.loop import signed_cycle
from graphs.mechanism.sc import SCGraph
from graphs.rank.exact import independent_cycles
from graphs.rank.singular_values import spectrum
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.linkages.guidance.order import Direction
from synth.linkages.guidance.orientations import Orientations, Pair, unit_vector

__all__ = ["freedoms_by_screws", "hoop_sequence", "pole_axes", "shadow_allows"]


def shadow_allows(places: npt.ArrayLike) -> npt.NDArray[np.bool_]:
    """Check by the shadow method whether four-bars can be intra- or extramobile (Hyatt et al. 2021, section 5).

    The lines of the two side links, O A and B C, cut the plane into two double wedges. If the centre of the circle
    lies in the one that holds ground and coupler, the linkage is transmobile; else it is not. Azimuths, float[...,
    4], are those of O, A, B, C; the ground link is C O, the coupler A B.
    """
    t = np.asarray(places, dtype=float)
    o, a, b, c = np.moveaxis(np.stack([np.sin(t), np.cos(t)], axis=-1), -2, 0)

    def side(p: Floats, q: Floats, r: Floats) -> Floats:
        """Return which side of the line p q the point r lies on."""
        return np.asarray(
            (q[..., 0] - p[..., 0]) * (r[..., 1] - p[..., 1]) - (q[..., 1] - p[..., 1]) * (r[..., 0] - p[..., 0])
        )

    centre = np.zeros_like(o)
    # the coupler lies in one double wedge, and the ground link in the same one
    coupler = side(o, a, b) * side(b, c, a)
    return np.asarray(side(o, a, centre) * side(b, c, centre) * coupler < 0)


def pole_axes(motions: npt.ArrayLike, cone_angle: npt.ArrayLike) -> Floats:
    """Return the angular velocities of links on cones, along their pole axes, from motions w, float[..., N, 3]."""
    lam = np.asarray(cone_angle, dtype=float)[..., np.newaxis, np.newaxis]
    w = np.asarray(motions, dtype=float)
    return np.concatenate([np.cos(lam) * w[..., :1], -np.sin(lam) * w[..., 1:2], np.cos(lam) * w[..., 2:]], axis=-1)


def hoop_sequence(orientations: Orientations, axis: npt.ArrayLike, direction: Direction = "ccw") -> tuple[Pair, ...]:
    """Return all relative axes but S_12 in the order of crossing: the geometric form, without angles.

    The end of each axis line that lies ahead of the plane of the hoop at its start is the one that the hoop meets;
    of two such ends that one is met first from which the other lies ahead. Both are signs of triple products.
    """
    g = unit_vector(axis, "fixed axis") * (1.0 if direction == "ccw" else -1.0)
    lines = orientations.relative_axes()
    start = lines.pop((1, 2))

    def ahead(here: Floats, there: Floats) -> float:
        """Return [G, here, there], positive if a turn about G by less than 180 degrees leads there."""
        return float(g @ np.cross(here, there))

    met = {pair: s * np.copysign(1.0, ahead(start, s)) for pair, s in lines.items()}

    def later(a: Pair, b: Pair) -> int:
        return int(-np.sign(ahead(met[a], met[b])))

    return tuple(sorted(met, key=cmp_to_key(later)))


def freedoms_by_screws(linkage: JointedLinkage) -> int | None:
    """Return the degrees of freedom by the screws of the joints, without revolutes; None if not known.

    The linkage has places, and all loops close with six equations.
    """
    screws = screws_of_joints(linkage)
    chain = linkage.chain
    columns = {joint: place for place, joint in enumerate(chain.joints)}
    widths = [screws[joint].shape[1] for joint in chain.joints]
    starts = np.concatenate([[0], np.cumsum(widths)])
    cycles = independent_cycles(SCGraph(chain.nodes, chain.joints))
    matrix = np.zeros((6 * len(cycles), int(starts[-1])))
    for row, loop in enumerate(cycles):
        for joint, sign in signed_cycle(loop.joints, chain.joints):
            place = columns[joint]
            matrix[6 * row : 6 * row + 6, starts[place] : starts[place + 1]] = sign * screws[joint]
    rank = spectrum(matrix, DOUBLE.closed).rank
    return None if rank is None else int(starts[-1]) - rank
