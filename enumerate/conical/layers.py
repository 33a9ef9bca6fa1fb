"""Layers: how many links must lie over each other where their arcs overlap on a circle.

Links are arcs of a circle that the joints cut into gaps; an arc is the set of gaps it covers, bit i of a mask for
gap i. Links whose arcs share a gap lie in different layers. A link may have several arcs to choose from.
Theory: docs/theory/conical-candidates.md.
"""

from __future__ import annotations

import numpy as np

from enumerate.kernel.compiled import compiled
from graphs.types import Ints

__all__ = ["fewest_layers", "layers_of_links"]

_WITHOUT_END = 1 << 62
_STEPS = 20_000_000
"""Steps of the search for one linkage: a fraction of a second. Twenty links, at random, need a tenth of them."""


@compiled
def _fewest(arcs: Ints, chosen: Ints, layer_of: Ints, steps: int) -> int:
    """Return the fewest layers of links with masks arcs[n, o]; 0 is no choice. Sets choice and layer of each link.

    Links are put into layers one after the other, each into a layer that has room or the next new one; a branch
    ends where it has as many layers as the best solution, the search where no fewer are possible or after so many
    steps.
    """
    links, choices = arcs.shape
    best: int = links
    for i in range(links):  # a layer for each always does
        layer_of[i] = i
        chosen[i] = 0
        while chosen[i] < choices - 1 and arcs[i, chosen[i]] == 0:
            chosen[i] += 1
    least = _deepest(arcs)
    filled = np.zeros((links + 1, links), np.int64)  # what each layer holds before each link
    used = np.zeros(links + 1, np.int64)
    tried = np.zeros(links, np.int64)  # next (choice, layer) of each link
    link = 0
    while link >= 0 and best > least and steps > 0:
        steps -= 1
        if tried[link] == choices * links:
            tried[link] = 0
            link -= 1
            continue
        choice, layer = tried[link] // links, tried[link] % links
        tried[link] += 1
        mask = arcs[link, choice]
        if mask == 0 or layer > used[link] or filled[link, layer] & mask:
            continue
        now = max(used[link], layer + 1)
        if now >= best:
            continue
        if link == links - 1:
            best = now
            for i in range(links):
                chosen[i], layer_of[i] = (tried[i] - 1) // links, (tried[i] - 1) % links
            continue
        for i in range(links):
            filled[link + 1, i] = filled[link, i]
        filled[link + 1, layer] |= mask
        used[link + 1] = now
        link += 1
    return best


@compiled
def _deepest(arcs: Ints) -> int:
    """Return how many links cover one gap whatever they choose, at most: no fewer layers are possible."""
    links, choices = arcs.shape
    covered = 0
    for i in range(links):
        for choice in range(choices):
            covered |= arcs[i, choice]
    deepest = 1
    gap = 0
    while covered >> gap:
        over = 0
        for i in range(links):
            always = True
            for choice in range(choices):
                mask = arcs[i, choice]
                if mask and not mask >> gap & 1:
                    always = False
            over += always
        deepest = max(deepest, over)
        gap += 1
    return deepest


@compiled
def _fewest_of_all(arcs: Ints) -> Ints:
    found = np.empty(len(arcs), np.int64)
    chosen, layer_of = np.zeros(arcs.shape[1], np.int64), np.zeros(arcs.shape[1], np.int64)
    for i in range(len(arcs)):
        found[i] = _fewest(arcs[i], chosen, layer_of, _WITHOUT_END)
    return found


def fewest_layers(arcs: Ints) -> Ints:
    """Return the fewest layers in which links lie without overlapping.

    Parameters
    ----------
    arcs : int64[r, N, o]
        Masks of the arcs that each link can take, at least one each; 0 where there are fewer choices. All links
        cover something.

    Returns
    -------
    int64[r]

    Examples
    --------
    Three arcs round a circle of three gaps, each over two: no two go together.

    >>> fewest_layers(np.array([[[0b011], [0b110], [0b101]], [[0b001], [0b010], [0b100]]])).tolist()
    [3, 1]
    """
    return _fewest_of_all(np.ascontiguousarray(arcs, dtype=np.int64))


def layers_of_links(arcs: Ints) -> tuple[Ints, Ints]:
    """Return the arc and the layer of each link, in the fewest layers (`fewest_layers`).

    Of many more than twenty links they may be more than the fewest: the search ends after a fraction of a second.
    Arcs, int64[N, o], are masks of those that each link can take; layers count from 0. In the example, the first
    link has two arcs to choose from, and the second leaves room in its layer.

    >>> [found.tolist() for found in layers_of_links(np.array([[0b011, 0b100], [0b011, 0]]))]
    [[1, 0], [0, 0]]
    """
    masks = np.ascontiguousarray(arcs, dtype=np.int64)
    chosen, layer_of = np.zeros(len(masks), np.int64), np.zeros(len(masks), np.int64)
    _fewest(masks, chosen, layer_of, _STEPS)
    return chosen, layer_of
