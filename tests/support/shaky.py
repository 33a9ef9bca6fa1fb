"""Linkages that move and are shaky all along: of flexes beside their motion that close to first order only."""

import numpy as np

from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids


def with_flat_triangles(solids, number, chance):
    """Return solids with triangles of three parallel axes in one plane put on their links.

    A link and two bars, joined in line: the middle axis may begin to move across the line, and cannot, since the
    bars are as long as the line. Each triangle is one flex more, and no freedom.
    """
    joints, axes = dict(solids.chain.joints), dict(solids.axes)
    links = list(solids.chain.nodes)
    size = np.ptp([point for point, _ in axes.values()], axis=0).max()
    middle = np.mean([point for point, _ in axes.values()], axis=0)
    for triangle in range(number):
        host = links[chance.integers(len(solids.chain))]
        along, normal = np.linalg.qr(chance.normal(size=(3, 2)))[0].T
        start = middle + size * chance.uniform(-0.5, 0.5, 3)
        bars = [f"bar {triangle}-{side}" for side in (1, 2)]
        links += bars
        ends = (host, bars[0]), (bars[0], bars[1]), (bars[1], host)
        for place, (pair, far) in enumerate(zip(ends, (0.0, chance.uniform(0.3, 0.7), 1.0), strict=True)):
            joints[f"flat {triangle}-{place}"] = pair
            point = start + 0.5 * size * far * along
            axes[f"flat {triangle}-{place}"] = tuple(point.tolist()), tuple(normal.tolist())
    return HingedSolids(SCGraph(links, joints, solids.chain.loops), axes)
