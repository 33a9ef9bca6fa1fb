"""How does it move: one question to any mechanism.

Theory: docs/theory/mobility-by-count.md, docs/theory/exact-mobility.md, docs/theory/pose.md.
"""

from __future__ import annotations

from dataclasses import replace
from math import pi
from typing import Literal

import networkx as nx
import numpy as np

from graphs.answer.jointed import mobility_of_jointed
from graphs.answer.ranks import model_with_exact, model_with_pose, notes_of_pose, with_exact, with_pose
from graphs.answer.report import MobilityAnswer
from graphs.convert.duality import SheetMechanism, mechanism_of_sheet
from graphs.convert.table import Mechanism, graph_of
from graphs.count.report import mobility_report
from graphs.errors import InvariantError, numbered
from graphs.joints.linkage import JointedLinkage
from graphs.mechanism.on_surface import SurfaceLinkage
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.precision import Precision, extent_of, precision_of
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.mechanism.surfaces import Cone, Cylinder
from graphs.rank.pose import pose_mobility_of_axes
from graphs.tolerances import DOUBLE

__all__ = ["lying", "mobility", "precision_of_steps"]

_ASSUMED = (
    "a link-joint graph without centres: each face of a drawing is assumed to have a finite one, which decides M"
)
_ANY_CONE = Cone(pi / 4)
"""Rank at the conformed position does not depend on the cone angle (docs/theory/behaviour.md)."""


def mobility(
    mechanism: Mechanism | nx.Graph,
    *,
    exact: bool | None = None,
    hinge_flat: bool = False,
    pose: int | Literal[False] | None = None,
    geometry: bool = True,
    dual: SheetMechanism | None = None,
) -> MobilityAnswer:
    """Report how many degrees of freedom a mechanism has, and which formula applies.

    Parameters
    ----------
    mechanism : Sheet, SCGraph, SCDGraph, PolyhedronModel, VertexEdgeGraph, SurfaceLinkage, HingedSolids, ...
        Of joints of other kinds than revolutes the answer is that of `graphs.answer.jointed`.
        A plain graph is a link-joint graph: each face of a drawing of it is given a finite centre.
    exact : bool, optional
        Find the exact generic rank; by default of what is not too large.
    hinge_flat : bool, optional
        Make hinges of the flat (F) edges of a crease pattern too.
    pose : int, optional
        The frame of a FOLD file that is asked about, counts, ranks and freedoms as it lies; by default the
        pattern as it was read, or if that has no coordinates, the first frame that has. False leaves the
        freedoms out.
    geometry : bool, optional
        Give loops round holes and cuts of a crease pattern the centre where their axes meet or are parallel.
    dual : SheetMechanism, optional
        Of the crease pattern as it lies, made with the same options, where it is at hand.

    Returns
    -------
    MobilityAnswer

    Raises
    ------
    UnsolvableError
        If a pose is demanded of a sheet that has no coordinates there.
    FileError, InvariantError
        If there is no such frame, or the mechanism breaks an invariant.

    Examples
    --------
    >>> answer = mobility(nx.cycle_graph(4))
    >>> answer.mobility, answer.exact.mobility, answer.equations["spherical_system"].why
    (1, 1, 'Eq. 3: every loop has a centre')
    >>> mobility(Sheet(4, (), "", ((0, 1, 2), (0, 2, 3)), ((0, 0), (1, 0), (1, 1), (0, 1)))).pose.dof
    1
    """
    demanded, wanted = bool(exact), exact is not False
    if isinstance(mechanism, Sheet):
        drawn = lying(mechanism, None if pose is False else pose)
        dual = dual or mechanism_of_sheet(drawn, hinge_flat=hinge_flat, geometry=geometry)
        return _of_sheet(drawn, dual, exact, pose, hinged=(hinge_flat, geometry))
    if isinstance(mechanism, PolyhedronModel):
        answer = MobilityAnswer.of(mobility_report(mechanism))
        if wanted:
            answer = model_with_exact(answer, mechanism, demanded=demanded)
        return answer if pose is False else model_with_pose(answer, mechanism)
    if isinstance(mechanism, JointedLinkage):
        answer = mobility_of_jointed(mechanism)
        if demanded:
            why = "revolute joints that replace others share points and directions, generic ones do not"
            answer = answer.with_notes(warnings=[f"no exact rank: {why}"])
        return replace(answer, pose=None) if pose is False else answer
    sc = graph_of(mechanism)
    answer = MobilityAnswer.of(mobility_report(sc))
    if sc.centres_assumed:
        answer = replace(answer, warnings=(_ASSUMED, *answer.warnings))
    if pose is not None and pose is not False:
        answer = answer.with_notes(
            warnings=["no degrees of freedom at a configuration: a graph has no coordinates"]
        )
    if wanted:
        answer = with_exact(answer, sc, demanded=demanded)
    if pose is not False and isinstance(mechanism, SurfaceLinkage):
        return _conformed(answer, mechanism)
    if pose is not False and isinstance(mechanism, HingedSolids):
        here = pose_mobility_of_axes(mechanism.chain, mechanism.axes)
        return replace(answer, pose=here).with_notes(warnings=notes_of_pose(here))
    return answer


