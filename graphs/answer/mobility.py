"""Mobility of any mechanism: one question, answered by count, by exact rank, and at a configuration.

Theory: docs/theory/mobility-by-count.md, docs/theory/exact-mobility.md, docs/theory/pose.md.
"""

from collections.abc import Callable
from dataclasses import replace
from math import pi
from typing import Any

import networkx as nx
import numpy as np

from graphs.answer.mobility_of_joints import chain_with_centres, mobility_of_jointed
from graphs.answer.remote import notes_on_centres
from graphs.answer.report import RODS_ALONE, MobilityAnswer, notes_on_singular_values
from graphs.convert.conversions import Mechanism, graph_of
from graphs.convert.duality import SheetMechanism, mechanism_of_sheet
from graphs.count.report import mobility_report
from graphs.errors import InvariantError, NumericalError, UnsolvableError, numbered, shown
from graphs.joints.linkage import JointedLinkage
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.bodies import rigid_sets, undeclared_rods
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.precision import Precision, extent_of, precision_of
from graphs.mechanism.sc import CENTRES_ASSUMED, SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.mechanism.surfaces import Cone, Cylinder, SurfaceLinkage
from graphs.rank.exact import ExactMobility, diagnose, exact_mobility, independent_cycles
from graphs.rank.infinitesimal import (
    InfinitesimalMobility,
    infinitesimal_mobility,
    infinitesimal_mobility_of_axes,
    infinitesimal_mobility_of_model,
)
from graphs.rank.rods import exact_mobility_of_model
from graphs.tolerances import DOUBLE

MOST_JOINTS = 2000
"""Larger mechanisms are ranked on request only: so many joints take a second, ten times as many twenty seconds."""

# Joints up to which it takes seconds to find why the count differs: nobody waits longer unasked.
_DIAGNOSED_UNASKED = 400
_MOST_DIAGNOSED = 20_000  # joints beyond which it takes over a quarter of a minute, and names places nobody can look at
_ENDS = 2  # a body of two vertices is a rod: its spin about its own line moves nothing, so it has 5 freedoms and not 6
_LISTED = 12  # joints that are named: a region can have hundreds, and a line holds about so many


def with_exact(
    answer: MobilityAnswer, mechanism: SCGraph | PolyhedronModel, *, demanded: bool = False
) -> MobilityAnswer:
    """Add the exact generic mobility, and where it differs from the count, why.

    It is found whatever the size of the mechanism if it is demanded.
    """
    rank: Callable[[Any], ExactMobility] = exact_mobility
    if isinstance(mechanism, PolyhedronModel):
        size, unit, most, rank = len(mechanism), "vertices", MOST_JOINTS // 3, exact_mobility_of_model
    else:
        size, unit, most = len(mechanism.joints), "joints", MOST_JOINTS
    if size > most and not demanded:
        return answer.with_notes(warnings=[f"exact rank skipped: {size} {unit}, more than {most}; --exact computes it"])
    try:
        exact = rank(mechanism)
    except (UnsolvableError, NumericalError) as error:
        return answer.with_notes(warnings=[f"no exact rank: {error}"])
    answer = replace(answer, exact=exact)
    if exact.mobility == answer.mobility:
        return answer
    return answer.with_notes(warnings=[_why_it_differs(answer, mechanism, exact.mobility, demanded)])


def is_ranked_by_bodies(model: PolyhedronModel) -> bool:
    """Return whether the exact rank is that of bodies: without remote centres, or if every rod lies in a body.

    Rods that pass through a remote centre lie in one plane with their neighbours, which they may leave to first
    order; bodies may not.
    """
    if not model.centres:
        return True
    bodies = [frozenset(body) for body in rigid_sets(model)]
    return all(any(a in body and b in body for body in bodies) for a, b in undeclared_rods(model))


