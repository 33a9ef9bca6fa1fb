"""How a motion from the conformed position is told: lines and tables."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING

from graphs.printing import Block, TableBlock, plain

if TYPE_CHECKING:
    from synth.moving.conical import ConicalMotion
    from synth.moving.conical_walk import Sense, Stretch

__all__ = ["blocks_of_motion"]


def blocks_of_motion(motion: ConicalMotion) -> list[Block]:
    """Return where a linkage goes from its conformed position."""
    chain, angle = motion.chain, motion.on_cone.cone_angle
    where = "" if angle is None else f"lambda {degrees(angle):.10g} degrees, "
    rows = [
        (plain(link), _stretches(motion.backward.ways[link]), _stretches(motion.forward.ways[link]))
        for link in chain.links[1:]
    ]
    return [
        f"{where}link {plain(chain.links[0])} fixed, joint {plain(motion.driver)} driven",
        f"range {_side(motion.backward)}, {_side(motion.forward)}",
        _circuit(motion),
        TableBlock(("link", "backward", "forward"), rows),
        *(_positions(motion) if motion.positions else []),
    ]


def _side(sense: Sense) -> str:
    told = f"to {degrees(sense.limit):.10g} degrees ({sense.ends})"
    if sense.one_way is None:
        return told
    way, end = sense.one_way
    return f"{told}, all links {way.name.lower()} to {degrees(end):.6g}"


def _circuit(motion: ConicalMotion) -> str:
    circuit = motion.circuit
    if not circuit.closed:
        return f"circuit not followed to its end: {circuit.stopped}"
    turning = [f"joint {plain(joint)} {turns:+d}" for joint, turns in motion.turns.items() if turns]
    told = f"circuit closed, loops to {circuit.error:.1e}; whole turns: {', '.join(turning) or 'none'}"
    if motion.meets:
        told += "; another circuit meets it at " + ", ".join(f"{degrees(turn):.6g}" for turn in motion.meets)
    return told


def _stretches(stretches: tuple[Stretch, ...]) -> str:
    return ", ".join(f"{each.way.name.lower()} to {degrees(each.end):.6g}" for each in stretches)


def _positions(motion: ConicalMotion) -> list[Block]:
    joints = list(motion.linkage.graph.joints)
    heads = ("at", *(f"joint {joint}" for joint in joints), "without turning back")
    rows = [
        (
            f"{degrees(each.at):g}",
            *(f"{degrees(turn):.8g}" for turn in each.angles),
            "yes" if each.direct else "no",
        )
        for each in motion.positions
    ]
    asked = {each.at for each in motion.positions}
    told = f"{len(motion.positions)} position(s) at {len(asked)} turn(s) that are reached"
    return [TableBlock(heads, rows, ["at"]), told]
