"""Chains by another road: nauty's graphs, and rigid sub-chains looked for among all subsets of links."""

from __future__ import annotations

import shutil
import subprocess

import networkx as nx
import numpy as np
import pytest


def geng(*arguments):
    """Return the graphs that nauty's geng prints; skip the test where there is no nauty."""
    program = shutil.which("nauty-geng") or shutil.which("geng")
    if program is None:
        pytest.skip("nauty is not installed (Debian: apt-get install nauty)")
    lines = subprocess.run([program, "-q", *arguments], capture_output=True, check=True).stdout.split()
    return [nx.from_graph6_bytes(line) for line in lines]


def without_rigid_parts(graphs):
    """Return those of some graphs with equally many nodes whose subsets of two links or more can all move."""
    if not graphs:
        return []
    n = len(graphs[0])
    size = np.array([s.bit_count() for s in range(1 << n)])
    kept = []
    for i in range(0, len(graphs), 2000):
        batch = graphs[i : i + 2000]
        neighbours = np.array([[sum(1 << u for u in graph[v]) for v in range(n)] for graph in batch])
        joints = np.zeros((len(batch), 1), np.int16)
        for v in range(n):
            with_v = joints + size[neighbours[:, v, None] & np.arange(1 << v)]
            joints = np.hstack([joints, with_v.astype(np.int16)])
        moves = (3 * (size - 1) - 2 * joints >= 1)[:, size >= 2].all(axis=1)
        kept += [graph for graph, good in zip(batch, moves, strict=True) if good]
    return kept


def chains_by_geng(links, dof, fractionated=False):
    """Return all chains with so many links and freedoms, by geng and a look at all subsets of links."""
    joints = (3 * (links - 1) - dof) // 2
    kind = "-c" if fractionated else "-C"
    return without_rigid_parts(geng(kind, "-d2", str(links), f"{joints}:{joints}"))
