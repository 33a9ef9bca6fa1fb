"""One kind of mechanism made of another; `graphs.convert.conversions` says which of which."""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
