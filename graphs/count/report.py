"""The mobility report: the class of a mechanism, which equations apply, why the others do not, their values.

Source: Wiener 2016, Fig. 37 and Table 6; Wampler, Larson, Erdman 2007, Eqs. 5 to 10.
Theory: docs/theory/mobility-by-count.md.
"""

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Self

from graphs.count.applicability import EquationResult, equation_results, mechanism_class
from graphs.count.equations import mobility_of_model
from graphs.errors import numbered, shown
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sc import Arrangement, SCGraph, arrangement_of
from graphs.mechanism.scd import SCDGraph
from graphs.plain_data import plain_data

_MANY = 3  # centres that lie on one axis are in one line: of two that says nothing, of three it is a condition


@dataclass(frozen=True)
class MobilityReport:
    """Everything the counts say about the mobility of one mechanism.

    Attributes
    ----------
    mechanism_class : str
        ``spherical``, ``planar``, ``spherical system``, ``hybrid``, ``spatial``, ``closed`` (closed
        surfaces and concentric loops), or ``polyhedron model`` where only vertices and rods are known.
    links, joints, loops : int or None
        N, J, L (independent loops); None where the input does not distinguish them.
    centres : int
        Distinct centres: classes of loops, or remote centres of a polyhedron model.
    mobility : int or None
        Generic mobility by count; may be negative.
    equations : mapping of str to EquationResult
    counts : mapping of str to int
        Further counts: V, C, E_ext, E_int, spatial loops, parts, ... those that the input has.
    repairs, warnings : tuple of str
    arrangement : str or None
        How the centres are arranged (`graphs.mechanism.sc.ARRANGEMENTS`); None for a polyhedron model.

    Examples
    --------
    >>> report = mobility_report(SCGraph(4, [(0, 1), (1, 2), (2, 3)]))
    >>> report.mechanism_class, report.mobility, report.equations["loop_form"].value
    ('spatial', 3, 3)
    """

    mechanism_class: str
    links: int | None
    joints: int | None
    loops: int | None
    centres: int
    mobility: int | None
    equations: Mapping[str, EquationResult]
    counts: Mapping[str, int]
    repairs: tuple[str, ...] = ()
    warnings: tuple[str, ...] = field(default=())
    arrangement: Arrangement | None = None

    def with_notes(self, repairs: Iterable[str] = (), warnings: Iterable[str] = ()) -> Self:
        """Return the report with more repairs and warnings."""
        return replace(self, repairs=(*self.repairs, *repairs), warnings=(*self.warnings, *warnings))

    def to_json(self) -> dict[str, Any]:
        """Return the report as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        return {
            "class": self.mechanism_class,
            "links": self.links,
            "joints": self.joints,
            "loops": self.loops,
            "centres": self.centres,
            "arrangement": self.arrangement,
            "mobility": self.mobility,
            "equations": plain_data(self.equations),
            "counts": dict(self.counts),
            "repairs": list(self.repairs),
            "warnings": list(self.warnings),
        }


def mobility_report(mechanism: SCGraph | PolyhedronModel) -> MobilityReport:
    """Report the mobility of a mechanism by count.

    Parameters
    ----------
    mechanism : SCGraph, SCDGraph or PolyhedronModel

    Examples
    --------
    >>> from graphs.convert.panels import scd_from_panels
    >>> report = mobility_report(scd_from_panels([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)]))
    >>> report.mechanism_class, report.mobility, report.equations["polyhedron"].value
    ('spherical', 1, 1)
    """
    if isinstance(mechanism, PolyhedronModel):
        return _report_of_model(mechanism)
    kind = mechanism_class(mechanism)
    closed = mechanism.is_closed
    results = equation_results(mechanism)
    mobility = results["closed_surface" if closed else "loop_form"].value
    negative = "the count is negative: a generic realisation is rigid, and one that moves has special geometry"
    return MobilityReport(
        mechanism_class=kind,
        links=len(mechanism),
        joints=len(mechanism.joints),
        loops=mechanism.independent_loops,
        centres=len(mechanism.centre_classes()),
        mobility=mobility,
        equations=results,
        counts=_counts(mechanism),
        warnings=(*_warnings(mechanism), *([negative] if mobility is not None and mobility < 0 else [])),
        arrangement=arrangement_of(mechanism),
    )


def _counts(sc: SCGraph) -> dict[str, int]:
    counts = {
        "parts": sc.components,
        "flaps": sum(degree == 1 for _, degree in sc.degree),
        "centred_loops": len(sc.centred_loops),
        "spatial_loops": sc.spatial_loops,
        "closing_loops": len(sc.closing),
    }
    if isinstance(sc, SCDGraph):
        names = ("vertices", "implicit_centres", "external_edges", "internal_edges", "open_edges")
        counts |= {name: getattr(sc.counts, name) for name in names}
    return counts


def _warnings(sc: SCGraph) -> Iterable[str]:
    if sc.components > 1:
        yield (
            f"{sc.components} parts that are not joined: their relative motion, "
            f"{6 * (sc.components - 1)} more degrees of freedom, is not counted"
        )
    groups = sc.parallel_joints()
    if groups:
        names = shown(" ".join(str(joint) for joint in groups[0]))
        more = f" (and {len(groups) - 1} more pairs of links)" if len(groups) > 1 else ""
        yield f"joints {names}{more} join the same two links: rigid, unless they are collinear"
    pairs = sum(len(loop.joints) == 2 and loop.has_centre for loop in (*sc.loops, *sc.closing))
    if pairs:
        two = f"{numbered(pairs, 'loop')} of two joints constrain{'s' * (pairs == 1)} 2 degrees of freedom"
        yield f"{two}, not 3 (1 if collinear): the count is low"
    through = Counter(joint for one in sc.centre_classes() for joint in one.joints)
    lined_up = [joint for joint, number in through.items() if number >= _MANY]
    if lined_up:
        yield f"joint {shown(lined_up[0])} passes through three centres or more: these must be collinear"


def _report_of_model(model: PolyhedronModel) -> MobilityReport:
    remote = [centre.k for centre in model.centres]
    return MobilityReport(
        mechanism_class="polyhedron model",
        links=len(model.links) or None,
        joints=None,
        loops=None,
        centres=len(remote),
        mobility=mobility_of_model(model),
        equations=equation_results(model),
        counts={
            "vertices": model.free_vertices,
            "edges": model.counted_rods,
            "on_plane": len(model.on_plane),
            "on_line": len(model.on_line),
            "scissors": len(model.scissors),
            "remote": sum(remote),
        },
    )
