"""All generators, by name. Theory: docs/theory/generators.md."""

from __future__ import annotations

from synth.patterns.creases.listed import GENERATORS as _CREASES
from synth.patterns.generator import Generator
from synth.patterns.goods.listed import GENERATORS as _GOODS
from synth.patterns.platforms.listed import GENERATORS as _PLATFORMS
from synth.patterns.rings.listed import GENERATORS as _RINGS
from synth.patterns.scissors.listed import GENERATORS as _SCISSORS

__all__ = ["GENERATORS"]

GENERATORS: dict[str, Generator] = {
    one.name: one for one in (*_CREASES, *_RINGS, *_GOODS, *_PLATFORMS, *_SCISSORS)
}
