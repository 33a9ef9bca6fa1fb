"""The mobility report: the class of a mechanism, which equations apply, why the others do not, their values.

Source: Wiener 2016, Fig. 37 and Table 6; Wampler, Larson, Erdman 2007, Eqs. 5 to 10.
Theory: docs/theory/mobility-by-count.md.
"""

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Self

import networkx as nx

from graphs.count.equations import (
    closed_surface,
    loop_form,
    mobility_of_model,
    modified_cgk,
    polyhedron_equation,
    spherical_system,
    traditional_cgk,
    wampler_ground_free,
    wampler_points,
    wampler_remote,
    wampler_rods,
    wampler_scissors,
)
from graphs.errors import numbered, shown
from graphs.loops.loop import Centre
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sc import Arrangement, SCGraph, arrangement_of
from graphs.mechanism.scd import SCDGraph

_MANY = 3


@dataclass(frozen=True, slots=True)
class EquationResult:
    """The value of one equation of mobility, and whether it applies.

    Attributes
    ----------
    value : int or None
        None where the equation lacks an input.
    applies : bool
        Whether the equation holds for mechanisms of this class.
    why : str
        Why, or why not.

    Examples
    --------
    >>> result = mobility_report(SCGraph(3, [(0, 1), (1, 2), (2, 0)])).equations["spherical_system"]
    >>> result.applies, result.why
    (False, '1 of 1 loop spatial')
    """

    value: int | None
    applies: bool
    why: str


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
            "equations": {
                name: {"value": one.value, "applies": one.applies, "why": one.why}
                for name, one in self.equations.items()
            },
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
    results = _equations(mechanism, kind)
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


def mechanism_class(sc: SCGraph) -> str:
    """Return the class of a mechanism (Wiener 2016, Fig. 37).

    It is ``spherical``, ``planar``, ``spherical system``, ``hybrid``, ``spatial``, or ``closed`` if some loop that
    depends on others has a centre too.

    Parameters
    ----------
    sc : SCGraph or SCDGraph

    Examples
    --------
    >>> mechanism_class(SCGraph(3, [(0, 1), (1, 2)]))  # an open chain
    'spatial'
    """
    if sc.is_closed:
        return "closed"
    if not sc.centred_loops:
        return "spatial"
    if sc.spatial_loops:
        return "hybrid"
    classes = sc.centre_classes()
    if len(classes) > 1:
        return "spherical system"
    return "spherical" if classes[0].centre is Centre.FINITE else "planar"


_WHY_NOT_CGK = {
    "spherical system": "Eq. 1 presumes one centre for all loops; the centres here differ",
    "hybrid": "loops with a centre constrain 3 degrees of freedom and spatial loops 6: no single constraint space",
    "closed": "the loops of a closed surface or of concentric loops are not independent constraints",
}


def _equations(sc: SCGraph, kind: str) -> dict[str, EquationResult]:
    """Evaluate every equation for an SC or SCD graph; which apply is Wiener's Table 6."""
    # Parts that are not joined are counted each with a fixed link of its own.
    links, joints = len(sc) - sc.components + 1, len(sc.joints)
    space = 6 if kind == "spatial" else None if sc.spatial_loops else 3
    one_space = kind in ("spherical", "planar", "spatial")
    modified = one_space or kind == "spherical system"
    system = kind in ("spherical", "planar", "spherical system")
    return {
        "traditional_cgk": EquationResult(
            None if space is None else traditional_cgk(links, [1] * joints, space),
            one_space,
            f"Eq. 1 with constraint space {space} for all loops" if one_space else _WHY_NOT_CGK[kind],
        ),
        "modified_cgk": EquationResult(
            None if space is None else modified_cgk(links, joints, space),
            modified,
            f"Eq. 2 with constraint space {space} for each loop" if modified else _WHY_NOT_CGK[kind],
        ),
        "spherical_system": EquationResult(
            spherical_system(links, joints),
            system,
            "Eq. 3: every loop has a centre" if system else _why_no_system(sc, kind),
        ),
        "polyhedron": _polyhedron_result(sc),
        "loop_form": EquationResult(
            loop_form(joints, len(sc.centred_loops), sc.spatial_loops),
            not sc.is_closed,
            "3 for each loop with a centre and 6 for each spatial loop, over independent loops"
            if not sc.is_closed
            else "leaves out that the closing loop has a centre too",
        ),
        "closed_surface": _closed_result(sc),
    }


