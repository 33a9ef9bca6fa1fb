"""What a mechanism does at a configuration: motion, branches, layers, assembly modes, verdict, reasons, states.

Rooms are imported as they are asked for.
"""

from types import ModuleType


def __getattr__(name: str) -> ModuleType:
    from graphs.lazy import module_of

    return module_of(__name__, name)
