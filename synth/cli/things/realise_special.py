"""``synth realise --freedoms K``: members of special geometry of a type, looked for."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import click

from synth.cli.output import about, check_output, print_answer, print_json, tell_written
from synth.cli.things.given import given

if TYPE_CHECKING:
    from synth.realisation.special.search import SpecialSearch

__all__ = ["SpecialOutput", "refuse_others", "search_special_geometry"]


@dataclass(frozen=True, slots=True)
class SpecialOutput:
    """Where a member goes, and the type with its mark; how the answer is printed."""

    member: str | None
    mark: str | None
    force: bool
    as_json: bool


def refuse_others(given: bool, message: str) -> None:
    """Raise click.UsageError if options are given that do not go together."""
    if given:
        raise click.UsageError(message)


def search_special_geometry(file: str, search: dict[str, Any], output: SpecialOutput) -> None:
    """Look for members that move, print and write them; exit status 1 if none was found.

    The search has the options of `synth.realise`.
    """
    from synth.drawing.catalogue.entries import is_catalogue
    from synth.realisation.realised import realise

    if is_catalogue(file):
        raise click.UsageError("--freedoms is for one type at a time")
    for path in (output.member, output.mark):
        check_output(path, force=output.force)
    with about(file):
        thing: Any = given(file).thing
        found = realise(thing, **search)
    written = _written(found, output) if found.members else []
    if output.as_json:
        print_json({"file": file, "output": written[0] if output.member and written else None, **found.to_json()})
    else:
        print_answer(found)
        tell_written(*written)
    if not found.members:
        sys.exit(1)


def _written(found: SpecialSearch, output: SpecialOutput) -> list[str]:
    """Write the first member, and the type with its mark, where they are asked for; return the names."""
    from graphs.files.formats import write

    names = []
    if output.member is not None:
        write(found.members[0].mechanism, output.member, force=output.force)
        names.append(output.member)
    if output.mark is not None:
        write(found.type_with_mark, output.mark, force=output.force)
        names.append(output.mark)
    return names
