"""Which theory page has which drawing: run as a program, it writes them to docs/pictures/theory."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from drawings import cones, enumeration, guidance, holding, kinds, mobility, motion, searching, thick, things, turning
from synth.making.drawing import Scene

FOLDER = Path(__file__).resolve().parent.parent / "pictures" / "theory"

DRAWINGS: dict[str, Callable[[], Scene]] = {
    **kinds.DRAWINGS,
    **mobility.DRAWINGS,
    **motion.DRAWINGS,
    **holding.DRAWINGS,
    **enumeration.DRAWINGS,
    **things.DRAWINGS,
    **cones.DRAWINGS,
    **turning.DRAWINGS,
    **guidance.DRAWINGS,
    **thick.DRAWINGS,
    **searching.DRAWINGS,
}
"""Name of a theory page to what draws its picture."""


def drawing_of(page: str) -> Scene:
    """Return the drawing of a page; who cannot see it is told what the function that draws it says of itself."""
    draw = DRAWINGS[page]
    return replace(draw(), title=(draw.__doc__ or "").split("\n")[0])


def main() -> None:
    """Write the drawings of the pages named, or all."""
    FOLDER.mkdir(exist_ok=True)
    for page in sys.argv[1:] or DRAWINGS:
        drawing_of(page).save(FOLDER / f"{page}.svg", force=True)


if __name__ == "__main__":
    main()
