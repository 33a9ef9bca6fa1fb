"""Outward rates of joints in closed form, and what the places of joints alone say of their signs.

Rates are the maximal minors of the closure equations: sums of products of brackets, [a b c] = det(e_a, e_b, e_c)
with e = (sin t, 1, cos t). Joint j of a link moves outward at rho_j = sum of +-q_i sin(t_j - t_i), i running along
a path from the ground. The cyclic order gives the signs of brackets, orders with opposites those of sines; where
terms differ in sign, chords are compared as sets of gaps (`signs_by_chords`), or three-term relations followed
(`SignRelations`). Theory: docs/theory/conical-candidates.md.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
import numpy.typing as npt

from enumerate.kernel._compiled import compiled
from graphs.errors import UnsolvableError
from graphs.rank.singular_values import rank_of
from graphs.types import Floats, Ints, Signs
from synth.linkages.conformed.rates import ConformedChain, signed_cycles

_BASES = 12
_PATHS = 12
_TERMS = 400
"""Choices of loops, of paths, and terms of a formula that are looked at."""
_Triples = tuple[tuple[int, int, int], ...]
_Term = tuple[int, _Triples]


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
        """Return the rates of linkages with azimuths float[..., J], radians: float[...]."""
        t = np.asarray(places, dtype=float)
        total = np.zeros(t.shape[:-1])
        for factor, i, triples in self._terms:
            sine = np.ones(t.shape[:-1]) if i is None else np.sin(t[..., self.joint] - t[..., i])
            total += _product(factor * sine, triples, t)
        return total

    def signs(self, places: npt.ArrayLike) -> npt.NDArray[np.int8]:
        """Return the sign of all terms, 0 where they differ, at azimuths float[..., J] in [0, 2 pi): int8[...].

        It is that of all linkages with the same order of joints and opposite points.
        """
        signs = self._term_signs(np.asarray(places, dtype=float))
        least, most = np.min(signs, axis=0), np.max(signs, axis=0)
        return np.where(least == most, most, 0).astype(np.int8)

    def signs_by_chords(self, slots: Ints) -> npt.NDArray[np.int8]:
        """Return the sign of the rate where each term has a larger one of the other sign, else 0: int8[r].

        Slots, int64[r, J], are orders with opposites, on 2 J slots.
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
            _sign_of_brackets(factor, triples, t)
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
    """Return det(e_a, e_b, e_c) of joints at azimuths float[..., 3]: twice their triangle's area, + in order."""
    a, b, c = np.moveaxis(np.asarray(places, dtype=float) / 2.0, -1, 0)
    return np.asarray(4.0 * np.sin(b - a) * np.sin(c - b) * np.sin(c - a))


def _product(term: Floats, triples: Iterable[Iterable[int]], t: Floats) -> Floats:
    """Return a term times the brackets of triples of joints."""
    for triple in triples:
        term = term * brackets(t[..., list(triple)])
    return term


def _sign_of_brackets(factor: int, triples: Iterable[Iterable[int]], t: Floats) -> npt.NDArray[np.int8]:
    """Return the sign of a product of brackets: it follows from the cyclic order."""
    sign = np.full(t.shape[:-1], factor, np.int8)
    for a, b, c in triples:
        for i, j in ((a, b), (b, c), (a, c)):
            sign = sign * np.where(t[..., j] > t[..., i], 1, -1).astype(np.int8)
    return sign


def joint_rates(chain: ConformedChain) -> tuple[tuple[OutwardRate, ...], ...]:
    """Return formulas for the rate q of every joint, to the scale of `outward_rates`, shortest first.

    Parameters
    ----------
    chain : ConformedChain
        Of one freedom: J = 3 L + 1, else `UnsolvableError`.

    Examples
    --------
    >>> from graphs.mechanism.sc import SCGraph
    >>> chain = ConformedChain.of(SCGraph(4, dict(zip("OABC", [(0, 1), (1, 2), (2, 3), (3, 0)]))))
    >>> [formulas[0].text(chain.joints) for formulas in joint_rates(chain)]
    ['[A B C]', '- [O B C]', '[O A C]', '- [O A B]']
    """
    kernels = _kernels(chain)
    formulas = []
    for joint in range(len(chain.joints)):
        choices = {tuple(kernel[joint]) for kernel in kernels if kernel[joint]}
        ordered = sorted(choices, key=lambda terms: (len(terms), terms))
        formulas.append(
            tuple(_rate(joint, [(factor, None, triples) for factor, triples in terms]) for terms in ordered)
        )
    return tuple(formulas)


