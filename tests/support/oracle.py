"""A second method: generic mobility as joints minus the numerical rank of the loop closure at random."""

from __future__ import annotations

import networkx as nx
import numpy as np

from graphs.loops.loop import Centre
from graphs.mechanism.sc import SCGraph


def placed_centres(sc: SCGraph, rng: np.random.Generator) -> list[np.ndarray] | None:
    """Place the centres one by one at random, on the axes that two placed centres fix; None if that fails."""
    classes = sc.centre_classes()
    points: list[np.ndarray] = []
    on_axis: dict[object, list[int]] = {}
    for k, one in enumerate(classes):
        infinite = one.centre is Centre.INFINITE
        lines = [on_axis[joint][:2] for joint in one.joints if len(on_axis.get(joint, [])) >= 2]
        if len(lines) > 1:
            return None
        if lines:
            p, q = (points[i] for i in lines[0])
            at_infinity = p[3] * q - q[3] * p
            point = at_infinity if infinite else rng.normal() * p + rng.normal() * q
            if not np.any(point):
                return None
        else:
            point = np.append(rng.normal(size=3), 0.0 if infinite else 1.0)
        points.append(point)
        for joint in one.joints:
            on_axis.setdefault(joint, []).append(k)
    return points


def numeric_mobility(sc: SCGraph, seed: int = 0) -> int | None:
    """Place the centres of a mechanism at random and count the freedoms of its joints."""
    rng = np.random.default_rng(seed)
    points = placed_centres(sc, rng)
    if points is None:
        return None
    twists = {}
    for joint in sc.joints:
        on_axis = [p for one, p in zip(sc.centre_classes(), points, strict=True) if joint in one.joints]
        while len(on_axis) < 2:
            on_axis.append(np.append(rng.normal(size=3), 1.0))
        p, q = on_axis[:2]
        twists[joint] = np.concatenate([p[3] * q[:3] - q[3] * p[:3], np.cross(p[:3], q[:3])])
    rows = []
    forest = nx.minimum_spanning_tree(nx.Graph(sc))
    in_tree, first = {}, set()
    for joint, (a, b) in sc.joints.items():
        if forest.has_edge(a, b) and frozenset((a, b)) not in first:
            first.add(frozenset((a, b)))
            in_tree[frozenset((a, b))] = joint
    number = {joint: i for i, joint in enumerate(sc.joints)}
    for joint, (a, b) in sc.joints.items():
        if in_tree.get(frozenset((a, b))) == joint:
            continue
        block = np.zeros((6, len(number)))
        block[:, number[joint]] = twists[joint]  # from a to b, and back through the tree
        path = nx.shortest_path(forest, b, a)
        for u, v in zip(path, path[1:], strict=False):
            k = in_tree[frozenset((u, v))]
            block[:, number[k]] += twists[k] * (1 if sc.joints[k] == (u, v) else -1)
        rows.append(block)
    if not rows:
        return len(number)
    return len(number) - int(np.linalg.matrix_rank(np.vstack(rows), tol=1e-9))
