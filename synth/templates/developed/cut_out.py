"""Layered links as flat pieces: sectors of the unrolled surface with tabs and slots, and the surface itself."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import pi

import numpy as np
import shapely

from synth.templates.developed.layered import Joining, LayeredLink, LayeredLinkage
from synth.templates.lines import Kind, Piece, Point, Stroke, Text

__all__ = ["flat_pieces"]

_OFF = 0.004
"""Millimetres by which a chord may miss its arc."""
_NAME, _SMALL = 4.0, 2.8
"""Sizes of names of links and of joints, millimetres."""
_FROM_RIM = 5.0
"""Millimetres from the outer edge to names of joints."""
_SLANT = 0.05
"""A tab runs in by this part of its length at each end."""
_Corner = tuple[float, float]
"""Azimuth and length along the ruling line there."""


@dataclass(frozen=True)
class _Unrolled:
    """The plane of a piece; `middle` is the azimuth that points upwards."""

    linkage: LayeredLinkage
    layer: float
    middle: float

    def at(self, azimuth: float, along: float) -> Point:
        """Return where a place lies."""
        height = self.linkage.height(self.layer)
        x, y = self.linkage.surface.flat(azimuth - self.middle, along, height).tolist()
        return x, y

    def points(self, corners: Sequence[_Corner]) -> list[Point]:
        """Return a way along corners; from one to the next at the same length it goes along the arc."""
        height, found = self.linkage.height(self.layer), [np.array(corners[:1])]
        for (azimuth, along), (after, then) in pairwise(corners):
            count = 1
            if along == then:
                count = self.linkage.surface.chords(abs(after - azimuth), along, height, _OFF)
            parts = np.arange(1, count + 1)[:, None] / count
            found.append(np.array([azimuth, along]) * (1 - parts) + np.array([after, then]) * parts)
        azimuths, lengths = np.concatenate(found).T
        flat = self.linkage.surface.flat(azimuths - self.middle, lengths, height).tolist()
        return [(x, y) for x, y in flat]

    def lines(self, kind: Kind, corners: Sequence[_Corner]) -> list[Stroke]:
        """Return the strokes of a way along corners."""
        return [Stroke(kind, a, b) for a, b in pairwise(self.points(corners))]


def flat_pieces(linkage: LayeredLinkage) -> list[Piece]:
    """Return the pieces of a linkage: the surface with the ruling lines of its joints, then a piece for each link.

    All are seen from outside; the arcs of their edges are chords that miss them by 0.004 mm at most.
    """
    links = [_piece_of_link(linkage, number) for number in range(len(linkage.links))]
    return [_piece_of_surface(linkage), *links]


def _piece_of_surface(linkage: LayeredLinkage) -> Piece:
    """Return the surface under all links, cut open half way between the two joints that are farthest apart."""
    places = sorted(linkage.places.values())
    gaps = [after - here for here, after in pairwise([*places, places[0] + 2 * pi])]
    widest = int(np.argmax(gaps))
    start = places[widest] + gaps[widest] / 2
    end, middle = start + 2 * pi, start + pi
    unrolled = _Unrolled(linkage, -1, middle)
    inner, outer = ends = linkage.dimensions.ends
    tab = _tab_corners(end, 1, min(linkage.tab, gaps[widest] / 4), ends)
    outline = [(end, outer), (start, outer), (start, inner), (end, inner), *tab[1:-1], (end, outer)]
    strokes = [*unrolled.lines("CUT", outline), *unrolled.lines("CREASE", [(end, inner), (end, outer)])]
    texts = [Text(unrolled.at(middle, (inner + outer) / 2), "surface", _NAME)]
    for name, place in linkage.places.items():
        azimuth = start + float(np.remainder(place - start, 2 * pi))
        strokes += unrolled.lines("MARKS", [(azimuth, inner), (azimuth, outer)])
        texts.append(Text(unrolled.at(azimuth, outer - _FROM_RIM), name, _SMALL))
    return Piece(tuple(strokes), tuple(texts), shapely.Polygon(unrolled.points(outline)))


def _piece_of_link(linkage: LayeredLinkage, number: int) -> Piece:
    """Return the piece of a link."""
    link = linkage.links[number]
    start, end = link.start, link.start + link.width
    inner, outer = linkage.dimensions.ends
    unrolled = _Unrolled(linkage, link.layer, start + link.width / 2)
    joinings = {one.side: one for one in linkage.joinings if one.tabbed == number and one.side}
    tabs = {
        side: _tab_corners(azimuth, side, linkage.tab, linkage.dimensions.tab_ends)
        for side, azimuth in ((-1, start), (1, end))
        if side in joinings
    }
    outline = [
        (start, inner),
        *tabs.get(-1, []),
        (start, outer),
        (end, outer),
        *tabs.get(1, [])[::-1],
        (end, inner),
    ]
    strokes = unrolled.lines("CUT", [*outline, outline[0]])
    texts = [Text(unrolled.at(*_free_place(linkage, link)), f"{link.name}, layer {link.layer}", _NAME)]
    for side, tab in tabs.items():
        strokes += unrolled.lines(_fold(linkage, joinings[side]), [tab[0], tab[-1]])
        middle = (tab[1][0] + tab[0][0]) / 2, sum(linkage.dimensions.ends) / 2
        texts.append(Text(unrolled.at(*middle), joinings[side].joint, _SMALL))
    for name, along in link.joints:
        side = link.at_end(name)
        if not side:
            strokes += unrolled.lines("MARKS", [(start + along, inner), (start + along, outer)])
        inside = start + along - side * min(linkage.tab, link.width) / 2
        texts.append(Text(unrolled.at(inside, outer - _FROM_RIM), name, _SMALL))
    holes = []
    for _, along in link.slots:
        slot = _slot_corners(linkage, start + along)
        strokes += unrolled.lines("CUT", slot)
        holes.append(shapely.Polygon(unrolled.points(slot)))
    covered = shapely.Polygon(unrolled.points(outline)).difference(shapely.union_all(holes))
    return Piece(tuple(strokes), tuple(texts), covered)


def _tab_corners(azimuth: float, side: int, width: float, ends: tuple[float, float]) -> list[_Corner]:
    """Return the corners of a tab beside a ruling line, from its inner end to its outer one."""
    low, high = ends
    slant, beyond = _SLANT * (high - low), azimuth + side * width
    return [(azimuth, low), (beyond, low + slant), (beyond, high - slant), (azimuth, high)]


def _slot_corners(linkage: LayeredLinkage, azimuth: float) -> list[_Corner]:
    """Return the corners of a slot along a ruling line, the first again at the end."""
    (low, high), half = linkage.dimensions.slot_ends, linkage.slot
    ring = [(azimuth - half, low), (azimuth - half, high), (azimuth + half, high), (azimuth + half, low)]
    return [*ring, ring[0]]


def _fold(linkage: LayeredLinkage, joining: Joining) -> Kind:
    """Return how a tab is folded, seen from outside: back over or under its link, or it lies flat and hinges."""
    if not joining.folded:
        return "CREASE"
    outside = linkage.links[joining.other].layer > linkage.links[joining.tabbed].layer
    return "VALLEY" if outside else "MOUNTAIN"


def _free_place(linkage: LayeredLinkage, link: LayeredLink) -> _Corner:
    """Return the middle of the widest part of a link without a ruling line of a joint or a slot."""
    lines = sorted({along for _, along in (*link.joints, *link.slots)})
    widest = max(pairwise(lines), key=lambda pair: pair[1] - pair[0])
    return link.start + sum(widest) / 2, sum(linkage.dimensions.ends) / 2
