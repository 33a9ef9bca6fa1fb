"""What is evaluated of conical candidates, for many at a time: circuits, half turns, Grashof classes.

Layers and all angles: `synth.conformed.all_angles`; rank and behaviour: `synth.conformed.rates`,
`synth.conformed.behaviours`. Theory: docs/theory/conical-candidates.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np
import numpy.typing as npt

from graphs.mechanism.surfaces import Cone, Surface
from synth.conformed.rates import ConformedChain
from synth.fourbar.closing import grashof_class, planar_differences, spherical_differences
from synth.surfaces.circuit import HALF_TURN, Circuits, circuits, link_angles, wrapped
from synth.surfaces.loop_maps import chords

__all__ = ["four_bar_classes", "half_turns", "loop_circuits"]


def loop_circuits(loops: Sequence[Sequence[int]], places: npt.ArrayLike) -> tuple[Circuits, ...]:
    """Return the circuits of loops, each its joints in loop order, at azimuths float[..., J], radians."""
    t = np.asarray(places, dtype=float)
    of_loops = []
    for loop in loops:
        mine = t[..., list(loop)]
        of_loops.append(circuits(wrapped((np.roll(mine, -1, axis=-1) - mine).round(12))))
    return tuple(of_loops)


def half_turns(
    chain: ConformedChain, places: npt.ArrayLike
) -> tuple[list[tuple[int, int]], npt.NDArray[np.bool_]]:
    """Return the pairs of joints that share a link, and which of these steps are half a turn, bool[..., pairs].

    Such steps have no sign; azimuths are float[..., J], radians.

    >>> from graphs.mechanism.sc import SCGraph
    >>> chain = ConformedChain.of(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)]))
    >>> pairs, is_half_turn = half_turns(chain, np.radians([0, 180, 90, 300]))
    >>> [pair for pair, is_so in zip(pairs, is_half_turn) if is_so]
    [(0, 1)]
    """
    t = np.asarray(places, dtype=float)
    pairs = sorted({pair for joints in chain.joints_of for pair in combinations(joints, 2)})
    first, second = (list(side) for side in zip(*pairs, strict=True))
    return pairs, np.abs(wrapped(t[..., second] - t[..., first])) > HALF_TURN


def four_bar_classes(
    loops: Sequence[Sequence[int]], places: npt.ArrayLike, surface: Surface | None
) -> list[npt.NDArray[np.str_]]:
    """Return ``Grashof``, ``non-Grashof`` or ``folding`` for each loop of four joints; other loops are skipped.

    The class depends on the cone; without a surface it is that on a cylinder. Azimuths are float[..., J].

    A crossed loop is Grashof on a cylinder; on a steep cone it need not be (docs/misprints.md 000-6).

    >>> places = np.radians([0, 150, 20, 160])
    >>> [str(four_bar_classes([(0, 1, 2, 3)], places, one)[0]) for one in (None, Cone(0.3))]
    ['Grashof', 'non-Grashof']
    """
    t = np.asarray(places, dtype=float)
    classes = []
    for loop in loops:
        if len(loop) != 4:
            continue
        mine = t[..., list(loop)]
        steps = wrapped(np.roll(mine, -1, axis=-1) - mine)
        if isinstance(surface, Cone):
            differences = spherical_differences(link_angles(steps, surface.angle))
        else:
            differences = planar_differences(chords(steps, 1.0))
        classes.append(grashof_class(differences))
    return classes
