"""Mobility by rank: exact for a general member of a type, numerical at a pose.

A general member is placed over a prime field (`general_member`), its loops close (`closure`) or its rods keep
their lengths (`rods`), and the rank of these equations is found modulo primes (`generic`) or in real numbers
(`pose`).
"""

from __future__ import annotations

from graphs.lazy import offered

__getattr__, __dir__, __all__ = offered(__name__)
