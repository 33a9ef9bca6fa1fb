"""Which type a mechanism is: its canonical ids.

Theory: docs/theory/map-codes.md.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from graphs.convert.conversions import Mechanism, graph_of, to_scd
from graphs.errors import InvariantError, UnsolvableError, numbered
from graphs.files.formats import Entry, read_all
from graphs.files.mechanism_like import MechanismLike, mechanism_for
from graphs.identity.chains import chain_id
from graphs.identity.drawings import map_id
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.printing import Block, Printed, TableBlock


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
    >>> import networkx as nx
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


def identify(mechanism: MechanismLike) -> Identity:
    """Return the canonical ids of a mechanism.

    Parameters
    ----------
    mechanism : Mechanism, str, Path or networkx.Graph

    Examples
    --------
    >>> import networkx as nx
    >>> identify(nx.cycle_graph(4)).chain
    'k1:Cr'
    """
    mechanism = mechanism_for("identify", mechanism)
    chain, no_chain = _id_or_reason(lambda: chain_id(graph_of(mechanism)))
    drawing, no_drawing = _id_or_reason(lambda: map_id(_drawn(mechanism)))
    notes = [f"no id of the chain: {no_chain}"] * (chain is None)
    notes += [f"no id of the drawing: {no_drawing}"] * (drawing is None)
    return Identity(chain, drawing, tuple(notes))


By = Literal["chain", "drawing"]


@dataclass(frozen=True, slots=True)
class TypeClasses(Printed):
    """A list of mechanisms by type: those of one type have one id.

    Attributes
    ----------
    by : {"chain", "drawing"}
        Which id: of the link-joint graphs, or of the drawings with centres.
    classes : dict of str to tuple of str
        Id to the labels of the mechanisms that have it; both in the order of the list.
    without : dict of str to str
        Label to the reason why a mechanism has no such id.

    Examples
    --------
    >>> import networkx as nx
    >>> classes = types_of(["k1:Cr", nx.cycle_graph(4), nx.cycle_graph(5)])
    >>> classes.to_json()["classes"]
    [{'id': 'k1:Cr', 'members': ['k1:Cr', '2']}, {'id': 'k1:DqK', 'members': ['3']}]
    """

    by: By
    classes: dict[str, tuple[str, ...]]
    without: dict[str, str]

    @property
    def repeated(self) -> int:
        """How many mechanisms have the type of an earlier one."""
        return sum(len(members) - 1 for members in self.classes.values())

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on."""
        classes = [{"id": code, "members": list(members)} for code, members in self.classes.items()]
        without = [{"mechanism": label, "reason": reason} for label, reason in self.without.items()]
        return {"by": self.by, "classes": classes, "repeated": self.repeated, "without_id": without}

    def blocks(self) -> list[Block]:
        """Return a row per type."""
        many = sum(map(len, self.classes.values()))
        first = f"{numbered(many, 'mechanism')}, {numbered(len(self.classes), 'type')} by {self.by}"
        rows = [(code, str(len(members)), ", ".join(members)) for code, members in self.classes.items()]
        notes = [f"note: {label} has no id of its {self.by}: {reason}" for label, reason in self.without.items()]
        return [first, *([TableBlock(("id", "number", "mechanisms"), rows, ("number",))] if rows else []), *notes]


def types_of(mechanisms: Iterable[MechanismLike], *, by: By | None = None) -> TypeClasses:
    """Group mechanisms by type: which are isomorphic, and which appear more than once.

    Parameters
    ----------
    mechanisms : iterable of Mechanism, str, Path or networkx.Graph
        Of a file with several, such as graph6, each one. Mechanisms that are no files are labelled by their place,
        counted from 1.
    by : {"chain", "drawing"}, optional
        By the link-joint graph, or by the drawing with centres; by default by drawing where all have one.

    Examples
    --------
    >>> import networkx as nx
    >>> types_of([nx.path_graph(3), nx.star_graph(2)]).repeated
    1
    """
    identities: dict[str, Identity] = {}
    for place, given in enumerate(mechanisms, 1):
        for entry in read_all(given) if isinstance(given, str | Path) else [Entry(str(place), given)]:
            label = entry.label if entry.label not in identities else f"{entry.label} ({place})"
            identities[label] = identify(entry.mechanism)
    chosen = by or ("drawing" if all(one.drawing for one in identities.values()) else "chain")
    classes: dict[str, list[str]] = {}
    without = {}
    for label, identity in identities.items():
        code = getattr(identity, chosen)
        if code is None:
            without[label] = next(note.partition(": ")[2] for note in identity.notes if chosen in note)
        else:
            classes.setdefault(code, []).append(label)
    return TypeClasses(chosen, {code: tuple(members) for code, members in classes.items()}, without)


def _id_or_reason(find: Callable[[], str]) -> tuple[str | None, str]:
    try:
        return find(), ""
    except (InvariantError, UnsolvableError) as error:
        return None, str(error)


def _drawn(mechanism: Mechanism) -> SCGraph:
    """Return the mechanism with its drawing."""
    if isinstance(mechanism, Sheet | PolyhedronModel):
        return to_scd(mechanism)
    graph = graph_of(mechanism)
    if graph.centres_assumed:
        raise UnsolvableError("a link-joint graph has no drawing and no centres")
    return graph
