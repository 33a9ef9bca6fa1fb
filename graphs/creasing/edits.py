"""Edits of sheets: a pattern edited is a pattern. Theory: docs/theory/edits.md.

Vertices keep their numbers, and edges theirs, except where a crease is removed or panels are taken off. New
ones come last.
"""

from collections import Counter
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from graphs.convert.duality import mechanism_of_sheet
from graphs.count.equations import relative_spherical_system
from graphs.creasing.lines import creased_along, edge_in_words
from graphs.edit.edits import Edit
from graphs.edit.named import joint_named, known
from graphs.errors import InvariantError, UnsolvableError, shown
from graphs.mechanism.sheet import HINGES, Sheet, sides_of_face, with_all_edges


@dataclass(frozen=True)
class SheetEdit:
    """A sheet before and after an edit.

    Attributes
    ----------
    what : str
        The edit in words.
    before, sheet : Sheet
        The pattern before and after.

    Examples
    --------
    >>> edit = lock_crease(Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3))), 0)
    >>> edit.what, edit.predicted
    ('lock crease 0', -1)
    """

    what: str
    before: Sheet
    sheet: Sheet
    equation = "Eq. 6"
    """The equation that predicts the change of mobility."""

    @cached_property
    def of_mechanism(self) -> Edit:
        """The edit of the mechanism, whose loops all have centres: Eq. 6."""
        before, after = (mechanism_of_sheet(sheet).sc for sheet in (self.before, self.sheet))
        predicted = relative_spherical_system(len(after) - len(before), len(after.joints) - len(before.joints))
        return Edit(self.what, before, after, predicted, self.equation)

    @property
    def predicted(self) -> int:
        """The change of mobility by the numbers of links and joints."""
        return self.of_mechanism.predicted

    @property
    def counted(self) -> int:
        """The change of mobility as the difference of the two counts."""
        return self.of_mechanism.counted

    def to_json(self) -> dict[str, Any]:
        """Return the edit as plain data."""
        return self.of_mechanism.to_json()


def lock_crease(sheet: Sheet, joint: int) -> SheetEdit:
    """Lock a crease: all pieces of the joint become flat (F), so that its two panels are one.

    Parameters
    ----------
    sheet : Sheet
    joint : int
        Its id, the number of an edge; InvariantError if there is no such joint.

    Examples
    --------
    >>> edit = lock_crease(Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3))), 0)
    >>> edit.sheet.assignments[0], edit.predicted, edit.counted
    ('F', -1, -1)
    """
    whole, pieces = _pieces(sheet, joint)
    letters = "".join(
        "F" if frozenset(edge) in pieces else letter
        for edge, letter in zip(whole.edges, whole.assignments, strict=True)
    )
    return SheetEdit(f"lock crease {joint}", sheet, replace(whole, assignments=letters, frames=None))


def crease_sheet(
    sheet: Sheet, start: int | Sequence[float], end: int | Sequence[float], letter: str = "U"
) -> SheetEdit:
    """Crease a sheet along a straight line between two vertices or points.

    Parameters
    ----------
    sheet : Sheet
    start, end : int or (x, y)
        Vertices, or points on edges, which get a vertex there; else InvariantError. Of a flat sheet the line may
        cross edges; UnsolvableError if it leaves the sheet, or there are creases all along it.
    letter : {"U", "M", "V"}, optional
        Assignment of the crease. Flat edges along the line become creases, creases stay.

    Examples
    --------
    >>> square = Sheet(4, (), "", ((0, 1, 2, 3),), ((0, 0), (1, 0), (1, 1), (0, 1)))
    >>> edit = crease_sheet(square, (0.5, 0), (0.5, 1))
    >>> edit.sheet.faces, edit.predicted, edit.counted
    (((4, 1, 2, 5), (5, 3, 0, 4)), 1, 1)
    """
    if letter not in HINGES:
        raise InvariantError("crease", f"the assignment {letter!r}", "one of " + " ".join(HINGES))
    after, (a, b) = creased_along(with_all_edges(sheet), start, end, letter)
    return SheetEdit(f"crease from vertex {a} to vertex {b}", sheet, replace(after, frames=None))


def remove_crease(sheet: Sheet, joint: int) -> SheetEdit:
    """Remove a crease with all its pieces: the faces beside it become one. Edges after it move up.

    Parameters
    ----------
    sheet : Sheet
    joint : int
        Its id, the number of an edge: InvariantError if it is none; UnsolvableError if the faces meet in other
        edges too, so that they would not make a simple face.

    Examples
    --------
    >>> edit = remove_crease(Sheet(4, ((0, 2),), "V", ((0, 1, 2), (0, 2, 3))), 0)
    >>> edit.sheet.faces, edit.counted
    (((0, 1, 2, 3),), -1)
    """
    whole, pieces = _pieces(sheet, joint)
    faces = list(whole.faces)
    left = set(pieces)
    while left:
        piece = min(left, key=sorted)
        first, second = (i for i, face in enumerate(faces) if piece in map(frozenset, sides_of_face(face)))
        between = left & set(map(frozenset, sides_of_face(faces[first])))
        between &= set(map(frozenset, sides_of_face(faces[second])))
        faces[first] = _merged(faces[first], faces[second], between, joint)
        del faces[second]
        left -= between
    kept = [i for i, edge in enumerate(whole.edges) if frozenset(edge) not in pieces]
    after = _with_faces(whole, faces, kept, (whole.assignments[i] for i in kept))
    return SheetEdit(f"remove crease {joint}", sheet, after)


