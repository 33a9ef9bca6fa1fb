"""Random sheets on a lattice, whose freedoms are known exactly, and the noise that files have."""

from __future__ import annotations

import numpy as np
from flint import nmod_mat
from scipy.spatial import Delaunay

from graphs.convert.duality import mechanism_of_sheet
from graphs.mechanism.sheet import Sheet
from graphs.rank.exact import closure_of
from graphs.rank.realisation import PRIMES, PrimeField, join

SIZE = 1000
"""Of the sheets, in steps of the lattice."""


def exact_freedoms(sheet):
    """Return the freedoms at integer coordinates, by ranks modulo two primes: no rounding, no tolerance."""
    found = mechanism_of_sheet(sheet)
    freedoms = []
    for prime in PRIMES:
        field = PrimeField(prime)
        places = [tuple(int(x) % prime for x in (*place, 0)[:3]) for place in sheet.coordinates]
        axes = {joint: join((*places[a], 1), (*places[b], 1), field) for joint, (a, b) in found.hinges.items()}
        centres = {i: (*places[v], 1) for i, v in enumerate(found.loop_vertices)}
        closure = closure_of(found.sc, axes, centres, field)
        matrix = nmod_mat(max(len(closure.rows), 1), max(len(closure.joints), 1), prime)
        for i, row in enumerate(closure.rows):
            for j, value in row.items():
                matrix[i, j] = value
        freedoms.append(len(closure.joints) - matrix.rank())
    assert freedoms[0] == freedoms[1]
    return freedoms[0]


def random_sheet(rng):
    """Return a sheet of one of several kinds: flat, folded, partly folded, of triangles, quads or strips."""
    kinds = (_triangles, _grid, _prism)
    return kinds[rng.integers(len(kinds))](rng)


def _triangles(rng):
    """Triangles on random points: flat, with some vertices raised, or all."""
    points = rng.integers(0, SIZE, size=(int(rng.integers(5, 16)), 2))
    points = np.unique(points // 60 * 60, axis=0)  # no slivers
    if len(points) < 4 or np.linalg.matrix_rank(points - points[0]) < 2:
        return _grid(rng)
    faces = Delaunay(points).simplices
    area = [abs(np.linalg.det((points[f[1:]] - points[f[0]]).astype(float))) for f in faces]
    faces = [tuple(map(int, f)) for f, a in zip(faces, area, strict=True) if a > 4000]
    raised = rng.random(len(points)) < rng.choice([0.0, 0.15, 1.0])
    heights = np.where(raised, rng.integers(100, 300, size=len(points)), 0)
    return _sheet(np.column_stack([points, heights]), faces)


def _grid(rng):
    """Quads: a flat grid of slanted lines."""
    rows, columns = (int(n) for n in rng.integers(2, 6, size=2))
    x, y = (np.cumsum(rng.integers(120, 250, size=n + 1)) for n in (columns, rows))
    shift = rng.integers(-50, 50, size=rows + 1)
    places = [(x[j] + shift[i], y[i], 0) for i in range(rows + 1) for j in range(columns + 1)]
    return _sheet(np.array(places), _quads(rows, columns))


def _prism(rng):
    """Quads with all lines one way parallel, folded: its freedoms are those of its cross-section, and special."""
    rows, columns = (int(n) for n in rng.integers(2, 6, size=2))
    section = np.cumsum(rng.integers(100, 250, size=(columns + 1, 2)) * [[1, (-1) ** j] for j in range(columns + 1)], 0)
    along = np.cumsum(rng.integers(120, 250, size=rows + 1))
    places = [(section[j, 0], along[i], section[j, 1]) for i in range(rows + 1) for j in range(columns + 1)]
    return _sheet(np.array(places), _quads(rows, columns))


def _quads(rows, columns):
    at = np.arange((rows + 1) * (columns + 1)).reshape(rows + 1, columns + 1)
    return [
        tuple(map(int, (at[i, j], at[i, j + 1], at[i + 1, j + 1], at[i + 1, j])))
        for i in range(rows)
        for j in range(columns)
    ]


def _sheet(places, faces):
    return Sheet(len(places), (), "", tuple(faces), tuple(tuple(map(float, place)) for place in places))


def disturbed(sheet, noise, rng):
    """Return the sheet with errors: normal ones, rounded to decimals, or in single precision, turned in space."""
    places = np.array(sheet.coordinates)
    if places.shape[1] < 3:
        places = np.column_stack([places, np.zeros(len(places))])
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0] if rng.random() < 0.5 else np.eye(3)
    places = places @ turn / SIZE
    kind = rng.integers(4)
    if kind == 0:
        places = places.round(max(int(-np.log10(noise)), 3))
    elif kind == 1:
        places = places.astype(np.float32).astype(float)
    elif kind == 2:
        places[:, int(rng.integers(3))] += rng.normal(size=len(places)) * noise
    else:
        places += rng.normal(size=places.shape) * noise
    return Sheet(sheet.vertices, sheet.edges, sheet.assignments, sheet.faces, tuple(map(tuple, places.tolist())))
