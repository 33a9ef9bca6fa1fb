"""Loops of bare link-joint graphs."""

import os
import subprocess
import sys

_JOINTS = "0-8 0-12 1-9 1-12 2-4 2-10 3-4 3-11 5-8 5-9 5-10 6-8 6-9 6-11 7-10 7-11 7-12"
"""A chain of 13 links that cannot be drawn without crossings."""

_LOOPS = """
import sys
import networkx as nx
from graphs.convert.link_joint import sc_from_link_joint_graph

graph = nx.Graph([tuple(map(int, pair.split("-"))) for pair in sys.argv[1].split()])
print(sc_from_link_joint_graph(graph).loops)
"""


def test_loops_come_in_the_same_order_in_every_process():
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    printed = [
        subprocess.run(
            [sys.executable, "-c", _LOOPS, _JOINTS],
            env={**environment, "PYTHONHASHSEED": seed},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for seed in "01"
    ]
    assert printed[0].count("Loop(") == 5
    assert printed[0] == printed[1]
