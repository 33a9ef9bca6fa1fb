"""The generators of pop-ups and cartons. Theory: docs/theory/generators.md."""

from __future__ import annotations

from synth.patterns.generator import Generator, angle, count, length
from synth.patterns.goods import cartons, pop_ups

__all__ = ["GENERATORS"]

_OPENING = angle("opening", 90, 10, 170, "between the halves of the card")

GENERATORS = (
    Generator(
        "parallel-pop-up", "Pop-up across a fold, creases parallel to it", pop_ups.parallel_pop_up,
        (
            _OPENING,
            length("left", 2.0, 1.5, 2.5, "from the fold to the panel on the left half"),
            length("right", 2.0, 1.5, 2.5, "from the fold to the panel on the right half"),
            length("first", 3.0, 2.6, 4.0, "width of the panel on the left half"),
            length("second", 3.0, 2.6, 4.0, "width of the panel on the right half"),
        ),
        lambda _: 1, "the panels reach each other; the card closes if left + first = right + second",
        "Glassner 2002; a planar four-bar",
        relations="sqrt(left^2 + right^2 - 2 left right cos(opening)) is less than first + second, "
        "and more than their difference",
    ),
    Generator(
        "angle-pop-up", "Pop-up across a fold, creases that meet on it", pop_ups.angle_pop_up,
        (
            _OPENING,
            angle("base", 40, 10, 60, "between the fold and the creases on the card"),
            angle("rise", 75, 61, 89, "of each panel, between its crease on the card and the ridge"),
        ),
        lambda _: 1, "panels alike on both sides that reach each other", "Glassner 2002; a spherical four-bar",
    ),
    Generator(
        "box-pop-up", "Box cut out of a card", pop_ups.box_pop_up,
        (
            length("depth", 1.0, 0.2, 5, "from the fold to the crease on the left half"),
            length("more", 0.5, 0.1, 5, "by which the crease on the right half is farther"),
            length("width", 1.0, 0.1, 5, "of the box"),
        ),
        lambda _: 1, "on either of two ways: the box pops up, or lies on the card", "Glassner 2002", True,
    ),
    Generator(
        "slit-array", "Card with a row of boxes", pop_ups.slit_card,
        (
            count("strips", 2, 1, 6, "boxes"),
            length("depth", 1.0, 0.2, 5, "from the fold to the creases on the left half"),
            length("more", 0.5, 0.1, 5, "by which the creases on the right half are farther"),
            length("width", 1.0, 0.1, 5, "of a box and of what is between two"),
        ),
        lambda _: 1, "on each way: every box pops up or lies on the card", "Glassner 2002", True,
    ),
    Generator(
        "webbed-tray", "Tray with webbed corners", cartons.webbed_tray,
        (
            length("length", 3.0, 0.5, 10, "of the bottom"),
            length("width", 2.0, 0.5, 10, "of the bottom"),
            length("height", 0.8, 0.1, 5, "of the walls"),
        ),
        lambda _: 4, "a freedom for each wall", "spherical loops of five links at the corners", True,
    ),
    Generator(
        "crash-lock", "Carton with a crash-lock bottom", cartons.crash_lock,
        (
            angle("opening", 70, 5, 85, "between walls at a glued corner; 90 degrees locks"),
            length("length", 2.0, 0.5, 10, "of the bottom"),
            length("width", 1.4, 0.5, 10, "of the bottom"),
            length("height", 2.0, 0.5, 10, "of the walls"),
        ),
        lambda _: 1, "until the creases of the bottom are flat, at a right angle", "Dai and Cannella 2008",
    ),
)  # fmt: skip
