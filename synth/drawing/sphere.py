"""Pictures of orientations: the design sphere with its hoop, and maps of the sphere by verdict.

As Figs. 3 to 6 of Tipparthi and Larochelle 2011: orientations, relative axes, the hoop and its crossings. The
sphere is seen from far away (orthographic); the maps show all of it, equal areas as equal areas (Hammer).
:func:`synth.drawing.figure.save_figure` writes the pictures.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from graphs.arrays import Floats
from graphs.errors import UnsolvableError
from synth.drawing.figure import new_figure
from synth.drawing.labels import spread
from synth.guidance.dyads import Dyad
from synth.guidance.four import AxisCurve
from synth.guidance.hoop_method import Crossing, Hoop, direction_words, pair_name
from synth.guidance.order import order_verdicts
from synth.guidance.orientations import Orientations, unit_vector

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["draw_hoop", "draw_map", "hammer", "hammer_inverse"]

CCW, CW, NEITHER = "#3b75af", "#e08214", "#e9e9e9"
INK, PALE, NEEDED, BODY = "#222222", "#c8c8c8", "#b2182b", ("#b2182b", "#1b7837", "#2166ac")
_FINE = 181
_MOST_LABELLED = 7
"""Orientations; of more only the axes that decide are shown, on a map none."""
_MOST_DRAWN = 15


def draw_hoop(orientations: Orientations, axis: npt.ArrayLike, hoop: Hoop) -> Figure:
    """Return a picture of the design sphere with orientations, relative axes, the hoop and what it crosses.

    Parameters
    ----------
    orientations : Orientations
    axis : float[3]
        The fixed axis.
    hoop : Hoop
        Of :func:`synth.guidance.hoop_method.hoop`.

    Raises
    ------
    UnsolvableError
        If matplotlib is not installed, or if there are more than 15 orientations.
    """
    g = unit_vector(axis, "fixed axis")
    if len(orientations) > _MOST_DRAWN:
        raise UnsolvableError(
            f"a picture of {len(orientations)} orientations shows nothing; {_MOST_DRAWN} at most"
        )
    figure: Figure = new_figure(8.0, 9.6)
    sphere, strip = figure.subplots(2, 1, height_ratios=[5, 1])
    start = orientations.relative_axis(1, 2)
    start = start - (start @ g) * g
    start /= np.linalg.norm(start)
    across = np.cross(g, start) * (1.0 if hoop.direction == "ccw" else -1.0)
    view = _View(0.75 * across + 0.45 * g + 0.25 * start)
    _draw_globe(sphere, view)
    needed = set(hoop.required)
    half = np.linspace(0.0, np.pi, _FINE)[:, None]
    for angle, style in [
        (0.0, (INK, 2.2)),
        *((c.angle, (NEEDED, 1.0)) for c in hoop.crossings if c.pair in needed),
    ]:
        side = np.cos(angle) * start + np.sin(angle) * across
        _draw_curve(sphere, view, np.cos(half) * g + np.sin(half) * side, *style)
    _draw_bodies(sphere, view, orientations)
    marks = [
        (np.copysign(1.0, orientations.relative_axis(1, 2) @ start) * orientations.relative_axis(1, 2), "S12", INK)
    ]
    shown = [c for c in hoop.crossings if c.pair in needed or len(orientations) <= _MOST_LABELLED]
    for crossing in shown:
        s = orientations.relative_axis(*crossing.pair)
        end = s * np.copysign(1.0, s @ (np.cos(crossing.angle) * start + np.sin(crossing.angle) * across))
        marks.append((end, pair_name(crossing.pair), NEEDED if crossing.pair in needed else INK))
    marks.append((g, "G", INK))
    _draw_marks(sphere, view, marks)
    _draw_strip(strip, [c for c in shown if c.pair in needed], [c for c in shown if c.pair not in needed])
    verdict = "order kept" if hoop.in_order else "order defect"
    sphere.set_title(f"Hoop about G, turning {direction_words(hoop.direction)}: {verdict}", fontsize=12)
    key = "blue: the body's z axis at each orientation; red, green: towards its x, y; open or dashed: far side"
    sphere.text(0.0, -1.13, key, fontsize=8, ha="center", va="top", color=INK)
    return figure


def draw_map(
    orientations: Orientations,
    dyads: Iterable[Dyad] = (),
    curves: Iterable[AxisCurve] = (),
    width: int = 1800,
) -> Figure:
    """Return a map of the sphere: the order-defect verdict of each fixed axis, with relative axes and dyads.

    Parameters
    ----------
    orientations : Orientations
    dyads : iterable of Dyad, optional
        Their fixed axes are marked and numbered from 1.
    curves : iterable of AxisCurve, optional
        Curves of fixed axes, where there are four orientations.
    width : int, optional
        Points across the map.

    Raises
    ------
    UnsolvableError
        If matplotlib is not installed.
    """
    from matplotlib.colors import to_rgba
    from matplotlib.patches import Patch

    figure: Figure = new_figure(10.0, 6.0)
    plane = figure.subplots()
    x = np.linspace(-2.0 * np.sqrt(2.0), 2.0 * np.sqrt(2.0), width)
    y = np.linspace(-np.sqrt(2.0), np.sqrt(2.0), width // 2)
    points, inside = hammer_inverse(*np.meshgrid(x, y))
    colours = np.array([to_rgba(CW), to_rgba(NEITHER), to_rgba(CCW)])
    picture = colours[order_verdicts(orientations, points.reshape(-1, 3)) + 1].reshape(*inside.shape, 4)
    picture[~inside] = (1.0, 1.0, 1.0, 0.0)  # clear, and no dark rim where it is mixed with what is inside
    # colours, not verdicts, are mixed at the borders of regions, which else are steps
    plane.imshow(
        picture, extent=(x[0], x[-1], y[0], y[-1]), origin="lower", interpolation="bilinear",
        interpolation_stage="rgba",
    )  # fmt: skip
    _draw_graticule(plane)
    for curve in curves:
        for ends in (curve.fixed, -curve.fixed):
            _draw_flat_curve(plane, ends)
    axes = orientations.relative_axes() if len(orientations) <= _MOST_LABELLED else {}
    lines = [(end, pair_name(pair), INK) for pair, s in axes.items() for end in (s, -s)]
    numbered = [(end, str(k), NEEDED) for k, d in enumerate(dyads, start=1) for end in (d.fixed, -d.fixed)]
    _draw_flat_marks(plane, lines, numbered)
    legend = [
        Patch(color=CCW, label="in order, crank counter-clockwise"),
        Patch(color=CW, label="in order, crank clockwise"),
        Patch(color=NEITHER, label="order defect"),
    ]
    plane.legend(handles=legend, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncols=3, frameon=False)
    plane.set_title(f"Order of {len(orientations)} orientations by fixed axis", fontsize=12)
    plane.set_aspect("equal")
    plane.axis("off")
    return figure


def hammer(points: Floats) -> tuple[Floats, Floats]:
    """Return points of the sphere on the Hammer map: x and y, |x| <= 2 sqrt 2, |y| <= sqrt 2; z points up.

    Examples
    --------
    >>> [round(float(c[0]), 6) for c in hammer(np.array([[1.0, 0.0, 0.0]]))]
    [0.0, 0.0]
    """
    east, north = np.arctan2(points[:, 1], points[:, 0]), np.arcsin(np.clip(points[:, 2], -1.0, 1.0))
    scale = np.sqrt(2.0 / (1.0 + np.cos(north) * np.cos(east / 2.0)))
    return 2.0 * scale * np.cos(north) * np.sin(east / 2.0), scale * np.sin(north)


def hammer_inverse(x: Floats, y: Floats) -> tuple[Floats, npt.NDArray[np.bool_]]:
    """Return what the Hammer map shows at x, y: points of the sphere, float[..., 3], and whether there is one."""
    inside = x * x / 8.0 + y * y / 2.0 <= 1.0
    z = np.sqrt(np.maximum(1.0 - (x / 4.0) ** 2 - (y / 2.0) ** 2, 0.5))
    east = 2.0 * np.arctan2(z * x, 2.0 * (2.0 * z * z - 1.0))
    north = np.arcsin(np.clip(z * y, -1.0, 1.0))
    return np.stack([np.cos(north) * np.cos(east), np.cos(north) * np.sin(east), np.sin(north)], axis=-1), inside


class _View:
    """A look at the sphere from far away, in a direction; G's axis is not tilted to a side."""

    def __init__(self, towards: Floats) -> None:
        self.out = unit_vector(towards)
        up = np.array([0.0, 0.0, 1.0]) if abs(self.out[2]) < 0.9 else np.array([1.0, 0.0, 0.0])
        self.right = unit_vector(np.cross(up, self.out))
        self.up = np.cross(self.out, self.right)

    def flat(self, points: Floats) -> tuple[Floats, Floats, npt.NDArray[np.bool_]]:
        """Return x, y, and whether each point is on the near side."""
        return points @ self.right, points @ self.up, points @ self.out >= 0.0


