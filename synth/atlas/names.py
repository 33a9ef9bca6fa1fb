"""Types that the literature names, in ``synth/atlas/named.json``: id, name, source.

Theory: docs/theory/atlas.md, which says how the file is made.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from enumerate.strings.panel_strings import ChainString

__all__ = ["NamedType", "name_of_type", "named_types"]


@dataclass(frozen=True, slots=True)
class NamedType:
    """A type that has a name, and the source that uses it."""

    kind: str
    id: str
    name: str
    source: str


@cache
def named_types() -> tuple[NamedType, ...]:
    """Return all types of the file, in its order.

    Examples
    --------
    >>> next(one for one in named_types() if one.name == "Watt chain").id
    'k1:E`hW'
    """
    text = files("synth.atlas").joinpath("named.json").read_text(encoding="utf-8")
    return tuple(NamedType(**entry) for entry in json.loads(text))


@cache
def _names() -> dict[tuple[str, str], str]:
    names: dict[tuple[str, str], list[str]] = {}
    for one in named_types():
        names.setdefault((one.kind, one.id), []).append(one.name)
    return {key: "; ".join(dict.fromkeys(every)) for key, every in names.items()}


def name_of_type(kind: str, code: str) -> str | None:
    """Return the name of a type, or None; a string has the name of the joints for which it stands.

    >>> name_of_type("chain", "k1:E`hW"), name_of_type("string", "RR-R-RRR"), name_of_type("chain", "k1:Bw")
    ('Watt chain', 'UPS', None)
    """
    if kind == "string":
        return ChainString.parse(code).mechanism
    return _names().get((kind, code))