def outward_rates(chain: ConformedChain) -> tuple[tuple[OutwardRate, ...], ...]:
    """Return formulas for the outward rate of every joint, shortest first; none for joints of the ground link.

    Parameters
    ----------
    chain : ConformedChain
        Of one freedom: J = 3 L + 1, else `UnsolvableError`.

    Examples
    --------
    >>> from graphs.mechanism.sc import SCGraph
    >>> chain = ConformedChain.of(SCGraph(4, dict(zip("OABC", [(0, 1), (1, 2), (2, 3), (3, 0)]))))
    >>> [formulas[0].text(chain.joints) for formulas in outward_rates(chain) if formulas]  # ground link C O
    ['sin(A - O) [A B C]', 'sin(B - C) [O A B]']
    """
    kernels = _kernels(chain)
    return tuple(
        () if joint in chain.joints_of[0] else _formulas(chain, joint, kernels) for joint in range(len(chain.joints))
    )


def _formulas(chain: ConformedChain, joint: int, kernels: Sequence[Sequence[list[_Term]]]) -> tuple[OutwardRate, ...]:
    sums: dict[tuple[tuple[int, int, _Triples], ...], None] = {}
    for kernel in kernels:
        for path in _paths(chain, joint):
            terms = tuple(
                (sign * factor, i, triples) for i, sign in path.items() if i != joint for factor, triples in kernel[i]
            )
            if terms and len(terms) <= _TERMS:
                sums[terms] = None
    return tuple(_rate(joint, terms) for terms in sorted(sums, key=len))


def _rate(joint: int, terms: Sequence[tuple[int, int | None, _Triples]]) -> OutwardRate:
    factors, sines, triples = (list(column) for column in zip(*terms, strict=True))
    of_sines = None if sines[0] is None else np.array(sines, np.int64)
    return OutwardRate(joint, np.array(factors, np.int64), of_sines, np.array(triples, np.int64))


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
    if joints != 3 * loops + 1:
        raise UnsolvableError(
            f"{joints} joints and {loops} independent loops do not have 1 degree of freedom; "
            f"expected {3 * loops + 1} joints"
        )
    cycles = signed_cycles(chain)
    places = np.random.default_rng(1).uniform(0, 2 * np.pi, (8, joints))
    kernels: list[list[list[_Term]]] = []
    first: Floats | None = None
    bases = sorted(combinations(range(len(cycles)), loops), key=lambda chosen: int(np.abs(cycles[list(chosen)]).sum()))
    for chosen in bases:
        basis = cycles[list(chosen)]
        if rank_of(basis.astype(float)) < loops:
            continue
        kernel = [[((-1) ** i * sign, triples) for sign, triples in _minor(basis, i)] for i in range(joints)]
        terms_of = [[_product(np.full(8, float(sign)), triples, places) for sign, triples in terms] for terms in kernel]
        values = np.stack([sum(terms, np.zeros(8)) for terms in terms_of], axis=-1)
        if first is None:
            first = values
        elif (values * first).sum() < 0:  # another basis has the same minors, but for a common factor
            kernel = [[(-sign, triples) for sign, triples in terms] for terms in kernel]
        kernels.append(kernel)
        if len(kernels) == _BASES:
            break
    return kernels


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


