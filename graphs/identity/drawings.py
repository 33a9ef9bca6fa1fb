"""Canonical ids of drawn mechanisms: SC graphs whose loops are faces, and SCD graphs.

The id is ``m1:`` and the least breadth-first reading of the drawing. From a joint at a link, beside the outer
face, the sides of the link are read in their cyclic order, then those of the links met, in the order in which
they were met, each from the joint by which it was met. A joint is a letter, ``a`` the first, and occurs twice;
``-`` is an open edge, ``.`` parts links. Mirror images are equal. The outer face is the one between the first
two joints. Where centres are not all finite, ``;`` and a letter for each bounded face follow, in the order in
which they are met: ``f`` finite, ``i`` infinite, ``s`` spatial. With more than 52 joints these are numbers,
parted by commas.

Names and ground links do not count. A changed form would be ``m2:``.
Theory: docs/theory/map-codes.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from string import ascii_letters
from typing import Any, NamedTuple

import networkx as nx

from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.loops.classes import centre_classes
from graphs.loops.loop import Centre, Loop, cut_into_cycles, signed_cycle
from graphs.mechanism.drawing import Rotation, Side, trace_faces
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.types import JointId, LinkId

_PREFIX = "m1:"
# Symbols of a reading. The least reading is the id, so their order is part of all ids.
_OPEN = 0  # an open edge
_END = 1  # the end of a link
_JOINT = 2  # the first joint; joint k is _JOINT + k, so it is the greatest
_LABELS = {Centre.FINITE: "f", Centre.INFINITE: "i", Centre.NONE: "s"}
_OUTER = "o"


def map_id(mechanism: SCGraph) -> str:
    """Return the canonical id of a drawn mechanism, ``m1:...``.

    Parameters
    ----------
    mechanism : SCGraph or SCDGraph
        Of an SC graph the loops must be the bounded faces of a drawing, spatial ones included.

    Raises
    ------
    UnsolvableError
        If the loops are not faces, the graph is neither 2-connected nor a tree, the outer face carries a centre,
        or centres coincide that nothing forces to.

    Examples
    --------
    >>> map_id(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))]))
    'm1:ab.ac.bd.cd'
    """
    return map_text(*map_code(mechanism))


def map_code(mechanism: SCGraph) -> tuple[list[int], str]:
    """Return the symbols of the id (0 an open edge, 1 the end of a link, 2 + k joint k), and labels of the faces.

    Of all readings the symbols are the least. Labels are a letter for each bounded face; empty where all centres
    are finite. Errors are those of `map_id`.

    Parameters
    ----------
    mechanism : SCGraph or SCDGraph
        As for `map_id`.

    Examples
    --------
    >>> map_code(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3), "infinite")]))
    ([2, 3, 1, 2, 4, 1, 3, 5, 1, 4, 5, 1], 'i')
    """
    _check_drawn(mechanism)
    rotation, outer = drawing_of(mechanism)
    faces, left_of = trace_faces(mechanism.joints, rotation)
    outside = left_of[outer]
    kinds = {frozenset(loop.joints): _LABELS[loop.centre] for loop in mechanism.loops}
    labels = [_OUTER if face.index == outside else kinds.get(frozenset(face.joints), "s") for face in faces]
    plain = set(labels) <= {_OUTER, "f"}
    best: tuple[list[int], str] | None = None
    for mirrored in (False, True):
        turns = {
            link: _Turn.of(mechanism, link, sides[::-1] if mirrored else sides) for link, sides in rotation.items()
        }
        for corner in faces[outside].corners:
            root = corner.arriving if mirrored else corner.leaving
            symbols, reads = _reading(turns, corner.link, root)
            found = symbols, ""
            if not plain:  # the face after a joint lies on its left seen from the link, in a mirror on its right
                met = [left_of[joint, _across(mechanism, joint, link) if mirrored else link] for link, joint in reads]
                found = symbols, "".join(labels[f] for f in dict.fromkeys(met))[1:]
            if best is None or found < best:
                best = found
    assert best is not None
    return best


def _across(mechanism: SCGraph, joint: JointId, link: LinkId) -> LinkId:
    a, b = mechanism.joints[joint]
    return b if link == a else a


class _Turn(NamedTuple):
    """The sides round a link, twice, each with the link across it, and the place where each is first."""

    sides: list[tuple[JointId | None, LinkId | None]]
    place: dict[JointId | None, int]

    @classmethod
    def of(cls, mechanism: SCGraph, link: LinkId, around: Sequence[JointId | None]) -> _Turn:
        sides = [(side, None if side is None else _across(mechanism, side, link)) for side in around]
        place: dict[JointId | None, int] = {}
        for at, side in enumerate(around):
            place.setdefault(side, at)
        return cls(sides + sides, place)


def _reading(
    turns: Mapping[LinkId, _Turn], root: LinkId, joint: JointId | None
) -> tuple[list[int], list[tuple[LinkId, JointId]]]:
    """Read a drawing from a joint at a link; return the symbols, and links and joints in the order of reading."""
    number: dict[JointId, int] = {}
    start: dict[LinkId, JointId | None] = {root: joint}
    order = [root]
    symbols: list[int] = []
    reads: list[tuple[LinkId, JointId]] = []
    for link in order:
        sides, place = turns[link]
        at = place[start[link]]
        for side, other in sides[at : at + len(sides) // 2]:
            if side is None or other is None:
                symbols.append(_OPEN)
                continue
            symbols.append(_JOINT + number.setdefault(side, len(number)))
            reads.append((link, side))
            if other not in start:
                start[other] = side
                order.append(other)
        symbols.append(_END)
    return symbols, reads


def map_text(symbols: Sequence[int], labels: str = "") -> str:
    """Return the id of symbols and labels."""
    joints = max(symbols) - _JOINT + 1
    short = joints <= len(ascii_letters)

    def side(symbol: int) -> str:
        return "-" if symbol == _OPEN else ascii_letters[symbol - _JOINT] if short else str(symbol - _JOINT)

    links = ("" if short else ",").join
    text = ".".join(links(side(symbol) for symbol in link) for link in _split(symbols))
    return _PREFIX + text + (";" + labels if labels else "")


def _split(symbols: Sequence[int]) -> Iterator[list[int]]:
    """Yield the symbols of each link."""
    link: list[int] = []
    for symbol in symbols:
        if symbol == _END:
            yield link
            link = []
        else:
            link.append(symbol)


def symbols_of(code: str) -> tuple[list[int], str]:
    """Return the symbols and the labels of an id; raises `InvariantError` if it is not an id."""
    text, _, labels = code.removeprefix(_PREFIX).partition(";")
    if not code.startswith(_PREFIX):
        wrong = f"{shown(code)} is not the id of a drawing"
        raise InvariantError("id", wrong, f"an id that begins with {_PREFIX}")
    symbols = []
    for link in text.split("."):
        for side in link.split(",") if any(c.isdigit() for c in text) else link:
            if side == "-":
                symbols.append(_OPEN)
            elif side.isascii() and side.isdigit() and len(side) < 9:
                symbols.append(_JOINT + int(side))
            elif len(side) == 1 and side in ascii_letters:
                symbols.append(_JOINT + ascii_letters.index(side))
            else:
                raise InvariantError("id", f"the id {shown(code)} has a side {shown(side)}", "a joint or -")
        symbols.append(_END)
    return symbols, labels


def mechanism_from_map_id(code: str) -> SCGraph:
    """Return the mechanism of an id: an SCD graph if it has open edges, else an SC graph.

    Links and joints are numbered as the id reads them.

    Parameters
    ----------
    code : str
        ``m1:...``, least or not.

    Raises
    ------
    InvariantError
        If it is not an id, or breaks a rule of SC or SCD graphs.

    Examples
    --------
    >>> four_bar = mechanism_from_map_id("m1:ab.ac.bd.cd")
    >>> len(four_bar), four_bar.loops[0].joints
    (4, (1, 3, 2, 0))
    """
    symbols, labels = symbols_of(code)
    ends: dict[JointId, list[LinkId]] = {}
    rotation: dict[LinkId, tuple[Side, ...]] = {}
    for link, sides in enumerate(_split(symbols)):
        rotation[link] = tuple(None if s == _OPEN else s - _JOINT for s in sides)
        for joint in rotation[link]:
            if joint is not None:
                ends.setdefault(joint, []).append(link)
    for joint, links in ends.items():
        if len(set(links)) != 2 or len(links) != 2:
            raise InvariantError("id", f"joint {joint} of {shown(code)} is at links {links}", "two different links")
    joints = {joint: (links[0], links[1]) for joint, links in sorted(ends.items())}
    if not joints or list(joints) != list(range(len(joints))):
        raise InvariantError("id", f"the joints of {shown(code)} are {list(joints)}", "all from the first on")
    faces, left_of = trace_faces(joints, rotation)
    if len(rotation) - len(joints) + len(faces) != 2:
        raise InvariantError("id", f"{shown(code)} is not drawn on one sphere", "one drawing, in one piece")
    loops = _loops(code, labels, rotation, faces, left_of)
    if any(None in sides for sides in rotation.values()):
        outer = (0, "left") if len(faces) > 1 else None
        return SCDGraph(len(rotation), joints, loops, rotation=rotation, outer=outer)
    return SCGraph(len(rotation), joints, loops)


def _loops(
    code: str, labels: str, rotation: Rotation, faces: Sequence[Any], left_of: Mapping[tuple[JointId, LinkId], int]
) -> list[Loop]:
    """Return the loops of the bounded faces, in the order in which an id meets them."""
    met = (left_of[side, link] for link, sides in rotation.items() for side in sides if side is not None)
    _, *bounded = dict.fromkeys(met)
    kinds = {letter: centre for centre, letter in _LABELS.items()}
    if labels and (len(labels) != len(bounded) or not set(labels) <= set(kinds)):
        raise InvariantError("id", f"the labels {shown(labels)} of {shown(code)}", f"{len(bounded)} of f, i, s")
    return [
        Loop(faces[f].joints, kinds[letter]) for f, letter in zip(bounded, labels or "f" * len(bounded), strict=True)
    ]


def _check_drawn(mechanism: SCGraph) -> None:
    """Refuse what an id has no place for."""
    if mechanism.closing:
        raise UnsolvableError("ids of drawn mechanisms have no place for a centre in the outer face")
    tree = len(mechanism.joints) == len(mechanism) - 1
    if mechanism.components != 1 or not (tree or nx.is_biconnected(nx.Graph(mechanism))):
        raise UnsolvableError("ids of drawn mechanisms are for trees and for graphs that no link cuts in two")
    bare = [Loop(loop.joints, loop.centre) for loop in mechanism.loops]
    if {one.joints for one in centre_classes(bare)} != {one.joints for one in mechanism.centre_classes()}:
        raise UnsolvableError("loops share a centre though no joints force them to: an id has no place for that")


def drawing_of(mechanism: SCGraph) -> tuple[Rotation, tuple[JointId, LinkId]]:
    """Return the drawing of a mechanism: its own, or the one whose bounded faces its loops are.

    It is the rotation, link to sides counter-clockwise, and the outer face, which lies on the left of a joint seen
    from a link.

    Parameters
    ----------
    mechanism : SCGraph or SCDGraph
        An SC graph is 2-connected and has a loop for every bounded face.

    Raises
    ------
    UnsolvableError
        If the loops are not faces.

    Examples
    --------
    >>> rotation, outer = drawing_of(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))]))
    >>> rotation[0], outer
    ((0, 3), (1, 1))
    """
    if isinstance(mechanism, SCDGraph):
        corner = mechanism.faces[mechanism.drawing.outer_face].corners[0]
        if corner.leaving is None:
            raise UnsolvableError("a single link has no joint to begin with")
        return mechanism.rotation, (corner.leaving, corner.link)
    if not mechanism.loops:
        raise UnsolvableError("a tree without open edges has no drawing of its own; expected an SCD graph")
    cycles = [loop.joints for loop in mechanism.loops]
    rest: set[JointId] = set()
    for cycle in cycles:
        rest ^= set(cycle)
    outside = cut_into_cycles(rest, mechanism.joints) if rest else []
    missing = len(mechanism.joints) - len(mechanism) + 1 - len(cycles)
    if missing or len(outside) != 1:
        raise UnsolvableError(
            f"the loops are not the bounded faces of a drawing: {missing} more would be needed"
            if missing
            else "the loops are not the bounded faces of a drawing: their sum is not one cycle"
        )
    after = _turns(mechanism, [*cycles, tuple(outside[0])])
    rotation = {
        link: _round(link, [joint for _, _, joint in mechanism.edges(link, keys=True)], after)
        for link in mechanism.nodes
    }
    faces, _ = trace_faces(mechanism.joints, rotation)
    outer = next(f for f in faces if set(f.joints) == rest)
    return rotation, (outer.corners[0].leaving, outer.corners[0].link)


def _turns(mechanism: SCGraph, cycles: Sequence[Sequence[JointId]]) -> dict[tuple[LinkId, JointId], JointId]:
    """Return the next joint counter-clockwise of each joint at each link, from the cycles round all faces."""
    walks = [list(signed_cycle(cycle, mechanism.joints)) for cycle in cycles]
    beside: dict[JointId, list[tuple[int, int]]] = {}
    for f, walk in enumerate(walks):
        for joint, sign in walk:
            beside.setdefault(joint, []).append((f, sign))
    sense = {0: 1}
    for f in (order := [0]):
        for joint, sign in walks[f]:
            for other, sign_there in beside[joint]:
                if other != f and other not in sense:  # two faces cross their joint in opposite directions
                    sense[other] = -sense[f] * sign * sign_there
                    order.append(other)
    after: dict[tuple[LinkId, JointId], JointId] = {}
    for f, walk in enumerate(walks):
        turned = [(joint, sign * sense.get(f, 1)) for joint, sign in walk[:: sense.get(f, 1)]]
        for (arriving, sign), (leaving, _) in zip(turned, turned[1:] + turned[:1], strict=True):
            after[mechanism.joints[arriving][1 if sign > 0 else 0], leaving] = arriving
    return after


def _round(
    link: LinkId, at_link: Sequence[JointId], after: Mapping[tuple[LinkId, JointId], JointId]
) -> tuple[JointId, ...]:
    """Return the joints of a link in their cyclic order."""
    around = [at_link[0]]
    while (following := after.get((link, around[-1]))) not in (None, around[0]) and len(around) < len(at_link):
        around.append(following)
    if len(around) < len(at_link) or following != around[0]:
        raise UnsolvableError(
            f"the loops are not the bounded faces of a drawing: they do not go round link {shown(link)} once"
        )
    return tuple(around)
