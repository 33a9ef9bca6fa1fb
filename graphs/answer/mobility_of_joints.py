"""Linkages with joints of all kinds: mobility by count, at a configuration, and their passive degrees of freedom.

Wiener's Eq. 1 holds the freedoms of each joint; Wampler's count takes joints of all kinds as vertices, rods, and
points on lines and planes (`graphs.joints.rods_and_points`). Loops are planar if their revolutes are across a plane,
their slides and planar joints along it. A freedom is *passive* if it moves links of one leg, a row of binary
links, and nothing else. Theory: docs/theory/joints.md, docs/theory/mobility-by-count.md.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from graphs.answer.report import MobilityAnswer, notes_on_singular_values
from graphs.count.applicability import EquationResult
from graphs.count.equations import loop_form, modified_cgk, traditional_cgk
from graphs.count.report import MobilityReport, mobility_report
from graphs.errors import numbered, shown
from graphs.geometry import frame_about, unit
from graphs.joints.centres import centred_by_axes
from graphs.joints.joint_places import placed
from graphs.joints.linkage import JointedLinkage, JointKind, JointPlace, Leg, legs
from graphs.joints.revolutes import revolutes_of
from graphs.joints.rods_and_points import points_of, rods_between_balls
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.precision import extent_of, precision_of_axes
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from graphs.rank.exact import independent_cycles
from graphs.rank.infinitesimal import infinitesimal_mobility_of_axes
from graphs.rank.singular_values import spectrum
from graphs.tolerances import DOUBLE, Tolerances
from graphs.types import Floats, JointId


def report_of_joints(linkage: JointedLinkage) -> MobilityReport:
    """Report the mobility of a linkage by count of its joints, each with its freedoms."""
    chain = linkage.chain
    bare = mobility_report(chain)
    freedoms = [kind.freedoms for kind in linkage.kinds.values()]
    if all(kind is JointKind.REVOLUTE for kind in linkage.kinds.values()):
        return replace(bare, equations={**bare.equations, **_wampler(linkage)})
    looped = loop_form(sum(freedoms), len(chain.centred_loops), chain.spatial_loops)
    why = "joint freedoms, less 3 for each loop with a centre and 6 for each spatial loop"
    if chain.is_closed:
        why = "leaves out that the closing loop has a centre too"
    equations = {
        **_by_wiener(linkage, bare, freedoms),
        "loop_form": EquationResult(looped, not chain.is_closed, why),
        **_wampler(linkage),
    }
    counts = {**bare.counts, "freedoms": sum(freedoms)}
    return replace(bare, mobility=looped, equations=equations, counts=counts, warnings=())


def _by_wiener(linkage: JointedLinkage, report: MobilityReport, freedoms: list[int]) -> dict[str, EquationResult]:
    """Evaluate Wiener's Eqs. 1 to 4; their conditions are those of his Table 6, and the kinds of the joints."""
    chain = linkage.chain
    links = len(chain) - chain.components + 1
    bare = report.equations
    space = _SPATIAL if report.mechanism_class == "spatial" else 3
    first = bare["traditional_cgk"]
    if first.applies:
        why = f"Eq. 1 with constraint space {space} for all loops, and the degrees of freedom of each joint"
        first = EquationResult(traditional_cgk(links, freedoms, space), True, why)
    elif first.value is not None:
        first = replace(first, value=traditional_cgk(links, freedoms, space))
    second = bare["modified_cgk"]
    if second.value is not None:
        second = replace(second, value=modified_cgk(links, len(chain.joints), space, sum(freedoms)))
    if second.applies:
        why = f"Eq. 2 with constraint space {space} for each loop, and the degrees of freedom of each joint"
        second = replace(second, why=f"{why}; in space it overrides Eq. 1" if space == _SPATIAL else why)
    many = EquationResult(None, False, "for joints with one degree of freedom; these have more")
    third = bare["spherical_system"] if all(freedom == 1 for freedom in freedoms) else many
    fourth = EquationResult(None, False, "Eq. 4 is for revolute joints")
    return {"traditional_cgk": first, "modified_cgk": second, "spherical_system": third, "polyhedron": fourth}


def _wampler(linkage: JointedLinkage) -> dict[str, EquationResult]:
    """Evaluate Wampler's count: Eq. 5, or 6 with points on lines and planes, or 7 with remote centres."""
    model = points_of(linkage)
    equations = mobility_report(model).equations
    name = "wampler_eq7" if model.centres else "wampler_eq6" if model.on_line or model.on_plane else "wampler_eq5"
    rods = len(list(rods_between_balls(linkage)))
    spins = f"; {numbered(rods, 'rod')} between spherical joints, whose spin is not counted" if rods else ""
    if linkage.chain.is_closed:
        return {name: replace(equations[name], applies=False, why="a centre for each independent loop only")}
    vertices = f"V {model.free_vertices}, E {model.counted_rods}, P {len(model.on_plane)}, L {len(model.on_line)}"
    return {name: replace(equations[name], why=f"{vertices}, S+3 {len(model.centres)}{spins}")}


