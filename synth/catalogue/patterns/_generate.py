"""What a generator makes, with what is known of it. Theory: docs/theory/generators.md."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import degrees
from typing import Any

from graphs.answer.mobility import counts_and_ranks
from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.joints.linkage import JointedLinkage
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.printing import Block, Printed
from synth.analysis.folding.symmetric_motion import fold_to
from synth.catalogue.patterns.generator import FOLD, Generator
from synth.catalogue.patterns.generators import GENERATORS


@dataclass(frozen=True, slots=True, repr=False)
class Generated(Printed):
    """A mechanism that a generator makes. It prints as ``synth generate`` does.

    Attributes
    ----------
    generator : Generator
    values : mapping of str to float
        Of all parameters; radians.
    fold : float or None
        Largest fold angle, radians; None if the mechanism is not folded.
    mechanism : Sheet, HingedSolids or JointedLinkage
    freedoms : int
        Of finite motion, according to the source.
    count : int or None
        Mobility by count of a generic realisation of its type.

    Examples
    --------
    >>> miura = generate("miura")
    >>> miura.generator.name, miura.freedoms
    ('miura', 1)
    """

    generator: Generator
    values: Mapping[str, float]
    fold: float | None
    mechanism: Sheet | HingedSolids | JointedLinkage
    freedoms: int
    count: int | None

    @property
    def overconstraint(self) -> int | None:
        """Freedoms beyond the count, h."""
        return None if self.count is None else self.freedoms - self.count

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on (docs/command-json.md)."""
        units = {parameter.name: parameter.unit for parameter in self.generator.parameters}
        return {
            "name": self.generator.name,
            "parameters": {
                name: degrees(value) if units[name] == "angle" else value for name, value in self.values.items()
            },
            "fold_deg": None if self.fold is None else degrees(self.fold),
            "freedoms": self.freedoms,
            "count": self.count,
            "h": self.overconstraint,
            "conditions": self.generator.conditions,
            "source": self.generator.source,
        }

    def blocks(self) -> list[Block]:
        """Return the lines that are printed."""
        with_values = ", ".join(
            f"{one.name} {one.in_words(self.values[one.name])}" for one in self.generator.parameters
        )
        lines: list[Block] = [f"{self.generator.title}: {with_values}" if with_values else self.generator.title]
        if self.fold is not None:
            lines.append(f"folded to {degrees(self.fold):g} degrees")
        freedoms = numbered(self.freedoms, "degree of freedom", "degrees of freedom")
        count = "not known" if self.count is None else f"{self.count}, h = {self.overconstraint}"
        lines.append(f"{freedoms} of finite motion, according to the source; by count M = {count}")
        return [*lines, f"conditions: {self.generator.conditions}", f"source: {self.generator.source}"]

    def __reduce__(self) -> tuple[Any, ...]:
        rest = (self.values, self.fold, self.mechanism, self.freedoms, self.count)
        return _with_generator, (self.generator.name, *rest)  # functions of a generator cannot be pickled

    def __repr__(self) -> str:
        return f"<Generated: {self.generator.name}, {self.mechanism!r}>"


def _with_generator(name: str, *rest: Any) -> Generated:
    """Return what a generator made, unpickled in another process."""
    return Generated(GENERATORS[name], *rest)


def generate(name: str, *, fold: float | None = None, **parameters: float) -> Generated:
    """Make a known pattern or linkage from its parameters.

    Parameters
    ----------
    name : str
        One of `synth.catalogue.patterns.GENERATORS`.
    fold : float, optional
        Fold angle of the crease that moves most, radians, for a flat pattern; by default it stays flat.
    **parameters
        Those of the generator; lengths in any unit, angles in radians.

    Raises
    ------
    InvariantError
        If there is no such generator or parameter, or a value is out of range.
    UnsolvableError
        If it cannot be folded, or not so far.

    Examples
    --------
    >>> sheet = generate("miura", rows=3, columns=3)
    >>> sheet.mechanism, sheet.freedoms, sheet.count, sheet.overconstraint
    (<Sheet: 9 faces, 12 creases, 16 vertices, flat>, 1, 0, 1)
    """
    if name not in GENERATORS:
        raise InvariantError("generator", f"there is no generator {shown(name)}", ", ".join(GENERATORS))
    generator = GENERATORS[name]
    values = generator.values(parameters)
    mechanism = generator.make(**values)
    if fold is not None:
        if not generator.foldable or not isinstance(mechanism, Sheet):
            raise UnsolvableError(f"{name} is not a flat pattern, so it is not folded: its parameters set its shape")
        fold = FOLD.checked(fold)
        last_frame = fold_to(mechanism, fold).frames()[-1]  # on the branch of its assignment
        assert isinstance(last_frame, Sheet)
        mechanism = last_frame
    by_count = counts_and_ranks(mechanism, exact=False, infinitesimal=False).mobility
    return Generated(generator, values, fold, mechanism, generator.freedoms(values), by_count)
