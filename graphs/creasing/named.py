"""Joints of a sheet named by people: by the number of an edge, or as a pair of panels."""

from __future__ import annotations

from graphs.convert.duality import mechanism_of_sheet
from graphs.creasing.lines import edge_in_words
from graphs.edit.named import joint_named, known
from graphs.errors import InvariantError, shown
from graphs.mechanism.sheet import Sheet, with_all_edges

__all__ = ["joint_of_sheet_named"]


def joint_of_sheet_named(sheet: Sheet, name: str) -> int:
    """Return the joint of a sheet: by the number of any of its edges, or as the one between two panels.

    Parameters
    ----------
    sheet : Sheet
    name : str
        The number of an edge, such as ``"3"``, or two panels, such as ``"0,1"``.

    Returns
    -------
    int
        Id of the joint: the number of its first edge.

    Raises
    ------
    InvariantError
        If there is none; edges are told with their coordinates.

    Examples
    --------
    >>> strip = Sheet(4, ((0, 2), (0, 1)), "VB", ((0, 1, 2), (0, 2, 3)))
    >>> joint_of_sheet_named(strip, "0"), joint_of_sheet_named(strip, "0,1")
    (0, 0)
    >>> joint_of_sheet_named(strip, "1")
    Traceback (most recent call last):
    ...
    graphs.errors.InvariantError: edge 1 (B) from vertex 0 to vertex 1 is no joint; expected one of 0 [joint]
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
