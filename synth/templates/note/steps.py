"""What is to be done with a printed template, in words."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from textwrap import wrap

from graphs.errors import numbered
from synth.templates.lines import Kind, Piece, Text
from synth.templates.pieces.hinges import Hinges

__all__ = ["PRINTING", "TILES", "steps_of_folds", "steps_of_hinges", "steps_of_joins", "written_steps"]

PRINTING = "Print at 100 %, not fitted to the page, and measure the gauge: it is 100 mm long."
TILES = "Lay the pages of a piece together, crosses of one name over each other, and tape them."
_FOLDS: dict[Kind, tuple[str, str, str]] = {
    "MOUNTAIN": ("mountain", "mountains", "red, dash and dot: away from you"),
    "VALLEY": ("valley", "valleys", "blue, dashes: towards you"),
    "CREASE": ("other crease", "other creases", "magenta, dots: either way"),
}
_SIZE, _LINE = 3.6, 5.2
"""Height of letters, and from line to line, millimetres."""
_LETTER = 0.5
"""Width of a letter in the mean, in units of its height."""


def steps_of_folds(pieces: Sequence[Piece]) -> list[str]:
    """Return the steps that cut and fold.

    >>> from synth.templates.lines import Stroke
    >>> steps_of_folds([Piece((Stroke("CUT", (0, 0), (9, 0)), Stroke("VALLEY", (0, 5), (9, 5))), (), None)])[1]
    'Fold 1 valley (blue, dashes: towards you). You see the printed side.'
    """
    counts = Counter(stroke.kind for piece in pieces for stroke in piece.strokes)
    cut = f"Cut out {numbered(len(pieces), 'piece')} along the full black lines. Score the folds first."
    folds = [f"{numbered(counts[kind], *name)} ({how})" for kind, (*name, how) in _FOLDS.items() if counts[kind]]
    return [cut] + ([f"Fold {', '.join(folds)}. You see the printed side."] if folds else [])


def steps_of_joins(edges: int, without: int, *, slotted: bool = False) -> list[str]:
    """Return the steps that join edges: how many meet another, and how many of these have no tab.

    Tabs are glued unless slotted.
    """
    if not edges:
        return []
    steps = []
    if edges > without and slotted:
        steps.append(
            f"Put {numbered(edges - without, 'tab')} through slots: each into the panel at whose edge its number "
            "stands again, from the side to which it is folded, until its fold lies along that edge."
        )
    elif edges > without:
        steps.append(
            f"Glue {numbered(edges - without, 'tab')}: each to the panel at whose edge its number stands again, "
            "on the side to which it is folded, its fold along that edge."
        )
    if without:
        steps.append(f"Tape {numbered(without, 'pair')} of edges of one number that have no tab, edge to edge.")
    return steps


def steps_of_hinges(hinges: Hinges | None) -> list[str]:
    """Return the steps for folds in thick material."""
    if hinges is None:
        return []
    wide = f"{hinges.width:g} mm"
    told = {
        "offset": f"Each fold is two, {wide} apart: bend each half way; thick panels then have room between.",
        "living": f"Rows of cuts, {wide} wide, are the folds: bend them gently, M away from you, V towards you.",
        "gap": f"Panels stay {wide} apart where they hinge: join them with tape or cloth as they lie on the page, "
        "M to be folded away from you, V towards you.",
    }
    return [told[hinges.kind]]


def written_steps(steps: Sequence[str], corner: tuple[float, float], width: float) -> tuple[list[Text], float]:
    """Return steps as lines of text, and the height that they take.

    `corner` is (left, top) and `width` the longest line; all in millimetres.
    """
    letters = int(width / (_LETTER * _SIZE))
    lines: list[str] = []
    for number, step in enumerate(steps, start=1):
        first, rest = f"{number}. ", " " * 5
        lines += wrap(step, letters, initial_indent=first, subsequent_indent=rest)
    left, top = corner
    texts = [
        Text((left, top - (number + 0.5) * _LINE), line, _SIZE, middle=False) for number, line in enumerate(lines)
    ]
    return texts, len(lines) * _LINE
