"""Conversions that may have to list: an SC graph as its only SCD graph. The others: `graphs.answer.conversion`."""

from graphs.answer.conversion import convert as converted
from graphs.convert.conversions import Mechanism, graph_of
from graphs.errors import InvariantError, shown
from graphs.files.mechanism_like import MechanismLike, mechanism_for
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Sheet

__all__ = ["convert"]

_WITH_SIDES = ("scd", "polyhedron", "sheet")
"""Kinds that hold the order of the sides of the links."""


def convert(
    mechanism: MechanismLike, kind: str | None = None, *, form: str | None = None, max_degree: int | None = None
) -> Mechanism:
    """Convert a mechanism to another kind, or change its centres, or both in this order.

    Parameters
    ----------
    mechanism : Mechanism, str or Path
    kind : {"sc", "scd", "polyhedron", "vertex-edge", "sheet", "solids", "joints"}, optional
        "solids": revolutes with axes, chains of them for joints of other kinds; "joints": such chains recognised
        as the joints that they stand for.
    form : {"planar", "spherical", "general"}, optional
        Planar analogue, spherical analogue, or most general form of the SC graph.
    max_degree : int, optional
        Where the sides of the links are not known, take the SCD graph whose links have no more sides, if it is the
        only one; for the kinds "scd", "polyhedron" and "sheet".

    Raises
    ------
    InvariantError
        If a name is not known, or `max_degree` is stated for another kind.
    UnsolvableError
        If there is no road to that kind, or not just one SCD graph with so few sides.

    Examples
    --------
    >>> from graphs.convert.panels import scd_from_panels
    >>> fan = scd_from_panels([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)])
    >>> convert(fan, "polyhedron")
    <PolyhedronModel: 5 vertices, 8 rods>
    >>> convert(fan.sc_graph(), "polyhedron", max_degree=3)
    <PolyhedronModel: 5 vertices, 8 rods>
    """
    if max_degree is None:
        return converted(mechanism, kind, form=form)
    if kind not in _WITH_SIDES:
        stated = "no kind" if kind is None else f"the kind {shown(kind)}"
        raise InvariantError(
            "max_degree", f"a largest number of sides for {stated}", "one of " + ", ".join(_WITH_SIDES)
        )
    known = mechanism_for("convert", mechanism)
    if not isinstance(known, SCDGraph | Sheet | PolyhedronModel):
        from enumerate.scd.only import only_scd_graph  # its kernels load numpy and, where there is machine code, numba

        known = only_scd_graph(graph_of(known), max_degree)
    return converted(known, kind, form=form)
