"""The picture of architecture.md: rooms about the middle, and which of them imports which.

``make pictures`` runs it. An arrow goes from a room to one that imports it, where no other room lies between.
"""

from __future__ import annotations

import ast
import sys
from pathlib import Path

import networkx as nx

sys.path.insert(0, str(Path(__file__).resolve().parent))

from drawings.pieces import head

from synth.making.drawing.scene.shapes import NORMAL, SMALL, Label, Layer, Line, Polygon, Shape, text_width
from synth.making.drawing.scene.writing import Scene

ROOT = Path(__file__).resolve().parent.parent
PLACE = ROOT / "docs" / "pictures" / "architecture.svg"
ROOMS = (
    *("graphs.tolerances", "graphs.geometry", "graphs.rank", "synth.analysis.motion", "synth.analysis.folding"),
    *(
        "synth.analysis.moving",
        "synth.analysis.assembly",
        "synth.analysis.compliance",
        "synth.analysis.overconstraint",
        "synth.analysis.verdict",
    ),
    *(
        "synth.analysis.advice",
        "synth.making.drawing",
        "synth.catalogue.realisation",
        "synth.making.templates",
        "synth.making.viewer",
    ),
)
GAP, HIGH, DOWN, EDGE = 12.0, 20.0, 48.0, 6.0


def imports() -> nx.DiGraph:
    """Return the rooms, with an edge from each to those that import it; what longer ways say is left out."""
    graph = nx.DiGraph()
    graph.add_nodes_from(ROOMS)
    for room in ROOMS:
        folder = ROOT.joinpath(*room.split("."))
        files = folder.rglob("*.py") if folder.is_dir() else [folder.with_suffix(".py")]
        for file in files:
            for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
                if isinstance(node, ast.ImportFrom) and node.module and file.name != "__init__.py":
                    inside = [other for other in ROOMS if f"{node.module}.".startswith(f"{other}.")]
                    graph.add_edges_from((other, room) for other in inside if other != room)
    return nx.transitive_reduction(graph)


def main() -> None:
    """Draw it."""
    graph = imports()
    rows = [sorted(row, key=ROOMS.index) for row in nx.topological_generations(graph)]
    wide = {room: text_width(room, SMALL) + 14.0 for room in ROOMS}
    width = 2 * EDGE + max(sum(wide[room] for room in row) + GAP * (len(row) - 1) for row in rows)
    boxes: dict[str, tuple[float, float]] = {}
    for number, row in enumerate(rows):
        left = (width - sum(wide[room] for room in row) - GAP * (len(row) - 1)) / 2
        for room in row:
            boxes[room] = left + wide[room] / 2, EDGE + number * DOWN
            left += wide[room] + GAP
    shapes: list[Shape] = []
    for room, (x, y) in boxes.items():
        half = wide[room] / 2
        corners = [(x - half, y), (x + half, y), (x + half, y + HIGH), (x - half, y + HIGH)]
        middle = room == "synth.analysis.motion"
        shapes.append(Polygon(corners, None, "marked" if middle else "grey", NORMAL))
        shapes.append(Label((x, y + HIGH / 2), room, SMALL, halo=False, bold=middle))
    for below, above in sorted(graph.edges):
        (x, y), (u, v) = boxes[below], boxes[above]
        start, tip = (x, y + HIGH), (u, v)
        shapes += [Line([start, tip], "grey", NORMAL / 2), head(start, tip, "grey")]
    scene = Scene(width, 2 * EDGE + (len(rows) - 1) * DOWN + HIGH, (Layer("rooms", tuple(shapes)),), "Rooms")
    scene.save(PLACE, force=True)


if __name__ == "__main__":
    main()
