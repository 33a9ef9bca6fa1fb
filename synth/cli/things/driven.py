"""Joints and numbers as they are typed: ``JOINT=DEGREES``, ``JOINT=RATE``."""

from __future__ import annotations

from math import radians
from typing import TYPE_CHECKING

import click

from synth.cli.output import plain

if TYPE_CHECKING:
    from graphs.mechanism.sc import SCGraph
    from graphs.types import JointId

__all__ = ["driven_angles", "numbers_of_joints"]


def driven_angles(graph: SCGraph, words: tuple[str, ...], option: str = "--drive") -> dict[JointId, float]:
    """Return the angles of joints, radians, as an option has them."""
    asked = numbers_of_joints(graph, words, option, "JOINT=DEGREES")
    return {joint: radians(angle) for joint, angle in asked.items()}


def numbers_of_joints(graph: SCGraph, words: tuple[str, ...], option: str, form: str) -> dict[JointId, float]:
    """Return joints and numbers of an option, ``form`` saying how they are typed."""
    from graphs.edit.named import joint_named

    asked = {}
    for word in words:
        joint, equals, number = word.rpartition("=")
        try:
            if not equals or not joint:
                raise ValueError
            value = float(number)
        except ValueError:
            raise click.BadParameter(f"{plain(word)!r} is not {form}", param_hint=option) from None
        asked[joint_named(graph, joint.strip())] = value
    return asked
