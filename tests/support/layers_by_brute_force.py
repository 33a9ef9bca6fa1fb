"""Layer orders of grids and vertices of equal sectors by trying everything: creases flat or folded, all permutations.

Faces are squares of a grid, or sectors round a vertex, and lie over cells of the same grid. Nothing is shared with
`synth.analysis.layering`.
"""

from __future__ import annotations

from collections import defaultdict
from itertools import combinations, permutations, product


def _crossing(places):
    """Whether any two chords, pairs of places on a circle, alternate."""
    return any(len({lo < x < hi for x in other}) == 2 for (lo, hi), other in combinations(map(sorted, places), 2))


def _stacks(cell_of, strands):
    """Count permutations of the faces over each cell for which no strands cross.

    `strands` are (segment, cell, face, cell, face); the two cells at a segment are told apart by their order.
    """
    over = defaultdict(list)
    for face, cell in cell_of.items():
        over[cell].append(face)
    at = defaultdict(list)
    for segment, *ends in strands:
        at[segment].append(ends)
    cells = sorted(over)
    number = 0
    for order in product(*(permutations(over[cell]) for cell in cells)):
        height = {face: place for stack in order for place, face in enumerate(stack)}
        good = True
        for ends in at.values():
            sides = sorted({cell for a, _, b, _ in ends for cell in (a, b)})

            def place(cell, face, sides=sides, height=height):
                return height[face] if cell == sides[0] else 1000 - height[face]

            if _crossing([(place(a, f), place(b, g)) for a, f, b, g in ends]):
                good = False
                break
        number += good
    return number


def map_orders(rows, columns):
    """Return the number of orders of a map for each set of folded creases, pairs of squares (x, y)."""
    squares = [(x, y) for y in range(rows) for x in range(columns)]
    creases = [((x, y), (x + 1, y)) for x, y in squares if x + 1 < columns]
    creases += [((x, y), (x, y + 1)) for x, y in squares if y + 1 < rows]
    found = {}
    for picked in product((False, True), repeat=len(creases)):
        folded = {crease for crease, is_folded in zip(creases, picked, strict=True) if is_folded}
        where = {(0, 0): (0, 0, 1, 1)}
        closed = True
        for _ in squares:
            for one, other in creases:
                for a, b in ((one, other), (other, one)):
                    if a not in where:
                        continue
                    x, y, sx, sy = where[a]
                    axis = 0 if one[0] != other[0] else 1
                    step = (b[axis] - a[axis]) * (sx, sy)[axis]
                    there = [x, y, sx, sy]
                    if (one, other) in folded:
                        there[2 + axis] *= -1
                    else:
                        there[axis] += step
                    closed &= where.setdefault(b, tuple(there)) == tuple(there)
        if not closed:
            continue
        strands = []
        for one, other in creases:
            axis = 0 if one[0] != other[0] else 1
            x, y, *signs = where[one]
            line = (x, y)[axis] + (signs[axis] > 0)
            strands.append(((axis, line, (y, x)[axis]), where[one][:2], one, where[other][:2], other))
        number = _stacks({square: place[:2] for square, place in where.items()}, strands)
        if number:
            found[frozenset(folded)] = number
    return found


def vertex_orders(sectors):
    """Return the number of orders of a vertex of equal sectors for each set of folded creases.

    Crease k is between sectors k - 1 and k.
    """
    found = {}
    for picked in product((False, True), repeat=sectors):
        where = {0: (0, 1)}
        for k in range(1, sectors + 1):
            place, way = where[k - 1]
            where[k] = (place, -way) if picked[k % sectors] else ((place + way) % sectors, way)
        if where.pop(sectors) != where[0]:
            continue
        strands = []
        for k in range(sectors):
            before, (place, way) = where[(k - 1) % sectors], where[k]
            ray = place if way > 0 else (place + 1) % sectors
            strands.append((ray, before[0], (k - 1) % sectors, place, k))
        number = _stacks({k: place for k, (place, _) in where.items()}, strands)
        if number:
            found[frozenset(k for k in range(sectors) if picked[k])] = number
    return found
