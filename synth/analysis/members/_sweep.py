"""Sweep: members of one type taken through given inputs, and what becomes of each.

Where joints are determined by count all members go at once (`synth.analysis.members.member_kernel`). Loops of most
crease patterns, and of spatial linkages that move, have redundant equations, so a square system does not decide them;
the walk of one member after the other does (`synth.analysis.motion.walk`): each moves as `synth.move` moves it.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError, SynthedraError, UnsolvableError, check_argument, numbered, shown
from graphs.geometry import lines_meet
from graphs.loops.loop import Centre
from graphs.printing import Block, Printed, TableBlock, plain
from graphs.tolerances import DOUBLE
from graphs.types import Flags, Floats, Ints, JointId
from synth.analysis.assembly.family import family_of
from synth.analysis.folding.configuration import SheetConfiguration
from synth.analysis.members.member_dimensions import (
    MemberDimensions,
    batch_of,
    checked_coordinates,
    spatial_axes,
    type_of,
)
from synth.analysis.members.member_kernel import BARRED, CLOSED, OPEN, TURNS_BACK, Swept, swept
from synth.analysis.motion.configuration import Configuration
from synth.analysis.motion.driven_motion import MotionOptions, driven_from
from synth.analysis.moving._configuration_of import Movable, configuration_of

STATES = ("closed", "turns back", "not reached", "cannot close")
"""What becomes of a member at given inputs; its state is the place in this list.