def _draw_globe(axes: Axes, view: _View) -> None:
    turn = np.linspace(0.0, 2.0 * np.pi, 361)
    axes.fill(np.cos(turn), np.sin(turn), facecolor="#fafafa", edgecolor=INK, linewidth=1.0, zorder=0)
    for north in np.radians(np.arange(-60, 61, 30)):
        ring = np.stack(
            [np.cos(north) * np.cos(turn), np.cos(north) * np.sin(turn), np.full(361, np.sin(north))], 1
        )
        _draw_curve(axes, view, ring, PALE, 0.5, far=False)
    for east in np.radians(np.arange(0, 180, 30)):
        ring = np.stack([np.sin(turn) * np.cos(east), np.sin(turn) * np.sin(east), np.cos(turn)], 1)
        _draw_curve(axes, view, ring, PALE, 0.5, far=False)
    axes.set_aspect("equal")
    axes.set_xlim(-1.25, 1.25)
    axes.set_ylim(-1.12, 1.12)
    axes.axis("off")


def _draw_curve(axes: Axes, view: _View, points: Floats, colour: str, width: float, far: bool = True) -> None:
    x, y, near = view.flat(points)
    axes.plot(np.where(near, x, np.nan), np.where(near, y, np.nan), color=colour, linewidth=width)
    if far:
        hidden = np.where(near, np.nan, x), np.where(near, np.nan, y)
        axes.plot(*hidden, color=colour, linewidth=0.6 * width, linestyle=(0, (2, 2)))


