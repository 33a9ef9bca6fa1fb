"""What is evaluated of conical candidates, for many at a time: circuits, layers, half turns, Grashof classes.

Rank and behaviour: `synth.conformed.rates`, `synth.conformed.behaviours`; over all angles:
`synth.conformed.all_angles`. Theory: docs/theory/conical-candidates.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np
import numpy.typing as npt

from enumerate.conical.layers import fewest_layers
from graphs.arrays import Ints
from synth.conformed.rates import ConformedChain
from synth.fourbar.closing import grashof_class, planar_differences, spherical_differences
from synth.surfaces.circuit import Circuits, circuits, wrapped
from synth.surfaces.cone import link_angles
from synth.surfaces.cylinder import chords

__all__ = ["arc_choices", "four_bar_classes", "half_turns", "layers", "loop_circuits"]

_HALF = np.pi - 1e-9
"""Gaps this wide (radians) are half the circle."""


def loop_circuits(loops: Sequence[Sequence[int]], places: npt.ArrayLike) -> tuple[Circuits, ...]:
    """Return the circuits of loops.

    Parameters
    ----------
    loops : sequence of sequences of int
        Numbers of the joints of each loop, in loop order.
    places : float[..., J]
        Azimuths, radians.

    Examples
    --------
    >>> (one,) = loop_circuits([(0, 1, 2, 3)], np.radians([[0, 90, 180, 270], [0, 180, 90, 270]]))
    >>> one.names().tolist(), one.turns.tolist()
    (['open', 'crossed'], [1, -1])
    """
    t = np.asarray(places, dtype=float)
    found = []
    for loop in loops:
        mine = t[..., list(loop)]
        found.append(circuits(wrapped((np.roll(mine, -1, axis=-1) - mine).round(12))))
    return tuple(found)


def half_turns(
    chain: ConformedChain, places: npt.ArrayLike
) -> tuple[list[tuple[int, int]], npt.NDArray[np.bool_]]:
    """Tell which steps within links are half a turn and have no sign.

    Parameters
    ----------
    chain : ConformedChain
    places : float[..., J]

    Returns
    -------
    pairs : list of (int, int)
        Joints that share a link.
    found : bool[..., number of pairs]

    Examples
    --------
    >>> from graphs.mechanism.sc import SCGraph
    >>> chain = ConformedChain.of(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)]))
    >>> pairs, found = half_turns(chain, np.radians([0, 180, 90, 300]))
    >>> [pair for pair, is_so in zip(pairs, found) if is_so]
    [(0, 1)]
    """
    t = np.asarray(places, dtype=float)
    pairs = sorted({pair for joints in chain.joints_of for pair in combinations(joints, 2)})
    first, second = (list(side) for side in zip(*pairs, strict=True))
    return pairs, np.abs(wrapped(t[..., second] - t[..., first])) > _HALF


def arc_choices(chain: ConformedChain, places: npt.ArrayLike) -> Ints:
    """Return the arcs that links can take, as masks of the gaps between neighbouring joints.

    A link takes all the circle but one gap between its joints: the one that is half the circle or wider, either of
    two halves, or, where none is so wide, any.

    Parameters
    ----------
    chain : ConformedChain
    places : float[r, J]
        Azimuths between 0 and 2 pi, all different.

    Returns
    -------
    int64[r, N, o]
        Bit i is the gap after the joint that comes i-th from azimuth 0 on; 0 where a link has fewer choices.

    Examples
    --------
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
    found = np.zeros((len(t), len(chain.joints_of), most), np.int64)
    for number, mine in enumerate(chain.joints_of):
        ranks = np.sort(rank[:, list(mine)], axis=-1)
        ends = np.sort(t[:, list(mine)], axis=-1)
        widths = np.roll(ends, -1, axis=-1) - ends
        widths[:, -1] += 2 * np.pi
        after = np.roll(ranks, -1, axis=-1)
        gaps = (1 << after) - (1 << ranks)  # bits from one rank to below the next
        gaps[:, -1] += every  # the last goes past azimuth 0
        wide = widths >= _HALF
        allowed = wide | ~wide.any(axis=-1, keepdims=True)
        found[:, number, : len(mine)] = np.where(allowed, every ^ gaps, 0)
    return found


def layers(chain: ConformedChain, places: npt.ArrayLike) -> Ints:
    """Return how many layers links need so that none overlaps another of its layer.

    Parameters
    ----------
    chain : ConformedChain
    places : float[r, J]
        Azimuths, radians, all different.

    Returns
    -------
    int64[r]
        The fewest, over the arcs that links can take (`arc_choices`).

    Examples
    --------
    An open four-bar round the circle, and one on less than half of it, whose longest link lies over the rest:

    >>> from graphs.mechanism.sc import SCGraph
    >>> chain = ConformedChain.of(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)]))
    >>> layers(chain, np.radians([[0, 90, 180, 270], [0, 40, 90, 140]])).tolist()
    [1, 2]
    """
    t = np.remainder(np.asarray(places, dtype=float), 2 * np.pi)
    return fewest_layers(arc_choices(chain, t))


def four_bar_classes(
    loops: Sequence[Sequence[int]], places: npt.ArrayLike, cone_angle: float | None
) -> list[npt.NDArray[np.str_]]:
    """Return ``Grashof``, ``non-Grashof`` or ``folding`` for each loop of four joints.

    Parameters
    ----------
    loops : sequence of sequences of int
        Loops of other numbers of joints are passed over.
    places : float[..., J]
    cone_angle : float or None
        lambda, radians: the class depends on it. None: on a cylinder.

    Examples
    --------
    A crossed loop is Grashof on a cylinder; on a steep cone it need not be (docs/misprints.md 000-6).

    >>> places = np.radians([0, 150, 20, 160])
    >>> [str(four_bar_classes([(0, 1, 2, 3)], places, lam)[0]) for lam in (None, 0.3)]
    ['Grashof', 'non-Grashof']
    """
    t = np.asarray(places, dtype=float)
    found = []
    for loop in loops:
        if len(loop) != 4:
            continue
        mine = t[..., list(loop)]
        steps = wrapped(np.roll(mine, -1, axis=-1) - mine)
        if cone_angle is None:
            differences = planar_differences(chords(steps, 1.0))
        else:
            differences = spherical_differences(link_angles(steps, cone_angle))
        found.append(grashof_class(differences))
    return found
