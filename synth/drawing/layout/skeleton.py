"""What of a link-joint graph is laid out: the sides of its bodies, or links joined as dots, drawn by rotations.

Drawn as bodies, joints are nodes and a link is the polygon of its joints; a binary link is a side. Drawn as dots,
links are nodes. What would come twice, as two links that share two joints make it, has a node in its middle.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass

from synth.drawing.layout.embedding import Neighbours, Node

__all__ = ["Skeleton", "bodies", "dots"]


@dataclass(frozen=True, slots=True)
class Skeleton:
    """A plane graph to lay out. Nodes are ``("link", id)``, ``("joint", id)``, ``("side", link, {joint, joint})``.

    `around` has the neighbours of each node, and `outlines` the corners of each body (none for dots),
    counter-clockwise; `mirror` is a symmetry that reverses the rotations, of all links and joints too.
    """

    around: Neighbours
    outlines: dict[Node, tuple[Node, ...]]
    mirror: dict[Node, Node] | None


def dots(incidence: Neighbours, mirror: Mapping[Node, Node] | None = None) -> Skeleton:
    """Return links as nodes, from the rotations of links and joints.

    >>> l0, l1, a, b = ("link", 0), ("link", 1), ("joint", "a"), ("joint", "b")
    >>> skeleton = dots({l0: (a, b), l1: (b, a), a: (l0, l1), b: (l1, l0)})
    >>> len(skeleton.around)  # the joints are parallel, and so stay
    4
    """
    pairs = Counter(frozenset(row) for node, row in incidence.items() if node[0] == "joint")
    around: Neighbours = {}
    for node, row in incidence.items():
        if node[0] == "joint":
            if pairs[frozenset(row)] > 1:
                around[node] = row
            continue
        ends = [incidence[joint] for joint in row]
        around[node] = tuple(
            joint if pairs[frozenset(pair)] > 1 else _other(pair, node)
            for joint, pair in zip(row, ends, strict=True)
        )
    return Skeleton(around, {}, None if mirror is None else dict(mirror))


def bodies(incidence: Neighbours, mirror: Mapping[Node, Node] | None = None) -> Skeleton:
    """Return joints as nodes and links as rings of sides, from the rotations of links and joints.

    >>> l0, l1, l2, a, b, c = [("link", i) for i in range(3)] + [("joint", i) for i in "abc"]
    >>> rows = {l0: (a, c), l1: (b, a), l2: (c, b), a: (l0, l1), b: (l1, l2), c: (l2, l0)}
    >>> bodies(rows).around[a] == (c, b)
    True
    """
    sides = {link: _sides(row) for link, row in incidence.items() if link[0] == "link"}
    often = Counter(frozenset(side) for rows in sides.values() for side in rows)
    towards: dict[Node, dict[Node, list[Node]]] = {node: {} for node in incidence}
    around: Neighbours = {}
    outlines: dict[Node, tuple[Node, ...]] = {}
    for link, row in incidence.items():
        if link[0] != "link":
            continue
        if len(row) < 2:
            around[link] = row
            outlines[link] = (link, *row)
            for joint in row:
                towards[joint][link] = [link]
            continue
        corners: list[Node] = []
        for a, b in sides[link]:
            corners.append(a)
            if often[frozenset((a, b))] > 1:
                middle = ("side", link, frozenset((a, b)))
                around[middle] = (a, b)
                corners.append(middle)
        if len(row) == 2:
            corners.append(row[1])
        outlines[link] = tuple(corners)
        for joint in row:
            i = corners.index(joint)
            both = [corners[(i + 1) % len(corners)], corners[i - 1]]
            if len(row) == 2:  # not closed: the first corner is one end, the last the other
                middle_out = corners if len(corners) == 2 else [corners[1]] * 2
                both = [middle_out[1] if i == 0 else middle_out[0]]
            towards[joint][link] = both
    for joint, row in incidence.items():
        if joint[0] == "joint":
            around[joint] = tuple(node for link in row for node in towards[joint][link])
    return Skeleton(
        around, outlines, None if mirror is None else {**mirror, **{n: _moved(n, mirror) for n in around}}
    )


def _sides(row: tuple[Node, ...]) -> list[tuple[Node, Node]]:
    if len(row) < 2:
        return []
    if len(row) == 2:
        return [(row[0], row[1])]
    return list(zip(row, (*row[1:], row[0]), strict=True))


def _moved(node: Node, mirror: Mapping[Node, Node]) -> Node:
    if node[0] == "side":
        link, ends = node[1:]
        return "side", mirror[link], frozenset(mirror[end] for end in ends)
    return mirror[node]


def _other(pair: tuple[Node, ...], node: Node) -> Node:
    return pair[1] if pair[0] == node else pair[0]
