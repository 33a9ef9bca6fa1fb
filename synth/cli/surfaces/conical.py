"""What ``synth cone`` does with linkages of several loops and with behaviour: computing, printing, JSON."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import degrees
from typing import TYPE_CHECKING, Any

from synth.cli.output import console, plain, table
from synth.cli.surfaces.circles import signs_text

if TYPE_CHECKING:
    import numpy.typing as npt

    from graphs.ids import JointId
    from graphs.mechanism.conical import ConicalLinkage
    from graphs.mechanism.sc import SCGraph
    from synth.conformed.behaviours import Behaviour
    from synth.conformed.rates import ConformedChain
    from synth.surfaces.linkage_cones import CommonCone, CommonFamily

__all__ = [
    "CommonMap",
    "OnCone",
    "behaviours_json",
    "behaviours_of",
    "by_angles",
    "linkage_json",
    "loop_of_steps",
    "loop_on_cones",
    "mapped",
    "on_cones",
    "print_behaviours",
    "print_linkage",
]


@dataclass(frozen=True, slots=True)
class CommonMap:
    """Cones on which a linkage of several loops lies."""

    cones: tuple[CommonCone, ...]
    families: tuple[CommonFamily, ...]


@dataclass(frozen=True, slots=True)
class OnCone:
    """A linkage at its conformed position; without a cone angle, on any cone."""

    chain: SCGraph
    places: Sequence[float]
    cone_angle: float | None


@dataclass(frozen=True, slots=True)
class Found:
    """What a linkage does there."""

    chain: ConformedChain
    places: npt.NDArray[Any]
    cone_angle: float | None
    behaviour: Behaviour


# ---- mapping ------------------------------------------------------------------------------------------------


def by_angles(linkage: ConicalLinkage) -> ConicalLinkage:
    """Return a linkage given by steps and lambda as one that is given by all its link angles."""
    from graphs.errors import UnsolvableError
    from graphs.mechanism.conical import ConicalLinkage
    from synth.surfaces.cone import link_angles
    from synth.surfaces.several_loops import link_pairs

    if linkage.steps is None:
        return linkage
    if linkage.cone_angle is None:
        raise UnsolvableError("steps without a cone angle have no link angles: expected 'lambda_deg'")
    at = dict(zip(linkage.chain.joints, linkage.places(), strict=True))
    angles = {(a, b): float(link_angles(at[b] - at[a], linkage.cone_angle)) for a, b in link_pairs(linkage.chain)}
    return ConicalLinkage(linkage.chain, angles=angles)


def mapped(linkage: ConicalLinkage, tolerance: float) -> CommonMap:
    """Return the cones of a linkage: from its link angles, or, given steps, the one named or every one."""
    from synth.surfaces.linkage_cones import CommonCone, CommonFamily, common_cones

    if linkage.angles is not None:
        return CommonMap(*common_cones(linkage.chain, linkage.angles, tolerance))
    import numpy as np

    from synth.surfaces.several_loops import loop_steps

    places = np.array(linkage.places())
    loops = loop_steps(linkage.chain, places)
    mirror = -1 if loops[0].steps[0] < 0 else 1
    signs = tuple(tuple((mirror * np.sign(loop.steps)).astype(int).tolist()) for loop in loops)
    turns = tuple(int(mirror * loop.circuits.turns) for loop in loops)
    if linkage.cone_angle is None:
        return CommonMap((), (CommonFamily((0.0, np.pi / 2), signs, turns),))
    circuits = tuple(str(loop.circuits.names()) for loop in loops)
    residual = max(abs(float(loop.circuits.residual)) for loop in loops)
    named = dict(zip(linkage.chain.joints, places.tolist(), strict=True))
    return CommonMap((CommonCone(linkage.cone_angle, signs, turns, circuits, named, residual),), ())


def linkage_json(linkage: ConicalLinkage, found: CommonMap) -> dict[str, Any]:
    """Return what scripts rely on: ``cones``, ``families``, a list a loop for circuit, signs and k; and more."""
    return {
        "loops": [list(map(str, loop.joints)) for loop in linkage.chain.loops],
        "cones": [
            {
                "lambda_deg": degrees(one.cone_angle),
                "circuit": list(one.circuits),
                "signs": [list(signs) for signs in one.signs],
                "k": list(one.turns),
                "azimuths_deg": _named_degrees(one.places),
                "link_angles_deg": [[str(a), str(b), angle] for (a, b), angle in _angles(linkage, one)],
                "residual_deg": degrees(one.residual),
            }
            for one in found.cones
        ],
        "families": [
            {
                "lambda_deg": [degrees(x) for x in one.interval],
                "signs": [list(signs) for signs in one.signs],
                "k": list(one.turns),
            }
            for one in found.families
        ],
    }


def _named_degrees(places: Mapping[JointId, float]) -> dict[str, float]:
    return {str(joint): round(degrees(place), 12) for joint, place in places.items()}


def _angles(linkage: ConicalLinkage, one: CommonCone) -> list[tuple[tuple[JointId, JointId], float]]:
    """Return the link angles between all joints of each link, degrees."""
    from synth.surfaces.cone import link_angles
    from synth.surfaces.several_loops import link_pairs

    return [
        ((a, b), round(degrees(float(link_angles(one.places[b] - one.places[a], one.cone_angle))), 12))
        for a, b in link_pairs(linkage.chain)
        if a in one.places and b in one.places
    ]


def print_linkage(linkage: ConicalLinkage, found: CommonMap) -> None:
    """Print the cones of a linkage of several loops."""
    out = console()
    for one in found.cones:
        out.print(f"lambda {degrees(one.cone_angle):.10g} degrees")
        rows = table("loop", "circuit", "signs", "k", numbers=["k"])
        for loop, circuit, signs, turns in zip(
            linkage.chain.loops, one.circuits, one.signs, one.turns, strict=True
        ):
            rows.add_row(_joints_text(loop.joints), circuit, signs_text(signs), str(turns))
        out.print(rows)
        rows = table("link", "joints", "angle (deg)", numbers=["angle (deg)"])
        from synth.surfaces.several_loops import link_pairs

        link_of = link_pairs(linkage.chain)
        for (a, b), angle in _angles(linkage, one):
            rows.add_row(plain(link_of[a, b]), _joints_text((a, b)), f"{angle:.8g}")
        out.print(rows)
    for family in found.families:
        low, high = (degrees(x) for x in family.interval)
        told = "; ".join(
            f"{_joints_text(loop.joints)}: {signs_text(signs)}, k {turns}"
            for loop, signs, turns in zip(linkage.chain.loops, family.signs, family.turns, strict=True)
        )
        out.print(f"every lambda between {low:.10g} and {high:.10g} degrees   ({told})")
    if not found.cones and not found.families:
        out.print("no cone is common to all loops")


def _joints_text(joints: Sequence[JointId]) -> str:
    return plain(" ".join(map(str, joints)))


# ---- behaviour ------------------------------------------------------------------------------------------------


def on_cones(linkage: ConicalLinkage, cone_angle: float | None) -> list[OnCone]:
    """Return a linkage on each of its cones, from link angles or from steps."""
    from graphs.errors import UnsolvableError

    if linkage.steps is not None:
        return [OnCone(linkage.chain, linkage.places(), cone_angle or linkage.cone_angle)]
    if cone_angle is not None:
        raise UnsolvableError("link angles tell the cone themselves: leave --lambda out")
    return [
        OnCone(linkage.chain, [one.places[joint] for joint in linkage.chain.joints], one.cone_angle)
        for one in mapped(linkage, 1e-7).cones
    ]


def loop_on_cones(angles: Sequence[float]) -> list[OnCone]:
    """Return a loop on each of its cones."""
    from synth.surfaces.circuit import azimuths
    from synth.surfaces.cone import map_to_cones

    return [
        OnCone(_ring(len(angles)), azimuths(one.steps).tolist(), one.size) for one in map_to_cones(angles).cones
    ]


def loop_of_steps(steps: Sequence[float], cone_angle: float | None) -> OnCone:
    """Return a loop from its steps round the cone; the last is added if the rest do not close."""
    from math import pi

    from graphs.errors import InvariantError
    from synth.surfaces.circuit import azimuths, closing_step

    given = list(steps)
    for place, step in enumerate(given):
        if not 0.0 < abs(step) <= pi + 1e-12:
            told = f"step {place + 1} is {degrees(step):.12g} degrees"
            raise InvariantError("step", told, "between -180 and 180, and not 0")
    last = float(closing_step(given))
    if abs(last) > 1e-9:
        given.append(last)
    if len(given) < 3:
        raise InvariantError("step", f"{len(given)} steps", "three or more")
    return OnCone(_ring(len(given)), azimuths(given).tolist(), cone_angle)


def _ring(links: int) -> SCGraph:
    """Return a loop whose link i lies between joints i and i + 1, counted from 1."""
    from graphs.loops.loop import Loop
    from graphs.mechanism.sc import SCGraph

    joints = {str(i + 1): ((i - 1) % links + 1, i + 1) for i in range(links)}
    return SCGraph(range(1, links + 1), joints, [Loop(tuple(joints))])


def behaviours_of(given: Sequence[OnCone], ground: str | None) -> list[Found]:
    """Return what each linkage does, one link fixed."""
    import numpy as np

    from synth.cli.graphs.reduce import link_named
    from synth.conformed.behaviours import behaviour
    from synth.conformed.rates import ConformedChain

    found = []
    for one in given:
        fixed = None if ground is None else link_named(one.chain, ground)
        chain = ConformedChain.of(one.chain, fixed)
        places = np.array(one.places)
        found.append(Found(chain, places, one.cone_angle, behaviour(chain, places)))
    return found


def behaviours_json(found: Sequence[Found]) -> dict[str, Any]:
    """Return a document with an object a linkage."""
    return {"linkages": [_behaviour_json(one) for one in found]}


def _behaviour_json(one: Found) -> dict[str, Any]:
    from synth.conformed.behaviours import Way, icrl

    motion = one.behaviour.motion
    lines = icrl(motion.motions)
    row, intra, extra = _mobile(one)
    return {
        "lambda_deg": None if one.cone_angle is None else degrees(one.cone_angle),
        "azimuths_deg": {
            str(joint): round(degrees(place), 12)
            for joint, place in zip(one.chain.joints, one.places.tolist(), strict=True)
        },
        "ground": str(one.chain.links[0]),
        "freedoms": int(motion.freedoms),
        "rank": int(motion.rank()),
        "singular_values": motion.singular_values.tolist(),
        "intramobile": intra,
        "extramobile": extra,
        "links": [
            {
                "link": str(link),
                "joints": [str(one.chain.joints[joint]) for joint in joints],
                "way": Way(int(one.behaviour.ways[number])).name.lower(),
                "icrl_deg": _finite(degrees(lines[number])),
                "instant_centre": _centre(motion.motions[number]),
            }
            for number, (link, joints) in enumerate(zip(one.chain.links, one.chain.joints_of, strict=True))
        ],
        "tangent": [
            str(joint) for joint, is_so in zip(one.chain.joints, one.behaviour.tangent, strict=True) if is_so
        ],
        "table4": row,
    }


def _mobile(one: Found) -> tuple[dict[str, Any] | None, bool, bool]:
    """Return the row of Table 4 (four-bars), and whether the linkage can be intra- and extramobile."""
    from graphs.errors import InvariantError
    from synth.conformed.twelve_cases import table_row

    both = bool(one.behaviour.one_way)
    ordered = _around(one.chain)
    if ordered is None:
        return None, both, both
    try:
        row = table_row(one.places[ordered])
    except InvariantError:  # two joints on one ruling line have no row
        return None, both, both
    told = {"case": row.case, "configuration": row.configuration, "column": row.column, "diameter": row.special}
    return told, row.intramobile, row.extramobile


def _around(chain: ConformedChain) -> list[int] | None:
    """Return the joints O, A, B, C of a four-bar whose ground link is C O."""
    if len(chain.links) != 4 or len(chain.joints) != 4 or any(len(joints) != 2 for joints in chain.joints_of):
        return None
    c, o = chain.joints_of[0]
    a = next(sum(joints) - o for joints in chain.joints_of[1:] if o in joints)
    return [o, a, 6 - o - a - c, c]


def _finite(value: float) -> float | None:
    return value if abs(value) < float("inf") else None


def _centre(motion: npt.NDArray[Any]) -> list[float] | None:
    from synth.conformed.behaviours import instant_centres

    x, y = instant_centres(motion).tolist()
    return [x, y] if abs(x) < 1e12 and abs(y) < 1e12 else None


def print_behaviours(found: Sequence[Found]) -> None:
    """Print what each linkage does."""
    from synth.conformed.behaviours import Way, icrl

    out = console()
    if not found:
        out.print("no cone")
    for one in found:
        motion = one.behaviour.motion
        where = "any cone" if one.cone_angle is None else f"lambda {degrees(one.cone_angle):.10g} degrees"
        row, intra, extra = _mobile(one)
        ground = plain(one.chain.links[0])
        if motion.freedoms == 1:
            words = [word for word, is_so in (("intramobile", intra), ("extramobile", extra)) if is_so]
            verdict = "can be " + " or ".join(words) if words else "transmobile"
        else:
            verdict = f"{int(motion.freedoms)} infinitesimal freedoms: no one way"
        out.print(f"{where}, link {ground} fixed: {verdict}")
        if row is not None:
            special = ", a chord is a diameter" if row["diameter"] else ""
            out.print(f"Table 4: case {row['case']}, {row['configuration']}, {row['column']}{special}")
        rows = table("link", "joints", "moves", "ICRL (deg)", numbers=["ICRL (deg)"])
        lines = icrl(motion.motions)
        for number, (link, joints) in enumerate(zip(one.chain.links, one.chain.joints_of, strict=True)):
            way = Way(int(one.behaviour.ways[number])).name.lower()
            line = "" if lines[number] != lines[number] else f"{degrees(lines[number]):.6g}"
            rows.add_row(
                plain(link), _joints_text([one.chain.joints[joint] for joint in joints]),
                "fixed" if number == 0 else way, line,
            )  # fmt: skip
        out.print(rows)
