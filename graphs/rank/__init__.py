"""Mobility by rank: exact for a generic realisation of a type, numerical at a configuration.

A random realisation is placed over a prime field (`realisation`), its loops close (`exact`) or its rods keep their
lengths (`rods`), and the rank of these equations is found modulo primes, or in real numbers (`infinitesimal`,
`singular_values`, `dissection`).
"""

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
