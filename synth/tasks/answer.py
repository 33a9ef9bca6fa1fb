"""`task` is what `synth task` calls: from a task to types, or to designs, ranked."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from synth.tasks.record import Task
from synth.tasks.structure import TaskStructure, structure_of
from synth.tasks.task_files import read_task, task_of_document

TaskLike = Task | str | Path | Mapping[str, Any]
"""A task, its file, or the document of a file."""


def task(asked: TaskLike) -> TaskStructure:
    """Find the types that can do a task.

    Parameters
    ----------
    asked : Task, str, Path or mapping
        The task, its file (docs/native-json.md), or the document of a file.

    Returns
    -------
    TaskStructure

    Raises
    ------
    FileError
        If the file cannot be read, or the task contradicts itself.
    InvariantError
        If no type meets all requirements.

    Examples
    --------
    >>> task({"format": "synthedra/task", "version": 1, "links": [4, 6]}).admitted
    202
    """
    return structure_of(task_from(asked))


def task_from(asked: TaskLike) -> Task:
    """Return a task, whatever stands for it."""
    if isinstance(asked, Task):
        return asked
    return task_of_document(asked, Path("task")) if isinstance(asked, Mapping) else read_task(asked)
