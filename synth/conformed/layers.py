"""Layers of links round the circle of the conformed position: which arc each takes, and which lie over others.

Theory: docs/theory/conical-candidates.md.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from enumerate.conical.rounds import fewest_layers, layers_of_links
from graphs.arrays import Floats, Ints
from graphs.errors import UnsolvableError
from synth.conformed.rates import ConformedChain
from synth.surfaces.circuit import HALF_TURN

__all__ = ["LinksInLayers", "arc_choices", "layers", "links_in_layers"]

_MOST_JOINTS = 62
"""Gaps that the bits of a mask have room for."""


class LinksInLayers(NamedTuple):
    """Links of one linkage as arcs in layers.

    Attributes
    ----------
    arcs : float[N, 2]
        Start and length of the arc of each link, radians.
    layers : int64[N]
        The layer of each link, from 0 on.
    """

    arcs: Floats
    layers: Ints


def arc_choices(chain: ConformedChain, places: npt.ArrayLike) -> Ints:
    """Return the arcs that links can take, as masks of the gaps between neighbouring joints.

    A link takes all the circle but one gap between its joints: the one that is half the circle or wider, either of
    two halves, or, where none is so wide, any. Azimuths, float[r, J], are between 0 and 2 pi, all different. In
    the int64[r, N, o], bit i is the gap after the joint that comes i-th from azimuth 0 on; 0 where a link has
    fewer choices.

    >>> from graphs.mechanism.sc import SCGraph
    >>> chain = ConformedChain.of(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)]))
    >>> arc_choices(chain, np.radians([[0, 40, 90, 140]]))[0].max(axis=-1).tolist()
    [7, 1, 2, 4]
    """
    t = np.asarray(places, dtype=float)
    joints = t.shape[-1]
    rank = t.argsort(axis=-1).argsort(axis=-1)
    every = (1 << joints) - 1
    most = max(map(len, chain.joints_of))
    masks = np.zeros((len(t), len(chain.joints_of), most), np.int64)
    for number, mine in enumerate(chain.joints_of):
        ranks = np.sort(rank[:, list(mine)], axis=-1)
        ends = np.sort(t[:, list(mine)], axis=-1)
        widths = np.roll(ends, -1, axis=-1) - ends
        widths[:, -1] += 2 * np.pi
        after = np.roll(ranks, -1, axis=-1)
        gaps = (1 << after) - (1 << ranks)  # bits from one rank to below the next
        gaps[:, -1] += every  # the last goes past azimuth 0
        wide = widths >= HALF_TURN
        allowed = wide | ~wide.any(axis=-1, keepdims=True)
        masks[:, number, : len(mine)] = np.where(allowed, every ^ gaps, 0)
    return masks


def layers(chain: ConformedChain, places: npt.ArrayLike) -> Ints:
    """Return how many layers links need so that none overlaps another of its layer: int64[r].

    The fewest, over the arcs that links can take (`arc_choices`), at azimuths float[r, J], radians.
    """
    t = np.remainder(np.asarray(places, dtype=float), 2 * np.pi)
    return fewest_layers(arc_choices(chain, t))


def links_in_layers(
    chain: ConformedChain, places: npt.ArrayLike, begins: Mapping[int, int] | None = None
) -> LinksInLayers:
    """Put the links of a linkage into the fewest layers, `layers` of them.

    Parameters
    ----------
    chain : ConformedChain
    places : float[J]
        Azimuths, radians.
    begins : mapping of int to int, optional
        Number of a link to the number of the joint at which its arc begins: of one that spans half a turn.

    Raises
    ------
    UnsolvableError
        If there are more than 62 joints.

    Examples
    --------
    >>> from graphs.mechanism.sc import SCGraph
    >>> chain = ConformedChain.of(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)]))
    >>> laid = links_in_layers(chain, np.radians([0, 40, 90, 140]))
    >>> laid.layers.tolist(), np.degrees(laid.arcs).round(9).tolist()
    ([0, 1, 1, 1], [[0.0, 140.0], [0.0, 40.0], [40.0, 50.0], [90.0, 50.0]])
    """
    t = np.remainder(np.asarray(places, dtype=float), 2 * np.pi)
    if len(t) > _MOST_JOINTS:
        raise UnsolvableError(f"{len(t)} joints; layers are laid of {_MOST_JOINTS} at most")
    choices = arc_choices(chain, t[np.newaxis])[0]
    for number, joint in (begins or {}).items():
        mine = sorted(chain.joints_of[number], key=lambda one: float(t[one]))
        left_out = (mine.index(joint) - 1) % len(mine)
        choices[number, [gap for gap in range(choices.shape[1]) if gap != left_out]] = 0
    chosen, layer_of = layers_of_links(choices)
    arcs = np.empty((len(chain.joints_of), 2))
    for number, (joints, left_out) in enumerate(zip(chain.joints_of, chosen.tolist(), strict=True)):
        ends = np.sort(t[list(joints)])
        start = ends[(left_out + 1) % len(ends)]
        arcs[number] = start, np.remainder(ends[left_out] - start, 2 * np.pi)
    return LinksInLayers(arcs, layer_of)
