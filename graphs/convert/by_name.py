"""A mechanism converted by the names of kinds and of forms, as the command line and the front door ask for it."""

from __future__ import annotations

from graphs.convert.table import CONVERSIONS, Mechanism, graph_of
from graphs.edit.analogues import generalised_form, planar_analogue, spherical_analogue
from graphs.errors import InvariantError, check_argument, shown

__all__ = ["FORMS", "convert"]

FORMS = {"planar": planar_analogue, "spherical": spherical_analogue, "general": generalised_form}
"""Name of a form to the function that changes the centres."""


def convert(mechanism: Mechanism, kind: str | None = None, *, form: str | None = None) -> Mechanism:
    """Convert a mechanism to another kind, or change its centres, or both in this order.

    Parameters
    ----------
    mechanism : SCGraph, SCDGraph, PolyhedronModel, VertexEdgeGraph, Sheet, SurfaceLinkage, HingedSolids, ...
    kind : {"sc", "scd", "polyhedron", "vertex-edge", "sheet", "solids", "joints"}, optional
        "solids": revolutes with axes, those that stand for joints of other kinds; "joints": such chains seen as
        the joints that they are.
    form : {"planar", "spherical", "general"}, optional
        Planar analogue, spherical analogue, or most general form; of its SC graph.

    Raises
    ------
    InvariantError
        If a name is not known.
    UnsolvableError
        If there is no road to that kind.

    Examples
    --------
    >>> from graphs.convert.panels import scd_from_panels
    >>> fan = scd_from_panels([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)])
    >>> convert(fan, "polyhedron")
    <PolyhedronModel: 5 vertices, 8 rods>
    >>> convert(fan, "sc", form="planar").loops[0].centre
    <Centre.INFINITE: 'infinite'>
    """
    check_argument("convert", mechanism, Mechanism)
    for name, what, known in ((kind, "kind", tuple(CONVERSIONS)), (form, "form", tuple(FORMS))):
        if name is not None and name not in known:
            raise InvariantError(what, f"the {what} {shown(name)}", "one of " + ", ".join(known))
    if kind is not None:
        mechanism = CONVERSIONS[kind](mechanism)
    if form is None:
        return mechanism
    return FORMS[form](graph_of(mechanism))
