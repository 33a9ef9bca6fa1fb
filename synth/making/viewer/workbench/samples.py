"""Samples that an empty workbench offers: made by generators, and a linkage on a cone."""

from collections.abc import Callable
from math import radians

from graphs.convert.conversions import Mechanism
from graphs.files.formats import WRITERS
from synth.catalogue.patterns._generate import generate
from synth.linkages.conformed.linkage_behaviour import loop_on_cones


def _of_generator(name: str, **values: float) -> Callable[[], Mechanism]:
    return lambda: generate(name, **values).mechanism


def _on_cone() -> Mechanism:
    return loop_on_cones([radians(angle) for angle in (120.0, 95.0, 45.0, 85.0)])[0].linkage()


SAMPLES: tuple[tuple[str, str, Callable[[], Mechanism]], ...] = (
    ("miura.fold", "Miura sheet", _of_generator("miura")),
    ("waterbomb.fold", "Waterbomb", _of_generator("waterbomb")),
    ("box-pop-up.fold", "Box pop-up", _of_generator("box-pop-up")),
    ("kaleidocycle.json", "Kaleidocycle", _of_generator("kaleidocycle")),
    ("bennett.json", "Bennett linkage", _of_generator("bennett")),
    ("cone.json", "Four-bar on a cone", _on_cone),
)
"""Name of the file, title, and the function that makes the mechanism."""


def sample_bytes(number: int) -> bytes:
    """Return the file of a sample by its number in `SAMPLES`.

    >>> sample_bytes(0)[:1]
    b'{'
    """
    name, _, make = SAMPLES[number]
    return WRITERS[name[name.rindex(".") :]].to_bytes(make())
