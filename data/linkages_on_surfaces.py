"""The mechanisms of Hyatt et al. 2020 and 2021 and of Tipparthi and Larochelle 2011: their types.

The papers give angles and lengths; files of types hold none.
"""

from __future__ import annotations

from entries import entries_of
from wiener_2016 import STEPHENSON, STEPHENSON_LOOPS

from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph

cones = entries_of("hyatt", "Hyatt et al. 2020", "000")
cylinders = entries_of("hyatt", "Hyatt et al. 2021", "001")
hoops = entries_of("tipparthi", "Tipparthi and Larochelle 2011", "002")

FOUR_BAR = [(0, 1), (1, 2), (2, 3), (3, 0)]


def four_bar(centre: str, names: str) -> SCGraph:
    """Return a four-bar with its joints named as in the paper and link 0 fixed."""
    return SCGraph(4, dict(zip(names, FOUR_BAR, strict=True)), [Loop(tuple(names), centre)], ground=0)


ENTRIES = [
    cones("spherical-four-bar", "Fig. 10", "fig10a_T", lambda: four_bar("finite", "OABC"),
          "N 4 J 4 M 1"),
    cones("fig11-stephenson", "Fig. 11", "fig11_stephenson2", lambda: SCGraph(6, STEPHENSON, STEPHENSON_LOOPS),
          "N 6 J 7 M 1", "which axes form which loop is not printed"),
    cylinders("planar-four-bar", "Table 1", "table1_eq1_3", lambda: four_bar("infinite", "1234"),
              "N 4 J 4 M 1"),
    hoops("spherical-4r", "Case studies 1 and 2", "hoop_case1", lambda: four_bar("finite", "FWVG"),
          "N 4 J 4 M 1", "two RR dyads with one coupler"),
]  # fmt: skip
