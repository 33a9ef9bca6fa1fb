"""What a mechanism is: graphs, models, mobility, conversions and files.

Import from the modules by name, for example ``from graphs.mechanism.sc import SCGraph``. Nothing is imported here
before it is asked for, so that the command line starts quickly.
"""

from types import ModuleType


def __getattr__(name: str) -> ModuleType:
    from graphs.lazy import module_of

    return module_of(__name__, name)
