"""All mechanisms of a kind: chains, SC and SCD graphs, strings, the atlas, orders round a cone."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import combinations
from math import pi, sin
from pathlib import Path
from tempfile import TemporaryDirectory

import synth
from drawings.altered import cropped, legible, without
from drawings.pieces import arrow, in_rows, of_shapes, on_air, words
from drawings.together import above, beside, said
from enumerate.chains.names import chain_named, name_of
from enumerate.chains.rows import chain_ids
from enumerate.conical.query import ConicalQuery, conical_orders, count_conical_orders
from enumerate.contracted.binary_links import EVERY, PlacementRange, frame_of, joints_of_all, list_placements, no_prefix
from enumerate.contracted.graphs import contracted_graphs
from enumerate.scd.jobs import scd_graphs_of
from graphs.errors import numbered
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.types import LinkId
from synth.linkages.conformed.orders import OrderOnCircle
from synth.making.drawing import Scene
from synth.making.drawing.mechanisms.chains import ChainLook, chain_scene
from synth.making.drawing.scene.frame import PictureOptions
from synth.making.drawing.scene.shapes import NORMAL, STRONG, Disc, Layer, Line, Point, Polygon, Shape
from synth.synthesis.atlas.building import AtlasPlan, build_atlas

__all__ = ["DRAWINGS"]

_PLAIN = ChainLook(link_numbers=False, joint_numbers=False)
_LETTERS = ChainLook(link_numbers=False)
_SIX_BAR = 6
_MOST = 255
"""Binary links on a joint at most: no limit."""


def chains() -> Scene:
    """Six links: the contracted graph of two loops, binary links placed on its joints, the chains."""
    [(links, codes)] = contracted_graphs(2)
    frame = frame_of(codes[0], links)
    placed, _ = list_placements(frame, PlacementRange(_SIX_BAR, _MOST, EVERY), no_prefix())
    joints = joints_of_all(frame, placed)
    rows = []
    for numbers, pairs, code in zip(placed.tolist(), joints.tolist(), chain_ids(_SIX_BAR, joints)[0], strict=True):
        chain = cropped(
            chain_scene(SCGraph(_SIX_BAR, pairs), PictureOptions(box=(130, 110), caption=None), look=_PLAIN)
        )
        rows += [
            said(_strands(numbers), " + ".join(map(str, numbers)) + " binary links"),
            arrow(),
            said(chain, _named(code)),
        ]
    theta = said(_strands([0] * len(frame.ends)), "contracted graph", "of two loops")
    return beside(theta, arrow("4 binary", "links"), in_rows(rows, 3, gap=12.0))


def _named(code: str) -> str:
    return f"{str(name_of(code)).capitalize()}'s chain"


def _strands(numbers: Sequence[int]) -> Scene:
    """Return two links with joints between them, on these so many binary links."""
    wide, high = 110.0, 80.0
    left, right, level = 12.0, wide - 12.0, high / 2
    lines: list[Shape] = []
    discs: list[Shape] = []
    for place, number in enumerate(numbers):
        bulge = (place - (len(numbers) - 1) / 2) * 60.0

        def at(part: float, bulge: float = bulge) -> Point:
            return left + part * (right - left), level + bulge * sin(pi * part) * 0.55

        lines.append(Line([at(i / 24) for i in range(25)], "ink", 1.2 * NORMAL))
        discs += [Disc(at((i + 1) / (number + 1)), 4.0, "paper", "class1", STRONG) for i in range(number)]
    ternary = [Disc((x, level), 7.0, "ground", "ink", NORMAL) for x in (left, right)]
    return of_shapes(wide, high, [*lines, *discs, *ternary])


def sc_enumeration() -> Scene:
    """The SC graphs of six links and one freedom."""
    pictures = []
    for graph in synth.sc_graphs(_SIX_BAR, 1):
        centres = len(graph.centre_classes())
        scene = without(legible(synth.draw(graph, kind="graph", caption=None, box=(136, 124))), "ride-alongs")
        counted = f"{centres} centre{'s' * (centres > 1)}"
        pictures.append(said(cropped(scene), _named(str(synth.identify(graph).chain)), counted))
    return beside(*pictures, gap=24.0)


def scd_enumeration() -> Scene:
    """A four-bar: every placement of open edges that gives its links four sides at most, and its panels."""
    ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    columns = [above(_graph(ring), words("SC graph:", "where do", "open edges go?"), gap=6.0)]
    for graph in scd_graphs_of(ring, 4):
        panels = synth.draw(synth.realise(graph).sheet, colour="none", numbers=False, caption=None, box=(82, 82))
        columns.append(above(_graph(graph), cropped(panels), gap=6.0))
    return in_rows(columns, 4, gap=14.0, down=12.0)


def _graph(graph: SCGraph) -> Scene:
    return cropped(legible(synth.draw(graph, kind="graph", caption=None, box=(108, 108))))


def strings() -> Scene:
    """The strings of one, two and three creases as strips."""
    rows = []
    for creases in (1, 2, 3):
        strips = [
            said(cropped(synth.draw(chain, caption=None, box=(150, 70))), f"{chain.text}: {chain.mechanism}")
            for chain in synth.strings(creases)
        ]
        rows.append(beside(words(numbered(creases, "crease")), *strips))
    return above(*rows, gap=8.0)


def atlas() -> Scene:
    """An SC graph in a small atlas, and the types that are related to it."""
    with TemporaryDirectory() as folder:
        place = Path(folder) / "small.sqlite"
        build_atlas(place, AtlasPlan(_SIX_BAR, creases=0, orders_of=(), realised=False))
        opened = synth.open_atlas(place)
        report = opened.show(opened.query("kind = 'sc' AND links = 6 AND centres = 2").rows[0]["id"])
    drawn = [one.id for one in report.neighbours if one.relation.startswith("is, without")]
    named = [one.id for one in report.neighbours if one.id in drawn and one.name]
    from_it = [
        beside(arrow(one.relation, long=98.0), on_air(_type(one.id, 92.0), 80.0), gap=6.0)
        for one in report.neighbours
        if one.id not in drawn
    ]
    some = above(*(_type(code, 100.0) for code in named[:3]), gap=4.0)
    return beside(
        said(some, f"3 of {len(drawn)} SCD graphs"),
        arrow("is a drawing,", "with open edges, of"),
        said(_type(report.values["id"], 124.0), "SC graph"),
        above(*from_it, gap=14.0),
        gap=6.0,
    )


def _type(code: str, side: float) -> Scene:
    """Return the picture of a type by its id."""
    graph = synth.read(code)
    if code.startswith("k1:"):
        return cropped(chain_scene(graph, PictureOptions(box=(side, side), caption=None), look=_PLAIN))
    return cropped(without(legible(synth.draw(graph, kind="graph", caption=None, box=(side, side))), "ride-alongs"))


def conical_candidates() -> Scene:
    """Watt's chain, and some of the orders of its joints round a cone."""
    watt = synth.read(chain_named("watt"))
    joints = dict(zip("abcdefg", watt.joints.values(), strict=True))
    query = ConicalQuery(tuple(joints.items()))
    slots = [row for _, row in conical_orders(query)]
    chain = legible(
        chain_scene(SCGraph(len(watt), joints), PictureOptions(box=(150, 150), caption=None), look=_LETTERS),
        joints=True,
    )
    circles = [_circle(joints, row) for row in slots[:: len(slots) // 6][:6]]
    count = count_conical_orders(query)
    return beside(
        said(cropped(chain), "Watt's chain"),
        arrow("seen from", "the apex"),
        said(in_rows(circles, 3, gap=12.0), f"6 of its {count} orders round a cone"),
        gap=10.0,
    )


def _circle(joints: Mapping[str, tuple[LinkId, LinkId]], slots: Sequence[int]) -> Scene:
    """Return an order of joints, its ternary links as triangles."""
    scene = cropped(legible(synth.draw(_order(joints, slots), caption=None, box=(104, 104)), joints=True))
    places = {dict(one.data)["joint"]: one.centre for one in scene.shapes() if isinstance(one, Disc) and one.data}
    own = [[places[name] for name in joints if link in joints[name]] for link in _links(joints)]
    bodies = tuple(Polygon(corners, "marked", None, opacity=0.6) for corners in own if len(corners) > 2)
    return replace(scene, layers=(Layer("bodies", bodies), *scene.layers))


def _links(joints: Mapping[str, tuple[LinkId, LinkId]]) -> list[LinkId]:
    return sorted({link for ends in joints.values() for link in ends})


def _order(joints: Mapping[str, tuple[LinkId, LinkId]], slots: Sequence[int]) -> OrderOnCircle:
    """Return joints on their slots, those of a link joined in turn."""
    names = list(joints)
    pairs: set[tuple[int, int]] = set()
    for link in _links(joints):
        own = [place for place, name in enumerate(names) if link in joints[name]]
        pairs.update(combinations(own, 2))
    chain = SCGraph(len(_links(joints)), joints)
    return OrderOnCircle(chain, names, [2 * pi * slot / len(slots) for slot in slots], sorted(pairs))


DRAWINGS: dict[str, Callable[[], Scene]] = {
    "chains": chains,
    "sc-enumeration": sc_enumeration,
    "scd-enumeration": scd_enumeration,
    "strings": strings,
    "atlas": atlas,
    "conical-candidates": conical_candidates,
}
