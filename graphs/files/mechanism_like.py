"""What the verbs of ``synth`` take as their first argument: a mechanism, or the file or id that has it."""

from pathlib import Path
from types import UnionType
from typing import TypeAlias, TypeVar, overload

import networkx as nx

from graphs.convert.conversions import Mechanism, kind_in_words
from graphs.errors import ArgumentError, InvariantError, check_argument
from graphs.files.formats import read
from graphs.mechanism.precision import stated
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.vertex_edge import VertexEdgeGraph

MechanismLike: TypeAlias = Mechanism | nx.Graph | str | Path
"""A mechanism as `read` returns it, a graph of networkx, the path of a file, or an id."""

K = TypeVar("K")
T = TypeVar("T")


@overload
def mechanism_for(verb: str, mechanism: object, kinds: type[K]) -> K: ...
@overload
def mechanism_for(verb: str, mechanism: MechanismLike) -> Mechanism: ...
@overload
def mechanism_for(verb: str, mechanism: T | str | Path, kinds: UnionType) -> T | Mechanism: ...
def mechanism_for(verb: str, mechanism: object, kinds: type | UnionType = Mechanism) -> object:
    """Return the mechanism that a verb was called with, read if it is a path, an id or a graph of networkx.

    Raise ArgumentError, by the name of the verb, if it is not of the kinds that the verb takes; for a type in the
    place of a crease pattern it says how to give it coordinates.

    >>> mechanism_for("identify", "k1:Cr")
    <SCGraph: 4 links, 4 joints, 1 centre>
    """
    value = read(mechanism) if isinstance(mechanism, str | Path | nx.Graph) else mechanism
    if kinds is Sheet and isinstance(value, SCGraph | VertexEdgeGraph):
        what = f"{verb}: the {kind_in_words(value)} has no coordinates; expected a Sheet"
        raise ArgumentError(f"{what}; try `synth realise`, in Python synth.realise(...).sheet")
    check_argument(verb, value, kinds)
    return value


def with_stated_precision(mechanism: T, precision: float | None) -> T | Sheet:
    """Return a crease pattern with a stated precision of its coordinates; InvariantError for anything else."""
    if precision is None:
        return mechanism
    if not isinstance(mechanism, Sheet):
        raise InvariantError("precision", f"a precision for {mechanism!r}", "the coordinates of a crease pattern")
    return stated(mechanism, precision)
