"""Which equations of mobility apply to a mechanism: one table, an entry per equation.

Source: Wiener 2016, Fig. 37 and Table 6; Wampler, Larson, Erdman 2007, Eqs. 5 to 10.
Theory: docs/theory/mobility-by-count.md.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import networkx as nx

from graphs.count.equations import (
    closed_surface,
    loop_form,
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
from graphs.errors import numbered
from graphs.loops.loop import Centre
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph

__all__ = ["EQUATIONS", "Equation", "EquationResult", "equation_results", "equation_titles", "mechanism_class"]

_MANY = 3
"""Centres of a closed surface that need not lie in one line: with fewer it counts less than six conditions too many."""


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
    >>> result = equation_results(SCGraph(3, [(0, 1), (1, 2), (2, 0)]))["spherical_system"]
    >>> result.applies, result.why
    (False, '1 of 1 loop spatial')
    """

    value: int | None
    applies: bool
    why: str


@dataclass(frozen=True, slots=True)
class Equation:
    """One equation of mobility: how it is evaluated, when it applies, what it is called.

    Attributes
    ----------
    name : str
        Its key in reports and in JSON.
    function : callable
        Its value for a mechanism; None where the equation lacks an input.
    applies : callable
        Whether it holds for a mechanism, and why, or why not.
    title : str
        Its name in what is printed.
    mechanism : type
        The mechanisms that it counts: `SCGraph` (SCD graphs too) or `PolyhedronModel`.

    Examples
    --------
    >>> loops = next(equation for equation in EQUATIONS if equation.name == "loop_form")
    >>> loops.title, loops.function(SCGraph(4, [(0, 1), (1, 2), (2, 3)]))
    ('loop form', 3)
    """

    name: str
    function: Callable[[Any], int | None]
    applies: Callable[[Any], tuple[bool, str]]
    title: str
    mechanism: type[SCGraph] | type[PolyhedronModel] = SCGraph


def equation_results(mechanism: SCGraph | PolyhedronModel) -> dict[str, EquationResult]:
    """Return every equation for mechanisms of this type, by name in the order of the table, with its result."""
    return {
        equation.name: EquationResult(equation.function(mechanism), *equation.applies(mechanism))
        for equation in EQUATIONS
        if isinstance(mechanism, equation.mechanism)
    }


def equation_titles() -> dict[str, str]:
    """Return the title of each equation, by name."""
    return {equation.name: equation.title for equation in EQUATIONS}


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


def _links(sc: SCGraph) -> int:
    """Return N: parts that are not joined are counted each with a fixed link of its own."""
    return len(sc) - sc.components + 1


def _constraint_space(sc: SCGraph) -> int | None:
    """Return lambda where it is the same for all loops; None in hybrid mechanisms."""
    if mechanism_class(sc) == "spatial":
        return 6
    return None if sc.spatial_loops else 3


def _traditional(sc: SCGraph) -> int | None:
    space = _constraint_space(sc)
    return None if space is None else traditional_cgk(_links(sc), [1] * len(sc.joints), space)


def _traditional_applies(sc: SCGraph) -> tuple[bool, str]:
    kind = mechanism_class(sc)
    if kind in _WHY_NOT_CGK:
        return False, _WHY_NOT_CGK[kind]
    return True, f"Eq. 1 with constraint space {_constraint_space(sc)} for all loops"


def _modified(sc: SCGraph) -> int | None:
    space = _constraint_space(sc)
    return None if space is None else modified_cgk(_links(sc), len(sc.joints), space)


def _modified_applies(sc: SCGraph) -> tuple[bool, str]:
    kind = mechanism_class(sc)
    if kind in _WHY_NOT_CGK and kind != "spherical system":
        return False, _WHY_NOT_CGK[kind]
    return True, f"Eq. 2 with constraint space {_constraint_space(sc)} for each loop"


def _system_applies(sc: SCGraph) -> tuple[bool, str]:
    kind = mechanism_class(sc)
    if kind in ("spherical", "planar", "spherical system"):
        return True, "Eq. 3: every loop has a centre"
    if kind == "closed":
        return False, _WHY_NOT_CGK[kind]
    if not sc.independent_loops:
        return False, "an open chain: no loop has a centre"
    return False, f"{sc.spatial_loops} of {numbered(sc.independent_loops, 'loop')} spatial"


def _polyhedron(sc: SCGraph) -> int | None:
    if not isinstance(sc, SCDGraph):
        return None
    counts = sc.counts
    return polyhedron_equation(counts.vertices, counts.implicit_centres, counts.edges)


def _polyhedron_applies(sc: SCGraph) -> tuple[bool, str]:
    if not isinstance(sc, SCDGraph):
        return False, "Eq. 4 needs the sides of the links (an SCD graph); it would equal the loop form"
    if sc.is_closed and len(sc.centre_classes()) < _MANY:
        return False, "a closed surface with fewer than three centres"
    return True, "Eq. 4: holds for generic realisations of every class"


