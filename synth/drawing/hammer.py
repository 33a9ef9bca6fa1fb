"""All of a sphere on a map, equal areas as equal areas (Hammer), and the regions of it where something holds."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.types import Flags, Floats

__all__ = ["hammer", "hammer_inverse", "region"]

_WIDE, _HIGH = 2.0 * np.sqrt(2.0), np.sqrt(2.0)
_BISECTIONS = 12
_ROUND = 1e-4
"""By how much outlines may be simplified, in units of the sphere's radius."""


def hammer(points: Floats) -> tuple[Floats, Floats]:
    """Return points of the sphere on the Hammer map: x and y, |x| <= 2 sqrt 2, |y| <= sqrt 2; z points up.

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


def region(holds: Callable[[Floats], Flags], columns: int) -> list[list[tuple[Floats, bool]]]:
    """Return where on the map something holds: polygons, each its outline first and then its holes.

    Each ring is its corners on the map, float[k, 2], and whether it is a hole. `holds` takes points of the sphere,
    float[n, 3], and returns bool[n]; it is evaluated on a grid with half as many rows as columns. Between two
    places of the grid that differ the border is found by bisection, so that outlines are no steps; what is
    narrower than the grid may be missed. The northern half:

    >>> [[(outline, hole)]] = region(lambda points: points[:, 2] > 0.0, 40)
    >>> bool(abs(outline[:, 1].min()) < 1e-3), hole
    (True, False)
    """
    from shapely import union_all
    from shapely.geometry import Polygon as Area

    turn = np.linspace(0.0, 2.0 * np.pi, 361)[:-1]
    whole = Area(np.column_stack([_WIDE * np.cos(turn), _HIGH * np.sin(turn)]))
    found = union_all([Area(piece) for piece in _pieces(holds, columns)]).intersection(whole).simplify(_ROUND)
    parts: list[Any] = list(getattr(found, "geoms", [found]))
    return [
        [(np.asarray(part.exterior.coords), False), *((np.asarray(hole.coords), True) for hole in part.interiors)]
        for part in parts
        if part.geom_type == "Polygon" and not part.is_empty
    ]


def _pieces(holds: Callable[[Floats], Flags], columns: int) -> Iterator[list[tuple[float, float]]]:
    """Yield pieces of the region: rows of whole cells, and of the others what the border leaves."""
    x, y = np.linspace(-_WIDE, _WIDE, columns), np.linspace(-_HIGH, _HIGH, max(2, columns // 2))

    def on_map(across: Floats, up: Floats) -> Flags:
        points, _ = hammer_inverse(across, up)
        return np.asarray(holds(points.reshape(-1, 3)), dtype=bool).reshape(across.shape)

    flags = on_map(*np.meshgrid(x, y))
    across = _crossings(flags, x, y, on_map)
    upward = {(j, i): (b, a) for (i, j), (a, b) in _crossings(flags.T, y, x, lambda a, b: on_map(b, a)).items()}
    corners = flags[:-1, :-1].astype(int) + flags[:-1, 1:] + flags[1:, :-1] + flags[1:, 1:]
    for i, row in enumerate((corners == 4).astype(int)):
        ends = np.flatnonzero(np.diff(np.concatenate([[0], row, [0]])))
        for first, last in ends.reshape(-1, 2).tolist():
            yield [(x[first], y[i]), (x[last], y[i]), (x[last], y[i + 1]), (x[first], y[i + 1])]
    for i, j in np.argwhere((corners > 0) & (corners < 4)).tolist():
        round_it = [((i, j), across, (i, j)), ((i, j + 1), upward, (i, j + 1)),
                    ((i + 1, j + 1), across, (i + 1, j)), ((i + 1, j), upward, (i, j))]  # fmt: skip
        piece = []
        for corner, crossings, side in round_it:
            if flags[corner]:
                piece.append((x[corner[1]], y[corner[0]]))
            if side in crossings:
                piece.append(crossings[side])
        yield piece


def _crossings(
    flags: Flags, x: Floats, y: Floats, holds: Callable[[Floats, Floats], Flags]
) -> dict[tuple[int, int], tuple[float, float]]:
    """Return where the border crosses the sides of the grid that run along its rows: of row and column of each."""
    rows, columns = np.nonzero(flags[:, :-1] != flags[:, 1:])
    inside = flags[rows, columns]
    yes, no = np.where(inside, x[columns], x[columns + 1]), np.where(inside, x[columns + 1], x[columns])
    level = y[rows]
    for _ in range(_BISECTIONS):
        middle = (yes + no) / 2.0
        there = holds(middle, level)
        yes, no = np.where(there, middle, yes), np.where(there, no, middle)
    places = zip(((yes + no) / 2.0).tolist(), level.tolist(), strict=True)
    return dict(zip(zip(rows.tolist(), columns.tolist(), strict=True), places, strict=True))
