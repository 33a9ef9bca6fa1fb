"""Words of 64 bits in kernels: sums and products of which the lowest 64 bits count, and sets of bits.

A word is a number of numpy. Machine code drops what runs over, without a word; numpy's own numbers warn of it. So
interpreted kernels get Python's numbers here, cut to 64 bits: the same words.
"""

import numpy as np

from enumerate.machine_code.kernels import compiled_beside

ALL = 0xFFFF_FFFF_FFFF_FFFF
"""The word with all bits, as a number of Python."""

# 2^64 divided by the golden ratio, made odd (Knuth, vol. 3, 6.4): multiples of it are spread evenly over words.
_FACTOR = 0x9E37_79B9_7F4A_7C15

GOLDEN = np.uint64(_FACTOR)
"""2^64 over the golden ratio: the factor of hashes."""


def _plus(a: np.uint64, b: np.uint64) -> np.uint64:
    return np.uint64((int(a) + int(b)) & ALL)


def _minus(a: np.uint64, b: np.uint64) -> np.uint64:
    return np.uint64((int(a) - int(b)) & ALL)


def _times(a: np.uint64, b: np.uint64) -> np.uint64:
    return np.uint64((int(a) * int(b)) & ALL)


def hashed(word: int, value: int, added: int, shift: int) -> int:
    """Return what `mixed` returns, of numbers of Python."""
    product = ((word ^ value) * _FACTOR + added) & ALL
    return product ^ (product >> shift)


def _mixed(word: np.uint64, value: np.uint64, added: np.uint64, shift: np.uint64) -> np.uint64:
    return np.uint64(hashed(int(word), int(value), int(added), int(shift)))


def _has_several(word: np.uint64) -> bool:
    return int(word).bit_count() > 1


def _number_in(members: int) -> int:
    return int(members).bit_count()


def _lowest_in(members: int) -> int:
    whole = int(members)
    return (whole & -whole).bit_length() - 1


@compiled_beside(_plus)
def plus(a: np.uint64, b: np.uint64) -> np.uint64:
    """Return a + b, what runs over dropped."""
    return a + b


@compiled_beside(_minus)
def minus(a: np.uint64, b: np.uint64) -> np.uint64:
    """Return a - b, with a bit borrowed where b is larger."""
    return a - b


@compiled_beside(_times)
def times(a: np.uint64, b: np.uint64) -> np.uint64:
    """Return a b, what runs over dropped."""
    return a * b


@compiled_beside(_mixed)
def mixed(word: np.uint64, value: np.uint64, added: np.uint64, shift: np.uint64) -> np.uint64:
    """Return a hash of a hash, a value, and a number that is added on the way; `shift` mixes high bits in."""
    product = (word ^ value) * GOLDEN + added
    return product ^ (product >> shift)


@compiled_beside(_has_several)
def has_several(word: np.uint64) -> bool:
    """Tell whether a set has two members or more."""
    return bool(word & (word - np.uint64(1)))


@compiled_beside(_number_in)
def number_in(members: int) -> int:
    """Return how many there are in a set, of numbers 0 to 62."""
    members -= (members >> 1) & 0x5555555555555555
    members = (members & 0x3333333333333333) + ((members >> 2) & 0x3333333333333333)
    members = (members + (members >> 4)) & 0x0F0F0F0F0F0F0F0F
    return (members * 0x0101010101010101) >> 56


@compiled_beside(_lowest_in)
def lowest_in(members: int) -> int:
    """Return the least in a set that is not empty, of numbers 0 to 62."""
    return number_in((members & -members) - 1)
