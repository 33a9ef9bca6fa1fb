"""The report of a mechanism with the ranks that arbitrate where counts are conjectures.

Theory: docs/theory/exact-mobility.md, docs/theory/pose.md.
"""

from __future__ import annotations

from dataclasses import replace

from graphs.count.report import MobilityReport
from graphs.errors import NumericalError, UnsolvableError, shown
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.rank.generic import exact_mobility
from graphs.rank.overconstraint import diagnose
from graphs.rank.pose import pose_mobility, pose_mobility_of_model
from graphs.rank.rods import exact_mobility_of_model

__all__ = ["MOST_JOINTS", "model_with_exact", "with_exact", "with_pose"]

MOST_JOINTS = 1200
"""Larger mechanisms are ranked on request only: time grows with the cube of the joints."""

_MOST_DIAGNOSED = 400


def with_exact(report: MobilityReport, mechanism: SCGraph, *, demanded: bool = False) -> MobilityReport:
    """Add the exact generic mobility, and where it differs from the count, why.

    Parameters
    ----------
    report : MobilityReport
        Of the mechanism.
    mechanism : SCGraph or SCDGraph
    demanded : bool, optional
        Whatever its size.

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> from graphs.count.report import mobility_report
    >>> four_bar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> with_exact(mobility_report(four_bar), four_bar).exact["mobility"]
    1
    """
    joints = len(mechanism.joints)
    if joints > MOST_JOINTS and not demanded:
        return report.with_notes(
            warnings=[f"exact rank skipped: {joints} joints are more than {MOST_JOINTS}; ask for it with --exact"]
        )
    try:
        exact = exact_mobility(mechanism)
    except (UnsolvableError, NumericalError) as error:
        return report.with_notes(warnings=[f"no exact rank: {error}"])
    report = replace(report, exact=exact.to_json())
    if exact.mobility == report.mobility:
        return report
    return report.with_notes(warnings=[_why_it_differs(report, mechanism, exact.mobility)])


def model_with_exact(report: MobilityReport, model: PolyhedronModel, *, demanded: bool = False) -> MobilityReport:
    """Add the exact generic mobility of a polyhedron model, and the freedoms at its coordinates if it has any.

    Parameters
    ----------
    report : MobilityReport
        Of the model.
    model : PolyhedronModel
    demanded : bool, optional
        Whatever its size.
    """
    if len(model) > MOST_JOINTS // 3 and not demanded:
        return report.with_notes(
            warnings=[f"exact rank skipped: {len(model)} vertices are many; ask for it with --exact"]
        )
    try:
        exact = exact_mobility_of_model(model)
    except (UnsolvableError, NumericalError) as error:
        report = report.with_notes(warnings=[f"no exact rank: {error}"])
    else:
        report = replace(report, exact=exact.to_json())
        if exact.mobility != report.mobility:
            note = f"the exact generic mobility is {exact.mobility}, the count says {report.mobility}"
            report = report.with_notes(warnings=[note])
    if model.coordinates:
        report = replace(report, pose=pose_mobility_of_model(model).to_json(report.mobility))
    return report


def _why_it_differs(report: MobilityReport, mechanism: SCGraph, exact: int) -> str:
    text = f"the exact generic mobility is {exact}, the count says {report.mobility}"
    if len(mechanism.joints) > _MOST_DIAGNOSED:
        return text
    found = diagnose(mechanism)
    if found.idle:
        regions = sorted(found.regions, key=len)
        joints = shown(" ".join(sorted(map(str, regions[0]), key=lambda name: (len(name), name))))
        place = f"among joints {joints}" + (f" (and {len(regions) - 1} more places)" if len(regions) > 1 else "")
        text += f": {found.idle} closure equation(s) idle, {place}"
    if found.immobile:
        text += f"; {len(found.immobile)} joint(s) cannot move"
    return text


def with_pose(
    report: MobilityReport, sheet: Sheet, *, hinge_flat: bool = False, demanded: bool = False
) -> MobilityReport:
    """Add the infinitesimal freedoms of a crease pattern as it lies.

    Parameters
    ----------
    report : MobilityReport
        Of the sheet; the overconstraint h is against its count (Eq. 8).
    sheet : Sheet
    hinge_flat, demanded : bool, optional

    Raises
    ------
    UnsolvableError
        If it is demanded and the sheet has no coordinates.
    InvariantError
        If a hinge has no length.
    """
    if sheet.coordinates is None and not demanded:
        return report
    if (report.joints or 0) > MOST_JOINTS and not demanded:
        return report.with_notes(
            warnings=[
                f"pose skipped: {report.joints} joints are more than {MOST_JOINTS}; ask for it with --pose 0"
            ]
        )
    pose = pose_mobility(sheet, hinge_flat=hinge_flat)
    notes = []
    if pose.dof is None:
        notes.append(
            "indeterminate at this pose: no gap between the singular values that are zero and those that are not; "
            "the coordinates may be rounded"
        )
    elif pose.spectrum.nearly:
        notes.append(f"nearly mobile: {pose.spectrum.nearly} more freedom(s) but for small strains")
    return replace(report, pose=pose.to_json(report.mobility)).with_notes(warnings=notes)
