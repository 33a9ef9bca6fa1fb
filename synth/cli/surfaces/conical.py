"""How ``synth cone`` prints linkages of several loops and their behaviour."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees
from typing import TYPE_CHECKING

from synth.cli.output import console, plain, table
from synth.cli.surfaces.circles import signs_text

if TYPE_CHECKING:
    from graphs.ids import JointId
    from synth.conformed.linkages import LinkageBehaviour
    from synth.surfaces.linkages import LinkageMap

__all__ = ["print_behaviours", "print_linkage"]


def print_linkage(linkage_map: LinkageMap) -> None:
    """Print the cones of a linkage of several loops."""
    from synth.surfaces.linkages import angles_on
    from synth.surfaces.several_loops import link_pairs

    out, chain = console(), linkage_map.linkage.chain
    link_of = link_pairs(chain)
    for cone in linkage_map.cones:
        out.print(f"lambda {degrees(cone.cone_angle):.10g} degrees")
        if cone.caution:
            out.print(cone.caution)
        rows = table("loop", "circuit", "signs", "k", numbers=["k"])
        for loop, circuit, signs, turns in zip(chain.loops, cone.circuits, cone.signs, cone.turns, strict=True):
            rows.add_row(_joints_text(loop.joints), circuit, signs_text(signs), str(turns))
        out.print(rows)
        rows = table("link", "joints", "angle (deg)", numbers=["angle (deg)"])
        for (a, b), angle in angles_on(linkage_map.linkage, cone).items():
            rows.add_row(plain(link_of[a, b]), _joints_text((a, b)), f"{angle:.8g}")
        out.print(rows)
    for family in linkage_map.families:
        low, high = (degrees(x) for x in family.interval)
        told = "; ".join(
            f"{_joints_text(loop.joints)}: {signs_text(signs)}, k {turns}"
            for loop, signs, turns in zip(chain.loops, family.signs, family.turns, strict=True)
        )
        out.print(f"every lambda between {low:.10g} and {high:.10g} degrees   ({told})")
        if family.caution:
            out.print(family.caution)
    if not linkage_map.cones and not linkage_map.families:
        out.print("no cone is common to all loops")


def _joints_text(joints: Sequence[JointId]) -> str:
    return plain(" ".join(map(str, joints)))


def print_behaviours(linkages: Sequence[LinkageBehaviour]) -> None:
    """Print what each linkage does."""
    out = console()
    if not linkages:
        out.print("no cone")
    for linkage in linkages:
        out.print(_verdict(linkage))
        row = linkage.table_row()
        if row is not None:
            special = ", a chord is a diameter" if row.special else ""
            out.print(f"Table 4: case {row.case}, {row.configuration}, {row.column}{special}")
        _print_links(linkage)


def _verdict(linkage: LinkageBehaviour) -> str:
    """Say in a line which way a linkage can go."""
    where = "any cone" if linkage.cone_angle is None else f"lambda {degrees(linkage.cone_angle):.10g} degrees"
    motion = linkage.behaviour.motion
    freedoms = int(motion.freedoms)
    if motion.undecided:
        verdict = "indeterminate: a singular value is near the noise"
    elif freedoms == 1:
        words = [word for word, so in zip(("intramobile", "extramobile"), linkage.mobile(), strict=True) if so]
        verdict = "can be " + " or ".join(words) if words else "transmobile"
    else:
        verdict = f"{freedoms} infinitesimal freedoms: no one way"
    if motion.nearly:
        verdict += f"; nearly mobile: {int(motion.nearly)} more freedom(s) but for small errors"
    return f"{where}, link {plain(linkage.chain.links[0])} fixed: {verdict}"


def _print_links(linkage: LinkageBehaviour) -> None:
    from synth.conformed.behaviours import icrl

    chain = linkage.chain
    rows = table("link", "joints", "moves", "ICRL (deg)", numbers=["ICRL (deg)"])
    lines = icrl(linkage.behaviour.motion.motions) + 0.0  # no minus before a zero
    for number, (link, joints) in enumerate(zip(chain.links, chain.joints_of, strict=True)):
        line = "" if lines[number] != lines[number] else f"{degrees(lines[number]):.6g}"
        way = "fixed" if number == 0 else linkage.way_of(number)
        rows.add_row(plain(link), _joints_text([chain.joints[joint] for joint in joints]), way, line)
    console().print(rows)
