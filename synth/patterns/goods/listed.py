"""The generators of pop-ups and cartons. Theory: docs/theory/generators.md."""

from __future__ import annotations

from synth.patterns.generator import Generator, angle, count, length
from synth.patterns.goods import cartons, pop_ups

__all__ = ["GENERATORS"]

_OPENING = angle("opening", 90, 10, 170, "angle between the halves of the card")

GENERATORS = (
    Generator(
        "parallel-pop-up", "Pop-up across a fold, creases parallel to it", pop_ups.parallel_pop_up,
        (
            _OPENING,
            length("left", 2.0, 1.5, 2.5, "distance from the fold to the panel on the left half"),
            length("right", 2.0, 1.5, 2.5, "distance from the fold to the panel on the right half"),
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
            angle("base", 40, 10, 60, "angle between the fold and the creases on the card"),
            angle("rise", 75, 61, 89, "angle of each panel between its crease on the card and the ridge"),
        ),
        lambda _: 1, "panels alike on both sides that reach each other", "Glassner 2002; a spherical four-bar",
    ),
    Generator(
        "box-pop-up", "Box cut out of a card", pop_ups.box_pop_up,
        (
            length("depth", 1.0, 0.2, 5, "distance from the fold to the crease on the left half"),
            length("more", 0.5, 0.1, 5, "extra distance of the crease on the right half"),
            length("width", 1.0, 0.1, 5, "width of the box"),
        ),
        lambda _: 1, "on either of two branches: the box pops up, or stays flat", "Glassner 2002", True,
    ),
    Generator(
        "beaked-box", "Box cut out of a card, whose ridge ends in a beak", pop_ups.beaked_box,
        (
            length("depth", 1.0, 0.6, 5, "distance from the fold to the crease on the left half"),
            length("more", 0.5, 0.1, 5, "extra distance of the crease on the right half"),
            length("width", 1.0, 0.7, 5, "width of the box"),
            angle("angle", 40, 5, 55, "angle between the ridge and the creases of the beak"),
            length("reach", 0.6, 0.05, 0.95, "length of the beak along the ridge"),
        ),
        lambda _: 1, "a planar and a spherical loop of four that share the ridge, on each branch",
        "Wiener 2016, Fig. 36, element 1: a six-bar of one planar and one spherical loop", True,
        relations="reach is less than width, reach tan(angle) less than depth",
    ),
    Generator(
        "slit-array", "Card with a row of boxes", pop_ups.slit_card,
        (
            count("strips", 2, 1, 6, "number of boxes"),
            length("depth", 1.0, 0.2, 5, "distance from the fold to the creases on the left half"),
            length("more", 0.5, 0.1, 5, "extra distance of the creases on the right half"),
            length("width", 1.0, 0.1, 5, "width of a box, and of the strip between two boxes"),
        ),
        lambda _: 1, "on each branch: every box pops up or stays flat", "Glassner 2002", True,
    ),
    Generator(
        "webbed-tray", "Tray with webbed corners", cartons.webbed_tray,
        (
            length("length", 3.0, 0.5, 10, "length of the bottom"),
            length("width", 2.0, 0.5, 10, "width of the bottom"),
            length("height", 0.8, 0.1, 5, "height of the walls"),
        ),
        lambda _: 4, "one degree of freedom per wall", "spherical loops of five links at the corners", True,
    ),
    Generator(
        "crash-lock", "Carton with a crash-lock bottom", cartons.crash_lock,
        (
            angle("opening", 70, 5, 85, "angle between walls at a glued corner; at 90 degrees the bottom locks"),
            length("length", 2.0, 0.5, 10, "length of the bottom"),
            length("width", 1.4, 0.5, 10, "width of the bottom"),
            length("height", 2.0, 0.5, 10, "height of the walls"),
        ),
        lambda _: 1, "until the creases of the bottom are flat, at a right angle", "Dai and Cannella 2008",
    ),
)  # fmt: skip