@compiled
def _matched(fits: npt.NDArray[np.bool_], rows: int, columns: int) -> bool:
    """Check whether every row can have a column of its own that fits (augmenting paths)."""
    owner = np.full(columns, -1, np.int64)
    came = np.empty(columns, np.int64)
    queue = np.empty(rows + 1, np.int64)
    for start in range(rows):
        seen = np.zeros(columns, np.bool_)
        head, tail = 0, 1
        queue[0] = start
        free = -1
        # breadth first along alternating paths; came[column] is the row that reached a column
        while head < tail and free < 0:
            row = queue[head]
            head += 1
            for column in range(columns):
                if fits[row, column] and not seen[column]:
                    seen[column] = True
                    came[column] = row
                    if owner[column] < 0:
                        free = column
                        break
                    queue[tail] = owner[column]
                    tail += 1
        if free < 0:
            return False
        column = free  # flip the path: each row on it takes the column that led on, back to the start
        while True:
            row = came[column]
            before = -1
            for other in range(columns):
                if owner[other] == row:
                    before = other
            owner[column] = row
            if row == start:
                break
            column = before
    return True


@compiled
def _all_dominated(signs: Signs, sets: Ints, less: int) -> bool:
    """Check whether each term of sign ``less`` has a larger term of the other sign of its own."""
    terms, factors = sets.shape
    fits = np.zeros((terms, terms), np.bool_)
    within = np.zeros((factors, factors), np.bool_)
    rows = 0
    for a in range(terms):
        if signs[a] != less:
            continue
        columns = 0
        for b in range(terms):
            if signs[b] == less:
                continue
            for i in range(factors):
                for j in range(factors):
                    within[i, j] = sets[a, i] & ~sets[b, j] == 0
            fits[rows, columns] = _matched(within, factors, factors)
            columns += 1
        rows += 1
    return _matched(fits, rows, terms - rows)


@compiled
def _signs(signs: Signs, sets: Ints) -> Signs:
    of_sums = np.zeros(len(signs), np.int8)
    for i in range(len(signs)):
        if _all_dominated(signs[i], sets[i], -1):
            of_sums[i] = 1
        elif _all_dominated(signs[i], sets[i], 1):
            of_sums[i] = -1
    return of_sums


def arc_sets(slots: Ints) -> Ints:
    """Return the sizes of fine gaps that the shorter arc between two joints covers, as masks int64[r, J, J].

    Slots are orders with opposites, on 2 J slots; bit g is the gap after a slot that is g modulo J.
    """
    joints = slots.shape[-1]
    first, second = slots[:, :, np.newaxis], slots[:, np.newaxis, :]
    ahead = np.remainder(second - first, 2 * joints)
    start = np.where(ahead < joints, first, second) % joints
    length = np.minimum(ahead, 2 * joints - ahead)
    run = ((1 << length) - 1) << start
    return np.asarray((run | run >> joints) & ((1 << joints) - 1))


def sign_of_sum(signs: Signs, sets: Ints) -> Signs:
    """Return the signs of sums of products of chords, 0 where this does not decide.

    Signs, int8[r, T], are those of the terms, sets, int64[r, T, F], the arcs of each term's chords.
    """
    return np.asarray(_signs(np.ascontiguousarray(signs), np.ascontiguousarray(sets)))


_ZERO = 2
"""Stands for the sign of what is always zero."""


@compiled
def _follow(known: Signs, unknowns: Ints, sines: Ints, factors: Ints, sine_signs: Signs) -> bool:
    """Add what follows to the known signs of one linkage; return whether they contradict each other."""
    changed = True
    while changed:
        changed = False
        for r in range(len(unknowns)):
            plus = minus = missing = 0  # the three terms add up to zero: two of one sign force the third
            where = sign_there = 0
            for k in range(3):
                sign = factors[r, k]
                if sines[r, k, 0] >= 0:
                    sign *= sine_signs[sines[r, k, 0], sines[r, k, 1]]
                value = known[unknowns[r, k]]
                if sign == 0 or value == 2:
                    continue
                if value == 0:
                    missing += 1
                    where, sign_there = unknowns[r, k], sign
                elif value * sign > 0:
                    plus += 1
                else:
                    minus += 1
            if missing == 0 and (plus > 0) != (minus > 0):
                return True
            if missing == 1 and (plus > 0) != (minus > 0):
                known[where] = -sign_there if plus else sign_there
                changed = True
    return False


