"""Which theory page has which drawing: run as a program, it writes them to docs/pictures/theory."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from drawings import holding, kinds, mobility, motion
from synth.drawing import Scene, save_scene

FOLDER = Path(__file__).resolve().parent.parent / "pictures" / "theory"

DRAWINGS: dict[str, Callable[[], Scene]] = {
    **kinds.DRAWINGS,
    **mobility.DRAWINGS,
    **motion.DRAWINGS,
    **holding.DRAWINGS,
}
"""Name of a theory page to what draws its picture."""


def main() -> None:
    """Write the drawings of the pages named, or all."""
    FOLDER.mkdir(exist_ok=True)
    for page in sys.argv[1:] or DRAWINGS:
        save_scene(titled(DRAWINGS[page]), FOLDER / f"{page}.svg", force=True)


def titled(drawing: Callable[[], Scene]) -> Scene:
    """Return a drawing with a title: what its function says that it shows, where it has none of its own."""
    scene = drawing()
    what, *_ = (drawing.__doc__ or "").split("\n")
    return scene if scene.title else replace(scene, title=what)


if __name__ == "__main__":
    main()
