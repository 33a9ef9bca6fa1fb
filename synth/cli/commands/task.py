"""``synth task``: from a task to types, with dimensions, ranked."""

from __future__ import annotations

from typing import Any

import click

import synth.tasks
from graphs.errors import InvariantError
from synth.cli import options
from synth.cli.output import about, check_output, print_result, tell_written


@click.command()
@click.argument("task", type=options.FILE_NAME)
@options.flag("--structure-only", "List the types and placements that can do it by structure, and design none.")
@options.flag("--new", "Ask questions, and write the task to TASK.")
@options.FORCE
@options.JSON
def task(task: str, structure_only: bool, new: bool, force: bool, as_json: bool) -> None:
    """Find all types that can do a task, with dimensions, ranked.

    TASK is a JSON file (docs/native-json.md): roles of bodies, requirements on the type, and wishes about their motion.
    All types of the sizes are listed, with the families that move although a generic realisation is rigid; those that
    cannot do it are counted by reasons. Roles are placed in all ways up to symmetries of the type.

    \b
    Examples:
      synth task --new lid.json
      synth task lid.json --structure-only

    Exit status 1: no design.
    """
    if new:
        check_output(task, force=force)
        document = _document_of_questions()
        synth.tasks.write_task(document, task, force=force)
        tell_written(task)
        return
    with about(task):
        print_result(synth.tasks.task(task), {"file": task}, as_json=as_json)


def _document_of_questions() -> dict[str, Any]:
    """Ask what a task needs; return its document."""
    document: dict[str, Any] = {"format": "synthedra/task", "version": 1}
    document["title"] = click.prompt("What is it", default="a task", err=True)
    roles = ["base", "output"]
    if click.confirm("Is a body driven (the input)?", default=False, err=True):
        roles.insert(1, "input")
    document["roles"] = roles
    document["degrees_of_freedom"] = click.prompt("Degrees of freedom", type=click.IntRange(1), default=1, err=True)
    least = click.prompt("Fewest links", type=click.IntRange(1), default=4, err=True)
    document["links"] = [least, click.prompt("Most links", type=click.IntRange(least), default=max(least, 6), err=True)]
    forms, systems = click.Choice(synth.tasks.FORMS), click.Choice(synth.tasks.SYSTEMS)
    document["form"] = click.prompt("Where it lies", type=forms, default="space", err=True)
    document["system"] = click.prompt("Kind of system", type=systems, default="any", err=True)
    wishes: list[dict[str, Any]] = []
    names: list[str] = []
    click.echo("Rotations of the output from its first pose, each a quaternion W,X,Y,Z; an empty line ends.", err=True)
    while word := click.prompt(f"Pose {len(names) + 2}", default="", show_default=False, err=True):
        numbers = _quaternion(word)
        names.append(f"pose {len(names) + 2}")
        wishes.append({"kind": "orientation", "at": names[-1], "link": "output", "quaternion": numbers})
    if wishes:
        document["wishes"] = {"configurations": [{"name": name} for name in names], "wishes": wishes}
    return document


def _quaternion(word: str) -> list[float]:
    try:
        numbers = [float(part) for part in word.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) != 4 or not any(numbers):
        raise InvariantError("pose", f"the quaternion {word}", "four numbers W,X,Y,Z that are not all 0")
    return numbers
