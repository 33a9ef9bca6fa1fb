"""All assembly modes of a linkage at many inputs, as arrays."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from graphs.errors import numbered
from graphs.printing import Block, Printed, TableBlock, plain
from graphs.types import Flags, Floats, Ints, JointId
from synth.motion.configuration import Configuration

OTHER_QUESTION = "positions finds all configurations at given angles of driven joints, on all branches"


@dataclass(frozen=True, slots=True, repr=False)
class PositionTable(Printed):
    """All assembly modes at each of many inputs: F inputs of D driven joints, J joints, at most M real modes.

    Attributes
    ----------
    configuration : Configuration
        The mechanism that was given.
    joints, driven : tuple of joint id
    inputs : float[F, D]
        Radians; of prismatic joints lengths.
    angles : float[F, M, J]
        Of the real modes, in the order of `positions` at each input; nan where there are fewer.
    regular : bool[F, M]
        Whether the linkage is rigid there while its driven joints are held.
    count : int[F]
        How many real modes there are.
    general : int
        How many a generic realisation has, real or not.
    imaginary, far, singular, lost : int[F]
        The others at each input, as of `PositionSet`.
    curves : int
        Closed curves that were walked to count those of a generic realisation.

    Examples
    --------
    >>> from synth.assembly import positions
    >>> from synth.patterns import generate
    >>> table = positions(generate("four-bar").mechanism, drive={0: [0.0, 0.5, 1.0]})
    >>> table.count.tolist(), table.angles.shape, bool(table.exhaustive.all())
    ([2, 2, 2], (3, 2, 4), True)
    """

    configuration: Configuration
    joints: tuple[JointId, ...]
    driven: tuple[JointId, ...]
    inputs: Floats
    angles: Floats
    regular: Flags
    count: Ints
    general: int
    imaginary: Ints
    far: Ints
    singular: Ints
    lost: Ints
    curves: int

    @property
    def exhaustive(self) -> Flags:
        """At which inputs each position of the general member was followed to one that is listed, or to infinity."""
        return np.asarray((self.lost == 0) & (self.singular == 0))

    def __len__(self) -> int:
        return len(self.inputs)

    def __repr__(self) -> str:
        return f"<PositionTable: {numbered(len(self), 'input')}, {int(self.count.sum())} modes>"

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        joints = ", ".join(map(plain, self.driven))
        numbers, inputs = np.unique(self.count, return_counts=True)
        rows = [(str(modes), str(many)) for modes, many in zip(numbers.tolist(), inputs.tolist(), strict=True)]
        found = int(self.exhaustive.sum())
        return [
            f"assembly modes at {numbered(len(self), 'input')} of joint {joints}",
            TableBlock(("assembly modes", "inputs"), rows, ["assembly modes", "inputs"]),
            f"a generic realisation has {self.general}; all solutions tracked at {found} of {len(self)} inputs",
        ]

    def to_json(self) -> dict[str, Any]:
        """Return all as plain data, angles in radians; of each input as many modes as there are."""
        modes = [rows[:count].tolist() for rows, count in zip(self.angles, self.count.tolist(), strict=True)]
        rigid = [rows[:count].tolist() for rows, count in zip(self.regular, self.count.tolist(), strict=True)]
        return {
            "configuration": self.configuration.to_json(other_question=OTHER_QUESTION),
            "joints": list(self.joints),
            "driven": list(self.driven),
            "inputs": self.inputs.tolist(),
            "positions": modes,
            "regular": rigid,
            "general": self.general,
            **{name: getattr(self, name).tolist() for name in ("imaginary", "far", "singular", "lost")},
            "exhaustive": self.exhaustive.tolist(),
            "curves": self.curves,
        }