def _why_no_system(sc: SCGraph, kind: str) -> str:
    if kind == "closed":
        return _WHY_NOT_CGK[kind]
    if not sc.independent_loops:
        return "an open chain: no loop has a centre"
    return f"{sc.spatial_loops} of {numbered(sc.independent_loops, 'loop')} spatial"


def _polyhedron_result(sc: SCGraph) -> EquationResult:
    if not isinstance(sc, SCDGraph):
        return EquationResult(
            None, False, "Eq. 4 needs the sides of the links (an SCD graph); it would equal the loop form"
        )
    counts = sc.counts
    value = polyhedron_equation(counts.vertices, counts.implicit_centres, counts.edges)
    if sc.is_closed and len(sc.centre_classes()) < _MANY:
        return EquationResult(value, False, "a closed surface with fewer than three centres")
    return EquationResult(value, True, "Eq. 4: holds for generic realisations of every class")


def _closed_result(sc: SCGraph) -> EquationResult:
    if not sc.is_closed:
        return EquationResult(None, False, "no loop that depends on others has a centre")
    faces = len(sc.centred_loops) + len(sc.closing)
    value = closed_surface(len(sc.joints), faces, sc.spatial_loops, _centres_of_closed_parts(sc))
    return EquationResult(value, True, "every face of a closed surface has a centre: J - 3 F + 6")


def _centres_of_closed_parts(sc: SCGraph) -> list[int]:
    """Count the distinct centres of each closed surface, the loops that hang together with a closing one."""
    loops = (*sc.loops, *sc.closing)
    parts = nx.utils.UnionFind(range(len(loops)))
    first: dict[object, int] = {}
    for i, loop in enumerate(loops):
        for joint in loop.joints:
            parts.union(first.setdefault(joint, i), i)
    closed = [parts[i] for i in range(len(sc.loops), len(loops))]
    return [
        sum(any(parts[loop] == part for loop in one.loops) for one in sc.centre_classes())
        for part in dict.fromkeys(closed)
    ]


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
    vertices, rods = model.free_vertices, model.counted_rods
    points, lines, scissors = len(model.on_plane), len(model.on_line), len(model.scissors)
    remote = [centre.k for centre in model.centres]
    free = model.ground is None
    extra = {
        "points on planes or lines": points + lines,
        "remote centres": len(remote),
        "scissors": scissors,
        "a ground link": int(not free),
    }

    def result(value: int, *covered: str) -> EquationResult:
        missing = [name for name, number in extra.items() if number and name not in covered]
        if missing:
            return EquationResult(value, False, "leaves out " + " and ".join(missing))
        return EquationResult(value, True, "covers every term of the model, for generic realisations")

    on, centred = "points on planes or lines", "remote centres"
    eq7 = result(wampler_remote(vertices, rods, points, lines, [3] * len(remote)), on, centred)
    if any(k != 3 for k in remote):
        eq7 = EquationResult(eq7.value, False, "takes every remote centre for S_{+3}")
    eq10 = EquationResult(None, False, "the model has no ground link to leave out")
    if not free:
        eq10 = EquationResult(
            wampler_ground_free(vertices, rods, points, lines, remote, scissors), True, "ground is left out"
        )
    equations = {
        "wampler_eq5": result(wampler_rods(vertices, rods)),
        "wampler_eq6": result(wampler_points(vertices, rods, points, lines), on),
        "wampler_eq7": eq7,
        "wampler_eq8": result(wampler_remote(vertices, rods, points, lines, remote), on, centred),
        "wampler_eq9": result(
            wampler_scissors(vertices, rods, points, lines, remote, scissors), on, centred, "scissors"
        ),
        "wampler_eq10": eq10,
    }
    return MobilityReport(
        mechanism_class="polyhedron model",
        links=len(model.links) or None,
        joints=None,
        loops=None,
        centres=len(remote),
        mobility=mobility_of_model(model),
        equations=equations,
        counts={
            "vertices": vertices,
            "edges": rods,
            "on_plane": points,
            "on_line": lines,
            "scissors": scissors,
            "remote": sum(remote),
        },
    )
