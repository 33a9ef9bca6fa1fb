"""Panels taken off a sheet: what is left keeps its numbers of vertices, and what was a crease there is a border.

Theory: docs/theory/edits.md.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from graphs.convert.duality import mechanism_of_sheet
from graphs.creasing.edits import SheetEdit
from graphs.errors import InvariantError, UnsolvableError
from graphs.mechanism.sheet import Sheet, sides_of_face, with_all_edges

__all__ = ["take_off_panels"]


def take_off_panels(sheet: Sheet, links: Collection[int]) -> SheetEdit:
    """Take panels off: all faces of some links, and the edges that are of no other face.

    Parameters
    ----------
    sheet : Sheet
    links : collection of int
        Numbers of the panels.

    Raises
    ------
    InvariantError
        If there is no such panel.
    UnsolvableError
        If no panel would be left.

    Examples
    --------
    >>> strip = Sheet(5, ((0, 2), (0, 3)), "VM", ((0, 1, 2), (0, 2, 3), (0, 3, 4)))
    >>> edit = take_off_panels(strip, {2})
    >>> edit.sheet.faces, edit.sheet.edges, edit.sheet.assignments
    (((0, 1, 2), (0, 2, 3)), ((0, 2), (0, 3), (0, 1), (1, 2), (2, 3)), 'VBBBB')
    """
    panels = mechanism_of_sheet(sheet).panels
    for link in links:
        if not 0 <= link < len(panels):
            expected = f"a number from 0 to {len(panels) - 1}"
            raise InvariantError("panel", f"{link} is no panel of the sheet", expected)
    gone = {face for link in links for face in panels[link]}
    if len(gone) == len(sheet.faces):
        raise UnsolvableError("no panel would be left")
    whole = with_all_edges(sheet)
    faces = tuple(face for number, face in enumerate(whole.faces) if number not in gone)
    beside: dict[frozenset[int], int] = {}
    for face in faces:
        for side in sides_of_face(face):
            beside[frozenset(side)] = beside.get(frozenset(side), 0) + 1
    kept = [number for number, edge in enumerate(whole.edges) if frozenset(edge) in beside]
    letters = (whole.assignments[number] if beside[frozenset(whole.edges[number])] > 1 else "B" for number in kept)
    angles = whole.fold_angles
    after = replace(
        whole,
        edges=tuple(whole.edges[number] for number in kept),
        assignments="".join(letters),
        faces=faces,
        fold_angles=None if angles is None else tuple(angles[number] for number in kept),
        frames=None,
    )
    return SheetEdit(f"take off panels {', '.join(map(str, sorted(links)))}", sheet, after)
