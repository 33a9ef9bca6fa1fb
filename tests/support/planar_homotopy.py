"""All positions of planar linkages by a homotopy from products of linear forms, of which Bezout's theorem counts all.

A link turned by t has the unit complex number e^(it). Loops close if these numbers, x, satisfy linear equations, and
their inverses, y, the conjugate ones. What is left of x and of y are L unknowns each for L loops, and 2 L equations x y =
1 that are linear in both: there are binomial(2 L, L) solutions in a product of two projective spaces at most.
"""

from itertools import combinations

import networkx as nx
import numpy as np


def positions_of(linkage, drive, random):
    """The unit complex numbers of all links at each isolated position, complex[N, links]; turned by real or complex."""
    links = {link: place for place, link in enumerate(linkage.graph.nodes)}
    names = list(linkage.graph.joints)
    held = nx.Graph()
    held.add_nodes_from(range(len(links)))
    for joint, angle in drive.items():
        first, second = (links[link] for link in linkage.graph.joints[joint])
        sense = np.sign(linkage.directions[names.index(joint)][2])
        held.add_edge(first, second, turn={(first, second): sense * angle, (second, first): -sense * angle})
    group, turned = np.zeros(len(links), dtype=int), np.ones(len(links), dtype=complex)
    for number, part in enumerate(nx.connected_components(held)):
        root = min(part)
        group[root] = number
        for near, far in nx.bfs_edges(held, root):
            group[far], turned[far] = number, turned[near] * np.exp(1j * held[near][far]["turn"][near, far])
    rows = np.zeros((len(linkage.loops), group.max() + 1), dtype=complex)
    points = linkage.points[:, 0] + 1j * linkage.points[:, 1]
    for row, loop in zip(rows, linkage.loops, strict=True):
        for one, other in zip(loop.joints, [*loop.joints[1:], loop.joints[0]], strict=True):
            (common,) = set(linkage.graph.joints[names[one]]) & set(linkage.graph.joints[names[other]])
            row[group[links[common]]] += (points[other] - points[one]) * turned[links[common]]
    # the group of the first link stays where it is
    size = len(rows)
    assert rows.shape[1] == 2 * size + 1
    origin = np.linalg.lstsq(rows[:, 1:], -rows[:, 0], rcond=None)[0]
    space = np.linalg.svd(rows[:, 1:])[2][size:].conj().T
    x, y = (origin, space), (origin.conj(), space.conj())
    ends = _followed(x, y, random)
    whole = np.concatenate([np.ones((len(ends), 1)), origin + ends[:, :size] @ space.T], axis=1)
    return whole[:, group] * turned


def _followed(x, y, random):
    """Solutions of (x0 + X u) (y0 + Y v) = 1 by paths from those of a product of random linear forms."""
    size = len(x[0]) // 2

    def complexes(*shape):
        return random.normal(size=shape) + 1j * random.normal(size=shape)

    forms, gamma = (
        [(complexes(2 * size), complexes(2 * size, size)) for _ in range(2)],
        np.exp(2j * random.uniform(0, 3)),
    )
    # in projective space: each side has one coordinate more, normed by a random plane
    planes = [complexes(size + 1) for _ in range(2)]

    def value(place, s):
        u, v = place[: size + 1], place[size + 1 :]
        rows, out = np.zeros((2 * size + 2, 2 * size + 2), dtype=complex), np.zeros(2 * size + 2, dtype=complex)
        by = np.zeros_like(out)
        for weight, slope, (one, other), minus in ((s, 1.0, (x, y), 1.0), (gamma * (1 - s), -gamma, forms, 0.0)):
            left, right = np.column_stack(one[::1]), np.column_stack(other[::1])
            a, b = left @ u, right @ v
            out[: 2 * size] += weight * (a * b - minus * u[0] * v[0])
            by[: 2 * size] += slope * (a * b - minus * u[0] * v[0])
            rows[: 2 * size, : size + 1] += weight * b[:, None] * left
            rows[: 2 * size, size + 1 :] += weight * a[:, None] * right
            rows[: 2 * size, 0] -= weight * minus * v[0]
            rows[: 2 * size, size + 1] -= weight * minus * u[0]
        for k, (plane, part) in enumerate(zip(planes, (slice(0, size + 1), slice(size + 1, None)), strict=True)):
            out[2 * size + k] = plane @ place[part] - 1.0
            rows[2 * size + k, part] = plane
        return out, rows, by

    found = []
    for chosen in combinations(range(2 * size), size):
        others = sorted(set(range(2 * size)) - set(chosen))
        place = []
        for form, which, plane in ((forms[0], list(chosen), planes[0]), (forms[1], others, planes[1])):
            matrix = np.vstack([np.column_stack(form)[which], plane])
            place.append(np.linalg.solve(matrix, np.eye(size + 1)[:, -1]))
        end = _path(value, np.concatenate(place))
        if end is not None and min(abs(end[0]), abs(end[size + 1])) > 1e-6:
            found.append(np.concatenate([end[1 : size + 1] / end[0], end[size + 2 :] / end[size + 1]]))
    return np.array(found).reshape(-1, 2 * size)


def _path(value, place):
    """The end of a path at s = 1; None where it cannot be followed to a regular one."""
    s, step = 0.0, 0.02
    while s < 1.0:
        onwards = min(1.0, s + step)
        _, rows, by = value(place, s)
        rate = np.linalg.solve(rows, -by)
        _, rows, by = value(place + 0.5 * (onwards - s) * rate, 0.5 * (s + onwards))
        tried = place + (onwards - s) * np.linalg.solve(rows, -by)
        sizes = []
        for _ in range(3):
            out, rows, _ = value(tried, onwards)
            change = np.linalg.solve(rows, -out)
            tried = tried + change
            sizes.append(np.abs(change).max() / np.abs(tried).max())
        if sizes[0] < 1e-3 and sizes[2] < 1e-9:
            place, s, step = tried, onwards, min(2.0 * step, 0.1)
        else:
            step *= 0.5
            if step < 1e-9:
                return None
    return place
