"""Pictures of loop sums against lambda or the radius (Hyatt et al. 2020, Fig. 10; 2021, Figs. 3 and 10)."""

from math import ceil, floor
from typing import NamedTuple

import numpy as np

from graphs.types import Floats
from synth.linkages.surfaces.loop_maps import ConeMap, CylinderMap, cone_reach, cylinder_reach
from synth.linkages.surfaces.loop_sums import Base, loop_sum, sign_patterns
from synth.making.drawing.scene.frame import PictureFrame, Plot, page_of, round_steps
from synth.making.drawing.scene.shapes import FINE, SMALL, STRONG, Disc, Label, Layer, Line, Shape, colour_of_class
from synth.making.drawing.scene.writing import Scene

_POINTS = 400
_MOST_CURVES = 128
"""Sums that are drawn beside those that close somewhere."""
_MOST_NAMED = 8
_LEFT, _TOP, _WIDE, _HIGH, _BELOW = 34.0, 22.0, 250.0, 170.0, 30.0
"""Space left of the plot, and above it; its width and height; space below it, points."""
_LEGEND = 74.0
_DASH = 7.0


class _Sums(NamedTuple):
    """Sums of a loop to be drawn, for a cylinder (base 0) or a cone (base 1).

    `along` is float[p], lambda in degrees or the radius, and `size` the same as `synth.linkages.surfaces.loop_sums`
    counts it; `reach` is float[n]. A root is (signs, place along, turns), a family its signs.
    """

    along: Floats
    size: Floats
    reach: Floats
    base: Base
    roots: list[tuple[tuple[int, ...], float, int]]
    families: list[tuple[int, ...]]

    def curve(self, signs: tuple[int, ...]) -> Floats:
        """Return the sum with some signs, degrees: float[p]."""
        return np.degrees(loop_sum(self.size, self.reach, np.array(signs), self.base))


def draw_loop_sums(mapped: ConeMap | CylinderMap) -> Scene:
    """Return a picture of all loop sums of a loop: spherical against lambda, planar against the radius.

    The loop closes where a sum is a multiple of 360 degrees, which are dashed.

    Parameters
    ----------
    mapped : ConeMap or CylinderMap

    Examples
    --------
    >>> from synth.linkages.surfaces.loop_maps import map_to_cones
    >>> scene = draw_loop_sums(map_to_cones(np.radians([70, 80, 120, 40])))
    >>> [layer.name for layer in scene.layers]
    ['turns', 'sums', 'axes', 'legend', 'caption']
    >>> scene.title
    'loop sums of link angles 70°, 80°, 120°, 40°: the loop closes where one is a multiple of 360° (dots)'
    >>> from synth.linkages.surfaces.loop_maps import map_to_cylinders
    >>> "radius R" in [label.text for label in draw_loop_sums(map_to_cylinders([4, 3, 5, 1])).labels()]
    True
    """
    if isinstance(mapped, ConeMap):
        sums = _on_cones(mapped)
        name, ends = "cone angle λ (degrees)", (0.0, float(sums.along[-1]) * 1.02)
        links = "link angles " + ", ".join(f"{angle:.5g}°" for angle in np.degrees(mapped.angles))
    else:
        sums = _on_cylinders(mapped)
        least, most = float(sums.along[0]), float(sums.along[-1])
        name, ends = "radius R", (least - 0.02 * (most - least), most)
        links = "lengths " + ", ".join(f"{length:.5g}" for length in mapped.lengths)
    special = list(dict.fromkeys([*(signs for signs, _, _ in sums.roots), *sums.families]))
    patterns = [tuple(signs.tolist()) for signs in sign_patterns(len(sums.reach))[:_MOST_CURVES]]
    curves = {signs: sums.curve(signs) for signs in dict.fromkeys([*special, *patterns])}
    low, high = (float(pick([pick(curve) for curve in curves.values()])) for pick in (np.min, np.max))
    air = 0.05 * (high - low)
    plot = Plot(_LEFT, _TOP, _WIDE, _HIGH, ends, (low - air, high + air))
    layers = [
        Layer("turns", tuple(_turns(plot))),
        Layer("sums", tuple(_lines(plot, sums, curves, special))),
        Layer("axes", tuple(_axes(plot, name))),
        Layer("legend", tuple(_legend(special))),
    ]
    said = f"loop sums of {links}: the loop closes where one is a multiple of 360° (dots)"
    return page_of(PictureFrame(1, 0, 0, 0, 0, _LEFT + _WIDE + _LEGEND, _TOP + _HIGH + _BELOW), layers, [said])


