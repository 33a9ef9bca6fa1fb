"""What a mechanism is: graphs, their drawings, centres, models."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import synth
from drawings.together import beside, said
from synth.drawing import Scene

__all__ = ["DRAWINGS"]

DATA = Path(__file__).resolve().parent.parent.parent / "data"


def sc_graphs() -> Scene:
    """A panel mechanism beside its link-joint graph with the centres of its loops."""
    teller = synth.read(DATA / "wiener" / "fortune-teller.json")
    return beside(
        said(synth.draw(teller, caption=None), "panels and creases"),
        said(synth.draw(teller, kind="graph", caption=None), "links, joints, and the centre of each loop"),
    )


DRAWINGS: dict[str, Callable[[], Scene]] = {"sc-graphs": sc_graphs}
