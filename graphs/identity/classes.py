"""Canonical codes and symmetries of mechanisms with centres, drawn or not.

A mechanism becomes a coloured graph of its links, its joints, and its classes of loops with one centre, which
bliss labels. Which loops were chosen within a class does not show. Theory: docs/theory/centre-classes.md.
"""

from __future__ import annotations

from collections.abc import Collection, Hashable
from typing import Any

from graphs.identity.bliss import ColouredGraph, labels_of, symmetries_of
from graphs.ids import JointId, LinkId
from graphs.mechanism.sc import SCGraph

__all__ = ["class_code", "symmetries_of_links"]


def class_code(sc: SCGraph, marked: Collection[LinkId] = ()) -> tuple[Any, ...]:
    """Return the same code for two mechanisms exactly if links, joints and centre classes correspond.

    Parameters
    ----------
    sc : SCGraph
    marked : collection of link ids
        Links that must correspond to marked ones, such as those that an edit added.

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> ring = [(0, 1), (1, 2), (2, 3), (3, 0)]
    >>> one = SCGraph(4, ring, [Loop((0, 1, 2, 3))])
    >>> class_code(one) == class_code(one.relabel({0: "a"}))
    True
    >>> class_code(one) == class_code(SCGraph(4, ring, [Loop((0, 1, 2, 3), "infinite")]))
    False
    """
    graph, colours = _coloured(sc, marked)
    labels = labels_of(graph)
    form = sorted(tuple(sorted((labels[a], labels[b]))) for a, b in graph.edges)
    return tuple(sorted(zip(labels, map(repr, colours), strict=True))), tuple(form), sc.spatial_loops


def symmetries_of_links(sc: SCGraph) -> list[dict[LinkId, LinkId]]:
    """Return permutations of the links that generate the symmetries of a mechanism.

    Parameters
    ----------
    sc : SCGraph or SCDGraph
        Of an SCD graph the sides of the links do not count.

    Returns
    -------
    list of dict of link id to link id
        Each with the image of every link; empty if there is no symmetry but the identity.

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> four_bar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> len(symmetries_of_links(four_bar)) > 0
    True
    """
    graph, _ = _coloured(sc, ())
    links = list(sc.nodes)
    return [{link: links[moved[i]] for i, link in enumerate(links)} for moved in symmetries_of(graph).generators]


def _coloured(sc: SCGraph, marked: Collection[LinkId]) -> tuple[ColouredGraph, list[tuple[Any, ...]]]:
    """Return the coloured graph, links first in their order, and what the colours of its nodes stand for."""
    colours: list[tuple[Any, ...]] = []
    edges: list[tuple[int, int]] = []
    number: dict[tuple[str, Hashable], int] = {}

    def node(kind: str, thing: LinkId | JointId | int, *colour: object) -> None:
        number[kind, thing] = len(colours)
        colours.append((kind, *colour))

    for link in sc.nodes:
        node("link", link, link == sc.ground, link in marked)
    for joint, ends in sc.joints.items():
        node("joint", joint)
        edges += [(number["joint", joint], number["link", end]) for end in ends]
    for k, one in enumerate(sc.centre_classes()):
        closing = sum(loop >= len(sc.loops) for loop in one.loops)
        node("class", k, one.centre.value, len(one.loops), closing)
        edges += [(number["class", k], number["joint", joint]) for joint in one.joints]
    palette = {colour: i for i, colour in enumerate(sorted(set(colours), key=repr))}
    return ColouredGraph(len(colours), edges, [palette[colour] for colour in colours]), colours
