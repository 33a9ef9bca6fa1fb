"""A generator: a function that makes a mechanism, its parameters with ranges, and the facts from its source."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import degrees, isfinite, radians
from typing import Literal

from graphs.errors import InvariantError, shown
from graphs.joints.linkage import JointedLinkage
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.tolerances import DOUBLE

Unit = Literal["count", "length", "angle"]
"""Counts are whole; lengths have any unit, the same for all of a mechanism; angles are radians."""

Values = Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Parameter:
    """One parameter of a generator.

    Attributes
    ----------
    name : str
    unit : {"count", "length", "angle"}
    default, least, most : float
        Both ends belong to the range; angles in radians.
    meaning : str

    Examples
    --------
    >>> count("rows", 3, 1, 9, "number of rows of panels").checked(12)
    Traceback (most recent call last):
    ...
    graphs.errors.InvariantError: rows = 12; expected a whole number from 1 to 9 [parameter]
    """

    name: str
    unit: Unit
    default: float
    least: float
    most: float
    meaning: str

    def checked(self, value: float) -> float:
        """Return a value that is in range, a count as a whole number; InvariantError for others."""
        whole = self.unit != "count" or value == int(value) if isfinite(value) else False
        if not whole or not self.least - DOUBLE.same_point <= value <= self.most + DOUBLE.same_point:
            raise InvariantError("parameter", f"{self.name} = {self.in_words(value)}", self.range)
        return int(value) if self.unit == "count" else float(value)

    @property
    def range(self) -> str:
        """The range in words; angles in degrees."""
        kind = "a whole number" if self.unit == "count" else "a number" if self.unit == "length" else "an angle"
        return f"{kind} {self.limits}"

    @property
    def limits(self) -> str:
        """The least and the largest value in words; angles in degrees."""
        return f"from {self.in_words(self.least).removesuffix(' degrees')} to {self.in_words(self.most)}"

    def in_words(self, value: float) -> str:
        """Return a value with its unit, as it is printed."""
        if self.unit == "angle":
            return f"{degrees(value):.6g} degrees"
        return f"{value:.6g}"


def count(name: str, default: int, least: int, most: int, meaning: str) -> Parameter:
    """Return a parameter that is a whole number."""
    return Parameter(name, "count", default, least, most, meaning)


def length(name: str, default: float, least: float, most: float, meaning: str) -> Parameter:
    """Return a parameter that is a length."""
    return Parameter(name, "length", default, least, most, meaning)


def angle(name: str, default: float, least: float, most: float, meaning: str) -> Parameter:
    """Return a parameter that is an angle, by its default and range in degrees."""
    return Parameter(name, "angle", radians(default), radians(least), radians(most), meaning)


@dataclass(frozen=True, slots=True)
class Generator:
    """How one kind of mechanism is made, and what is known of it.

    Attributes
    ----------
    name : str
    title : str
    make : callable
        Takes the parameters by name; returns a sheet, hinged solids, or a linkage with joints of all kinds.
    parameters : tuple of Parameter
    freedoms : callable
        Takes the values of the parameters; returns the degrees of freedom of finite motion by the source.
    conditions : str
        When these are the freedoms: the branch that is meant, what the proportions must obey.
    source : str
    foldable : bool
        Whether it is flat, and can be folded to an angle.
    relations : str
        What its parameters must obey together, within their ranges; empty if there is nothing.
    """

    name: str
    title: str
    make: Callable[..., Sheet | HingedSolids | JointedLinkage]
    parameters: tuple[Parameter, ...]
    freedoms: Callable[[Values], int]
    conditions: str
    source: str
    foldable: bool = False
    relations: str = ""

    def values(self, chosen: Values) -> dict[str, float]:
        """Return the values of all parameters; InvariantError if one is unknown or out of range."""
        known = {parameter.name for parameter in self.parameters}
        for name in chosen:
            if name not in known:
                what = f"{self.name} has no parameter {shown(name)}"
                raise InvariantError("parameter", what, ", ".join(sorted(known)) or "no parameters")
        return {one.name: one.checked(chosen.get(one.name, one.default)) for one in self.parameters}


FOLD = Parameter("fold", "angle", 0.0, radians(0.5), radians(170.0), "fold angle of the crease that moves most")
"""The largest fold angle of a foldable pattern."""