def _why_it_differs(answer: MobilityAnswer, mechanism: SCGraph | PolyhedronModel, exact: int, demanded: bool) -> str:
    text = f"the exact generic mobility is {exact}, by count {answer.mobility}"
    if isinstance(mechanism, PolyhedronModel):
        if len(mechanism) <= _ENDS and mechanism.ground is None:
            return f"{text}: a rod by itself has 5 degrees of freedom, which the count takes for 6"
        return f"{text}{'' if is_ranked_by_bodies(mechanism) else RODS_ALONE}"
    if len(mechanism.joints) > _MOST_DIAGNOSED:
        return f"{text}; where equations are redundant is not looked for among more than {_MOST_DIAGNOSED} joints"
    if len(mechanism.joints) > _DIAGNOSED_UNASKED and not demanded:
        return f"{text}; --exact says where equations are redundant"
    diagnosis = diagnose(mechanism)
    if diagnosis.idle:
        regions = sorted(diagnosis.regions, key=len)
        region = sorted(regions[0], key=lambda joint: (len(str(joint)), str(joint)))
        joints = ", ".join([*map(shown, region[:_LISTED]), *(["..."] if region[_LISTED:] else [])])
        more = f" (and {numbered(len(regions) - 1, 'more place')})" if len(regions) > 1 else ""
        text += f": {numbered(diagnosis.idle, 'redundant closure equation')}, among joints {joints}{more}"
    if diagnosis.immobile:
        text += f"; {numbered(len(diagnosis.immobile), 'joint')} generically immobile"
    return text


def with_infinitesimal(
    answer: MobilityAnswer, sheet: Sheet, mechanism: SheetMechanism, *, demanded: bool = False
) -> MobilityAnswer:
    """Add the infinitesimal degrees of freedom of a crease pattern at its coordinates.

    The overconstraint h is against the count of the answer (Eq. 8). Raises `UnsolvableError` if it is demanded and
    the sheet has no coordinates, `InvariantError` if a hinge has no length.
    """
    if sheet.coordinates is None and not demanded:
        return answer
    found = infinitesimal_mobility(sheet, mechanism)
    return replace(answer, infinitesimal=found).with_notes(
        warnings=[*notes_on_singular_values(found), *_flat_notes(answer, found)]
    )


def model_with_infinitesimal(answer: MobilityAnswer, model: PolyhedronModel) -> MobilityAnswer:
    """Add the freedoms of a polyhedron model at its coordinates, if it has any."""
    if not model.coordinates:
        return answer
    try:
        found = infinitesimal_mobility_of_model(model)
    except UnsolvableError as error:
        return answer.with_notes(warnings=[f"no degrees of freedom at this configuration: {error}"])
    return replace(answer, infinitesimal=found).with_notes(warnings=notes_on_singular_values(found))


def _flat_notes(answer: MobilityAnswer, found: InfinitesimalMobility) -> list[str]:
    """Caution where creases lie in one plane, if anything is gained by it."""
    gained = found.dof is None or (answer.mobility is not None and found.dof > answer.mobility)
    if not found.flat_loops or not gained:
        return []
    if found.flat:
        return ["flat state: the sheet has fewer infinitesimal degrees of freedom once folded"]
    flat = f"{numbered(found.flat_loops, 'loop')} with all axes in one plane"
    return [f"{flat}: fewer infinitesimal degrees of freedom once folded"]


_ANY_CONE = Cone(pi / 4)
"""Rank at the conformed position does not depend on the cone angle (docs/theory/behaviour.md)."""


