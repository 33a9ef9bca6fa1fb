"""How many positions a planar or spherical linkage has, by elimination modulo a prime: no tracking, no quaternions.

Links that driven joints hold together are one plate. Some bars are left out, or vertices cut, so that the other plates
hang on each other by one vertex each: a tree, with a tangent t of half an angle for each plate but one. A bar that was
left out keeps a distance (planar) or a scalar product (spherical), the two sides of a cut vertex are one place: these
are polynomials of degree 2 at most in each t. What satisfies all of them in the product of projective lines is a
position, but where 1 + t² |axis|² = 0 for some t, which is no rotation. Monomials modulo the equations, multiplied by
enough of these factors, are a space of as many dimensions as there are positions: a difference of two ranks.
Two bars at a vertex of their own are first left out, which have two places each time, and three plates of which each
two share a vertex made one, in both ways; the prime is such that these have coordinates. Coordinates are read as the fractions that they are in binary.
"""

from collections import Counter
from fractions import Fraction
from itertools import combinations, product

import networkx as nx
import numpy as np
from flint import fmpz, nmod_mat

from graphs.loops.loop import Centre

_LEVELS = range(-4, 5)
"""Degrees in each unknown, less those of all equations together: isolated positions need none beyond the latter."""


def primes():
    """Primes below 2^30, so that products fit 64 bits, modulo which roots are powers."""
    return (number for number in range(2**30 - 1, 2, -4) if fmpz(number).is_prime())


def residue(number, prime):
    """A fraction, a float or an integer."""
    whole = Fraction(number)
    return whole.numerator % prime * pow(whole.denominator, -1, prime) % prime


def dot(a, b, prime):
    return sum(x * y for x, y in zip(a, b, strict=True)) % prime


def rotated(axis, tangent, place, prime):
    """A direction rotated about another, or a point of the plane about another, by the tangent of half the angle."""
    if len(place) == 2:
        x, y = place[0] - axis[0], place[1] - axis[1]
        scale = pow(1 + tangent * tangent, -1, prime)
        c, s = (1 - tangent * tangent) * scale, 2 * tangent * scale
        return (axis[0] + c * x - s * y) % prime, (axis[1] + s * x + c * y) % prime
    (a, b, c), (x, y, z) = axis, place
    square, along = dot(axis, axis, prime) * tangent * tangent, 2 * tangent * tangent * dot(axis, place, prime)
    scale = pow(1 + square, -1, prime)
    cross = (b * z - c * y, c * x - a * z, a * y - b * x)
    return tuple(
        scale * ((1 - square) * q + along * p + 2 * tangent * r) % prime
        for p, q, r in zip(axis, place, cross, strict=True)
    )


def brought(here, there, place, prime):
    """A place where a plate is so moved that `here` is `there`."""
    if len(place) == 2:
        return tuple((q + b - a) % prime for a, b, q in zip(here, there, place, strict=True))
    middle = [(a + b) % prime for a, b in zip(here, there, strict=True)]  # of a half turn that changes the two
    scale = 2 * dot(middle, place, prime) * pow(dot(middle, middle, prime), -1, prime)
    return tuple((scale * m - q) % prime for m, q in zip(middle, place, strict=True))


def between(a, b, prime):
    """What a bar keeps: a squared distance, or a scalar product."""
    if len(a) == 3:
        return dot(a, b, prime)
    return sum((x - y) ** 2 for x, y in zip(a, b, strict=True)) % prime


