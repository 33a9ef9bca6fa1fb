"""The mechanism of a row of an atlas: to be drawn, or written to a file."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from enumerate.strings.graphs import chain_scd
from enumerate.strings.panel_strings import ChainString
from graphs.errors import UnsolvableError, shown
from graphs.files.ids import mechanism_of_id
from graphs.files.native.documents import dumps
from synth.conformed.cycles import loops_of_chain
from synth.drawing.catalogue.rows import order_of_row

__all__ = ["drawable_of_type", "mechanism_file_of_type"]


def drawable_of_type(kind: str, code: str) -> Any:
    """Return what `synth.draw` draws of a type.

    Parameters
    ----------
    kind : str
    code : str
        Its id in an atlas.

    Examples
    --------
    >>> drawable_of_type("sc", "m1:ab.ac.bd.cd")
    <SCGraph: 4 links, 4 joints, 1 centre>
    >>> drawable_of_type("order", "k1:Cr:0-2-1-3").names
    ['0', '1', '2', '3']
    """
    if kind == "string":
        return ChainString.parse(code)
    if kind != "order":
        return mechanism_of_id(code)
    chain_code, _, joints = code.rpartition(":")
    chain = mechanism_of_id(chain_code)
    order = joints.split("-")
    loops = [list(map(str, loop)) for loop in loops_of_chain(chain)]
    return order_of_row(_evenly_spaced(order, loops), chain)


def _evenly_spaced(order: list[str], loops: list[list[str]]) -> Mapping[str, Any]:
    """Return a row as conical candidates have it, joints on equal slots."""
    place = {name: slot for slot, name in enumerate(order)}
    slots = [place[str(joint)] for joint in range(len(order))]
    return {"order": order, "slots": slots, "loops": loops, "most_layers": None}


def mechanism_file_of_type(row: Mapping[str, Any]) -> str:
    """Return the native file of the mechanism of a row with ``kind`` and ``id``.

    Raises
    ------
    UnsolvableError
        If it is an order, which has no angles.
    """
    kind, code = row["kind"], row["id"]
    if kind == "order":
        raise UnsolvableError(f"{shown(code)} is an order without angles: there is no file of it")
    return dumps(chain_scd(ChainString.parse(code)) if kind == "string" else mechanism_of_id(code))