def counts_and_ranks(
    mechanism: Mechanism | nx.Graph,
    *,
    exact: bool | None = None,
    hinge_flat: bool = False,
    frame: int | None = None,
    infinitesimal: bool = True,
    geometry: bool = True,
    dual: SheetMechanism | None = None,
) -> MobilityAnswer:
    """Report how many degrees of freedom a mechanism has, and which formula applies.

    Parameters
    ----------
    mechanism : Sheet, SCGraph, SCDGraph, PolyhedronModel, VertexEdgeGraph, SurfaceLinkage, HingedSolids, ...
        A plain graph is a link-joint graph: each face of a drawing of it gets a finite centre.
    exact : bool, optional
        Find the exact generic rank; by default unless the mechanism is too large.
    hinge_flat : bool, optional
        Make hinges of the flat (F) edges of a crease pattern too.
    frame : int, optional
        The frame of a FOLD file that all numbers are those of; by default the pattern as it was read, or if that
        has no coordinates, the first frame that has.
    infinitesimal : bool, optional
        Find the infinitesimal degrees of freedom at the coordinates; by default where there are any.
    geometry : bool, optional
        Give loops round holes and cuts of a crease pattern the centre where their axes meet or are parallel.
    dual : SheetMechanism, optional
        The mechanism of the crease pattern, made with the same options, so that it is not made again.

    Raises
    ------
    UnsolvableError
        If a frame is demanded and the sheet has no coordinates there.
    FileError, InvariantError
        If there is no such frame, or the mechanism breaks an invariant.

    Examples
    --------
    >>> answer = counts_and_ranks(nx.cycle_graph(4))
    >>> answer.mobility, answer.exact.mobility, answer.equations["spherical_system"].why
    (1, 1, 'Eq. 3: every loop has a centre')
    """
    demanded = bool(exact)
    if isinstance(mechanism, Sheet):
        drawn = sheet_in_frame(mechanism, frame)
        dual = dual or mechanism_of_sheet(drawn, hinge_flat=hinge_flat, geometry=geometry)
        answer = _of_sheet(drawn, dual, exact, frame, hinged=(hinge_flat, geometry))
        if infinitesimal:
            answer = with_infinitesimal(answer, drawn, dual, demanded=frame is not None)
        others = mechanism.frames.others if mechanism.frames is not None and not frame else 0
        more = (f"not read: {numbered(others, 'more frame')} of the file (--at FRAME)",) if others else ()
        return answer.with_notes((), more)
    if isinstance(mechanism, PolyhedronModel):
        answer = MobilityAnswer.of(mobility_report(mechanism))
        if exact is not False:
            answer = with_exact(answer, mechanism, demanded=demanded)
        answer = answer.with_notes(warnings=notes_on_centres(mechanism))
        return model_with_infinitesimal(answer, mechanism) if infinitesimal else answer
    if isinstance(mechanism, JointedLinkage):
        answer = mobility_of_jointed(mechanism)
        if demanded:
            why = "revolute joints that replace others share points and directions, generic ones do not"
            answer = answer.with_notes(warnings=[f"no exact rank: {why}"])
        return answer if infinitesimal else replace(answer, infinitesimal=None)
    sc = _counted_graph(mechanism)
    answer = MobilityAnswer.of(mobility_report(sc))
    if isinstance(mechanism, HingedSolids):
        answer = answer.with_notes(warnings=_centres_by_axes(graph_of(mechanism), sc))
        answer = answer.with_notes(warnings=mechanism.notes)
    if sc.centres_assumed:
        answer = replace(answer, warnings=(CENTRES_ASSUMED, *answer.warnings))
    if frame is not None and infinitesimal:
        answer = answer.with_notes(warnings=["no degrees of freedom at a configuration: a graph has no coordinates"])
    if exact is not False:
        answer = with_exact(answer, sc, demanded=demanded)
    if infinitesimal and isinstance(mechanism, SurfaceLinkage):
        return _conformed(answer, mechanism)
    if infinitesimal and isinstance(mechanism, HingedSolids):
        here = infinitesimal_mobility_of_axes(mechanism.chain, mechanism.axes)
        return replace(answer, infinitesimal=here).with_notes(warnings=notes_on_singular_values(here))
    return answer


def _counted_graph(mechanism: Mechanism | nx.Graph) -> SCGraph:
    """Return the SC graph of a mechanism with the centres that its axes have for certain."""
    if isinstance(mechanism, HingedSolids):
        return chain_with_centres(mechanism)
    return _on_one_centre(mechanism) if isinstance(mechanism, SurfaceLinkage) else graph_of(mechanism)