class Tree:
    """Plates hung on each other, but for bars left out and for vertices that one of their plates lets go.

    Plates are mappings of vertices to coordinates where each plate is on its own; `cuts` are pairs of plate and vertex.
    """

    def __init__(self, plates, bars, cuts):
        self.plates = [
            {("cut", name) if (number, name) in cuts else name: place for name, place in plate.items()}
            for number, plate in enumerate(plates)
        ]
        self.bars, self.cuts = bars, cuts
        hung = [number for number in range(len(plates)) if number not in bars]
        self.graph = nx.Graph(
            (("plate", number), ("vertex", vertex)) for number in hung for vertex in self.plates[number]
        )
        self.root = max(hung, key=lambda number: len(plates[number]))
        self.whole = len(self.graph) == len(hung) + len(set().union(*self.plates)) and nx.is_tree(self.graph)
        if not self.whole:
            return
        self.hinges = {}
        for near, far in nx.bfs_edges(self.graph, ("plate", self.root)):
            if far[0] == "plate":
                self.hinges[far[1]] = near[1]
        self.column = {plate: column for column, plate in enumerate(self.hinges)}
        self.ends = [tuple(self.plates[bar]) for bar in bars] + [(name, ("cut", name)) for _, name in cuts]
        self.paths = [self._path(*ends) for ends in self.ends]
        columns = range(len(self.hinges))
        self.degrees = np.array([[2 * any(c == k for c, _ in path) for k in columns] for path in self.paths])
        self.degree = self.degrees[: len(bars)].sum(axis=0) + 2 * self.degrees[len(bars) :].sum(axis=0)

    @property
    def size(self):
        return np.prod(1.0 + self.degree)

    def _path(self, one, other):
        """The unknowns between two vertices in their order, and whether each is passed down the tree (1) or up."""
        nodes, found = nx.shortest_path(self.graph, ("vertex", one), ("vertex", other)), []
        for near, vertex, far in zip(nodes[1::2], nodes[2::2], nodes[3::2], strict=False):
            if self.hinges.get(near[1]) == vertex[1]:
                found.append((self.column[near[1]], -1))
            if self.hinges.get(far[1]) == vertex[1]:
                found.append((self.column[far[1]], 1))
        return found

    def equations(self, random, prime):
        """The coefficients of each equation, and |axis|² of each unknown; angles count from where they are random."""
        at = dict(self.plates[self.root])
        for plate, vertex in self.hinges.items():
            own, turn = self.plates[plate], int(random.integers(1, prime))
            for name in own:
                if name != vertex:
                    at[name] = rotated(at[vertex], turn, brought(own[vertex], at[vertex], own[name], prime), prime)
        axes = [at[vertex] for vertex in self.hinges.values()]
        squares = [dot(axis, axis, prime) if len(axis) == 3 else 1 for axis in axes]
        found = []
        for number, (one, other) in enumerate(self.ends):
            ends = self._ends(number, at[other], axes, squares, prime)
            if number < len(self.bars):
                bar = self.plates[self.bars[number]]
                kept = between(bar[one], bar[other], prime)
                off = [{at_: (between(at[one], end, prime) - kept) * scale for at_, (end, scale) in ends.items()}]
            else:
                parts = enumerate(at[one])
                off = [{at_: (end[k] - part) * scale for at_, (end, scale) in ends.items()} for k, part in parts]
            found += [self._polynomial(number, values, prime) for values in off]
        return found, squares

    def _ends(self, number, place, axes, squares, prime):
        """Where a path moves a place for tangents 0, 1, 2 each, and the product of all factors 1 + t² |axis|²."""
        path, ends = self.paths[number], {}
        for tangents in product(range(3), repeat=len(path)):
            end, scale = place, 1
            for (column, sense), tangent in zip(path[::-1], tangents[::-1], strict=True):
                end = rotated(axes[column], sense * tangent, end, prime)
                scale *= 1 + tangent * tangent * squares[column]
            ends[tangents] = end, scale
        return ends

    def _polynomial(self, number, at, prime):
        """The polynomial of degree 2 in each unknown of a path with values at tangents 0, 1, 2 each."""
        path, half = self.paths[number], pow(2, -1, prime)
        values = np.empty([3] * len(path), dtype=object)
        for tangents, value in at.items():
            values[tangents] = value % prime
        by_values = np.array([[1, 0, 0], [-3 * half, 2, -half], [half, -1, half]], dtype=object)
        for axis in range(len(path)):
            values = np.moveaxis(np.tensordot(by_values, values, axes=(1, axis)), 0, axis) % prime
        order = np.argsort([column for column, _ in path])
        return values.transpose(order).astype(np.int64).reshape(self.degrees[number] + 1)


def trees(plates):
    """All ways to leave out bars and to cut vertices so that a tree remains, with as few cuts as possible."""
    bars, many = [number for number, plate in enumerate(plates) if len(plate) == 2], (len(plates) - 1) // 2
    ends = [(number, name) for number, plate in enumerate(plates) if len(plate) > 2 for name in plate]
    for cuts in range(many + 1):
        chosen = product(combinations(bars, many - cuts), combinations(ends, cuts))
        found = [tree for tree in (Tree(plates, *one) for one in chosen) if tree.whole]
        if found:
            return found
    raise ValueError("no tree remains")