def _draw_bodies(axes: Axes, view: _View, orientations: Orientations) -> None:
    """Draw each orientation where the body's z axis meets the sphere, with short arcs towards its x and y axes."""
    reach = np.linspace(0.0, np.radians(11.0), 9)[:, None]
    for number, m in enumerate(orientations.matrices, start=1):
        for k in (0, 1):
            _draw_curve(axes, view, np.cos(reach) * m[:, 2] + np.sin(reach) * m[:, k], BODY[k], 1.8)
        x, y, near = view.flat(m[:, 2:].T)
        axes.plot(
            x, y, "o", color=BODY[2], markersize=9, markerfacecolor=BODY[2] if near[0] else "white", zorder=4
        )
        ink = "white" if near[0] else BODY[2]
        axes.text(x[0], y[0], str(number), color=ink, fontsize=7, ha="center", va="center_baseline", zorder=5)


def _draw_marks(axes: Axes, view: _View, marks: Sequence[tuple[Floats, str, str]]) -> None:
    x, y, near = view.flat(np.array([point for point, _, _ in marks]))
    places = spread(np.stack([x, y], axis=1), reach=0.085, gap=0.075)
    for (px, py), (tx, ty), (_, name, colour), here in zip(
        zip(x, y, strict=True), places, marks, near, strict=True
    ):
        axes.plot(px, py, "o", color=colour, markersize=5, markerfacecolor=colour if here else "white", zorder=6)
        axes.plot([px, tx], [py, ty], color=colour, linewidth=0.4, zorder=5)
        _write(axes, tx, ty, name, colour, 9)


