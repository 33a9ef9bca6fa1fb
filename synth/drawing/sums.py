"""Pictures of loop sums against lambda or the radius (Hyatt et al. 2020, Fig. 10; 2021, Figs. 3 and 10)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from synth.drawing.figure import COLOURS, new_figure
from synth.surfaces.cone import ConeMap, cone_reach
from synth.surfaces.cylinder import CylinderMap, cylinder_reach
from synth.surfaces.loop_sums import loop_sum, sign_patterns

__all__ = ["draw_cone_sums", "draw_cylinder_sums"]

_POINTS = 400
_MOST_CURVES = 128
_MOST_NAMED = 8


def draw_cone_sums(found: ConeMap) -> Any:
    """Return a picture of all loop sums of a spherical loop against lambda.

    Parameters
    ----------
    found : ConeMap

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
    >>> draw_cone_sums(map_to_cones(np.radians([70, 80, 120, 40]))).axes[0].get_xlabel()
    'cone angle λ (degrees)'
    """
    reach = cone_reach(np.array(found.angles))
    end = float(np.arctan(np.sqrt(reach.min())))
    # close together at the end, where the longest link's step rises steeply
    lam = end * np.sin(np.linspace(0, np.pi / 2, _POINTS))
    size = np.minimum(np.tan(lam) ** 2, reach.min())
    roots = [(one.signs, float(np.degrees(one.size)), one.turns) for one in (*found.flat, *found.cones)]
    figure = _draw(np.degrees(lam), size, reach, 1, roots, [one.signs for one in found.families])
    figure.axes[0].set(xlabel="cone angle λ (degrees)", xlim=(0, float(np.degrees(end)) * 1.02))
    figure.axes[0].set_title("loop sums: " + ", ".join(f"{a:.5g}°" for a in np.degrees(found.angles)))
    return figure


def draw_cylinder_sums(found: CylinderMap) -> Any:
    """Return a picture of all loop sums of a planar loop against the radius.

    Parameters
    ----------
    found : CylinderMap

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    UnsolvableError
        If matplotlib is not installed.

    Examples
    --------
    >>> from synth.surfaces.cylinder import map_to_cylinders
    >>> draw_cylinder_sums(map_to_cylinders([4, 3, 5, 1])).axes[0].get_xlabel()
    'radius R'
    """
    reach = cylinder_reach(np.array(found.lengths))
    least = float(0.5 / np.sqrt(reach.min()))
    most = max([1.5 * least, *(least + 1.4 * (one.size - least) for one in found.cylinders)])
    radius = least + (most - least) * (1 - np.cos(np.linspace(0, np.pi / 2, _POINTS)))
    size = np.minimum(0.25 / radius**2, reach.min())
    roots = [(one.signs, one.size, one.turns) for one in found.cylinders]
    figure = _draw(radius, size, reach, 0, roots, [one.signs for one in found.families])
    figure.axes[0].set(xlabel="radius R", xlim=(least - 0.02 * (most - least), most))
    figure.axes[0].set_title("loop sums: " + ", ".join(f"{length:.5g}" for length in found.lengths))
    return figure


def _draw(
    along: npt.NDArray[np.float64],
    size: npt.NDArray[np.float64],
    reach: npt.NDArray[np.float64],
    base: Any,
    roots: Sequence[tuple[tuple[int, ...], float, int]],
    families: Sequence[tuple[int, ...]],
) -> Any:
    figure = new_figure(7.0, 4.6)
    axes = figure.add_subplot()
    special = dict.fromkeys([*(signs for signs, _, _ in roots), *families])
    patterns = [tuple(signs.tolist()) for signs in sign_patterns(len(reach))[:_MOST_CURVES]]
    for signs in dict.fromkeys([*special, *patterns]):
        if signs not in special:
            sums = np.degrees(loop_sum(size, reach, np.array(signs), base))
            axes.plot(along, sums, color="0.8", linewidth=0.8, zorder=1)
    for number, signs in enumerate(special):
        sums = np.degrees(loop_sum(size, reach, np.array(signs), base))
        name = "".join("+" if sign > 0 else "−" for sign in signs) if number < _MOST_NAMED else None
        # families lie on one another: their dashes take turns
        dashes = (
            (7 * families.index(signs), (7, 7 * (len(families) - 1)))
            if len(families) > 1 and signs in families
            else "-"
        )
        axes.plot(
            along,
            sums,
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
