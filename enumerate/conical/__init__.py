"""All conical candidates: the cyclic orders of the joints of a chain round a cone, up to symmetry."""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
