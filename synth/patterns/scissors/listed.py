"""The generators of scissors. Theory: docs/theory/generators.md."""

from __future__ import annotations

from graphs.joints.linkage import JointedLinkage
from synth.patterns.generator import Generator, Parameter, angle, count
from synth.patterns.scissors.elements import (
    CUBE,
    OCTAHEDRON,
    TETRAHEDRON,
    Corners,
    prism,
    scissor_polyhedron,
    scissor_ring,
)

__all__ = ["GENERATORS"]

_SOURCE = "Hoberman 1990; Wampler, Larson, Erdman 2007, Figs. 13 to 18"


def _opening(default: float, most: float) -> tuple[Parameter, ...]:
    meaning = "angle between an arm and the perpendicular from its pin to the ray on which it ends"
    return (angle("opening", default, 10, most, meaning),)


def _polyhedron(name: str, corners: Corners, default: float, most: float) -> Generator:
    def make(opening: float) -> JointedLinkage:
        return scissor_polyhedron(corners, opening)

    return Generator(
        f"scissor-{name}", f"{name.capitalize()} of kinked scissors", make, _opening(default, most), lambda _: 1,
        _KINKS, _SOURCE,
    )  # fmt: skip


def _prism(sides: int, opening: float) -> JointedLinkage:
    return scissor_polyhedron(prism(sides), opening)


_KINKS = "arms alike, kinks of 180 degrees minus the angle between the rays to neighbouring "
"corners"

GENERATORS = (
    Generator(
        "scissor-ring", "Ring of kinked scissors in a plane", scissor_ring,
        (count("scissors", 10, 4, 24, "number of scissors in the ring"), *_opening(30, 44)),
        lambda _: 1, "arms alike, kinks of 180 degrees minus 360 degrees divided by the number of scissors",
        _SOURCE,
    ),
    _polyhedron("tetrahedron", TETRAHEDRON, 20, 34),
    _polyhedron("cube", CUBE, 30, 54),
    _polyhedron("octahedron", OCTAHEDRON, 30, 44),
    Generator(
        "scissor-prism", "Prism of kinked scissors", _prism,
        (count("sides", 3, 3, 6, "number of sides of the end polygons"), *_opening(30, 48)), lambda _: 1,
        f"{_KINKS}, all of which are one; besides it has flexes to first order, as the cube has", _SOURCE,
    ),
)  # fmt: skip
