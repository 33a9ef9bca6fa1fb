"""Pictures of a linkage at its conformed position: circle with ICRL and shadow, cone with the links as strips.

Both are seen from the side of the apex, where azimuths grow counter-clockwise. Static pictures;
Hyatt et al. 2020, Figs. 7 to 9; Hyatt et al. 2021, section 5.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.arrays import Floats
from graphs.plain_text import plain_label
from synth.conformed.behaviours import Way, behaviour_of_motion, icrl
from synth.conformed.layers import LinksInLayers, links_in_layers
from synth.conformed.pose import joint_axes, strip
from synth.conformed.rates import ConformedChain, first_order
from synth.drawing.figure import COLOURS, new_figure

__all__ = ["draw_conformed"]

_LONGEST_TITLE = 400

_WAYS = {
    Way.OUTWARD: "out",
    Way.INWARD: "in",
    Way.BOTH: "both ways",
    Way.STILL: "still",
    Way.UNKNOWN: "not told",
}


def draw_conformed(
    chain: ConformedChain,
    places: npt.ArrayLike,
    cone_angle: float | None = None,
    title: str = "",
    *,
    grounded: bool = True,
) -> Any:
    """Return a picture of a linkage on its circle and, with a cone angle, on its cone, in the fewest layers.

    Parameters
    ----------
    chain : ConformedChain
    places : float[J]
        Azimuths of the joints, radians.
    cone_angle : float, optional
        lambda, radians; None for a cylinder, of which only the circle is drawn.
    title : str, optional
    grounded : bool, optional
        Whether the first link is fixed; else nothing is drawn of motions.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    UnsolvableError
        If matplotlib is not installed, or there are more than 62 joints.

    Examples
    --------
    >>> from graphs.mechanism.sc import SCGraph
    >>> chain = ConformedChain.of(SCGraph(4, dict(zip("OABC", [(0, 1), (1, 2), (2, 3), (3, 0)]))))
    >>> len(draw_conformed(chain, np.radians([40, 90, 140, 0]), 0.4).axes)
    2
    """
    t = np.asarray(places, dtype=float)
    laid = links_in_layers(chain, t)
    figure = new_figure(11.0 if cone_angle is not None else 6.4, 5.6)
    _circle(figure.add_subplot(1, 1 if cone_angle is None else 2, 1), chain, t, laid, grounded)
    if cone_angle is not None:
        _cone(figure.add_subplot(1, 2, 2, projection="3d"), chain, t, laid, cone_angle)
    if title:
        figure.suptitle(plain_label(title, _LONGEST_TITLE))
    return figure


def _circle(axes: Any, chain: ConformedChain, t: Floats, laid: LinksInLayers, grounded: bool) -> None:
    """Draw circle, links as arcs and chords, ICRL of each moving link, and the shadow of a four-bar."""
    motion = first_order(chain, t)
    behaviour = behaviour_of_motion(chain, t, motion, laid.arcs)
    lines = icrl(motion.motions) if grounded else np.full(len(chain.links), np.nan)
    round_ = np.linspace(0, 2 * np.pi, 361)
    axes.plot(*_on_circle(round_), color="0.55", linewidth=1.0, zorder=1)
    four_bar = grounded and len(chain.links) == 4 and len(t) == 4
    if four_bar:
        _shadow(axes, chain, t)
    for number, (joints, layer) in enumerate(zip(chain.joints_of, laid.layers.tolist(), strict=True)):
        colour = "0.25" if number == 0 else COLOURS[(number - 1) % len(COLOURS)]
        start, length = laid.arcs[number]
        along = start + length * np.linspace(0, 1, 90)
        radius = 1.06 + 0.06 * layer
        name = _link_name(chain, number)
        told = "ground" if number == 0 else _WAYS[Way(int(behaviour.ways[number]))]
        axes.plot(
            *_on_circle(along, radius), color=colour, linewidth=4.5, solid_capstyle="butt",
            label=f"{name}: {told}" if grounded else name, zorder=3,
        )  # fmt: skip
        order = sorted(joints, key=lambda joint: (t[joint] - start) % (2 * np.pi))
        corners = [*order, order[0]] if len(order) > 2 else order
        axes.plot(*_on_circle(t[corners]), color=colour, linewidth=1.6, zorder=3)
        if number and np.isfinite(lines[number]):
            x, y = _on_circle(lines[number], 1.42)
            axes.plot([-x, x], [-y, y], color=colour, linewidth=1.0, linestyle=(0, (6, 3)), zorder=2)
    axes.scatter(*_on_circle(t), s=34, facecolor="white", edgecolor="black", zorder=5)
    _name_joints(axes, chain, t)
    axes.scatter([0], [0], marker="+", color="black", s=60, zorder=4)
    axes.set(aspect="equal", xlim=(-1.6, 1.6), ylim=(-1.6, 1.6))
    axes.axis("off")
    axes.legend(frameon=False, loc="upper center", bbox_to_anchor=(0.5, 0.02), ncols=2, fontsize=9)
    notes = ["seen from the apex"] + ["ICRL dashed"] * bool(np.isfinite(lines).any()) + ["shadow grey"] * four_bar
    axes.set_title(", ".join(notes), fontsize=10)


def _on_circle(azimuths: npt.ArrayLike, radius: float = 1.0) -> tuple[Floats, Floats]:
    """Return x and y of places on the circle: 0 on top, growing counter-clockwise, as the cone shows them."""
    t = np.asarray(azimuths, dtype=float)
    return -radius * np.sin(t), radius * np.cos(t)


def _name_joints(axes: Any, chain: ConformedChain, t: Floats) -> None:
    for joint, place in zip(chain.joints, t, strict=True):
        axes.text(
            *_on_circle(place, 0.87), plain_label(str(joint)[:8]),
            ha="center", va="center", zorder=6,
            bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.75, "boxstyle": "round,pad=0.12"},
        )  # fmt: skip


def _link_name(chain: ConformedChain, number: int) -> str:
    return "link " + "".join(plain_label(str(chain.joints[joint])[:4]) for joint in chain.joints_of[number])


def _shadow(axes: Any, chain: ConformedChain, t: Floats) -> None:
    """Shade the double wedge between the lines of the side links that holds ground and coupler."""
    points = np.stack(_on_circle(t), axis=-1)
    ground = chain.joints_of[0]
    sides = [joints for joints in chain.joints_of[1:] if set(joints) & set(ground)]
    (a, b), (c, d) = (sorted(joints, key=lambda joint: joint not in ground) for joints in sides)
    grid = np.linspace(-1.42, 1.42, 500)
    x, y = np.meshgrid(grid, grid)

    def side(p: Floats, q: Floats, u: Any, v: Any) -> Any:
        return (q[0] - p[0]) * (v - p[1]) - (q[1] - p[1]) * (u - p[0])

    here = side(points[a], points[b], x, y) * side(points[c], points[d], x, y)
    coupler = side(points[a], points[b], *points[d]) * side(points[c], points[d], *points[b])
    inside = (here * coupler > 0) & (x**2 + y**2 < 1.42**2)
    axes.contourf(x, y, inside.astype(float), levels=[0.5, 1.5], colors=["0.91"], zorder=0)


def _cone(axes: Any, chain: ConformedChain, t: Floats, laid: LinksInLayers, cone_angle: float) -> None:
    """Draw links as strips of the cone, in bands so that they do not hide each other, and joint axes."""
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    width = 0.62 / (int(laid.layers.max()) + 1)
    round_ = np.linspace(0, 2 * np.pi, 181)
    panels, shades = _surface(cone_angle)
    axes.add_collection3d(Poly3DCollection(panels, facecolor=shades, edgecolor=shades, linewidth=0.5, zorder=0))
    for radius in (0.35, 1.05):
        axes.plot(*_upright(radius * joint_axes(round_, cone_angle)), color="0.45", linewidth=0.9)
    for number, layer in enumerate(laid.layers.tolist()):
        start, length = laid.arcs[number]
        inner = 0.38 + width * layer
        edge_in, edge_out = strip(start, start + length, cone_angle, (inner, inner + 0.9 * width), 40)
        panels = [
            np.stack(_upright(np.array([edge_in[i], edge_in[i + 1], edge_out[i + 1], edge_out[i]])), axis=-1)
            for i in range(39)
        ]
        colour = "0.45" if number == 0 else COLOURS[(number - 1) % len(COLOURS)]
        axes.add_collection3d(
            Poly3DCollection(panels, facecolor=colour, edgecolor=colour, linewidth=0.4, zorder=2)
        )
    for joint, axis in zip(chain.joints, joint_axes(t, cone_angle), strict=True):
        axes.plot(*_upright(np.stack([np.zeros(3), 1.1 * axis])), color="black", linewidth=0.9, zorder=3)
        axes.text(*_upright(1.22 * axis), plain_label(str(joint)[:8]), ha="center", va="center", zorder=4)
    reach = 1.1 * np.cos(cone_angle)
    deep = 1.1 * np.sin(cone_angle)
    middle = deep / 2
    half = max(reach, middle)
    axes.set(xlim=(-half, half), ylim=(-half, half), zlim=(-middle - half, -middle + half))
    axes.set_box_aspect((1, 1, 1), zoom=1.55)
    middle_of_links = np.degrees(np.angle(np.exp(1j * t).sum()))
    # from outside the links, a little aside; so high that no part of the cone hides another
    axes.view_init(elev=min(88.0, max(38.0, np.degrees(cone_angle) + 8)), azim=middle_of_links + 15)
    axes.computed_zorder = False
    axes.set_axis_off()
    axes.set_title(f"cone of λ = {np.degrees(cone_angle):.4g}°, seen from the apex's side", fontsize=10)


def _surface(cone_angle: float) -> tuple[list[Floats], Any]:
    """Return the reference cone as narrow panels, and their colours: light from one side, darker away from it."""
    azimuths = np.linspace(0, 2 * np.pi, 73)
    inner, outer = strip(0.0, 2 * np.pi, cone_angle, (0.35, 1.05), len(azimuths))
    panels = [
        np.stack(_upright(np.array([inner[i], inner[i + 1], outer[i + 1], outer[i]])), axis=-1)
        for i in range(len(azimuths) - 1)
    ]
    greys = 0.93 - 0.12 * (1 - np.cos(azimuths[:-1] - np.pi / 3)) / 2
    return panels, [str(grey) for grey in greys]


def _upright(points: Floats) -> tuple[Floats, Floats, Floats]:
    """Return coordinates with the cone's axis upright: (z, x, y) of the paper's frame."""
    return points[..., 2], points[..., 0], points[..., 1]
