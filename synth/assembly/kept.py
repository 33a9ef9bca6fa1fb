"""The positions of a general member of each type, kept between runs: they are the same for all members of the type.

What is kept says itself what it is: its name is a digest of the type and the seed, its folder is named by a digest of
the files that find it. Where no folder can be written positions are found anew in each process.
"""

import io
from functools import cache
from hashlib import sha256
from pathlib import Path

import numpy as np

from enumerate.machine_code.folders import keep, kept
from synth.assembly.family import Family, GeneralPositions, general_positions

_FILES = ("family.py", "kernel.py", "kernel.c")
_MOST = 64
"""Types that a process remembers."""
_remembered: dict[str, GeneralPositions] = {}


def kept_positions(family: Family, seed: int = 0) -> GeneralPositions:
    """Return all positions of a general member of a family: those that are kept, or `general_positions`."""
    name = _name(family, seed)
    general = _remembered.get(name)
    if general is None:
        text = kept(_folder(), name)
        general = _read(text) if text is not None else general_positions(family, seed)
        if text is None:
            keep(_folder(), name, _written(general))
        while len(_remembered) >= _MOST:
            _remembered.pop(next(iter(_remembered)), None)
        _remembered[name] = general
    return general


def _name(family: Family, seed: int) -> str:
    arrays = (family.loops, family.signs, family.axes, family.column)
    of_type = [(array.shape, array.tolist()) for array in arrays]
    return f"{sha256(repr((of_type, seed)).encode()).hexdigest()[:32]}.npz"


@cache
def _folder() -> str:
    texts = b"".join(Path(__file__).with_name(name).read_bytes() for name in _FILES)
    return f"{__name__}-{sha256(texts + np.__version__.encode()).hexdigest()[:32]}"


def _written(general: GeneralPositions) -> bytes:
    text = io.BytesIO()
    np.savez(text, parameters=general.parameters, values=general.values, curves=np.array(general.curves))
    return text.getvalue()


def _read(text: bytes) -> GeneralPositions:
    with np.load(io.BytesIO(text), allow_pickle=False) as arrays:
        return GeneralPositions(arrays["parameters"], arrays["values"], int(arrays["curves"]))