It is closed there. Its driven joint turns back before, or within 1e-4 radians (with several, the inputs are not
reached). It is not reached from the mechanism's configuration, its loops do not stay closed on the way or it is
singular. Its loops cannot close at all.
"""

_OTHER_QUESTION = "sweep takes other members of the type through inputs, on the assembly mode of this configuration"


@dataclass(frozen=True, slots=True, repr=False)
class Sweep(Printed):
    """Many members of one type at inputs. All arrays have a row for each member and each of the inputs.

    Attributes
    ----------
    configuration : Configuration
        The mechanism that was given.
    joints, driven : tuple of joint id
        Those whose angles are listed; those that are driven.
    inputs : float[F, D] or float[N, F, D]
        Of the driven joints, radians, of prismatic joints lengths.
    angles : float[N, F, J]
        Radians, not wrapped; lengths of prismatic joints; nan where a member is not closed.
    residuals : float[N, F]
        Loop-closure residuals, radians and parts of the extent; nan where a member is not closed.
    state : int8[N, F]
        Places in `STATES`.
    why : mapping of int to str
        Of members that cannot close, or do not move, what is wrong with them, where more is known.

    Examples
    --------
    >>> from synth.catalogue.patterns import generate
    >>> ring = generate("four-bar").mechanism
    >>> sweep(ring, {"arcs": {(0, 1): np.radians([65, 70, 75])}}, drive={0: np.radians([0, 10, 20])})
    <Sweep: 3 members at 3 inputs, 9 of 9 closed>
    """

    configuration: Configuration
    joints: tuple[JointId, ...]
    driven: tuple[JointId, ...]
    inputs: Floats
    angles: Floats
    residuals: Floats
    state: npt.NDArray[np.int8]
    why: Mapping[int, str]

    def __len__(self) -> int:
        return len(self.state)

    @property
    def closed(self) -> Flags:
        """Where members are closed: bool[N, F]."""
        return np.asarray(self.state == CLOSED)

    @property
    def counts(self) -> dict[str, int]:
        """How many configurations have each state."""
        return dict(zip(STATES, np.bincount(self.state.ravel(), minlength=len(STATES)).tolist(), strict=True))

    def __repr__(self) -> str:
        members, rows = numbered(len(self), "member"), numbered(self.state.shape[1], "input")
        return f"<Sweep: {members} at {rows}, {int(self.closed.sum())} of {self.state.size} closed>"

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        driven = ", ".join(map(plain, self.driven))
        lines: list[Block] = [
            f"{numbered(len(self), 'member')}, each at {numbered(self.state.shape[1], 'input')} of joint {driven}"
        ]
        rows = [(state, str(count)) for state, count in self.counts.items() if count]
        if rows:
            lines.append(TableBlock(("state", "configurations"), rows, ["configurations"]))
        if self.closed.any():
            lines.append(f"largest loop-closure residual: {np.nanmax(self.residuals):.1e}")
        lines += [f"member {member}: {plain(why, 200)}" for member, why in list(self.why.items())[:10]]
        return lines

    def to_json(self) -> dict[str, Any]:
        """Return all as plain data; angles in radians, null where a member is not closed."""
        return {
            "configuration": self.configuration.to_json(other_question=_OTHER_QUESTION),
            "joints": list(self.joints),
            "driven": list(self.driven),
            "inputs": self.inputs.tolist(),
            "states": list(STATES),
            "state": self.state.tolist(),
            "angles": _listed(self.angles, self.closed),
            "residuals": _listed(self.residuals, self.closed),
            "why": {str(member): why for member, why in self.why.items()},
        }


def sweep(
    mechanism: Movable,
    parameters: MemberDimensions,
    *,
    drive: Mapping[JointId, npt.ArrayLike],
    joints: Sequence[JointId] | None = None,
    report: Callable[[int], None] | None = None,
) -> Sweep:
    """Take many members of a type through given inputs, arrays in and out: each stays on its assembly mode.

    Parameters
    ----------
    mechanism : Movable
        With coordinates; it gives the type, and the assembly mode.
    parameters : mapping
        The dimensions of N members, of one kind. ``"arcs"``: radians between axes that follow each other in a loop,
        float[N, A] in the order of `arcs_of`, or a mapping of pairs of joints to float[N], the others being those of
        the mechanism; the angle between two arcs of a link stays. ``"axes"``: directions of all joints where
        spherical loops are closed, float[N, J, 3]. ``"points"``: of all joints where planar loops are closed, float[N,
        J, 3], in the unit of the coordinates. Of a linkage with a spatial loop one of these or both, each member being
        moved by itself, which takes milliseconds, from where its axes are. ``"coordinates"``: vertices of a crease
        pattern, float[N, V, 2 or 3]; where it is flat, or has more closure equations than creases to solve them for,
        each member is folded by itself too. Empty: the mechanism alone, which may have spatial loops.
    drive : mapping of joint id to float[F] or float[N, F]
        Radians; of creases fold angles, of other joints from the configuration of the mechanism, or from the axes
        that are given; of prismatic joints lengths. They are gone through one after the other. As many joints as
        there are degrees of freedom.
    joints : sequence of joint id, optional
        Those whose angles are returned; by default all.
    report : callable, optional
        Called with the number of members that are done.

    Returns
    -------
    Sweep
        Members that do not close at some inputs say so in `state`; none is left out.

    Raises
    ------
    UnsolvableError
        If the mechanism has no coordinates, arcs are given of a spatial loop, or so many driven joints do not
        determine the others.
    InvariantError
        If arrays do not fit each other or the mechanism, or have numbers out of range.

    Examples
    --------
    A four-bar whose arcs are known to five degrees:

    >>> from synth.catalogue.patterns import generate
    >>> ring, random = generate("four-bar").mechanism, np.random.default_rng(1)
    >>> arcs = np.radians([75, 80, 70, 85] + random.uniform(-5, 5, (100, 4)))
    >>> swept = sweep(ring, {"arcs": arcs}, drive={3: np.linspace(0, 1, 11)})
    >>> swept, swept.angles.shape, bool(np.nanmax(swept.residuals) < 1e-12)
    (<Sweep: 100 members at 11 inputs, 1100 of 1100 closed>, (100, 11, 4), True)
    """
    check_argument("sweep", mechanism, Movable)
    at = configuration_of(mechanism, slides=True)
    linkage = at.linkage
    names = list(linkage.graph.joints)
    for joint in [*drive, *(joints or ())]:
        if joint not in names:
            raise InvariantError("joint", f"{shown(joint)} is no joint of the mechanism", "one of its joints")
    driven = np.array([names.index(joint) for joint in drive], dtype=np.int64)
    walks = set(parameters) <= _walked_kinds(at)
    if walks and (_is_flat(at) or not _determined(at, drive)):
        return _walked(at, parameters, drive, driven, joints, report)
    family, of_mechanism = family_of(linkage, list(drive))
    batch = batch_of(at, family, of_mechanism, parameters, driven)
    count = len(batch.barred)
    units = np.ones(len(names))
    units[list(linkage.slides)] = linkage.extent
    inputs = _inputs(drive, count)
    listed = names if joints is None else list(joints)
    places = np.array([names.index(joint) for joint in listed], dtype=np.int64)
    in_loops = [joint for joint in listed if joint in family.joints]
    columns = family.column[[family.joints.index(joint) for joint in in_loops]]
    zero = np.broadcast_to(batch.zero, (count, len(names)))
    shared = batch.zero.ndim == 1
    turned = inputs / units[driven] - (batch.zero[driven] if shared else zero[:, None, driven])
    answer = swept(type_of(family), batch.members, np.ascontiguousarray(turned), count, columns, report)
    state, residuals = answer.status, answer.residuals
    state[batch.barred], residuals[batch.barred] = BARRED, np.nan
    angles = answer.angles
    if len(in_loops) < len(listed):  # the others stay as they are
        angles = np.zeros((*state.shape, len(listed)))
        angles[..., [joint in family.joints for joint in listed]] = answer.angles
    offset = zero[0, places] if shared and count else zero[:, None, places]
    if offset.any():
        angles += offset
    if linkage.slides:
        angles *= units[places]
    angles[batch.barred] = np.nan
    if len(in_loops) < len(listed):
        angles[state != CLOSED] = np.nan
    return Sweep(at, tuple(listed), tuple(drive), inputs, angles, residuals, state, batch.why)


def _determined(at: Configuration, drive: Mapping[JointId, object]) -> bool:
    """Tell whether so many driven joints determine the others by count, and no loop is spatial."""
    try:
        family_of(at.linkage, list(drive))
    except UnsolvableError:
        return False
    return True


def _walked_kinds(at: Configuration) -> set[str]:
    """Return the kinds of dimensions of members that can be moved one after the other."""
    if isinstance(at, SheetConfiguration):
        return {"coordinates"}
    spatial = any(loop.centre is Centre.NONE for loop in at.linkage.loops)
    return {"axes", "points"} if spatial else set()


def _is_flat(at: Configuration) -> bool:
    return isinstance(at, SheetConfiguration) and at.flat


def _walked(
    at: Configuration,
    parameters: MemberDimensions,
    drive: Mapping[JointId, npt.ArrayLike],
    driven: Ints,
    joints: Sequence[JointId] | None,
    report: Callable[[int], None] | None,
) -> Sweep:
    """Move members one after the other: they are flat, or joints are not determined by count."""
    members: Sequence[Callable[[], Configuration]] = [lambda: at]
    if isinstance(at, SheetConfiguration) and parameters:
        members = sheets_at(at, checked_coordinates(at, parameters["coordinates"]))
    elif parameters:
        members = linkages_at(at, *spatial_axes(at.linkage, parameters))
    inputs = _inputs(drive, len(members))
    units = np.ones(len(at.joints))
    units[list(at.linkage.slides)] = at.linkage.extent
    answer, why = walked(members, driven, inputs / units[driven], len(at.joints), report)
    answer.angles[:] *= units
    listed = at.joints if joints is None else tuple(joints)
    angles = answer.angles[..., [at.joints.index(joint) for joint in listed]]
    return Sweep(at, tuple(listed), tuple(drive), inputs, angles, answer.residuals, answer.status, why)


def _listed(values: Floats, there: Flags) -> list[Any]:
    """Return values as lists, with None where there is none."""
    listed = values.astype(object)
    listed[~there] = None
    return list(listed.tolist())


def _inputs(drive: Mapping[JointId, npt.ArrayLike], count: int) -> Floats:
    """Return the inputs of all members, float[F, D], or of each, float[N, F, D]."""
    columns = [np.asarray(values, dtype=float) for values in drive.values()]
    for joint, values in zip(drive, columns, strict=True):
        if values.ndim not in (1, 2) or (values.ndim == 2 and len(values) not in (1, count)):
            raise InvariantError(
                "inputs", f"inputs of shape {values.shape} for joint {shown(joint)}", f"float[F] or float[{count}, F]"
            )
        if not np.isfinite(values).all():
            raise InvariantError("inputs", f"the inputs of joint {shown(joint)} are not all numbers", "finite numbers")
    if not columns:
        return np.zeros((1, 0))
    if len({values.shape[-1] for values in columns}) > 1:
        lengths = ", ".join(str(values.shape[-1]) for values in columns)
        raise InvariantError("inputs", f"{lengths} inputs of the driven joints", "as many of each")
    return np.stack(np.broadcast_arrays(*columns), axis=-1)


def walked(
    members: Sequence[Callable[[], Configuration]],
    driven: Ints,
    inputs: Floats,
    joints: int,
    report: Callable[[int], None] | None,
) -> tuple[Swept, dict[int, str]]:
    """Move members, each made when it is its turn, to inputs, float[F, D] or float[N, F, D]: radians.

    Return the angles of all joints, and why members have none.
    """
    rows = inputs.shape[-2]
    answer = Swept(
        np.full((len(members), rows, joints), np.nan),
        np.full((len(members), rows), np.nan),
        np.full((len(members), rows), BARRED, dtype=np.int8),
    )
    why: dict[int, str] = {}
    for member, made in enumerate(members):
        try:
            own = made()
            answer.status[member] = OPEN
            for places, angles, errors in _moved(own, driven, inputs[member] if inputs.ndim == 3 else inputs):
                answer.status[member, places] = TURNS_BACK
                reached = places[: len(angles)]
                answer.status[member, reached] = CLOSED
                answer.angles[member, reached], answer.residuals[member, reached] = angles, errors
        except SynthedraError as error:
            why[member] = str(error)
        if report is not None:
            report(member + 1)
    return answer, why


def sheets_at(at: SheetConfiguration, coordinates: Floats) -> list[Callable[[], Configuration]]:
    """Return what makes the configuration of a crease pattern with each of some vertices, float[N, V, 3]."""

    def made(corners: Floats) -> Configuration:
        return configuration_of(replace(at.sheet, coordinates=tuple(map(tuple, corners.tolist()))))

    return [partial(made, corners) for corners in coordinates]


def linkages_at(at: Configuration, axes: Floats, points: Floats) -> list[Callable[[], Configuration]]:
    """Return what makes the configuration of a linkage with each of some axes, float[N, J, 3] both, in extents.

    Any axes are those of a linkage that closes where they are; but a loop about a centre, or a planar one, remains so.
    """
    linkage = at.linkage

    def made(along: Floats, places: Floats) -> Configuration:
        for loop in linkage.loops:
            joints = list(loop.joints)
            if loop.centre is Centre.FINITE and lines_meet(places[joints], along[joints]).off.max() > DOUBLE.meant:
                raise UnsolvableError("the axes of a loop about a centre do not meet in a point")
            if loop.centre is Centre.INFINITE:
                turning = along[[joint for joint in joints if joint not in linkage.slides]]
                if np.abs(np.cross(turning, turning[:1])).max(initial=0.0) > DOUBLE.meant:
                    raise UnsolvableError("the axes of a planar loop are not parallel")
        return replace(at, linkage=replace(linkage, directions=along, points=places))

    return [partial(made, along, places) for along, places in zip(axes, points, strict=True)]


def _moved(own: Configuration, driven: Ints, values: Floats) -> Iterator[tuple[Ints, Floats, Floats]]:
    """Yield numbers of inputs, in the order in which they are come to, and the configurations at the first of them.

    One joint goes from where it is to larger angles, and to smaller ones; several go from input to input.
    """
    start = own.linkage.angles[driven]
    ways = [np.arange(len(values))]
    if len(driven) == 1:
        rising = np.argsort(values[:, 0], kind="stable")
        above = values[rising, 0] >= start[0]
        ways = [rising[above], rising[~above][::-1]]
    names = [own.joints[place] for place in driven.tolist()]
    for places in filter(len, ways):
        wanted = values[places]
        here = np.abs(wanted - start).max(axis=1) <= DOUBLE.closed
        if here.all():
            yield places, np.tile(own.linkage.angles, (len(places), 1)), np.zeros(len(places))
            continue
        goals = dict(zip(names, wanted[-1].tolist(), strict=True))
        path = driven_from(own, MotionOptions(goals, frames=len(wanted), values=wanted)).path
        frame, found = 0, list[int]()
        for value in wanted:  # frames at turning points stand between those at inputs
            off = np.abs(path.angles[frame:][:, driven] - value).max(axis=1) <= DOUBLE.same_configuration
            if not off.any():
                break
            frame += int(off.argmax())
            found.append(frame)
        yield places, path.angles[found], path.errors[found]