def multiples(polynomial, most):
    """Rows of coefficients of a polynomial times all monomials, of degrees in each unknown `most` altogether."""
    free = most - np.array(polynomial.shape) + 1
    if (free < 0).any():
        return np.zeros((0, np.prod(most + 1)), dtype=np.int64)
    rows = np.zeros((*(free + 1), *(most + 1)), dtype=np.int64)
    for shift in product(*(range(n + 1) for n in free)):
        rows[(*shift, *(slice(s, s + n) for s, n in zip(shift, polynomial.shape, strict=True)))] = polynomial
    return rows.reshape(-1, np.prod(most + 1))


def rank(rows, prime):
    return nmod_mat(*rows.shape, rows.ravel().tolist(), prime).rank()


def dimension(equations, squares, degrees, power, prime):
    """Of monomials of these degrees times a power of all factors 1 + t² |axis|², modulo the equations."""
    most, factor = degrees + 2 * power, np.ones([1] * len(squares), dtype=np.int64)
    for square in squares:
        one = np.array([1, 0, square], dtype=object)
        whole = np.ones(1, dtype=object)
        for _ in range(power):
            whole = np.convolve(whole, one) % prime
        factor = np.multiply.outer(factor, whole.astype(np.int64)) % prime
    factor = factor.reshape(factor.shape[len(squares) :])
    ideal = np.concatenate([multiples(equation, most) for equation in equations])
    return rank(np.concatenate([ideal, multiples(factor, most)]), prime) - rank(ideal, prime)


def number_of_positions(plates_modulo, random):
    """How many isolated positions plates have, each as often as it is a root; None if they are not isolated.

    The plates are given as a function of a prime.
    """
    for prime in primes():
        try:
            return _number(plates_modulo(prime), random, prime)
        except NoRootError:
            continue


class NoRootError(Exception):
    """Of three plates that are made one, coordinates are not in the field."""


def _number(plates, random, prime):
    if len(plates) == 1:
        return 1
    rest = without_two_bars(plates)
    if rest is not None:
        return 2 * _number(rest, random, prime)
    three = three_plates(plates)
    if three is None:
        return _by_elimination(plates, random, prime)
    numbers = [_number(one, random, prime) for one in made_one(plates, *three, prime)]
    return None if None in numbers else sum(numbers)


def without_two_bars(plates):
    """The plates less two bars at a vertex that is in no third one; None without such."""
    for vertex in set().union(*plates):
        those = [number for number, plate in enumerate(plates) if vertex in plate]
        if len(those) == 2 and all(len(plates[number]) == 2 for number in those):
            rest = [plate for number, plate in enumerate(plates) if number not in those]
            times = Counter(name for plate in rest for name in plate)
            return [{name: place for name, place in plate.items() if times[name] > 1} for plate in rest]
    return None


def three_plates(plates):
    """Three plates, and the vertices of the first and second, second and third, third and first; None without."""
    for numbers in combinations(range(len(plates)), 3):
        one, two, three = (plates[number].keys() for number in numbers)
        for corner, top, other in product(one & two, two & three, three & one):
            if len({corner, top, other}) == 3:
                return numbers, (corner, top, other)
    return None


def made_one(plates, numbers, corners, prime):
    """Yield the plates with three of them as one, in both ways."""
    first, second, third = (plates[number] for number in numbers)
    corner, top, other = corners
    a, c = first[corner], first[other]
    for b in tops(a, c, (second[corner], second[top]), (third[other], third[top]), prime):
        whole = dict(first)
        for plate, start, end in (
            (second, (second[corner], second[top]), (a, b)),
            (third, (third[other], third[top]), (c, b)),
        ):
            whole |= {name: carried(start, end, place, prime) for name, place in plate.items() if name not in whole}
        rest = [plate for number, plate in enumerate(plates) if number not in numbers]
        used = set().union(*rest)
        yield [{name: place for name, place in whole.items() if name in used}, *rest]


