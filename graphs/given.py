"""What a function was given, checked at the door: a name or a number where it takes a mechanism."""

from __future__ import annotations

from pathlib import Path
from types import UnionType

from graphs.errors import ArgumentError, shown

__all__ = ["check_given"]


def check_given(verb: str, thing: object, kinds: type | UnionType) -> None:
    """Refuse what a function of ``synth`` cannot take, and say how to come by what it can.

    Parameters
    ----------
    verb : str
        The name of the function.
    thing : object
        What it was given.
    kinds : type or union of types
        What it takes.

    Raises
    ------
    ArgumentError
        Naming `synth.read`.

    Examples
    --------
    >>> from graphs.mechanism.sheet import Sheet
    >>> check_given("fold", "a.fold", Sheet)
    Traceback (most recent call last):
    ...
    graphs.errors.ArgumentError: fold: the text 'a.fold'; expected a Sheet; try synth.fold(synth.read('a.fold'))
    >>> check_given("fold", None, Sheet)
    Traceback (most recent call last):
    ...
    graphs.errors.ArgumentError: fold: None; expected a Sheet, as synth.read returns it
    """
    if isinstance(thing, kinds):
        return
    expected = f"a {kinds.__name__}" if isinstance(kinds, type) else "a mechanism"
    if isinstance(thing, str | Path):
        name = shown(str(thing))
        what = "text" if isinstance(thing, str) else "path"
        raise ArgumentError(
            f"{verb}: the {what} {name}; expected {expected}; try synth.{verb}(synth.read({name}))"
        )
    number = isinstance(thing, int | float)
    told = "None" if thing is None else shown(thing) if number else f"an object of type {type(thing).__name__}"
    raise ArgumentError(f"{verb}: {told}; expected {expected}, as synth.read returns it")
