"""What a search for special geometry finds: three types with M <= 0 and known special members, thirty without.

Writes benchmarks/results/special_geometry.json, a row for each type; with FIRST LAST some of them. Types are made
of graphs: sheets about the vertices of a planar graph, each with creases to the border until four meet (or more,
where asked); chains of two loops whose centres are chosen.
"""

from __future__ import annotations

import json
import sys
from itertools import pairwise
from pathlib import Path
from time import process_time
from typing import Any

import networkx as nx

from graphs.convert.panels import scd_from_panels
from graphs.identity.drawings import map_id
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from synth.catalogue.realisation.special.search import SpecialWishes, search_special

OUT = Path(__file__).parent / "results" / "special_geometry.json"


def sheet_about(edges: list[tuple[int, int]], more: tuple[int, ...] = ()) -> SCDGraph:
    """Return the sheet with these creases between inner vertices, which are two-connected.

    Creases go to the border from the vertices of the outer cycle until each has four, and one more for each time
    it is in `more`.
    """
    graph = nx.Graph(edges)
    _, drawing = nx.check_planarity(graph)
    faces, seen = [], set()
    for half in sorted(drawing.edges()):
        if half not in seen:
            faces.append(drawing.traverse_face(*half, seen))
    outer = max(faces, key=len)
    panels = [tuple(face) for face in faces if face is not outer]
    spokes = [v for v in outer for _ in range(max(4 - graph.degree(v), 0) + more.count(v))]
    where = {v: place for place, v in enumerate(outer)}
    tips = [len(graph) + number for number in range(len(spokes))]
    for number, (v, tip) in enumerate(zip(spokes, tips, strict=True)):
        after, next_tip = spokes[(number + 1) % len(spokes)], tips[(number + 1) % len(spokes)]
        steps = (where[after] - where[v]) % len(outer)
        walk = [outer[(where[v] + step) % len(outer)] for step in range(steps + 1)]
        panels.append((tip, *walk, next_tip))
    return scd_from_panels(panels)


def cycle(count: int) -> list[tuple[int, int]]:
    """Return the edges of a polygon."""
    return [(k, (k + 1) % count) for k in range(count)]


def two_loops(first: int, shared: int, second: int, centres: tuple[str, str]) -> SCGraph:
    """Return a chain of two loops: so many joints of its own, shared, and of its own; centres of both."""
    joints: list[tuple[int, int]] = []
    number = 2
    for count in (first, shared, second):
        ends = [0, *range(number, number + count - 1), 1]
        number += count - 1
        joints += list(pairwise(ends))
    one = tuple(range(first + shared))
    other = tuple(range(first, first + shared + second))
    return SCGraph(number, joints, [Loop(one, centres[0]), Loop(other, centres[1])])


def ring(count: int) -> SCGraph:
    """Return a spatial loop."""
    return SCGraph(count, [((k - 1) % count, k) for k in range(count)])


def types() -> list[tuple[str, SCGraph]]:
    """Return all types with their names: three known ones, then thirty."""
    square = cycle(4)
    known = [
        ("four vertices about a square (Miura, square twist)", sheet_about(square)),
        ("4R (Bennett)", ring(4)),
        ("6R (Sarrus, Bricard, kaleidocycle)", ring(6)),
    ]
    sheets = [
        ("triangle", cycle(3), ()),
        ("pentagon", cycle(5), ()),
        ("hexagon", cycle(6), ()),
        ("heptagon", cycle(7), ()),
        ("octagon", cycle(8), ()),
        ("two triangles", [*square, (0, 2)], ()),
        ("triangle and square", [*cycle(5), (0, 2)], ()),
        ("two squares", [*cycle(6), (0, 3)], ()),
        ("triangle and pentagon", [*cycle(6), (0, 2)], ()),
        ("square and pentagon", [*cycle(7), (0, 3)], ()),
        ("two pentagons", [*cycle(8), (0, 4)], ()),
        ("square and hexagon", [*cycle(8), (0, 3)], ()),
        ("three triangles", [*cycle(5), (0, 2), (0, 3)], ()),
        ("fan of five triangles", [*cycle(5), *((k, 5) for k in range(5))], ()),
        ("two triangles and a square", [*cycle(6), (0, 2), (0, 3)], ()),
        ("fan of six triangles", [*cycle(6), *((k, 6) for k in range(6))], ()),
        ("squares round a corner", [*cycle(8), (0, 3), (0, 5)], ()),
        ("fan of four triangles", [*square, *((k, 4) for k in range(4))], ()),
        ("two squares, one vertex of five", [*cycle(6), (0, 3)], (1,)),
        ("two triangles, one vertex of five", [*square, (0, 2)], (0,)),
    ]
    chains = [
        ("5R", ring(5)),
        ("6R and spherical 4R, a joint in common", two_loops(5, 1, 3, ("none", "finite"))),
        ("6R and planar 4R, a joint in common", two_loops(5, 1, 3, ("none", "infinite"))),
        ("6R and spherical 4R, two joints in common", two_loops(4, 2, 2, ("none", "finite"))),
        ("6R and planar 4R, two joints in common", two_loops(4, 2, 2, ("none", "infinite"))),
        ("5R and spherical 4R, a joint in common", two_loops(4, 1, 3, ("none", "finite"))),
        ("two 6R, a joint in common", two_loops(5, 1, 5, ("none", "none"))),
        ("two 6R, two joints in common", two_loops(4, 2, 4, ("none", "none"))),
        ("two 4R, a joint in common", two_loops(3, 1, 3, ("none", "none"))),
        ("6R and 4R, a joint in common", two_loops(5, 1, 3, ("none", "none"))),
    ]
    made = [(f"sheet: {name}", sheet_about(edges, more)) for name, edges, more in sheets]
    return [*known, *made, *((f"chain: {name}", graph) for name, graph in chains)]


def row(name: str, graph: SCGraph) -> dict[str, Any]:
    """Return what is found of one type."""
    begun = process_time()
    found = search_special(graph, SpecialWishes(1, tries=4))
    told = found.to_json()
    return {
        "type": name,
        "id": map_id(graph) if isinstance(graph, SCDGraph) else None,
        "links": len(graph),
        "joints": len(graph.joints),
        "M": found.mobility,
        "proof": found.proof,
        "found": [
            {key: one[key] for key in ("family", "start", "freedoms", "certainty", "closure", "h", "reasons")}
            for one in told["members"]
        ],
        "families": len(found.trials),
        "starts": sum(trial.starts for trial in found.trials),
        "work": told["work"],
        "seconds": round(process_time() - begun, 1),
    }


def main(first: int, last: int) -> None:
    """Search types by their numbers, and keep the rows of others."""
    rows = json.loads(OUT.read_text()) if OUT.exists() else []
    known = {one["type"]: one for one in rows}
    listed = types()
    for name, graph in listed[first:last]:
        known[name] = row(name, graph)
        print(json.dumps(known[name]), flush=True)
        OUT.write_text(json.dumps([known[one] for one, _ in listed if one in known], indent=1) + "\n")


if __name__ == "__main__":
    limits = [int(one) for one in sys.argv[1:]]
    main(*(limits or (0, len(types()))))
