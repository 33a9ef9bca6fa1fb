"""Outward rates of joints in closed form, and what the places of joints alone say of their signs.

Let e_i = (sin t_i, 1, cos t_i). The rates of a linkage of one freedom are the maximal minors of its closure
equations, and a minor is a sum of products of brackets, one for each independent loop,

    [a b c] = det(e_a, e_b, e_c) = 4 sin((t_b - t_a) / 2) sin((t_c - t_b) / 2) sin((t_c - t_a) / 2),

so that joint j of a link moves outward at the rate

    rho_j = sum over i of +-q_i sin(t_j - t_i) = sum of +-sin(t_j - t_i) [a b c] [d e f] ...,

i running along a path from the ground to the link. The sign of a bracket follows from the cyclic order of its
joints, that of the sine from the order of joint j, joint i and the point opposite to i. Where all terms have one
sign, so has rho_j, whatever the angles. There is a formula for every choice of independent loops and of the path;
one whose terms agree is enough. Theory: docs/theory/conical-candidates.md.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
import numpy.typing as npt

from graphs.errors import UnsolvableError
from graphs.rank.singular_values import rank_of
from graphs.types import Floats, Ints
from synth.conformed.chords import arc_sets, sign_of_sum
from synth.conformed.cycles import signed_cycles
from synth.conformed.rates import ConformedChain

__all__ = ["OutwardRate", "brackets", "joint_rates", "outward_rates"]

_BASES = 12
_PATHS = 12
_TERMS = 400
"""Choices of loops, of paths, and terms of a formula that are looked at."""
_Term = tuple[int, tuple[tuple[int, int, int], ...]]


@dataclass(frozen=True, slots=True)
class OutwardRate:
    """The outward rate of one joint as a sum of terms; those of all joints of a chain have one common scale.

    Attributes
    ----------
    joint : int
        Number of the joint, j.
    factors : int64[T]
        +1 or -1.
    sines : int64[T] or None
        i of sin(t_j - t_i); None: no sines, in the rate q_j of the joint itself.
    triples : int64[T, L, 3]
        The joints of the brackets.
    """

    joint: int
    factors: Ints
    sines: Ints | None
    triples: Ints

    @property
    def _terms(self) -> Iterator[tuple[int, int | None, Ints]]:
        """Factor, joint of the sine, if there is one, and brackets of each term."""
        sines = [None] * len(self.factors) if self.sines is None else self.sines.tolist()
        return zip(self.factors.tolist(), sines, self.triples, strict=True)

    def values(self, places: npt.ArrayLike) -> Floats:
        """Return the rates of linkages.

        Parameters
        ----------
        places : float[..., J]
            Azimuths, radians.

        Returns
        -------
        float[...]
        """
        t = np.asarray(places, dtype=float)
        total = np.zeros(t.shape[:-1])
        for factor, i, triples in self._terms:
            sine = np.ones(t.shape[:-1]) if i is None else np.sin(t[..., self.joint] - t[..., i])
            term = factor * sine
            for triple in triples:
                term = term * brackets(t[..., triple])
            total += term
        return total

    def signs(self, places: npt.ArrayLike) -> npt.NDArray[np.int8]:
        """Return the sign that all terms have, 0 where they differ; it is that of all linkages of the same order.

        Parameters
        ----------
        places : float[..., J]
            Azimuths between 0 and 2 pi in the order of joints and opposite points that is asked for.

        Returns
        -------
        int8[...]
        """
        return _common_sign(self._term_signs(np.asarray(places, dtype=float)))

    def signs_by_chords(self, slots: Ints) -> npt.NDArray[np.int8]:
        """Return the sign of the rate where each term has a larger one of the other sign, else 0.

        Parameters
        ----------
        slots : int64[r, J]
            Orders with opposites, on 2 J slots.

        Returns
        -------
        int8[r]
        """
        t = slots * (np.pi / slots.shape[-1])
        arcs, every = arc_sets(slots), (1 << slots.shape[-1]) - 1
        terms = []
        for _, i, triples in self._terms:
            pairs = [pair for a, b, c in triples.tolist() for pair in ((a, b), (b, c), (a, c))]
            factors = [arcs[:, a, b] for a, b in pairs]
            if i is not None:
                factors += [arcs[:, self.joint, i], every ^ arcs[:, self.joint, i]]
            terms.append(np.stack(factors, axis=-1))
        return sign_of_sum(np.stack(self._term_signs(t), axis=-1), np.stack(terms, axis=1))

    def _term_signs(self, t: Floats) -> list[npt.NDArray[np.int8]]:
        return [
            _sign(factor, triples, t)
            * (np.int8(1) if i is None else np.sign(np.sin(t[..., self.joint] - t[..., i])).astype(np.int8))
            for factor, i, triples in self._terms
        ]

    def text(self, names: Sequence[object]) -> str:
        """Return the formula as text, sin(j - i) being that of the azimuths of joints j and i."""
        parts = []
        for factor, i, triples in self._terms:
            written = " ".join("[" + " ".join(str(names[k]) for k in triple) + "]" for triple in triples.tolist())
            sine = f"sin({names[self.joint]} - {names[i]}) " if i is not None else ""
            parts.append(f"{'-' if factor < 0 else '+'} {sine}{written}")
        return " ".join(parts).removeprefix("+ ")


def brackets(places: npt.ArrayLike) -> Floats:
    """Return det(e_a, e_b, e_c) of three joints: twice the area of their triangle, + if they are in order.

    Places, float[..., 3], are azimuths, radians.

    >>> from synth.conformed.rates import ring_axes
    >>> places = np.array([0.3, 2.0, 4.5])
    >>> bool(np.isclose(brackets(places), np.linalg.det(ring_axes(places))))
    True
    """
    a, b, c = np.moveaxis(np.asarray(places, dtype=float) / 2.0, -1, 0)
    return np.asarray(4.0 * np.sin(b - a) * np.sin(c - b) * np.sin(c - a))


def _sign(factor: int, triples: Iterable[Iterable[int]], t: Floats) -> npt.NDArray[np.int8]:
    """Return the sign of a product of brackets: it follows from the cyclic order."""
    sign = np.full(t.shape[:-1], factor, np.int8)
    for a, b, c in triples:
        for i, j in ((a, b), (b, c), (a, c)):
            sign = sign * np.where(t[..., j] > t[..., i], 1, -1).astype(np.int8)
    return sign


def _common_sign(signs: Sequence[npt.NDArray[np.int8]]) -> npt.NDArray[np.int8]:
    """Return the sign that all have, else 0."""
    least, most = np.min(signs, axis=0), np.max(signs, axis=0)
    return np.where(least == most, most, 0).astype(np.int8)


def joint_rates(chain: ConformedChain) -> tuple[tuple[OutwardRate, ...], ...]:
    """Return formulas for the rate q of every joint, to the scale of `outward_rates`, shortest first.

    Parameters
    ----------
    chain : ConformedChain
        Of one freedom: J = 3 L + 1.

    Raises
    ------
    UnsolvableError
        If the number of joints is another.

    Examples
    --------
    >>> from graphs.mechanism.sc import SCGraph
    >>> chain = ConformedChain.of(SCGraph(4, dict(zip("OABC", [(0, 1), (1, 2), (2, 3), (3, 0)]))))
    >>> [formulas[0].text(chain.joints) for formulas in joint_rates(chain)]
    ['[A B C]', '- [O B C]', '[O A C]', '- [O A B]']
    """
    kernels = _kernels(_checked(chain))
    formulas = []
    for joint in range(len(chain.joints)):
        choices = {tuple(kernel[joint]) for kernel in kernels if kernel[joint]}
        formulas.append(
            tuple(
                OutwardRate(
                    joint,
                    np.array([factor for factor, _ in terms], np.int64),
                    None,
                    np.array([triples for _, triples in terms], np.int64),
                )
                for terms in sorted(choices, key=lambda terms: (len(terms), terms))
            )
        )
    return tuple(formulas)


def _checked(chain: ConformedChain) -> ConformedChain:
    loops, joints = len(chain.loops), len(chain.joints)
    if joints != 3 * loops + 1:
        raise UnsolvableError(
            f"{joints} joints and {loops} independent loops have not one freedom: expected {3 * loops + 1} joints"
        )
    return chain


def outward_rates(chain: ConformedChain) -> tuple[tuple[OutwardRate, ...], ...]:
    """Return formulas for the outward rate of every joint, shortest first; none for joints of the ground link.

    Parameters
    ----------
    chain : ConformedChain
        Of one freedom: J = 3 L + 1.

    Returns
    -------
    tuple of tuples of OutwardRate
        For each joint.

    Raises
    ------
    UnsolvableError
        If the number of joints is another.

    Examples
    --------
    A four-bar with ground link C O: joint A turns about O.

    >>> from graphs.mechanism.sc import SCGraph
    >>> chain = ConformedChain.of(SCGraph(4, dict(zip("OABC", [(0, 1), (1, 2), (2, 3), (3, 0)]))))
    >>> [formulas[0].text(chain.joints) for formulas in outward_rates(chain) if formulas]
    ['sin(A - O) [A B C]', 'sin(B - C) [O A B]']
    """
    kernels = _kernels(_checked(chain))
    return tuple(
        () if joint in chain.joints_of[0] else _formulas(chain, joint, kernels)
        for joint in range(len(chain.joints))
    )


def _formulas(
    chain: ConformedChain, joint: int, kernels: Sequence[Sequence[list[_Term]]]
) -> tuple[OutwardRate, ...]:
    sums: dict[tuple[tuple[int, int, tuple[tuple[int, int, int], ...]], ...], None] = {}
    for kernel in kernels:
        for path in _paths(chain, joint):
            terms = tuple(
                (sign * factor, i, triples)
                for i, sign in path.items()
                if i != joint
                for factor, triples in kernel[i]
            )
            if terms and len(terms) <= _TERMS:
                sums[terms] = None
    return tuple(
        OutwardRate(
            joint,
            np.array([factor for factor, _, _ in terms], np.int64),
            np.array([i for _, i, _ in terms], np.int64),
            np.array([triples for _, _, triples in terms], np.int64),
        )
        for terms in sorted(sums, key=len)
    )


def _paths(chain: ConformedChain, joint: int) -> list[dict[int, int]]:
    """Return paths from the ground to a link of a joint: joints to +1 or -1; short ones first."""
    cycles = signed_cycles(chain)
    ends = [n for n, joints in enumerate(chain.joints_of) if joint in joints]
    paths: dict[tuple[tuple[int, int], ...], None] = {}
    for end in ends:
        base = chain.paths[end]
        near = [base, *(base + factor * cycle for cycle in cycles for factor in (1, -1))]
        for row in near:
            if np.abs(row).max() == 1:
                paths[tuple((i, int(row[i])) for i in np.flatnonzero(row).tolist())] = None
    return [dict(path) for path in sorted(paths, key=len)[:_PATHS]]


def _kernels(chain: ConformedChain) -> list[list[list[_Term]]]:
    """Return the rates of the joints as terms, for several sets of independent loops, with one common sign."""
    loops, joints = len(chain.loops), len(chain.joints)
    cycles = signed_cycles(chain)
    places = np.random.default_rng(1).uniform(0, 2 * np.pi, (8, joints))
    kernels: list[list[list[_Term]]] = []
    first: Floats | None = None
    bases = sorted(
        combinations(range(len(cycles)), loops), key=lambda chosen: int(np.abs(cycles[list(chosen)]).sum())
    )
    for chosen in bases:
        basis = cycles[list(chosen)]
        if rank_of(basis.astype(float)) < loops:
            continue
        kernel = [[((-1) ** i * sign, triples) for sign, triples in _minor(basis, i)] for i in range(joints)]
        values = np.stack([_value(terms, places) for terms in kernel], axis=-1)
        if first is None:
            first = values
        elif (values * first).sum() < 0:  # another basis has the same minors, but for a common factor
            kernel = [[(-sign, triples) for sign, triples in terms] for terms in kernel]
        kernels.append(kernel)
        if len(kernels) == _BASES:
            break
    return kernels


def _value(terms: Sequence[_Term], places: Floats) -> Floats:
    total = np.zeros(places.shape[:-1])
    for factor, triples in terms:
        term = np.full(places.shape[:-1], float(factor))
        for triple in triples:
            term = term * brackets(places[..., list(triple)])
        total += term
    return total


def _minor(basis: Ints, left_out: int) -> Iterator[_Term]:
    """Yield the terms of the minor without one column, by Laplace's expansion along the blocks of the loops."""
    columns = [i for i in range(basis.shape[1]) if i != left_out]

    def expanded(loop: int, left: list[int]) -> Iterator[_Term]:
        if loop == len(basis):
            yield 1, ()
            return
        open_ = [k for k in range(len(left)) if basis[loop, left[k]]]
        for places in combinations(open_, 3):
            triple = tuple(left[k] for k in places)
            rest = [left[k] for k in range(len(left)) if k not in places]
            swaps = sum(places) - 3  # 0 + 1 + 2: columns brought to the front
            sign = int(np.prod(basis[loop, list(triple)])) * (-1) ** swaps
            for factor, more in expanded(loop + 1, rest):
                yield sign * factor, ((triple[0], triple[1], triple[2]), *more)

    return expanded(0, columns)