_FEW = 3  # legs that are named in a sentence: they are alike, and the rest is a number
_SPATIAL = 6  # equations that a loop in space closes with, and the freedoms of a body there
_ROD = 2  # joints of a rod between balls: its spin has no effect, even where the ring of its joints is all there is


@dataclass(frozen=True, slots=True)
class Passive:
    """Freedoms of one leg, by its joints, that move its own links only.

    `spins`: there is one such freedom, a turn about the line through two spherical joints.
    """

    joints: tuple[JointId, ...]
    freedoms: int
    spins: bool


def mobility_of_jointed(linkage: JointedLinkage) -> MobilityAnswer:
    """Return the mobility of a linkage with joints of all kinds: by count, and at its configuration as revolutes.

    Loops that are planar at this configuration count three equations each. ``counts["passive"]`` are the passive
    freedoms, ``counts["revolutes"]`` the revolutes whose axes give the degrees of freedom at the configuration.
    Without places there is no configuration; a note gives the degrees of freedom of a random realisation.
    """
    whole = placed(linkage)
    solids = revolutes_of(whole)
    infinitesimal = infinitesimal_mobility_of_axes(solids.chain, solids.axes)
    counted = with_planar_loops(linkage)
    report = report_of_joints(counted)
    passive = passive_freedoms(whole)
    notes = [*report.warnings, *linkage.notes, f"joints: {linkage.kinds_in_words}"]
    found = len(counted.chain.centred_loops) - len(linkage.chain.centred_loops)
    if found:
        notes.append(f"{numbered(found, 'loop')} planar at this configuration: 3 equations each")
    notes += _if_planar(linkage)
    general: dict[str, int] = {}
    if not linkage.places:
        general = {} if infinitesimal.dof is None else {"general_member": infinitesimal.dof}
        freedom = numbered(infinitesimal.dof or 0, "degree of freedom", "degrees of freedom")
        known = "degrees of freedom are unknown" if infinitesimal.dof is None else f"result is {freedom}"
        notes.append(f"a type without places: for a generic realisation, placed at random, the {known}")
    notes += _passive_notes(passive)
    counts = {
        **report.counts,
        "passive": sum(one.freedoms for one in passive),
        "revolutes": len(solids.chain.joints),
        **general,
    }
    answer = replace(MobilityAnswer.of(report), counts=counts, warnings=tuple(notes))
    if not linkage.places:
        return answer
    return replace(answer, infinitesimal=infinitesimal).with_notes(warnings=notes_on_singular_values(infinitesimal))


def _if_planar(linkage: JointedLinkage) -> Iterator[str]:
    """Yield the count of a type in a plane, if its joints allow it and no loop has a centre."""
    chain = linkage.chain
    if linkage.places or chain.loops or not chain.independent_loops:
        return
    if all(kind.planar for kind in linkage.kinds.values()):
        links = len(chain) - chain.components + 1
        planar = traditional_cgk(links, [kind.freedoms for kind in linkage.kinds.values()], 3)
        yield f"no loop has a centre: all are spatial; if all are planar (centre infinite), Eq. 1 gives {planar}"


def passive_freedoms(linkage: JointedLinkage) -> tuple[Passive, ...]:
    """Return the freedoms that move links of one leg only: those that a leg has with both its ends held.

    The linkage has places. In a leg with an open end, one that comes back to its first link, and a lone ring, each
    row between successive spherical joints is examined, with the ground or the longest row of a ring held.
    """
    screws = screws_of_joints(linkage)
    found = []
    for row in (row for leg in legs(linkage.chain) for row in _rows_between_ends(linkage, leg)):
        columns = np.hstack([screws[joint] for joint in row])
        rank = spectrum(columns, DOUBLE.closed).rank
        if rank is not None and rank < columns.shape[1]:
            free = columns.shape[1] - rank
            balls = sum(linkage.kinds[joint] is JointKind.SPHERICAL for joint in row)
            found.append(Passive(row, free, free == 1 and balls == 2))
    return tuple(found)


