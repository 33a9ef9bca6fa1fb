"""How ``synth cone move`` prints motions."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING

import click

from synth.cli.output import console, plain, table

if TYPE_CHECKING:
    from synth.moving.conical import ConicalMotion
    from synth.moving.conical_walk import Sense, Stretch

__all__ = ["print_motion"]


def print_motion(motion: ConicalMotion) -> None:
    """Print where a linkage goes from its conformed position."""
    chain, angle = motion.chain, motion.on_cone.cone_angle
    where = "" if angle is None else f"lambda {degrees(angle):.10g} degrees, "
    click.echo(f"{where}link {plain(chain.links[0])} fixed, joint {plain(motion.driver)} driven")
    click.echo(f"range {_side(motion.backward)}, {_side(motion.forward)}")
    click.echo(_circuit(motion))
    rows = table("link", "backward", "forward")
    for link in chain.links[1:]:
        rows.add_row(plain(link), _stretches(motion.backward.ways[link]), _stretches(motion.forward.ways[link]))
    console().print(rows)
    if motion.positions:
        _print_positions(motion)


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


def _print_positions(motion: ConicalMotion) -> None:
    joints = list(motion.linkage.graph.joints)
    rows = table("at", *(f"joint {joint}" for joint in joints), "without turning back", numbers=["at"])
    for each in motion.positions:
        turns = [f"{degrees(turn):.8g}" for turn in each.angles]
        rows.add_row(f"{degrees(each.at):g}", *turns, "yes" if each.direct else "no")
    console().print(rows)
    asked = {each.at for each in motion.positions}
    click.echo(f"{len(motion.positions)} position(s) at {len(asked)} turn(s) that are reached")
