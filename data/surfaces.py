"""Linkages with their angles: Hyatt et al. 2020, Fig. 11, with every membership of its loops; 2021, Fig. 10."""

from __future__ import annotations

from dataclasses import replace
from math import degrees, radians
from pathlib import Path

from decimals import DIGITS
from memberships import memberships
from wiener_2016 import STEPHENSON, STEPHENSON_LOOPS

from graphs.files.atomic import write_text
from graphs.files.formats import write
from graphs.files.text import json_text
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.surfaces import Cone, Cylinder, SurfaceLinkage
from synth.linkages.conformed.linkage_behaviour import loop_on_cylinders

FIG_11 = {"OA": -40, "AB": -20, "BC": -45, "CD": -68, "DE": 28, "EF": 30}
"""The six printed steps, degrees: an open run through the seven axes."""
LAMBDA = 20


def fig_11() -> list[SurfaceLinkage]:
    """Return Fig. 11 with each membership of its loops that fits: steps are between joints of one link."""
    steps = {(run[0], run[1]): radians(step) for run, step in FIG_11.items()}
    chains = memberships(SCGraph(6, STEPHENSON, STEPHENSON_LOOPS), "OABCDEF")
    return [SurfaceLinkage(chain, steps=steps, surface=Cone(radians(LAMBDA))) for chain in chains]


def fig_10() -> SurfaceLinkage:
    """Return the links 4, 3, 5, 1 of Hyatt et al. 2021, Fig. 10, open on their cylinder of radius 2.54."""
    linkage = loop_on_cylinders([4, 3, 5, 1])[0].linkage()
    steps = {pair: radians(round(degrees(step), DIGITS)) for pair, step in (linkage.steps or {}).items()}
    return replace(linkage, steps=steps, surface=Cylinder(round(linkage.surface.radius, DIGITS)))


def write_surfaces(folder: Path) -> None:
    """Write the linkage with the first membership, and the list of all; and the one on a cylinder."""
    folder.mkdir(exist_ok=True)
    linkages = fig_11()
    write(linkages[0], folder / "fig11-stephenson.json", force=True)
    write(fig_10(), folder / "fig10-four-bar.json", force=True)
    rows = [["".join(loop.joints) for loop in linkage.chain.loops] for linkage in linkages]
    document = {
        "source": "Hyatt et al. 2020, Fig. 11",
        "note": "which axes form the loops is not printed; these are all ways, each loop's axes in its order",
        "memberships": rows,
    }
    write_text(folder / "fig11-memberships.json", json_text(document), force=True)
