"""Ranks added to an answer by count, and what they say where counts are conjectures.

Theory: docs/theory/exact-mobility.md, docs/theory/pose.md.
"""

from __future__ import annotations

from dataclasses import replace

from graphs.answer.report import MobilityAnswer
from graphs.convert.duality import SheetMechanism
from graphs.errors import NumericalError, UnsolvableError, numbered, shown
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.rank.generic import exact_mobility
from graphs.rank.overconstraint import diagnose
from graphs.rank.pose import PoseMobility, pose_mobility, pose_mobility_of_model
from graphs.rank.rods import exact_mobility_of_model
from graphs.tolerances import DOUBLE

__all__ = ["MOST_JOINTS", "model_with_exact", "model_with_pose", "notes_of_pose", "with_exact", "with_pose"]

MOST_JOINTS = 1200
"""Larger mechanisms are ranked on request only: time grows with the cube of the joints."""

_MOST_DIAGNOSED = 400
_LISTED = 12
"""Joints that are named, at most."""


def with_exact(answer: MobilityAnswer, mechanism: SCGraph, *, demanded: bool = False) -> MobilityAnswer:
    """Add the exact generic mobility, and where it differs from the count, why.

    It is found whatever the size of the mechanism if it is demanded.
    """
    joints = len(mechanism.joints)
    if joints > MOST_JOINTS and not demanded:
        return answer.with_notes(
            warnings=[f"exact rank skipped: {joints} joints, more than {MOST_JOINTS}; --exact computes it"]
        )
    try:
        exact = exact_mobility(mechanism)
    except (UnsolvableError, NumericalError) as error:
        return answer.with_notes(warnings=[f"no exact rank: {error}"])
    answer = replace(answer, exact=exact)
    if exact.mobility == answer.mobility:
        return answer
    return answer.with_notes(warnings=[_why_it_differs(answer, mechanism, exact.mobility)])


def model_with_exact(answer: MobilityAnswer, model: PolyhedronModel, *, demanded: bool = False) -> MobilityAnswer:
    """Add the exact generic mobility of a polyhedron model, whatever its size if it is demanded."""
    if len(model) > MOST_JOINTS // 3 and not demanded:
        return answer.with_notes(
            warnings=[
                f"exact rank skipped: {len(model)} vertices, more than {MOST_JOINTS // 3}; --exact computes it"
            ]
        )
    try:
        exact = exact_mobility_of_model(model)
    except (UnsolvableError, NumericalError) as error:
        answer = answer.with_notes(warnings=[f"no exact rank: {error}"])
    else:
        answer = replace(answer, exact=exact)
        if exact.mobility != answer.mobility:
            note = f"the exact generic mobility is {exact.mobility}, by count {answer.mobility}"
            answer = answer.with_notes(warnings=[note])
    return answer


def _why_it_differs(answer: MobilityAnswer, mechanism: SCGraph, exact: int) -> str:
    text = f"the exact generic mobility is {exact}, by count {answer.mobility}"
    if len(mechanism.joints) > _MOST_DIAGNOSED:
        return text
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


def with_pose(
    answer: MobilityAnswer, sheet: Sheet, mechanism: SheetMechanism, *, demanded: bool = False
) -> MobilityAnswer:
    """Add the infinitesimal freedoms of a crease pattern as it lies.

    The overconstraint h is against the count of the answer (Eq. 8). Raises `UnsolvableError` if it is demanded and
    the sheet has no coordinates, `InvariantError` if a hinge has no length.
    """
    if sheet.coordinates is None and not demanded:
        return answer
    pose = pose_mobility(sheet, mechanism)
    return replace(answer, pose=pose).with_notes(warnings=[*notes_of_pose(pose), *_flat_notes(answer, pose)])


def model_with_pose(answer: MobilityAnswer, model: PolyhedronModel) -> MobilityAnswer:
    """Add the freedoms of a polyhedron model at its coordinates, if it has any."""
    if not model.coordinates:
        return answer
    try:
        pose = pose_mobility_of_model(model)
    except UnsolvableError as error:
        return answer.with_notes(warnings=[f"no degrees of freedom at this configuration: {error}"])
    return replace(answer, pose=pose).with_notes(warnings=notes_of_pose(pose))


def notes_of_pose(pose: PoseMobility) -> list[str]:
    """Return what is to be said of the certainty of freedoms at a pose."""
    evidence = pose.spectrum
    if pose.dof is None:
        near = ", ".join(f"{value:.1e}" for value in evidence.undecided[:3])
        why = f"singular values near the noise: {near}" if near else "two counts of small values differ"
        return [f"indeterminate at this configuration: {why}; precision of the coordinates: {_precision(pose)}"]
    notes = []
    if min(evidence.largest_zero, pose.precision.size) > DOUBLE.closed:
        zeros = f"singular values up to {evidence.largest_zero:.0e} are noise"
        notes.append(f"coordinates precise to {_precision(pose)}: {zeros}")
    if evidence.nearly:
        more = numbered(evidence.nearly, "more degree of freedom", "more degrees of freedom")
        notes.append(f"nearly mobile: {more} if small strains are allowed")
    return notes


def _precision(pose: PoseMobility) -> str:
    return str(pose.precision)


def _flat_notes(answer: MobilityAnswer, pose: PoseMobility) -> list[str]:
    """Caution where creases lie in one plane, if anything is gained by it."""
    gained = pose.dof is None or (answer.mobility is not None and pose.dof > answer.mobility)
    if not pose.flat_loops or not gained:
        return []
    if pose.flat:
        return ["flat state: the sheet has fewer infinitesimal degrees of freedom once folded"]
    flat = f"{numbered(pose.flat_loops, 'loop')} with all axes in one plane"
    return [f"{flat}: fewer infinitesimal degrees of freedom once folded"]
