"""A mechanism in another form: converted by the names of kinds and forms, or reconstructed vertex by vertex.

The roads from kind to kind are in :mod:`graphs.convert.conversions`. A reconstruction is the polyhedron model of a
mechanism, with its counts; source: Wiener 2016, section 3.4.4. Theory: docs/theory/polyhedron-model.md.
"""

from dataclasses import asdict, dataclass
from typing import Any

from graphs.convert.conversions import CONVERSIONS, FORMS, Mechanism, graph_of, to_polyhedron, to_scd
from graphs.convert.panels import VertexStep, vertex_steps
from graphs.count.equations import mobility_of_model
from graphs.errors import InvariantError, numbered, shown
from graphs.files.mechanism_like import MechanismLike, mechanism_for
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.scd import FeatureCounts
from graphs.printing import Block, Printed, TableBlock, plain


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


_TOLD = ("vertices", "implicit_centres", "external_edges", "internal_edges")


@dataclass(frozen=True, slots=True, repr=False)
class Reconstruction(Printed):
    """A polyhedron model, and the steps of its reconstruction.

    Attributes
    ----------
    model : PolyhedronModel
    steps : tuple of VertexStep
        Vertex by vertex: in what kind of face it lies, and which links meet there.
    counts : FeatureCounts
        V, C, E_ext, E_int of the SCD graph.
    """

    model: PolyhedronModel
    steps: tuple[VertexStep, ...]
    counts: FeatureCounts

    @property
    def mobility(self) -> int:
        """M of the model by count (Wampler, Larson, Erdman 2007, Eq. 9)."""
        return mobility_of_model(self.model)

    def to_json(self) -> dict[str, Any]:
        """Return the reconstruction as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        counts = asdict(self.counts)
        return {
            "vertices": [
                {"vertex": step.vertex, "in": step.kind.value, "links": list(step.links)} for step in self.steps
            ],
            "counts": {key: counts[key] for key in _TOLD},
            "mobility": self.mobility,
        }

    def blocks(self) -> list[Block]:
        """Return the table and the line that are printed."""
        rows = [
            (
                str(step.vertex),
                "explicit centre" if step.kind.value == "explicit" else f"{step.kind.value} face",
                ", ".join(plain(link) for link in step.links),
            )
            for step in self.steps
        ]
        counts = self.counts
        return [
            TableBlock(("vertex", "lies in", "links that meet there"), rows, ["vertex"]),
            f"V = {counts.vertices}, C = {counts.implicit_centres}, E = {counts.external_edges} external "
            f"+ {counts.internal_edges} internal, M = {self.mobility}",
        ]

    def __repr__(self) -> str:
        return f"<Reconstruction: {numbered(len(self.model), 'vertex', 'vertices')}, M = {self.mobility}>"


def reconstruct(mechanism: MechanismLike) -> Reconstruction:
    """Reconstruct the polyhedron model of a mechanism, vertex by vertex.

    Parameters
    ----------
    mechanism : Mechanism, str or Path
        An SCD graph, a sheet of plain panels, or a polyhedron model that knows its links. The coordinates of a
        sheet go with it.

    Raises
    ------
    UnsolvableError
        If the sides of the links are not known.

    Examples
    --------
    >>> from graphs.convert.panels import scd_from_panels
    >>> reconstruct(scd_from_panels([("o", "a", "b"), ("o", "b", "c"), ("o", "c", "a")]))
    <Reconstruction: 4 vertices, M = 0>
    """
    mechanism = mechanism_for("reconstruct", mechanism)
    scd = to_scd(mechanism)
    return Reconstruction(to_polyhedron(mechanism), tuple(vertex_steps(scd)), scd.counts)
