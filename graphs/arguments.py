"""Keywords of functions that pass them on: an unknown one is refused by the name of the function that was called."""

from collections.abc import Callable
from functools import wraps
from inspect import Parameter, signature
from typing import ParamSpec, TypeVar, get_args, get_type_hints

from graphs.edit.named import known
from graphs.errors import ArgumentError, shown

__all__ = ["keywords_checked"]

P = ParamSpec("P")
R = TypeVar("R")


def keywords_checked(function: Callable[P, R]) -> Callable[P, R]:
    """Return a function that refuses unknown and missing arguments by an ArgumentError with its name.

    Keywords that it passes on (``**options: Unpack[Options]``) are those of the typed dictionary. A generator function
    refuses them when it is called, not when the first item is taken.

    >>> @keywords_checked
    ... def listed(links: int, *, workers: int = 1) -> int:
    ...     return links
    >>> listed(4, worker=2)  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    ...
    graphs.errors.ArgumentError: listed: there is no option 'worker'; ...; the nearest is 'workers'
    """
    takes, name = signature(function), function.__name__

    @wraps(function)
    def call(*args: P.args, **kwargs: P.kwargs) -> R:
        options = _option_names(function)
        for word in kwargs:
            if word not in options:
                raise ArgumentError(f"{name}: there is no option {shown(word)}; expected {known(options, word)}")
        try:
            takes.bind(*args, **kwargs)
        except TypeError as error:
            raise ArgumentError(f"{name}: {error}; expected {', '.join(options)}") from None
        return function(*args, **kwargs)

    return call


def _option_names(function: Callable[..., object]) -> list[str]:
    """Return the names that a function takes as keywords, those that it passes on too."""
    names: list[str] = []
    for name, parameter in signature(function).parameters.items():
        if parameter.kind is Parameter.VAR_KEYWORD:
            (options,) = get_args(get_type_hints(function, include_extras=True)[name])
            names += get_type_hints(options)
        else:
            names.append(name)
    return names
