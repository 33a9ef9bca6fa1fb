"""The mechanism of a type as an atlas names it: by its kind and its id there."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from enumerate.strings.panel_strings import ChainString
from graphs.errors import InvariantError, shown
from graphs.files.ids import is_id, mechanism_of_id
from synth.conformed.rates import loops_of_chain
from synth.drawing.catalogue.rows import order_of_row

__all__ = ["drawable_of_type"]


def drawable_of_type(kind: str, code: str) -> Any:
    """Return what `synth.draw` draws of the type with an id in an atlas.

    Raise InvariantError if there can be no such type.

    >>> drawable_of_type("sc", "m1:ab.ac.bd.cd")
    <SCGraph: 4 links, 4 joints, 1 centre>
    >>> drawable_of_type("order", "k1:Cr:0-2-1-3").names
    ['0', '1', '2', '3']
    """
    if not (isinstance(kind, str) and isinstance(code, str)):
        raise InvariantError("type", f"kind {shown(kind)}, id {shown(code)}", "texts")
    if kind == "string":
        return ChainString.parse(code)
    chain_code, _, joints = code.rpartition(":") if kind == "order" else (code, "", "")
    if not is_id(chain_code):
        raise InvariantError("type", f"{shown(code)} is no id", "k1:... or m1:...")
    mechanism = mechanism_of_id(chain_code)
    if kind != "order":
        return mechanism
    order = joints.split("-")
    if sorted(order) != sorted(map(str, range(len(mechanism.joints)))):
        raise InvariantError("type", f"{shown(code)} is no order of the joints of its chain", "each joint once")
    loops = [list(map(str, loop)) for loop in loops_of_chain(mechanism)]
    return order_of_row(_evenly_spaced(order, loops), mechanism)


def _evenly_spaced(order: list[str], loops: list[list[str]]) -> Mapping[str, Any]:
    """Return a row as conical candidates have it, joints on equal slots."""
    place = {name: slot for slot, name in enumerate(order)}
    slots = [place[str(joint)] for joint in range(len(order))]
    return {"order": order, "slots": slots, "loops": loops, "most_layers": None}
