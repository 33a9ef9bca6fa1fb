"""Sheets in space in which panels lie on each other, by construction: strips, maps folded half, boxes with flaps."""

from __future__ import annotations

from math import cos, pi, sin

from graphs.mechanism.sheet import Sheet, with_all_edges


def folded_strip(angles) -> Sheet:
    """Return a strip of unit squares with these fold angles, radians."""
    x = z = turn = 0.0
    line = [(x, z)]
    for angle in (*angles, 0.0):
        x, z = x + cos(turn), z + sin(turn)
        line.append((x, z))
        turn += angle
    width = len(line)
    corners = tuple((x, y, z) for y in (0.0, 1.0) for x, z in line)
    faces = tuple((k, k + 1, k + 1 + width, k + width) for k in range(width - 1))
    edges = tuple((k, k + width) for k in range(1, width - 1))
    letters = "".join("V" if angle > 0 else "M" for angle in angles)
    return Sheet(2 * width, edges, letters, faces, corners, fold_angles=tuple(angles))


def half_folded_map(columns: int, angles, letters: str = "") -> Sheet:
    """Return a map all of whose columns are folded onto each other, and whose rows are then bent by these angles.

    The creases between columns are unassigned, or have letters row by row.
    """
    rows = len(angles) + 1
    y = z = turn = 0.0
    line = [(y, z)]
    for angle in (*angles, 0.0):
        y, z = y + cos(turn), z + sin(turn)
        line.append((y, z))
        turn += angle
    corners = [(float(x % 2), *line[r]) for r in range(rows + 1) for x in range(columns + 1)]
    at = [[r * (columns + 1) + x for x in range(columns + 1)] for r in range(rows + 1)]
    faces = tuple((at[r][x], at[r][x + 1], at[r + 1][x + 1], at[r + 1][x]) for r in range(rows) for x in range(columns))
    between = [(at[r][x], at[r + 1][x]) for r in range(rows) for x in range(1, columns)]
    across = [(at[r][x], at[r][x + 1]) for r in range(1, rows) for x in range(columns)]
    bends = [angles[r - 1] * (-1) ** x for r in range(1, rows) for x in range(columns)]
    signs = letters or "U" * len(between)
    turned = [{"V": pi, "M": -pi}.get(letter) for letter in signs]
    sheet = Sheet(
        len(corners),
        (*between, *across),
        signs + "".join("V" if bend > 0 else "M" for bend in bends),
        faces,
        tuple(corners),
        fold_angles=(*turned, *bends),
    )
    return with_all_edges(sheet)


def box_with_flaps(depths, closed: float = 1.0) -> Sheet:
    """Return four walls of a unit box, and a flap at the top of each, folded inward by `closed` right angles."""
    ring = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    corners = [(*p, 0.0) for p in ring] + [(*p, 1.0) for p in ring]
    faces = [(k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k) for k in range(4)]
    edges, letters = [], ""
    for k, depth in enumerate(depths):
        (x, y), (u, v) = ring[k], ring[(k + 1) % 4]
        inward = (y - v, u - x)
        reach, rise = depth * sin(closed * pi / 2.0), depth * cos(closed * pi / 2.0)
        number = len(corners)
        corners += [(p + reach * inward[0], q + reach * inward[1], 1.0 + rise) for p, q in (ring[k], ring[(k + 1) % 4])]
        faces.append((4 + k, 4 + (k + 1) % 4, number + 1, number))
        edges += [(k, 4 + k), (4 + k, 4 + (k + 1) % 4)]
        letters += "MM"
    return with_all_edges(Sheet(len(corners), tuple(edges), letters, tuple(faces), tuple(corners)))