def root(square, prime):
    found = pow(square, (prime + 1) // 4, prime)
    if found * found % prime != square % prime:
        raise NoRootError
    return found


def tops(a, c, one, other, prime):
    """The two places that are from `a` as the second place of `one` is from its first, and so from `c`."""
    if len(a) == 2:
        near, far, base = between(*one, prime), between(*other, prime), between(a, c, prime)
        along = (near + base - far) * pow(2 * base, -1, prime) % prime
        up = root((near * pow(base, -1, prime) - along * along) % prime, prime)
        x, y = c[0] - a[0], c[1] - a[1]
        return [((a[0] + along * x - s * y) % prime, (a[1] + along * y + s * x) % prime) for s in (up, -up)]
    p, q, r = dot(a, a, prime), dot(a, c, prime), dot(c, c, prime)
    u, v = dot(*one, prime), dot(*other, prime)
    area = (p * r - q * q) % prime
    scale = pow(area, -1, prime)
    x, y = (r * u - q * v) * scale, (p * v - q * u) * scale
    up = root((dot(one[1], one[1], prime) - x * u - y * v) * scale % prime, prime)
    return [combined(a, c, (x, y, s), prime) for s in (up, -up)]


def combined(a, c, weights, prime):
    """A direction by its parts along two directions and their vector product."""
    x, y, z = weights
    return tuple((x * p + y * q + z * n) % prime for p, q, n in zip(a, c, across(a, c), strict=True))


def across(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def carried(start, end, place, prime):
    """A place of a plate that is so moved that two of its places, `start`, are `end`."""
    (a, b), (c, d) = start, end
    if len(a) == 2:
        (x, y), (u, v), (p, q) = ([j - i for i, j in zip(*pair, strict=True)] for pair in ((a, b), (c, d), (a, place)))
        scale = pow(x * x + y * y, -1, prime)
        # the complex number (p + q i) (u + v i) / (x + y i)
        re, im = ((p * x + q * y) * scale, (q * x - p * y) * scale)
        return (c[0] + re * u - im * v) % prime, (c[1] + re * v + im * u) % prime
    p, q, r = dot(a, a, prime), dot(a, b, prime), dot(b, b, prime)
    u, v, w = dot(a, place, prime), dot(b, place, prime), dot(across(a, b), place, prime)
    scale = pow(p * r - q * q, -1, prime)
    return combined(c, d, ((r * u - q * v) * scale, (p * v - q * u) * scale, w * scale), prime)


def _by_elimination(plates, random, prime):
    # Functions on points of degree d + 1 are products of those of degree d and of degree 1: where there are no more of
    # degree d + 1 than of d there are none of any degree. The power of the factors is enough where one more is the same.
    tree = min(trees(plates), key=lambda tree: tree.size)
    equations, squares = tree.equations(random, prime)
    before = -1
    for level in _LEVELS:
        degrees = np.maximum(tree.degree + level, 1)
        here = dimension(equations, squares, degrees, 1, prime)
        if here == before and dimension(equations, squares, degrees - 1, 2, prime) == here:
            return here
        before = here
    return None


def plates_of(linkage, drive, prime):
    """The plates of a linkage whose driven joints are turned, of loops all of one plane across z or about one centre."""
    names, curved = list(linkage.graph.joints), linkage.loops[0].centre is Centre.FINITE
    rows = linkage.directions if curved else linkage.points[:, :2]
    places = [tuple(residue(part, prime) for part in row) for row in rows.tolist()]
    steps, held = {}, nx.Graph()
    held.add_nodes_from(linkage.graph.nodes)
    for joint, angle in drive.items():
        column, (near, far) = names.index(joint), linkage.graph.joints[joint]
        turned = (angle - linkage.angles[column]) * (1.0 if curved else np.sign(linkage.directions[column, 2]))
        length = np.linalg.norm(rows[column]) if curved else 1.0
        held.add_edge(near, far, joint=column, first=near, tangent=residue(float(np.tan(0.5 * turned) / length), prime))
    alike, group = nx.utils.UnionFind(range(len(names))), {}
    for one, other in combinations(range(len(names)), 2):
        if places[one] == places[other] and set(linkage.graph.joints[names[one]]) & set(
            linkage.graph.joints[names[other]]
        ):
            alike.union(one, other)
    for part in nx.connected_components(held):
        root = min(part, key=list(linkage.graph.nodes).index)
        group[root], steps[root] = root, []
        for near, far in nx.bfs_edges(held, root):
            edge = held[near][far]
            tangent = edge["tangent"] * (1 if edge["first"] == near else -1)
            group[far], steps[far] = root, [(places[edge["joint"]], tangent), *steps[near]]
    plates = {root: {} for root in group.values()}
    for column, name in enumerate(names):
        for link in linkage.graph.joints[name] if name not in drive else ():
            place = places[column]
            for axis, tangent in steps[link]:
                place = rotated(axis, tangent, place, prime)
            plates[group[link]][alike[column]] = place
    return list(plates.values())


def random_plates(plates, dimensions, seed, prime):
    """Plates with these vertices and random coordinates, on a sphere (3) or in the plane (2)."""
    random = np.random.default_rng(seed)
    at = {v: tuple(random.integers(1, prime, dimensions).tolist()) for v in sorted(set().union(*plates))}
    return [{vertex: at[vertex] for vertex in sorted(plate)} for plate in plates]