def _with_faces(whole: Sheet, faces: Iterable[tuple[int, ...]], kept: list[int], letters: Iterable[str]) -> Sheet:
    """Return a sheet with other faces, some of its edges, by their numbers, and their assignments."""
    angles = whole.fold_angles
    return replace(
        whole,
        edges=tuple(whole.edges[i] for i in kept),
        assignments="".join(letters),
        faces=tuple(faces),
        fold_angles=None if angles is None else tuple(angles[i] for i in kept),
        frames=None,
    )


def _pieces(sheet: Sheet, joint: int) -> tuple[Sheet, set[frozenset[int]]]:
    """Return the sheet with all its edges listed, and the edges that make up a joint."""
    mechanism = mechanism_of_sheet(sheet)
    if joint not in mechanism.pieces:
        expected = "the number of a crease between two panels"
        raise InvariantError("crease", f"{joint} is no joint of the sheet", expected)
    return with_all_edges(sheet), {frozenset(edge) for edge in mechanism.pieces[joint]}


def _merged(
    first: Sequence[int], second: Sequence[int], between: Collection[frozenset[int]], joint: int
) -> tuple[int, ...]:
    """Return the face that two make without the edges between them."""
    sides = [side for side in sides_of_face(first) if frozenset(side) not in between]
    shared = next(side for side in sides_of_face(first) if frozenset(side) in between)
    if shared in sides_of_face(second):  # they are walked round in opposite senses
        second = tuple(reversed(second))
    sides += [side for side in sides_of_face(second) if frozenset(side) not in between]
    following: dict[int, int] = dict(sides)
    around = [sides[0][0]] if sides else []
    while around and following[around[-1]] != around[0] and len(around) <= len(sides):
        around.append(following[around[-1]])
    if len(around) != len(sides) or len(following) != len(sides):
        wrong = "the faces beside it meet in other edges too, and would surround them"
        raise UnsolvableError(f"crease {joint} cannot be removed: {wrong}")
    return tuple(around)


def take_off_panels(sheet: Sheet, links: Collection[int]) -> SheetEdit:
    """Take panels off: all faces of some links, and the edges that are of no other face.

    Parameters
    ----------
    sheet : Sheet
    links : collection of int
        Numbers of the panels: InvariantError if one is none; UnsolvableError if no panel would be left.

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
    faces = [face for number, face in enumerate(whole.faces) if number not in gone]
    beside = Counter(frozenset(side) for face in faces for side in sides_of_face(face))
    kept = [i for i, edge in enumerate(whole.edges) if frozenset(edge) in beside]
    letters = (whole.assignments[i] if beside[frozenset(whole.edges[i])] > 1 else "B" for i in kept)
    after = _with_faces(whole, faces, kept, letters)
    return SheetEdit(f"take off panels {', '.join(map(str, sorted(links)))}", sheet, after)


def joint_of_sheet_named(sheet: Sheet, name: str) -> int:
    """Return the joint of a sheet, the number of its first edge: by any of its edges, or by its two panels.

    Parameters
    ----------
    sheet : Sheet
    name : str
        The number of an edge, such as ``"3"``, or two panels, such as ``"0,1"``; else InvariantError, with the
        coordinates of edges.

    Examples
    --------
    >>> strip = Sheet(4, ((0, 2), (0, 1)), "VB", ((0, 1, 2), (0, 2, 3)))
    >>> joint_of_sheet_named(strip, "0"), joint_of_sheet_named(strip, "0,1")
    (0, 0)
    """
    mechanism = mechanism_of_sheet(sheet)
    if "," in name:
        return int(str(joint_named(mechanism.sc, name)))
    whole = with_all_edges(sheet)
    number = int(name) if name.isascii() and name.isdigit() and len(name) < 10 else len(whole.edges)
    if number >= len(whole.edges):
        raise InvariantError("edge", f"{shown(name)} is no edge", known(mechanism.sc.joints, name))
    ends = frozenset(whole.edges[number])
    for joint, pieces in mechanism.pieces.items():
        if ends in map(frozenset, pieces):
            return joint
    words = edge_in_words(whole, number)
    raise InvariantError("joint", f"{words} is no joint", known(mechanism.sc.joints, name))
