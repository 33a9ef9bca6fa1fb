"""What the index says of a mechanism, and how it is made."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from graphs.convert.conversions import Mechanism


@dataclass(frozen=True)
class Entry:
    """One mechanism: its file, where it comes from, how it is made and what the paper says of it."""

    file: str
    source: str
    golden: str | None
    make: Callable[[], Mechanism]
    numbers: dict[str, Any] = field(default_factory=dict)
    choice: str = ""

    def row(self) -> dict[str, Any]:
        """Return the row of the index."""
        row: dict[str, Any] = {"file": self.file, "source": self.source, "golden": self.golden, **self.numbers}
        return row | ({"choice": self.choice} if self.choice else {})


def entries_of(
    folder: str, source: str, paper: str
) -> Callable[[str, str, str, Callable[[], Mechanism], str, str], Entry]:
    """Return a maker of entries for one paper; numbers read ``"N 6 J 7 M 1"``."""

    def entry(
        name: str, where: str, golden: str, make: Callable[[], Mechanism], numbers: str, choice: str = ""
    ) -> Entry:
        words = numbers.split()
        parsed = {key: int(value) for key, value in zip(words[::2], words[1::2], strict=True)}
        suffix = "" if "." in name else ".json"
        return Entry(
            f"{folder}/{name}{suffix}",
            f"{source}, {where}",
            f"{paper}/{golden}" if golden else None,
            make,
            parsed,
            choice,
        )

    return entry
