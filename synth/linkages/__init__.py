"""Linkages of closed form: four-bars, the cones and cylinders that linkages lie on, guidance of a body.

Rooms are imported as they are asked for.
"""

from types import ModuleType


def __getattr__(name: str) -> ModuleType:
    from graphs.lazy import module_of

    return module_of(__name__, name)