def _draw_flat_curve(axes: Axes, points: Floats) -> None:
    """Draw a closed curve, broken where it goes over the edge of the map."""
    x, y = hammer(np.concatenate([points, points[:1]]))
    over = np.flatnonzero(np.hypot(np.diff(x), np.diff(y)) > 0.3) + 1
    axes.plot(np.insert(x, over, np.nan), np.insert(y, over, np.nan), color=INK, linewidth=1.0)


def _draw_flat_marks(
    axes: Axes, lines: Sequence[tuple[Floats, str, str]], numbered: Sequence[tuple[Floats, str, str]]
) -> None:
    every = [*lines, *numbered]
    x, y = hammer(np.array([point for point, _, _ in every]).reshape(-1, 3))
    places = spread(np.stack([x, y], axis=1), reach=0.13, gap=0.13)
    for k, ((tx, ty), (_, name, colour)) in enumerate(zip(places, every, strict=True)):
        marker, size = ("o", 3) if k < len(lines) else ("*", 10)
        axes.plot(x[k], y[k], marker, color=colour, markersize=size, markeredgecolor="white", zorder=6)
        axes.plot([x[k], tx], [y[k], ty], color=colour, linewidth=0.3, zorder=5)
        _write(axes, tx, ty, name, colour, 7)


def _write(axes: Axes, x: float, y: float, text: str, colour: str, size: float) -> None:
    """Write a label with a pale edge, so that it can be read over lines."""
    from matplotlib.patheffects import withStroke

    axes.text(
        x, y, text, color=colour, fontsize=size, ha="center", va="center", zorder=7,
        path_effects=[withStroke(linewidth=2.0, foreground="white", alpha=0.8)],
    )  # fmt: skip


def _draw_graticule(axes: Axes) -> None:
    turn = np.linspace(-np.pi + 1e-9, np.pi - 1e-9, 361)
    for north in np.radians(np.arange(-60, 61, 30)):
        ring = np.stack(
            [np.cos(north) * np.cos(turn), np.cos(north) * np.sin(turn), np.full(361, np.sin(north))], 1
        )
        axes.plot(*hammer(ring), color="white", linewidth=0.5, alpha=0.7)
    half = np.linspace(-np.pi / 2, np.pi / 2, 181)
    for degrees in range(-180, 181, 30):
        east = np.radians(np.clip(degrees, -180 + 1e-6, 180 - 1e-6))
        ring = np.stack([np.cos(half) * np.cos(east), np.cos(half) * np.sin(east), np.sin(half)], 1)
        edge = abs(degrees) == 180
        axes.plot(*hammer(ring), color=INK if edge else "white", linewidth=0.8 if edge else 0.5, alpha=0.7)


def _draw_strip(axes: Axes, deciding: Sequence[Crossing], others: Sequence[Crossing]) -> None:
    """Draw crossings along the angle of the hoop, those that decide above the line."""
    axes.axhline(0.0, color=INK, linewidth=1.0)
    for crossings, sign, colour in (([Crossing((1, 2), 0.0), *deciding], 1.0, NEEDED), (others, -1.0, INK)):
        marks = [(pair_name(c.pair), float(np.degrees(c.angle))) for c in crossings]
        at = np.array([[angle / 180.0, 0.0] for _, angle in marks]).reshape(-1, 2)
        text_at = 180.0 * spread(at, reach=0.0, gap=0.062, only_x=True)[:, 0]
        for (name, angle), x in zip(marks, text_at, strict=True):
            axes.plot([angle, angle, x], [0.0, 0.35 * sign, 0.75 * sign], color=colour, linewidth=0.9)
            axes.text(x, 0.85 * sign, f"{name}\n{angle:.1f}", color=colour, fontsize=8, ha="center",
                      va="bottom" if sign > 0 else "top")  # fmt: skip
    axes.set_xlim(-13.0, 193.0)
    axes.set_ylim(-2.4, 2.4)
    axes.set_xticks(range(0, 181, 30))
    axes.set_yticks([])
    axes.set_xlabel("angle of the hoop from S12, degrees (red: the axes that decide)", fontsize=9)
    for side in ("left", "right", "top"):
        axes.spines[side].set_visible(False)
