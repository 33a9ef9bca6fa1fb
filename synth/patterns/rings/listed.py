"""The generators of rings of solids. Theory: docs/theory/generators.md."""

from __future__ import annotations

from graphs.mechanism.solids import HingedSolids
from synth.patterns.generator import Generator, Parameter, angle, count, length
from synth.patterns.rings import bennett, bricard
from synth.patterns.rings.kaleidocycles import kaleidocycle
from synth.patterns.rings.spherical import spherical_ring

__all__ = ["GENERATORS"]

_FIRST = angle("first", 60, 20, 160, "angle of the first joint")
_TWIST = angle("twist", 40, 15, 55, "angle between the axes of a solid")
_FIVE = ", no five by more than 720"
_ARCS = (75, 80, 70, 85, 65, 60)


def _of_arcs(**arcs: float) -> HingedSolids:
    return spherical_ring([arcs[f"arc{i}"] for i in range(1, len(arcs) + 1)])


def _arcs(links: int) -> tuple[Parameter, ...]:
    return tuple(angle(f"arc{i + 1}", _ARCS[i], 5, 175, f"arc of link {i}") for i in range(links))


GENERATORS = (
    Generator(
        "sarrus", "Linkage of Sarrus", bennett.sarrus,
        (
            length("side", 1.0, 0.1, 10, "side of the plates"),
            length("height", 1.6, 0.1, 10, "height between the plates"),
            length("out", 0.6, 0.1, 10, "distance of the knees from the plates"),
        ),
        lambda _: 1, "two triples of parallel axes, not parallel to each other", "Sarrus 1853",
    ),
    Generator(
        "bennett", "Bennett's linkage", bennett.bennett,
        (_FIRST, _TWIST, angle("other", 70, 60, 120, "angle between the axes of the adjacent solids")),
        lambda _: 1, "opposite solids alike, lengths proportional to the sines of the twists", "Bennett 1903",
    ),
    Generator(
        "goldberg", "Goldberg's linkage of five", bennett.goldberg,
        (
            _FIRST,
            _TWIST,
            angle("shared", 70, 60, 85, "twist of the solid that is left out"),
            angle("other", 100, 96, 115, "twist of the second linkage's own solids"),
            angle("offset", 0, 0, 120, "angle between the two solids that are joined to one"),
        ),
        lambda _: 1, "two Bennett linkages with a solid in common, lengths proportional to the sines of "
"the twists",
        "Goldberg 1943", relations="other + shared is not 180 degrees",
    ),
    Generator(
        "myard", "Myard's linkage of five", bennett.myard, (_FIRST, _TWIST), lambda _: 1,
        "Goldberg's linkage of two mirror images with a common twist of 90 degrees", "Myard 1931",
    ),
    Generator(
        "bricard-line-symmetric", "Bricard's line-symmetric linkage", bricard.line_symmetric,
        (angle("lean", 0, 0, 40, "rotation of three of the axes about the x axis"),),
        lambda _: 1, "a half turn about the z axis maps each axis to its opposite", "Bricard 1927",
    ),
    Generator(
        "bricard-plane-symmetric", "Bricard's plane-symmetric linkage", bricard.plane_symmetric,
        (length("height", 0.0, 0.0, 0.5, "height of the second axis and its mirror image"),),
        lambda _: 1, "two axes in the plane y = 0, and mirror symmetry of the others in it", "Bricard 1927",
    ),
    Generator(
        "bricard-trihedral", "Bricard's trihedral linkage", bricard.trihedral,
        tuple(
            length(name, default, 0.5, 2.0, f"{name} length of a solid; three more follow from the others")
            for name, default in (("first", 1.0), ("second", 0.8), ("third", 1.3))
        ),
        lambda _: 1, "right-angle twists, no offsets, and equal sums of the squares of alternate lengths",
        "Bricard 1927",
    ),
    Generator(
        "kaleidocycle", "Kaleidocycle", kaleidocycle,
        (
            count("solids", 6, 6, 24, "number of solids in the ring"),
            angle("tilt", 50, 35, 52, "angle of every second axis to the ring's; for an even number only"),
        ),
        lambda v: max(int(v["solids"]) - 6, 1),
        "right-angle twists and equal lengths; with seven or more solids, on the general "
"branch",
        "Schatz 1929; Schattschneider and Walker 1977",
    ),
    *(
        Generator(
            f"{word}-bar", f"Spherical {word}-bar", _of_arcs, _arcs(links), lambda v: len(v) - 3,
            "axes through one point", "three equations a loop",
            relations="no arc is longer than the others together, no three by more than 360 degrees" + more,
        )
        for word, links, more in (("four", 4, ""), ("five", 5, _FIVE), ("six", 6, _FIVE))
    ),
)  # fmt: skip