@compiled
def _follow_all(known: Signs, unknowns: Ints, sines: Ints, factors: Ints, sine_signs: Signs) -> npt.NDArray[np.bool_]:
    wrong = np.zeros(len(known), np.bool_)
    for i in range(len(known)):
        wrong[i] = _follow(known[i], unknowns, sines, factors, sine_signs[i])
    return wrong


class SignRelations:
    """What the rates of a chain obey: R relations of three unknowns each.

    With the outward rate rho(n, x) of link n, thought of as all round the circle, at joint x, and the rates q_i,
    rho(n, x) sin(y - z) + rho(n, y) sin(z - x) + rho(n, z) sin(x - y) = 0 for any joints x, y, z, and rho(n, x) -
    rho(m, x) = +-q_i sin(x - i) for links m, n that joint i joins. An order with opposites has all signs of sines.

    An unknown is multiplied by a factor and the sine of two joints, none where these are -1. `zero` marks unknowns
    that are always zero; rho(n, x) has number n J + x, q_i has N J + i.
    """

    def __init__(self, chain: ConformedChain) -> None:
        self.links, self.joints = links, joints = len(chain.links), len(chain.joints)
        self.zero = zero = np.zeros(links * joints + joints, bool)
        zero[:joints] = True
        for n in range(1, links):
            for i in set(chain.joints_of[n]) & set(chain.joints_of[0]):
                zero[n * joints + i] = True
        relations = []
        for n in range(links):
            for x, y, z in combinations(range(joints), 3):
                terms = [n * joints + x, n * joints + y, n * joints + z]
                relations.append((terms, [[y, z], [z, x], [x, y]], [1, 1, 1]))
        for i in range(joints):
            m, n = (link for link in range(links) if i in chain.joints_of[link])
            # w of n less w of m is +-q_i e_i, by the direction of the joint: as paths and loops have it
            sign = _direction(chain, i, m, n)
            for x in range(joints):
                if x == i:
                    continue
                terms = [n * joints + x, m * joints + x, links * joints + i]
                relations.append((terms, [[-1, -1], [-1, -1], [x, i]], [1, -1, -sign]))
            terms = [n * joints + i, m * joints + i, m * joints + i]
            relations.append((terms, [[-1, -1]] * 3, [1, -1, 0]))
        kept = [relation for relation in relations if not zero[relation[0]].all()]
        self.unknowns, self.sines, self.factors = (np.array(part, np.int64) for part in zip(*kept, strict=True))

    def start(self, count: int) -> Signs:
        """Return signs of which none is known but that of zeros: int8[count, N J + J]."""
        known = np.zeros((count, len(self.zero)), np.int8)
        known[:, self.zero] = _ZERO
        return known

    def rho(self, link: int, joint: int) -> int:
        """Return the number of an outward rate."""
        return link * self.joints + joint

    def rate(self, joint: int) -> int:
        """Return the number of the rate of a joint."""
        return self.links * self.joints + joint

    def follow(self, known: Signs, sine_signs: Signs) -> npt.NDArray[np.bool_]:
        """Add all that follows to known signs, int8[r, N J + J]; return which sets contradict themselves, bool[r].

        The signs of sin(t_x - t_y) are int8[r, J, J].
        """
        return np.asarray(_follow_all(known, self.unknowns, self.sines, self.factors, sine_signs))


def _direction(chain: ConformedChain, joint: int, m: int, n: int) -> int:
    """Return the sign of q_i e_i in w of link n less w of link m, from their paths, closed by loops."""
    step = chain.paths[n] - chain.paths[m]
    step[joint] -= 1
    # +1 if the rest is a sum of loops, that is, rates that close leave nothing over
    basis = chain.loops
    return 1 if rank_of(np.vstack([basis, step])) == len(basis) else -1
