"""Known patterns and linkages by their parameters, and types given coordinates.

Rooms are imported as they are asked for.
"""

from types import ModuleType


def __getattr__(name: str) -> ModuleType:
    from graphs.lazy import module_of

    return module_of(__name__, name)