def _rows_between_ends(linkage: JointedLinkage, leg: Leg) -> list[tuple[JointId, ...]]:
    """Return the rows of a leg that may move while both their ends are held."""
    degree = dict(linkage.chain.degree)
    first, last = leg.links[0], leg.links[-1]
    if first != last and min(degree[first], degree[last]) > 1:
        return [leg.joints]
    balls = [place for place, joint in enumerate(leg.joints) if linkage.kinds[joint] is JointKind.SPHERICAL]
    rows = [leg.joints[a : b + 1] for a, b in pairwise(balls)]
    if first != last:
        return rows
    lone = degree[first] == 2
    if rows and lone and first != linkage.chain.ground:
        rows.append(leg.joints[balls[-1] :] + leg.joints[: balls[0] + 1])
        rows.remove(max(rows, key=len))
    # a lone ring of which all joints are between two balls is their line, about which the rest turns
    return [row for row in rows if not lone or len(row) < len(leg.joints) or len(row) == _ROD]


def _passive_notes(passive: tuple[Passive, ...]) -> Iterator[str]:
    """Yield the notes on passive degrees of freedom."""
    spinning = [one for one in passive if one.spins]
    others = [one for one in passive if not one.spins]
    for legs_, doing in ((spinning, "spin about the line through their spherical joints"), (others, "move alone")):
        if legs_:
            total = sum(one.freedoms for one in legs_)
            names = "; ".join(", ".join(map(shown, one.joints)) for one in legs_[:_FEW])
            more = f" and {len(legs_) - _FEW} more" if len(legs_) > _FEW else ""
            freedoms = numbered(total, "passive degree of freedom", "passive degrees of freedom")
            yield f"{freedoms}: legs that {doing} (joints {names}{more})"


def screws_of_joints(linkage: JointedLinkage) -> dict[JointId, Floats]:
    """Return the screws of all joints, lengths in units of the extent: joint to float[6, freedoms]."""
    points = np.array([place.point for place in linkage.places.values()], dtype=float).reshape(-1, 3)
    points = (points - points.mean(axis=0)) / (extent_of(points) or 1.0) if len(points) else points
    return {
        joint: _screws_of(linkage.kinds[joint], place, point)
        for (joint, place), point in zip(linkage.places.items(), points, strict=True)
    }


def _screws_of(kind: JointKind, place: JointPlace, point: Floats) -> Floats:
    axes = unit(np.reshape(place.axes, (-1, 3)))
    turns = np.eye(3) if kind is JointKind.SPHERICAL else axes[:0] if kind is JointKind.PRISMATIC else axes
    shifts = axes[:0]
    if kind in (JointKind.PRISMATIC, JointKind.CYLINDRICAL):
        shifts = axes
    elif kind is JointKind.PLANAR:
        shifts = frame_about(axes[0])[:2]
    turning = np.hstack([turns, np.cross(point, turns)]) if len(turns) else np.zeros((0, 6))
    sliding = np.hstack([np.zeros_like(shifts), shifts]) if len(shifts) else np.zeros((0, 6))
    return np.asarray(np.vstack([turning, sliding]).T)


def with_planar_loops(linkage: JointedLinkage) -> JointedLinkage:
    """Return a linkage whose loops that are planar at its configuration have an infinite centre.

    Loops that have a centre keep it. Without places nothing changes.
    """
    if not linkage.places:
        return linkage
    chain = linkage.chain
    points = np.array([place.point for place in linkage.places.values()])
    axes = np.array([axis for place in linkage.places.values() for axis in place.axes]).reshape(-1, 3)
    parallel = Tolerances.of(precision_of_axes(points, axes).size).parallel
    loops = [
        Loop(loop.joints, Centre.INFINITE)
        if not loop.has_centre and _is_planar(linkage, loop.joints, parallel)
        else loop
        for loop in independent_cycles(chain)
    ]
    if sum(loop.has_centre for loop in loops) == len(chain.centred_loops):
        return linkage
    whole = SCGraph(chain.nodes, chain.joints, loops, closing=chain.closing, ground=chain.ground)
    return JointedLinkage(whole, linkage.kinds, linkage.places)


def chain_with_centres(solids: HingedSolids) -> SCGraph:
    """Return the chain of hinged solids; loops without a centre whose axes meet or are parallel get it."""
    points, directions = (np.array([axis[part] for axis in solids.axes.values()]) for part in (0, 1))
    return centred_by_axes(solids.chain, solids.axes, precision_of_axes(points, directions).size)


def _is_planar(linkage: JointedLinkage, joints: Sequence[JointId], parallel: float) -> bool:
    """Return whether the joints of a loop move its links in one plane, and turn some of them."""
    if not all(linkage.kinds[joint].planar for joint in joints):
        return False
    turning = [joint for joint in joints if linkage.kinds[joint] is not JointKind.PRISMATIC]
    if not turning:
        return False
    axes = {joint: unit(linkage.places[joint].axes[0]) for joint in joints}
    normal = axes[turning[0]]
    if any(np.linalg.norm(np.cross(axes[joint], normal)) > parallel for joint in turning):
        return False
    return all(abs(axes[joint] @ normal) <= parallel for joint in joints if joint not in turning)
