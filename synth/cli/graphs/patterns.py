"""The edits of ``synth edit`` that are made to a crease pattern itself."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import click

from synth.cli.output import plain

if TYPE_CHECKING:
    from graphs.creasing.edits import SheetEdit
    from graphs.mechanism.sheet import Sheet

__all__ = ["pattern_edits"]


def pattern_edits(
    sheet: Sheet, wanted: dict[str, tuple[str, ...]], branch: int | str | None = None
) -> Iterator[SheetEdit]:
    """Yield the edits of a pattern: assigned as a branch, creases locked, added, removed, each to the last result.

    Edges keep their numbers until creases are removed; those are named before.
    """
    from graphs.creasing.edits import crease_sheet, joint_of_sheet_named, lock_crease, remove_crease
    from graphs.mechanism.sheet import with_all_edges

    if branch is not None:
        from synth.folding.assigned import assign_branch

        edit = assign_branch(sheet, branch)
        sheet = edit.sheet
        yield edit
    for text in wanted["lock"]:
        edit = lock_crease(sheet, joint_of_sheet_named(sheet, text))
        sheet = edit.sheet
        yield edit
    for text in wanted["add_crease"]:
        edit = crease_sheet(sheet, *_ends(text))
        sheet = edit.sheet
        yield edit
    whole = with_all_edges(sheet)
    leaving = [whole.edges[joint_of_sheet_named(sheet, text)] for text in wanted["remove_crease"]]
    for ends in leaving:
        number = next((i for i, edge in enumerate(with_all_edges(sheet).edges) if set(edge) == set(ends)), -1)
        edit = remove_crease(sheet, joint_of_sheet_named(sheet, str(number)))
        sheet = edit.sheet
        yield edit


def _ends(text: str) -> tuple[int | tuple[float, ...], int | tuple[float, ...]]:
    """Read ``A:B``, each a vertex, or a point ``X,Y``."""
    words = text.split(":")
    if len(words) != 2:
        raise click.BadParameter(
            f"{plain(text)!r} is not A:B, two vertices or points X,Y of the pattern", param_hint="--add-crease"
        )
    return _end(words[0].strip()), _end(words[1].strip())


def _end(word: str) -> int | tuple[float, ...]:
    if word.isascii() and word.isdigit() and len(word) < 10:
        return int(word)
    try:
        point = tuple(float(part) for part in word.split(","))
    except ValueError:
        point = ()
    if len(point) not in (2, 3) or not all(abs(x) < 1e12 for x in point):
        raise click.BadParameter(f"{plain(word)!r} is neither a vertex nor a point X,Y", param_hint="--add-crease")
    return point
