"""Orders of joints round a cone, as rows of conical candidates have them; linkages on surfaces, in any form.

Theory: docs/theory/conical-candidates.md.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import pi, radians
from pathlib import Path
from typing import Any, Protocol, TypeAlias

from graphs.errors import ArgumentError, InvariantError, shown
from graphs.files.bare import names_from_text
from graphs.files.formats import is_id, mechanism_of_id
from graphs.files.mechanism_like import MechanismLike, mechanism_for
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.surfaces import Surface, SurfaceLinkage

Row: TypeAlias = Mapping[str, Any]
"""Column to value."""
CandidateRow: TypeAlias = Mapping[str, object]
"""A row of `synth.conical_candidates`, or of a list of them: column to value, as callers pass it."""


class _WithLinkage(Protocol):
    """A result that has a linkage on a surface, as `synth.realise_on_cone` returns it."""

    @property
    def linkage(self) -> SurfaceLinkage: ...


SurfaceLike: TypeAlias = MechanismLike | CandidateRow | _WithLinkage
"""A linkage on a surface, its file, a row of `synth.conical_candidates`, or the result of `synth.realise_on_cone`."""


@dataclass(frozen=True, slots=True)
class OrderOnCircle:
    """Joints round a cone, at azimuths in radians.

    The chain is drawn if the order is not shown. `pairs` are the indices of neighbouring joints of a link.
    """

    chain: SCGraph
    names: Sequence[str]
    azimuths: Sequence[float]
    pairs: Sequence[tuple[int, int]]


def order_of_row(row: Row, chain: SCGraph) -> OrderOnCircle:
    """Return the order of joints of a row of conical candidates, at its azimuths, or evenly spaced.

    Names of joints and links are those of the file of the chain, which the id does not know: they are read from the
    loops, and from ``joins``, which older rows do not have. The row has ``order``, ``loops``, and ``azimuths_deg`` or
    ``slots``: azimuths are in the order of the joints of the chain (that of the row's id), and ``order`` names joints
    as they follow each other; a point opposite to one has a prime. Raise KeyError, TypeError or ValueError for
    another row.
    """
    # slots go round half a turn where orders name opposite points too; rows of other orders count the layers
    primed = "azimuths_deg" not in row and "most_layers" not in row
    turn = pi if primed else 2 * pi
    if "azimuths_deg" in row:
        azimuths = [radians(angle) for angle in row["azimuths_deg"]]
    else:
        azimuths = [slot * pi / len(row["slots"]) * (1 if primed else 2) for slot in row["slots"]]
    names = [""] * len(azimuths)
    ranked = sorted(range(len(azimuths)), key=lambda joint: azimuths[joint] % turn)
    for joint, name in zip(ranked, row["order"], strict=True):
        names[joint] = str(name).removesuffix("'") if primed else str(name)
    place = {name: joint for joint, name in enumerate(names)}
    pairs = {
        (min(place[a], place[b]), max(place[a], place[b]))
        for loop in row["loops"]
        for a, b in zip(loop, [*loop[1:], loop[0]], strict=True)
    }
    return OrderOnCircle(_chain_of_row(row, names) if "joins" in row else chain, names, azimuths, sorted(pairs))


def _chain_of_row(row: Row, names: Sequence[str]) -> SCGraph:
    """Return the chain of a row with the names that joints and links have there, and its independent loops."""
    joins = {name: (a, b) for name, a, b in row["joins"]}
    links = names_from_text(sorted({link for ends in joins.values() for link in ends}))
    joints = {name: (links[joins[name][0]], links[joins[name][1]]) for name in names}
    independent = len(joints) - len(links) + 1
    ground = links[row["ground"]] if row["ground"] else None
    loops = [Loop(tuple(loop)) for loop in row["loops"][:independent]]
    return SCGraph(sorted(links.values(), key=str), joints, loops, ground=ground)


def candidate_for(verb: str, row: Row) -> OrderOnCircle:
    """Return the order of joints of a row that a verb was called with.

    Raise ArgumentError, by the name of the verb, if it is no row of conical candidates, InvariantError if what it says
    does not fit together.
    """
    lacking = [column for column in ("chain", "order", "loops") if column not in row]
    if lacking or not is_id(shown_id := str(row["chain"])):
        wrong = f"without {', '.join(lacking)}" if lacking else f"whose chain is {shown(row['chain'])}"
        raise ArgumentError(f"{verb}: a mapping {wrong}; expected a row of synth.conical_candidates")
    try:
        return order_of_row(row, mechanism_of_id(shown_id))
    except (KeyError, TypeError, ValueError) as error:
        problem = f"the row's order of the joints is invalid: {type(error).__name__} {error}"
        raise InvariantError("row", problem, "columns order, loops, and slots or azimuths_deg") from None


def surface_linkage_for(verb: str, mechanism: SurfaceLike, surface: Surface | None = None) -> SurfaceLinkage:
    """Return the linkage on a surface that a verb was called with, in any of the forms of `SurfaceLike`.

    A row of conical candidates lies on the `surface`, or on any. Raise ArgumentError, by the name of the verb, for
    another object.
    """
    if isinstance(mechanism, Mapping):
        order = candidate_for(verb, mechanism)
        return SurfaceLinkage.placed(order.chain, order.azimuths, surface)
    held = None if isinstance(mechanism, str | Path) else getattr(mechanism, "linkage", None)
    return mechanism_for(verb, held if isinstance(held, SurfaceLinkage) else mechanism, SurfaceLinkage)
