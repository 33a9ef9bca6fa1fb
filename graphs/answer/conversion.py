"""A mechanism converted by the names of kinds and forms. The roads are in :mod:`graphs.convert.table`."""

from graphs.convert.table import CONVERSIONS, FORMS, Mechanism, graph_of
from graphs.errors import InvariantError, shown
from graphs.files.accepted import MechanismLike, mechanism_for


def convert(mechanism: MechanismLike, kind: str | None = None, *, form: str | None = None) -> Mechanism:
    """Convert a mechanism to another kind, or change its centres, or both in this order.

    Parameters
    ----------
    mechanism : Mechanism, str or Path
    kind : {"sc", "scd", "polyhedron", "vertex-edge", "sheet", "solids", "joints"}, optional
        "solids": revolutes with axes, chains of them for joints of other kinds; "joints": such chains recognised
        as the joints that they stand for.
    form : {"planar", "spherical", "general"}, optional
        Planar analogue, spherical analogue, or most general form of the SC graph.

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
    mechanism = mechanism_for("convert", mechanism)
    for name, what, known in ((kind, "kind", tuple(CONVERSIONS)), (form, "form", tuple(FORMS))):
        if name is not None and name not in known:
            raise InvariantError(what, f"the {what} {shown(name)}", "one of " + ", ".join(known))
    if kind is not None:
        mechanism = CONVERSIONS[kind](mechanism)
    return mechanism if form is None else FORMS[form](graph_of(mechanism))
