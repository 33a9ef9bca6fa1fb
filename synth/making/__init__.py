"""What is made of a mechanism: pictures, pages that fold, templates, thick panels, models for simulators.

Rooms are imported as they are asked for.
"""

from types import ModuleType


def __getattr__(name: str) -> ModuleType:
    from graphs.lazy import module_of

    return module_of(__name__, name)