def _on_cones(mapped: ConeMap) -> _Sums:
    reach = cone_reach(np.array(mapped.angles))
    end = float(np.arctan(np.sqrt(reach.min())))
    # close together at the end, where the longest link's step rises steeply
    lam = end * np.sin(np.linspace(0, np.pi / 2, _POINTS))
    size = np.minimum(np.tan(lam) ** 2, reach.min())
    roots = [(cone.signs, float(np.degrees(cone.size)), cone.turns) for cone in (*mapped.flat, *mapped.cones)]
    return _Sums(np.degrees(lam), size, reach, 1, roots, [family.signs for family in mapped.families])


def _on_cylinders(mapped: CylinderMap) -> _Sums:
    reach = cylinder_reach(np.array(mapped.lengths))
    least = float(0.5 / np.sqrt(reach.min()))
    most = max([1.5 * least, *(least + 1.4 * (cylinder.size - least) for cylinder in mapped.cylinders)])
    radius = least + (most - least) * (1 - np.cos(np.linspace(0, np.pi / 2, _POINTS)))
    size = np.minimum(0.25 / radius**2, reach.min())
    roots = [(cylinder.signs, cylinder.size, cylinder.turns) for cylinder in mapped.cylinders]
    return _Sums(radius, size, reach, 0, roots, [family.signs for family in mapped.families])


def _lines(
    plot: Plot, sums: _Sums, curves: dict[tuple[int, ...], Floats], special: list[tuple[int, ...]]
) -> list[Shape]:
    """Return the curves, those that close above the others, with dots where they do."""
    shapes: list[Shape] = [
        Line(plot.row(sums.along, curve), "faint", FINE) for signs, curve in curves.items() if signs not in special
    ]
    for number, signs in enumerate(special):
        dash: tuple[float, ...] = ()
        if signs in sums.families[1:]:  # families lie on one another, and are seen in turn, the first below all
            place = sums.families.index(signs)
            dash = (_DASH * (len(sums.families) - place), _DASH * place)
        shapes.append(Line(plot.row(sums.along, curves[signs]), colour_of_class(number), STRONG, dash))
    for signs, along, turns in sums.roots:
        shapes.append(Disc(plot.at(along, 360 * turns), 2.6, colour_of_class(special.index(signs)), "paper", FINE))
    return shapes


def _turns(plot: Plot) -> list[Shape]:
    """Return lines at the multiples of 360 degrees."""
    low, high = plot.y
    return [
        Line([plot.at(plot.x[0], 360 * turns), plot.at(plot.x[1], 360 * turns)], "grey", FINE, (4.0, 3.0))
        for turns in range(ceil(low / 360), floor(high / 360) + 1)
    ]


def _axes(plot: Plot, name: str) -> list[Shape]:
    low, high = plot.y
    step = next(step for step in (90, 180, 360, 720, 1440) if (high - low) / step < 12 or step == 1440)
    ticks = [float(step * i) for i in range(ceil(low / step), floor(high / step) + 1)]
    return [*plot.below(round_steps(*plot.x), name), *plot.beside(ticks, "sum of the steps (degrees)")]


def _legend(special: list[tuple[int, ...]]) -> list[Shape]:
    """Return the signs of the sums that close, with their colours."""
    left = _LEFT + _WIDE + 10
    named = special[:_MOST_NAMED]
    shapes: list[Shape] = [Label((left, _TOP), "signs", SMALL, "grey", "start", halo=False)] if named else []
    for number, signs in enumerate(named):
        y = _TOP + 1.6 * SMALL * (number + 1)
        text = "".join("+" if sign > 0 else "−" for sign in signs)
        shapes.append(Line([(left, y), (left + 10, y)], colour_of_class(number), STRONG))
        shapes.append(Label((left + 14, y), text, SMALL, anchor="start", halo=False, widest=16))
    if len(special) > _MOST_NAMED:
        y = _TOP + 1.6 * SMALL * (_MOST_NAMED + 1)
        shapes.append(Label((left, y), f"and {len(special) - _MOST_NAMED} more", SMALL, "grey", "start", halo=False))
    return shapes
