"""Chains that have names, in ``enumerate/named/chains.json``."""

import json
from functools import cache
from importlib.resources import files

from graphs.errors import InvariantError, shown


@cache
def _named() -> dict[str, str]:
    text = files("enumerate").joinpath("named/chains.json").read_text(encoding="utf-8")
    named: dict[str, str] = json.loads(text)
    return named


def name_of(chain: str) -> str:
    """Return the name of the chain with an id; empty if it has none.

    Parameters
    ----------
    chain : str
        ``k1:...``

    Examples
    --------
    >>> name_of("k1:Cr")
    'four-bar'
    """
    return next((name for name, code in _named().items() if code == chain), "")


def chain_names() -> tuple[str, ...]:
    """Return all names.

    Examples
    --------
    >>> chain_names()
    ('four-bar', 'five-bar', 'watt', 'stephenson')
    """
    return tuple(_named())


def chain_named(name: str) -> str:
    """Return the id of the chain with a name, ``k1:...``.

    Parameters
    ----------
    name : str
        In any case of letters.

    Raises
    ------
    InvariantError
        If there is no such name.

    Examples
    --------
    >>> chain_named("four-bar")
    'k1:Cr'
    """
    code = _named().get(name.lower())
    if code is None:
        raise InvariantError("chain", f"no chain is named {shown(name)}", " ".join(_named()))
    return code
