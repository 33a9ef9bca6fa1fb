"""Symmetries of a type as symmetries of the axes of a member: half turns, mirrors, turns about a line.

Theory: docs/theory/realisation.md.
"""

from __future__ import annotations

from itertools import islice
from math import cos, lcm, pi, sin

import networkx as nx
import numpy as np

from graphs.errors import numbered
from graphs.mechanism.sc import SCGraph
from graphs.types import Floats
from synth.realisation.special.conditions import AxisSymmetry

__all__ = ["named_motions"]

_MOST = 240
"""Symmetries of a type that are looked at; rings of six have twelve, types with more are very regular."""
_KINDS = 4
"""Kinds of symmetry that are tried, those that move most joints first."""

Image = tuple[int, ...]


def named_motions(graph: SCGraph) -> list[tuple[str, AxisSymmetry]]:
    """Return isometries by which a member of the type may be symmetric, one for each kind of symmetry.

    A symmetry of order two is half a turn about a line, or a mirror; others are turns about a line. Images are
    those of the joints, then of the centre classes, in their order.

    >>> ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])
    >>> [name for name, _ in named_motions(ring)][:1]
    ['line symmetry, 0 joints and 2 links on themselves']
    """
    joints = len(graph.joints)
    found = []
    for image in _kinds(_automorphisms(graph)):
        order = _order(image)
        fixed = f"{numbered(sum(image[place] == place for place in range(joints)), 'joint')} and "
        fixed += numbered(_links_kept(graph, image), "link")
        if order == 2:
            found.append(
                (f"line symmetry, {fixed} on themselves", AxisSymmetry(image, np.diag([-1.0, -1.0, 1.0])))
            )
            found.append(
                (f"plane symmetry, {fixed} on themselves", AxisSymmetry(image, np.diag([1.0, 1.0, -1.0])))
            )
        else:
            found.append((f"turns by {360 / order:.6g} degrees about a line", AxisSymmetry(image, _turn(order))))
    return found


def _turn(order: int) -> Floats:
    angle = 2.0 * pi / order
    return np.array([[cos(angle), -sin(angle), 0.0], [sin(angle), cos(angle), 0.0], [0.0, 0.0, 1.0]])


def _automorphisms(graph: SCGraph) -> list[Image]:
    """Return where joints and centre classes go, in every symmetry but the identity."""
    joints, classes, links = list(graph.joints), graph.centre_classes(), list(graph.nodes)
    whole = nx.Graph()
    for place in range(len(joints)):
        whole.add_node(place, kind="joint")
    for number, one in enumerate(classes):
        whole.add_node(len(joints) + number, kind=one.centre.value)
    first = len(joints) + len(classes)
    for number in range(len(links)):
        whole.add_node(first + number, kind="link")
    number_of = {link: first + number for number, link in enumerate(links)}
    for place, ends in enumerate(graph.joints.values()):
        whole.add_edges_from((place, number_of[link]) for link in ends)
    for number, one in enumerate(classes):
        members = [place for place, joint in enumerate(joints) if joint in one.joints]
        whole.add_edges_from((len(joints) + number, place) for place in members)
    same_kind = nx.isomorphism.categorical_node_match("kind", None)
    matcher = nx.isomorphism.GraphMatcher(whole, whole, same_kind)
    images = {tuple(one[place] for place in range(first)) for one in islice(matcher.isomorphisms_iter(), _MOST)}
    return sorted(images - {tuple(range(first))})


def _kinds(images: list[Image]) -> list[Image]:
    """Return one symmetry of each class of conjugates, those that move most first."""
    left, chosen = set(images), []
    for image in images:
        if image in left:
            chosen.append(image)
            left -= {_conjugate(image, by) for by in images}
            left.discard(image)
    return sorted(chosen, key=lambda one: (sum(to == place for place, to in enumerate(one)), _order(one), one))[
        :_KINDS
    ]


def _conjugate(image: Image, by: Image) -> Image:
    moved = [0] * len(image)
    for place, to in enumerate(image):
        moved[by[place]] = by[to]
    return tuple(moved)


def _links_kept(graph: SCGraph, image: Image) -> int:
    """Return how many links have their joints taken to their own joints."""
    place = {joint: number for number, joint in enumerate(graph.joints)}
    of_links = [{place[joint] for _, _, joint in graph.edges(link, keys=True)} for link in graph.nodes]
    return sum({image[one] for one in joints} == joints for joints in of_links)


def _order(image: Image) -> int:
    """Return the least number of times after which all are at their places again."""
    lengths, seen = [1], set()
    for place in range(len(image)):
        length = 0
        while place not in seen:
            seen.add(place)
            place, length = image[place], length + 1  # noqa: PLW2901
        lengths.append(max(length, 1))
    return lcm(*lengths)
