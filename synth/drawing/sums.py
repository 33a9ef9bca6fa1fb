"""Pictures of loop sums against lambda or the radius (Hyatt et al. 2020, Fig. 10; 2021, Figs. 3 and 10)."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from graphs.arrays import Floats
from synth.drawing.figure import COLOURS, new_figure
from synth.surfaces.cone import ConeMap, cone_reach
from synth.surfaces.cylinder import CylinderMap, cylinder_reach
from synth.surfaces.loop_sums import Base, loop_sum, sign_patterns

__all__ = ["draw_loop_sums"]

_POINTS = 400
_MOST_CURVES = 128
_MOST_NAMED = 8


class _Sums(NamedTuple):
    """What is drawn of the sums of a loop.

    Attributes
    ----------
    along : float[p]
        lambda in degrees, or the radius.
    size : float[p]
        The same as `synth.surfaces.loop_sums` counts it.
    reach : float[n]
    base : 0 or 1
        Of a cylinder, of a cone.
    roots : list of (signs, place along, turns)
    families : list of signs
    """

    along: Floats
    size: Floats
    reach: Floats
    base: Base
    roots: list[tuple[tuple[int, ...], float, int]]
    families: list[tuple[int, ...]]


def draw_loop_sums(mapped: ConeMap | CylinderMap) -> Any:
    """Return a picture of all loop sums of a loop: spherical against lambda, planar against the radius.

    Parameters
    ----------
    mapped : ConeMap or CylinderMap

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    UnsolvableError
        If matplotlib is not installed.

    Examples
    --------
    >>> from synth.surfaces.cone import map_to_cones
    >>> draw_loop_sums(map_to_cones(np.radians([70, 80, 120, 40]))).axes[0].get_xlabel()
    'cone angle λ (degrees)'
    >>> from synth.surfaces.cylinder import map_to_cylinders
    >>> draw_loop_sums(map_to_cylinders([4, 3, 5, 1])).axes[0].get_xlabel()
    'radius R'
    """
    if isinstance(mapped, ConeMap):
        sums = _on_cones(mapped)
        label, ends = "cone angle λ (degrees)", (0.0, float(sums.along[-1]) * 1.02)
        links = [f"{angle:.5g}°" for angle in np.degrees(mapped.angles)]
    else:
        sums = _on_cylinders(mapped)
        least, most = float(sums.along[0]), float(sums.along[-1])
        label, ends = "radius R", (least - 0.02 * (most - least), most)
        links = [f"{length:.5g}" for length in mapped.lengths]
    figure = _draw(sums)
    figure.axes[0].set(xlabel=label, xlim=ends)
    figure.axes[0].set_title("loop sums: " + ", ".join(links))
    return figure


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


def _draw(sums: _Sums) -> Any:
    along, size, reach, base, roots, families = sums
    figure = new_figure(7.0, 4.6)
    axes = figure.add_subplot()
    special = dict.fromkeys([*(signs for signs, _, _ in roots), *families])
    patterns = [tuple(signs.tolist()) for signs in sign_patterns(len(reach))[:_MOST_CURVES]]
    for signs in dict.fromkeys([*special, *patterns]):
        if signs not in special:
            curve = np.degrees(loop_sum(size, reach, np.array(signs), base))
            axes.plot(along, curve, color="0.8", linewidth=0.8, zorder=1)
    for number, signs in enumerate(special):
        curve = np.degrees(loop_sum(size, reach, np.array(signs), base))
        name = "".join("+" if sign > 0 else "−" for sign in signs) if number < _MOST_NAMED else None
        # families lie on one another: their dashes take turns
        dashes = (
            (7 * families.index(signs), (7, 7 * (len(families) - 1)))
            if len(families) > 1 and signs in families
            else "-"
        )
        axes.plot(
            along,
            curve,
            color=COLOURS[number % len(COLOURS)],
            linewidth=1.8,
            label=name,
            linestyle=dashes,
            zorder=3,
        )
    for number, signs in enumerate(special):
        points = [(place, 360 * turns) for mine, place, turns in roots if mine == signs]
        if points:
            axes.scatter(*zip(*points, strict=True), color=COLOURS[number % len(COLOURS)], s=42, zorder=4)
    low, high = axes.get_ylim()
    for turns in range(int(np.ceil(low / 360)), int(np.floor(high / 360)) + 1):
        axes.axhline(360 * turns, color="0.3", linewidth=0.8, linestyle=(0, (4, 3)), zorder=2)
    axes.yaxis.set_major_locator(_every_180(low, high))
    axes.set_ylabel("sum of the steps (degrees)")
    axes.spines[["top", "right"]].set_visible(False)
    if special:
        axes.legend(frameon=False, title="signs", loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return figure


def _every_180(low: float, high: float) -> Any:
    from matplotlib.ticker import MultipleLocator

    return MultipleLocator(180 if high - low < 2000 else 360)
