"""Which type of an atlas a mechanism is, and which known types are one edit away. Theory: docs/theory/atlas.md."""

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import Any

import networkx as nx

from graphs.answer.identity import identify
from graphs.convert.conversions import Mechanism, graph_of, to_scd
from graphs.edit import edits
from graphs.errors import SynthedraError
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Sheet
from graphs.printing import Block, Printed, TableBlock
from synth.synthesis.atlas.atlas_file import Atlas
from synth.synthesis.atlas.columns import NamedType, named_types


@dataclass(frozen=True, slots=True)
class NearType:
    """A type of the atlas, as its row, to which an edit, in words, leads from a mechanism."""

    edit: str
    row: dict[str, Any]

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {"edit": self.edit, "id": self.row["id"], "kind": self.row["kind"], "name": self.row["name"]}


@dataclass(frozen=True, slots=True)
class FoundType(Printed):
    """The types of an atlas that a mechanism is, with its ids as a chain and as a drawing.

    `rows` are the types with these ids, that of the drawing first; `named` are their names in the literature, in
    the atlas or not, and `near` the types one edit away.
    """

    chain: str | None
    drawing: str | None
    rows: tuple[dict[str, Any], ...]
    named: tuple[NamedType, ...]
    near: tuple[NearType, ...]

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on."""
        return {
            "chain": self.chain,
            "drawing": self.drawing,
            "types": [{"id": row["id"], "kind": row["kind"], "name": row["name"]} for row in self.rows],
            "names": [{"id": entry.id, "name": entry.name, "source": entry.source} for entry in self.named],
            "near": [near.to_json() for near in self.near],
        }

    def blocks(self) -> list[Block]:
        """Return the lines that are printed."""
        lines: list[Block] = [f"{entry.name}: {entry.source}" for entry in self.named]
        if self.rows:
            rows = [(row["id"], row["kind"], row["name"] or "") for row in self.rows]
            lines.append(TableBlock(("id", "kind", "name"), rows))
        else:
            lines.append(f"not in this atlas: {self.drawing or self.chain or 'a mechanism without an id'}")
        if self.near:
            table = [(near.edit, near.row["id"], near.row["name"] or "") for near in self.near]
            lines += ["one edit away:", TableBlock(("edit", "id", "name"), table)]
        return lines


def find_type(atlas: Atlas, mechanism: Mechanism | nx.Graph) -> FoundType:
    """Find the type of a mechanism in an atlas, and the types to which one edit leads.

    Parameters
    ----------
    atlas : Atlas
    mechanism : Sheet, SCGraph, SCDGraph, PolyhedronModel, VertexEdgeGraph, SurfaceLinkage or networkx.Graph

    Returns
    -------
    FoundType
        Edits: a joint locked, a ride-along added; of an SCD graph also a centre made explicit or remote.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from synth.synthesis.atlas import AtlasPlan, build_atlas, open_atlas
    >>> with TemporaryDirectory() as folder:
    ...     _ = build_atlas(f"{folder}/a.sqlite", AtlasPlan(4, creases=0, orders_of=(), realised=False))
    ...     identified = find_type(open_atlas(f"{folder}/a.sqlite"), nx.cycle_graph(4))
    >>> [(row["id"], row["name"]) for row in identified.rows]
    [('k1:Cr', 'four-bar chain')]
    """
    identity = identify(mechanism)
    codes = [code for code in (identity.drawing, identity.chain) if code is not None]
    named = tuple(entry for code in codes for entry in named_types() if entry.id == code)
    leading: dict[str, str] = {}
    for edit in _edits(mechanism) if codes else ():
        edited = identify(edit.graph)
        for code in (edited.drawing, edited.chain)[: 1 if edited.drawing is not None else 2]:
            if code is not None and code not in codes:
                leading.setdefault(code, edit.what)
    near = tuple(NearType(leading[row["id"]], row) for row in atlas.ids(list(leading)) if row["id"] in leading)
    return FoundType(identity.chain, identity.drawing, tuple(atlas.ids(codes)), named, near)


def _edits(mechanism: Mechanism | nx.Graph) -> Iterator[edits.Edit]:
    """Yield the edits of a mechanism that lead to a type: others break a rule."""
    for edit in _possible_edits(mechanism):
        with suppress(SynthedraError):
            yield edit()


def _possible_edits(mechanism: Mechanism | nx.Graph) -> Iterator[Callable[[], edits.Edit]]:
    graph = to_scd(mechanism) if isinstance(mechanism, Sheet) else graph_of(mechanism)
    if isinstance(graph, SCDGraph):
        for joint in graph.joints:
            yield partial(edits.lock_hinge, graph, joint)
            yield partial(edits.ride_along, graph, joint)
        for loop in range(len(graph.loops)):
            yield partial(edits.make_explicit, graph, loop)
            yield partial(edits.make_implicit, graph, loop)
        return
    for joint, ends in graph.joints.items():
        yield partial(edits.lock_joint, graph, joint)
        yield partial(edits.add_ride_along, graph, *ends)
