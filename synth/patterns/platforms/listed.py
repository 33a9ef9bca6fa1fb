"""The generators of parallel platforms. Theory: docs/theory/joints.md."""

from __future__ import annotations

from graphs.joints.linkage import JointedLinkage
from synth.patterns.generator import Generator, Parameter, angle, length
from synth.patterns.platforms.legs import platform, translating_platform

__all__ = ["GENERATORS"]

_RADII = (length("base", 1.0, 0.5, 10, "radius of the feet"), length("top", 0.6, 0.1, 10, "radius of the heads"))
_HEIGHT = length("height", 1.0, 0.3, 10, "height of the top over the base")
_GAP = angle("gap", 30, 5, 50, "angle between the two feet, and the two heads, of a pair")
_OUT = length("out", 0.4, 0.1, 10, "distance of the knees from the line from foot to head")


def _generator(
    name: str, title: str, legs: tuple[str, int], more: tuple[Parameter, ...], told: tuple[int, str, str]
) -> Generator:
    letters, number = legs
    freedoms, conditions, source = told

    def make(**values: float) -> JointedLinkage:
        return platform(letters, number, **values)

    parameters, relations = (*_RADII, _HEIGHT, *more), "base and top differ" if number == 3 else ""
    return Generator(name, title, make, parameters, lambda _: freedoms, conditions, source, relations=relations)


GENERATORS = (
    _generator(
        "stewart", "Platform on six UPS legs", ("UPS", 6), (_GAP,),
        (6, "no leg removes a degree of freedom: 36 - 30", "Stewart 1965; Hunt 1983"),
    ),
    _generator(
        "6-sps", "Platform on six SPS legs", ("SPS", 6), (_GAP,),
        (12, "six of them are rotations of the legs about themselves: 42 - 30", "Stewart 1965; Hunt 1983"),
    ),
    _generator(
        "6-rus", "Platform on six RUS legs", ("RUS", 6), (_GAP, _OUT),
        (6, "no leg removes a degree of freedom: 36 - 30", "Hunt 1983"),
    ),
    _generator(
        "6-uuu", "Platform on six UUU legs", ("UUU", 6), (_GAP, _OUT),
        (6, "no leg removes a degree of freedom: 36 - 30", "count of freedoms (Kutzbach)"),
    ),
    _generator(
        "3-rps", "Platform on three RPS legs", ("RPS", 3), (),
        (3, "each leg removes one degree of freedom: 15 - 12", "Hunt 1983"),
    ),
    _generator(
        "3-upu", "Platform on three UPU legs", ("UPU", 3), (),
        (3, "the axes of each leg at base and top are parallel, and so are its two transverse "
"axes: the top only translates",
         "Tsai 1996"),
    ),
    _generator(
        "3-uuu", "Platform on three UUU legs", ("UUU", 3), (_OUT,),
        (6, "no leg removes a degree of freedom: 18 - 12", "count of freedoms (Kutzbach)"),
    ),
    Generator(
        "3-crr", "Platform on three CRR legs that only translates", translating_platform,
        (
            length("size", 1.0, 0.1, 10, "length of the links of the legs"),
            angle("bent", 70, 20, 160, "bend angle of the legs"),
        ),
        lambda _: 3, "axes parallel in each leg, and perpendicular to those of the others",
        "Tsai's platform: Wampler, Larson, Erdman 2007, Fig. 16b; Kim and Tsai 2003",
    ),
)  # fmt: skip
