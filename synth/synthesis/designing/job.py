"""The starts of a search for designs as units of the runner: so a run can be stopped, kept in a store, continued.

A row holds what a start gave; designs are made of rows again when they are compared.
"""

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from functools import cached_property
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np

from enumerate.runner.job import Column, Row, Unit
from synth.synthesis.designing.defects import kinds_of
from synth.synthesis.designing.designs import MET_DIGITS, SPREAD, STARTS, Design, DesignSearch
from synth.synthesis.designing.problem import reweighed
from synth.synthesis.designing.wish_files import read_wishes

START_WEIGHT = 40_000
"""Weight of a start as a unit: about a second of a list of chains, as starts take."""

COLUMNS: dict[str, Column] = {
    "start": int, "success": bool, "miss": float, "residual": float, "freedoms": int, "defects": str, "record": str,
}  # fmt: skip
"""Values of a row; `defects` are the values of their kinds, and `record` is the rest of the design as JSON."""


@dataclass(frozen=True)
class DesignJob:
    """A search for designs: a file of a mechanism or the name of a generator, a file of wishes, and the starts.

    `frozen` and `weights` change wishes by their numbers, from 0; `begun` are numbers of designs to begin with.

    Examples
    --------
    >>> job = DesignJob("bennett", "wishes.json", starts=3)
    >>> [unit.payload for unit in job.units()]
    [0, 1, 2]
    """

    mechanism: str
    wishes: str
    starts: int = STARTS
    spread: float = SPREAD
    seed: int = 0
    frozen: tuple[int, ...] = ()
    weights: tuple[tuple[int, float], ...] = ()
    begun: tuple[tuple[float, ...], ...] = ()
    columns = COLUMNS

    def __getstate__(self) -> dict[str, Any]:
        """Return the state for a worker: without the search, which each makes itself."""
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @property
    def key(self) -> dict[str, Any]:
        """The identity of the job: digests of both files, and the options but the number of starts."""
        digests = {}
        for name in ("mechanism", "wishes"):
            path = Path(getattr(self, name))
            content = path.read_bytes() if path.is_file() else getattr(self, name).encode()
            digests[name] = sha256(content).hexdigest()
        key = {"design": digests, "starts": self.starts, "spread": self.spread, "seed": self.seed}
        changes = {"frozen": list(self.frozen), "weights": [list(pair) for pair in self.weights]}
        if self.begun:
            changes["begun"] = [sha256(json.dumps(self.begun).encode()).hexdigest()]
        return {**key, **{name: value for name, value in changes.items() if value}}

    @cached_property
    def search(self) -> DesignSearch:
        """The search, its files read."""
        wishes = reweighed(read_wishes(self.wishes), self.frozen, dict(self.weights))
        beginnings = [np.array(numbers) for numbers in self.begun]
        return DesignSearch(self.mechanism, wishes, self.spread, self.seed, beginnings)

    def units(self) -> list[Unit]:
        """One unit for each start."""
        return [Unit(start, START_WEIGHT) for start in range(self.starts)]

    def work(self, payload: int) -> list[Row]:
        """Return the row of a start; none where its numbers make no mechanism."""
        one = self.search.design(payload)
        if one is None:
            return []
        record = json.dumps(one.record(), separators=(",", ":"))
        return [(one.start, one.success, one.miss, one.error, one.freedoms, kinds_of(one.defects), record)]

    @staticmethod
    def numbers(rows: Iterable[Mapping[str, Any]]) -> tuple[tuple[float, ...], ...]:
        """Return the numbers of the designs of rows, successes first, nearest to their wishes first."""
        ranked = sorted(rows, key=lambda row: (not row["success"], round(row["miss"], MET_DIGITS), row["start"]))
        return tuple(tuple(json.loads(row["record"])["numbers"]) for row in ranked)

    def designs(self, rows: Iterable[Mapping[str, Any]]) -> list[Design]:
        """Return the designs of rows."""
        return [self.search.of_record(row["start"], json.loads(row["record"])) for row in rows]