def _conformed(answer: MobilityAnswer, linkage: SurfaceLinkage) -> MobilityAnswer:
    """Add the freedoms at the conformed position, where the places of the joints are known."""
    cylinder = linkage.kind == "cylinder"
    axes_note = (
        "on a cylinder all joint axes are parallel"
        if cylinder
        else "on a cone all joint axes pass through its apex"
    )
    answer = answer.with_notes(warnings=[axes_note])
    if linkage.steps is None:
        return answer
    surface = linkage.surface or (Cylinder(1.0) if cylinder else _ANY_CONE)
    lines = zip(*(part.tolist() for part in surface.axes(linkage.places())), strict=True)
    axes = dict(zip(linkage.chain.joints, lines, strict=True))
    pose = replace(pose_mobility_of_axes(linkage.chain, axes, precision_of_steps(linkage)), flat=False)
    return replace(answer, pose=pose).with_notes(warnings=notes_of_pose(pose))


def precision_of_steps(linkage: SurfaceLinkage) -> Precision:
    """Return how precise places are, in radians: the steps as files write them, in degrees, or solved for."""
    assert linkage.steps is not None
    steps = np.degrees(list(linkage.steps.values()))[:, None]
    written = precision_of(steps.tolist())
    size = max(np.radians(written.size * extent_of(steps)), DOUBLE.closed) * len(linkage.chain.joints) ** 0.5
    return Precision(float(size), written.source)


def _of_sheet(
    drawn: Sheet,
    dual: SheetMechanism,
    exact: bool | None,
    pose: int | Literal[False] | None,
    *,
    hinged: tuple[bool, bool],
) -> MobilityAnswer:
    """Answer for a crease pattern; where flat edges matter, say what it is the other way round."""
    hinge_flat, geometry = hinged
    answer = MobilityAnswer.of(mobility_report(dual.sc))
    answer = replace(answer, counts={**answer.counts, "interior_vertices": dual.interior_vertices})
    answer = replace(answer, reading=drawn.reading)
    notes = []
    if pose:
        notes.append(f"all numbers are those of frame {pose}")
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
    if pose is False:
        return answer
    return with_pose(answer, drawn, dual, demanded=pose is not None)


def lying(sheet: Sheet, pose: int | None) -> Sheet:
    """Return the sheet that is asked about: a frame, or the first that has coordinates."""
    if sheet.frames is None:
        if pose:
            raise InvariantError("frames", "has no frames", "a .fold file")
        return sheet
    if pose is not None:
        return sheet.frames.frame(pose)
    return sheet.frames.first_placed()