def _loops_apply(sc: SCGraph) -> tuple[bool, str]:
    if sc.is_closed:
        return False, "leaves out that the closing loop has a centre too"
    return True, "3 for each loop with a centre and 6 for each spatial loop, over independent loops"


def _surface(sc: SCGraph) -> int | None:
    if not sc.is_closed:
        return None
    faces = len(sc.centred_loops) + len(sc.closing)
    return closed_surface(len(sc.joints), faces, sc.spatial_loops, _centres_of_closed_parts(sc))


def _surface_applies(sc: SCGraph) -> tuple[bool, str]:
    if not sc.is_closed:
        return False, "no loop that depends on others has a centre"
    return True, "every face of a closed surface has a centre: J - 3 F + 6"


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


_POINTS = "points on planes or lines"
_REMOTE = "remote centres"
_SCISSORS = "scissors"


def _covers(*terms: str) -> Callable[[PolyhedronModel], tuple[bool, str]]:
    """Return the condition of an equation with these terms: it leaves out none that a model has."""

    def applies(model: PolyhedronModel) -> tuple[bool, str]:
        numbers = {
            _POINTS: len(model.on_plane) + len(model.on_line),
            _REMOTE: len(model.centres),
            _SCISSORS: len(model.scissors),
            "a ground link": int(model.ground is not None),
        }
        missing = [term for term, number in numbers.items() if number and term not in terms]
        if missing:
            return False, "leaves out " + " and ".join(missing)
        return True, "covers every term of the model, for generic realisations"

    return applies


def _three_each(model: PolyhedronModel) -> tuple[bool, str]:
    if any(centre.k != 3 for centre in model.centres):
        return False, "takes every remote centre for S_{+3}"
    return _covers(_POINTS, _REMOTE)(model)


def _ground_applies(model: PolyhedronModel) -> tuple[bool, str]:
    if model.ground is None:
        return False, "the model has no ground link to leave out"
    return True, "ground is left out"


def _terms(model: PolyhedronModel) -> tuple[int, int, int, int]:
    """Return V, E, P and L of a model."""
    return model.free_vertices, model.counted_rods, len(model.on_plane), len(model.on_line)


def _remote(model: PolyhedronModel) -> list[int]:
    return [centre.k for centre in model.centres]


EQUATIONS: tuple[Equation, ...] = (
    Equation("traditional_cgk", _traditional, _traditional_applies, "C-G-K (Wiener Eq. 1)"),
    Equation("modified_cgk", _modified, _modified_applies, "modified C-G-K (Wiener Eq. 2)"),
    Equation(
        "spherical_system",
        lambda sc: spherical_system(_links(sc), len(sc.joints)),
        _system_applies,
        "spherical system (Wiener Eq. 3)",
    ),
    Equation("polyhedron", _polyhedron, _polyhedron_applies, "polyhedron (Wiener Eq. 4)"),
    Equation(
        "loop_form",
        lambda sc: loop_form(len(sc.joints), len(sc.centred_loops), sc.spatial_loops),
        _loops_apply,
        "loop form",
    ),
    Equation("closed_surface", _surface, _surface_applies, "closed surface"),
    Equation(
        "wampler_eq5", lambda model: wampler_rods(*_terms(model)[:2]), _covers(), "Wampler Eq. 5, rods", PolyhedronModel
    ),
    Equation(
        "wampler_eq6",
        lambda model: wampler_points(*_terms(model)),
        _covers(_POINTS),
        "Wampler Eq. 6, points",
        PolyhedronModel,
    ),
    Equation(
        "wampler_eq7",
        lambda model: wampler_remote(*_terms(model), [3] * len(model.centres)),
        _three_each,
        "Wampler Eq. 7, S+3",
        PolyhedronModel,
    ),
    Equation(
        "wampler_eq8",
        lambda model: wampler_remote(*_terms(model), _remote(model)),
        _covers(_POINTS, _REMOTE),
        "Wampler Eq. 8, S+k",
        PolyhedronModel,
    ),
    Equation(
        "wampler_eq9",
        lambda model: wampler_scissors(*_terms(model), _remote(model), len(model.scissors)),
        _covers(_POINTS, _REMOTE, _SCISSORS),
        "Wampler Eq. 9, scissors",
        PolyhedronModel,
    ),
    Equation(
        "wampler_eq10",
        lambda model: (
            None if model.ground is None else wampler_ground_free(*_terms(model), _remote(model), len(model.scissors))
        ),
        _ground_applies,
        "Wampler Eq. 10, no ground",
        PolyhedronModel,
    ),
)
"""The equations of mobility, in the order in which they are reported: nothing else lists them."""