def _on_one_centre(linkage: SurfaceLinkage) -> SCGraph:
    """Return the chain of a linkage on a surface: all its axes pass through the apex, of a cylinder at infinity."""
    chain = linkage.chain
    centre = Centre.INFINITE if linkage.kind == "cylinder" else Centre.FINITE
    cycles = independent_cycles(chain)
    if all(loop.centre is centre for loop in cycles) and len(chain.centre_classes()) == 1 and not chain.closing:
        return chain
    name = "apex" if centre is Centre.FINITE else "the direction of all axes"
    return chain.with_loops([Loop(loop.joints, centre, loop.name, name) for loop in cycles])


def _centres_by_axes(chain: SCGraph, centred: SCGraph) -> list[str]:
    """Say how many loops of a chain got a centre by their axes."""
    warnings = []
    for centre, are, kind in ((Centre.INFINITE, "are parallel", "planar"), (Centre.FINITE, "meet", "spherical")):
        before, after = (sum(loop.centre is centre for loop in graph.loops) for graph in (chain, centred))
        if after > before:
            counted = numbered(after - before, f"loop whose axes {are} counts", f"loops whose axes {are} count")
            warnings.append(f"{counted} as {kind}")
    return warnings


def _conformed(answer: MobilityAnswer, linkage: SurfaceLinkage) -> MobilityAnswer:
    """Add the freedoms at the conformed position, where the places of the joints are known."""
    cylinder = linkage.kind == "cylinder"
    where = "are parallel" if cylinder else "pass through its apex"
    answer = answer.with_notes(warnings=[f"on a {linkage.kind} all joint axes {where}"])
    if linkage.steps is None:
        return answer
    surface = linkage.surface or (Cylinder(1.0) if cylinder else _ANY_CONE)
    lines = zip(*(part.tolist() for part in surface.axes(linkage.places())), strict=True)
    axes = dict(zip(linkage.chain.joints, lines, strict=True))
    found = replace(infinitesimal_mobility_of_axes(linkage.chain, axes, precision_of_steps(linkage)), flat=False)
    return replace(answer, infinitesimal=found).with_notes(warnings=notes_on_singular_values(found))


def precision_of_steps(linkage: SurfaceLinkage) -> Precision:
    """Return how precise places are, in radians: the steps as files write them, in degrees, or solved for."""
    assert linkage.steps is not None
    steps = np.degrees(list(linkage.steps.values()))[:, None]
    written = precision_of(steps.tolist())
    size = max(np.radians(written.size * extent_of(steps)), DOUBLE.closed) * len(linkage.chain.joints) ** 0.5
    return Precision(float(size), written.source)


def _of_sheet(
    drawn: Sheet, dual: SheetMechanism, exact: bool | None, frame: int | None, *, hinged: tuple[bool, bool]
) -> MobilityAnswer:
    """Answer for a crease pattern; where flat edges matter, say what it is the other way round."""
    hinge_flat, geometry = hinged
    answer = MobilityAnswer.of(mobility_report(dual.sc))
    answer = replace(answer, counts={**answer.counts, "interior_vertices": dual.interior_vertices})
    answer = replace(answer, reading=drawn.reading)
    notes = []
    if frame:
        notes.append(f"all numbers are those of frame {frame}")
    if flaps := answer.counts["flaps"]:
        notes.append(f"{numbered(flaps, 'flap')} (panels with one hinge): 1 degree of freedom each")
    if "F" in drawn.assignments:
        other = mechanism_of_sheet(drawn, hinge_flat=not hinge_flat, geometry=geometry).sc
        if len(other) != len(dual.sc):
            way = "merged" if hinge_flat else "hinged"
            counted = mobility_report(other).mobility
            notes.append(f"with flat edges {way}: links {len(other)}, joints {len(other.joints)}, M {counted}")
    answer = answer.with_notes(dual.repairs, (*dual.warnings, *notes))
    if exact is not False:
        answer = with_exact(answer, dual.sc, demanded=bool(exact))
    return answer


def sheet_in_frame(sheet: Sheet, frame: int | None) -> Sheet:
    """Return the sheet of a frame, or without one the first that has coordinates."""
    if sheet.frames is None:
        if frame:
            raise InvariantError("frames", "has no frames", "a .fold file")
        return sheet
    if frame is not None:
        return sheet.frames.frame(frame)
    return sheet.frames.first_placed()
