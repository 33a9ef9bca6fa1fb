"""Which type a mechanism is: its canonical ids.

Theory: docs/theory/map-codes.md.
"""

from collections.abc import Callable
from dataclasses import dataclass

import networkx as nx

from graphs.convert.table import Mechanism, graph_of, to_scd
from graphs.errors import InvariantError, UnsolvableError
from graphs.files.accepted import MechanismLike, mechanism_for
from graphs.identity.chains import chain_id
from graphs.identity.drawings import map_id
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.printing import Block, Printed


@dataclass(frozen=True, slots=True)
class Identity(Printed):
    """The canonical ids of a mechanism: equal for mechanisms of one type, and for no others.

    Attributes
    ----------
    chain, drawing : str or None
        ``k1:...``, of the link-joint graph, without centres; ``m1:...``, of the mechanism drawn on the sphere,
        with its centres and, where they are known, the sides of its links; mirror images have one id.
    notes : tuple of str
        Why an id is missing.

    Examples
    --------
    >>> identify(nx.cycle_graph(4)).to_json()
    {'chain': 'k1:Cr', 'drawing': None}
    """

    chain: str | None
    drawing: str | None
    notes: tuple[str, ...] = ()

    def to_json(self) -> dict[str, str | None]:
        """Return the keys that scripts rely on."""
        return {"chain": self.chain, "drawing": self.drawing}

    def blocks(self) -> list[Block]:
        """Return the lines that are printed."""
        lines = [f"chain    {self.chain}"] * (self.chain is not None)
        lines += [f"drawing  {self.drawing}"] * (self.drawing is not None)
        return [*lines, *(f"note: {note}" for note in self.notes)]


def identify(mechanism: MechanismLike | nx.Graph) -> Identity:
    """Return the canonical ids of a mechanism.

    Parameters
    ----------
    mechanism : Mechanism, str, Path or networkx.Graph

    Examples
    --------
    >>> identify(nx.cycle_graph(4)).chain
    'k1:Cr'
    """
    mechanism = mechanism_for("identify", mechanism, Mechanism | nx.Graph)
    chain, no_chain = _id_or_reason(lambda: chain_id(graph_of(mechanism)))
    drawing, no_drawing = _id_or_reason(lambda: map_id(_drawn(mechanism)))
    notes = [f"no id of the chain: {no_chain}"] * (chain is None)
    notes += [f"no id of the drawing: {no_drawing}"] * (drawing is None)
    return Identity(chain, drawing, tuple(notes))


def _id_or_reason(find: Callable[[], str]) -> tuple[str | None, str]:
    try:
        return find(), ""
    except (InvariantError, UnsolvableError) as error:
        return None, str(error)


def _drawn(mechanism: Mechanism | nx.Graph) -> SCGraph:
    """Return the mechanism with its drawing."""
    if isinstance(mechanism, Sheet | PolyhedronModel):
        return to_scd(mechanism)
    graph = graph_of(mechanism)
    if graph.centres_assumed:
        raise UnsolvableError("a link-joint graph has no drawing and no centres")
    return graph
