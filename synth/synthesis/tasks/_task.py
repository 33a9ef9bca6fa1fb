"""`task` is what `synth task` calls: from a task to types, or to designs, ranked."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Literal, overload

from enumerate.runner.job import Progress
from graphs.errors import InvariantError, numbered
from synth.synthesis.tasks.dimensioning import HALVING, halved, opened_store
from synth.synthesis.tasks.ranking import RankedTypes, ranked_types
from synth.synthesis.tasks.record import Task
from synth.synthesis.tasks.structure import TaskStructure, structure_of
from synth.synthesis.tasks.task_files import read_task, task_of_document

TaskLike = Task | str | Path | Mapping[str, object]
"""A task, its file, or the document of a file."""


@overload
def task(asked: TaskLike, *, structure_only: Literal[True]) -> TaskStructure: ...


@overload
def task(
    asked: TaskLike,
    *,
    structure_only: Literal[False] = False,
    starts: int = ...,
    rounds: int = ...,
    seed: int = ...,
    weights: Mapping[int, float] | None = ...,
    store: str | Path | None = ...,
    resume: bool = ...,
    force: bool = ...,
    workers: int = ...,
    scheduler: str | None = ...,
    report: Callable[[int, Progress], None] | None = ...,
) -> RankedTypes: ...


def task(
    asked: TaskLike,
    *,
    structure_only: bool = False,
    starts: int = HALVING.starts,
    rounds: int = HALVING.rounds,
    seed: int = 0,
    weights: Mapping[int, float] | None = None,
    store: str | Path | None = None,
    resume: bool = False,
    force: bool = False,
    workers: int = 1,
    scheduler: str | None = None,
    report: Callable[[int, Progress], None] | None = None,
) -> TaskStructure | RankedTypes:
    """Find the types that can do a task, with dimensions, ranked.

    Parameters
    ----------
    asked : Task, str, Path or mapping
        The task, its file (docs/native-json.md), or the document of a file.
    structure_only : bool, optional
        List the types and placements that can do it by structure, and design none.
    starts : int, optional
        Starts of each type and placement in the first round; each further round has twice as many for half of them.
    rounds : int, optional
    seed : int, optional
        Another seed gives other starts.
    weights : mapping of int to float, optional
        Weights of wishes by their numbers, from 0, by which designs are ranked.
    store : str or Path, optional
        A folder that keeps the designs, from which a stopped run is continued, and which is asked again with other
        weights.
    resume : bool, optional
        Whether to go on with the store.
    force : bool, optional
        Whether to remove the designs of a store that is there and is not to be resumed.
    workers : int, optional
        Processes.
    scheduler : str, optional
        Address of a Dask scheduler; needs a store.
    report : callable, optional
        With a store: called with the number of a round and its progress.

    Returns
    -------
    TaskStructure or RankedTypes

    Raises
    ------
    FileError
        If the file cannot be read, or the task contradicts itself.
    InvariantError
        If no type meets all requirements, the task has no wishes, or there is no wish of a number.
    StoreError
        If the store is of another task, or is there and neither to be resumed nor removed.

    Examples
    --------
    >>> task({"format": "synthedra/task", "version": 1, "types": ["sc"]}, structure_only=True).admitted
    29
    >>> answer = task("data/tasks/lid.json", starts=2, rounds=1)
    >>> answer.name(answer.best), answer.best.candidate.links
    ('four-bar', (0, 3))
    """
    wanted = task_from(asked)
    if structure_only:
        return structure_of(wanted)
    if wanted.wishes is None:
        raise InvariantError("wishes", "a task without wishes", "wishes, or a list of types: structure_only")
    wishes = len(wanted.wishes["wishes"])
    for number in weights or ():
        if not 0 <= number < wishes:
            raise InvariantError("weights", f"there is no wish {number + 1}", f"1 to {wishes}")
    if scheduler is not None and store is None:
        raise InvariantError("scheduler", "a scheduler without a store", "a store")
    if starts < 1 or rounds < 1:
        what = f"{numbered(starts, 'start')} in {numbered(rounds, 'round')}"
        raise InvariantError("starts", what, "1 or more of each")
    structure = structure_of(wanted)
    folder = None if store is None else opened_store(Path(store), resume=resume, force=force)
    rows = halved(
        structure, starts=starts, rounds=rounds, seed=seed, workers=workers, store=folder, resume=resume,
        scheduler=scheduler, report=report,
    )  # fmt: skip
    return ranked_types(structure, rows, weights, seed)


def task_from(asked: TaskLike) -> Task:
    """Return a task, whatever stands for it."""
    if isinstance(asked, Task):
        return asked
    return task_of_document(asked, Path("task")) if isinstance(asked, Mapping) else read_task(asked)
