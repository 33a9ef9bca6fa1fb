"""Fractionated chains: blocks that share single links, and bridge joints; listed, and counted by cycle indices.

A connected chain without rigid sub-chains is a tree of blocks: chains that nothing cuts, with N_i links and M_i >=
1 freedoms each, and single joints between two links (N_i = 2, M_i = 1), which no leaf of the tree is. Links - 1
and freedoms add up over the blocks. To list them, the blocks are chosen first; then they are put together in all
ways, forms that correspond kept once. For the number, a chain is rooted at a link: that link with a set of blocks
hung on it, each other link of a block again a rooted chain (Robinson 1970). With Z the sum of y^M Z(B) over all
blocks B, Z' its derivative by p_1 and p_k read as R(x^k, y^k),

    R = x exp( sum over k of Z'[R](x^k, y^k) / k ),

x marking links and y freedoms; a bridge joint takes part with y (R - x). The dissymmetry theorem (chains = rooted
at a link + rooted at a block - rooted at a block and one of its links) takes the roots away. The cycle index of
the blocks comes from placements fixed by each automorphism. Theory: docs/theory/chains.md.

Source: R. W. Robinson, *Enumeration of non-separable graphs*, J. Combin. Theory 9 (1970); Bergeron, Labelle and
Leroux, *Combinatorial Species and Tree-like Structures* (1998), section 4.1.
"""

from collections import Counter, defaultdict
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from functools import cache, reduce
from itertools import chain, combinations_with_replacement, groupby, product
from math import factorial, prod

import numpy as np
import numpy.typing as npt

from enumerate.contracted.binary_links import Frame, Units, conditions, frame_of, no_prefix, orbits_of, place
from enumerate.contracted.graphs import contracted_graphs
from enumerate.kernel._compiled import cycles
from graphs.identity.chains import automorphisms_of
from graphs.types import Bytes

Joints = tuple[tuple[int, int], ...]
Block = tuple[int, Joints]
"""Number of links, and joints between links 0, 1, ..."""

# Links and freedoms of two links with a joint: the one block that is no chain, since its joint lies in no loop.
_BRIDGE = (2, 1)
_BRIDGE_BLOCK: Block = (2, ((0, 1),))


def shapes(links: int, dof: int) -> Iterator[tuple[tuple[int, int], ...]]:
    """Yield the multisets of block sizes (links, dof), largest first, of chains of two blocks or more.

    >>> list(shapes(8, 3))
    [((5, 2), (4, 1)), ((4, 1), (4, 1), (2, 1))]
    """

    def rest(links: int, dof: int, most: tuple[int, int]) -> Iterator[tuple[tuple[int, int], ...]]:
        if links == 1 and dof == 0:
            yield ()
        if links - 1 < dof:  # no block has more freedoms than links - 1
            return
        for n in range(min(links, most[0]), 1, -1):
            for m in range(dof, 0, -1):
                fits = (n, m) == _BRIDGE or (n - 1 - m >= 2 and (n - 1 - m) % 2 == 0)
                if fits and (n, m) <= most:
                    yield from (((n, m), *others) for others in rest(links - n + 1, dof - m, (n, m)))

    for shape in rest(links, dof, (links, dof)):
        if len(shape) >= 2 and sum(size != _BRIDGE for size in shape) >= 2:
            yield shape


def block_choices(
    shape: Sequence[tuple[int, int]], blocks: Callable[[int, int], Iterator[Block]]
) -> Iterator[tuple[Block, ...]]:
    """Yield all multisets of blocks of some sizes; those of the largest size are read one by one.

    The sizes (links, dof) are those of one of `shapes`; `blocks` yields all chains of such a size that nothing
    cuts.
    """
    runs = [(size, len(list(run))) for size, run in groupby(shape)]

    def of_size(size: tuple[int, int]) -> Iterator[Block]:
        return iter([_BRIDGE_BLOCK]) if size == _BRIDGE else blocks(*size)

    smaller = [list(combinations_with_replacement(list(of_size(size)), count)) for size, count in runs[1:]]
    size, count = runs[0]
    first = ((block,) for block in of_size(size)) if count == 1 else combinations_with_replacement(of_size(size), count)
    for largest in first:
        for others in product(*smaller):
            yield (*largest, *(block for run in others for block in run))


def glued(blocks: Sequence[Block]) -> list[Joints]:
    """Return all chains, up to isomorphism, whose blocks are these; every link has two joints or more.

    >>> ring = (4, ((0, 1), (1, 2), (2, 3), (0, 3)))
    >>> len(glued([ring, ring])), len(glued([ring, ring, (2, ((0, 1),))]))
    (1, 1)
    """
    kinds = sorted(set(blocks))
    left = tuple(blocks.count(kind) for kind in kinds)
    start = (*left[:-1], left[-1] - 1)  # the largest block is the seed
    forms: dict[tuple[int, ...], dict[Joints, int]] = {start: {kinds[-1][1]: kinds[-1][0]}}
    for _ in range(len(blocks) - 1):
        grown: dict[tuple[int, ...], dict[Joints, int]] = {}
        for missing, partial in forms.items():
            for kind in range(len(kinds)):
                if missing[kind]:
                    rest = tuple(count - (k == kind) for k, count in enumerate(missing))
                    forms_of_rest = grown.setdefault(rest, {})
                    ends = sum(count for block, count in zip(kinds, rest, strict=True) if block != _BRIDGE_BLOCK)
                    for joints, links in partial.items():
                        for form in _attached((links, joints), kinds[kind]):
                            # links with one joint: each needs a block with a loop yet
                            if [*Counter(chain.from_iterable(form)).values()].count(1) <= ends:
                                forms_of_rest[form] = links + kinds[kind][0] - 1
        forms = grown
    [result] = forms.values()
    return sorted(result)


def _attached(form: Block, block: Block) -> set[Joints]:
    """Return all chains in which a link of a form is also a link of a block, in canonical form."""
    chains = set()
    links = form[0] + block[0] - 1
    for here in _representatives(form):
        for there in _representatives(block):
            name = {there: here}
            for link in range(block[0]):
                if link != there:
                    name[link] = form[0] + len(name) - 1
            joints = [*form[1], *((name[a], name[b]) for a, b in block[1])]
            order, _, _ = automorphisms_of(links, joints)
            canonical = sorted((min(order[a], order[b]), max(order[a], order[b])) for a, b in joints)
            chains.add(tuple(canonical))
    return chains


def _representatives(block: Block) -> list[int]:
    """Return one link of each orbit under the automorphisms."""
    links, joints = block
    _, generators, _ = automorphisms_of(links, joints)
    moves = np.array([range(links), *generators], np.int64)
    representatives: list[int] = np.flatnonzero(orbits_of(moves) == moves[0]).tolist()
    return representatives


Monomial = tuple[tuple[int, int], ...]
"""Lengths of cycles of links, with how many there are of each."""

Series = npt.NDArray[np.object_]
"""Coefficients, exact, by numbers of links and of freedoms; what lies beyond is cut off."""


def count_connected(links: int, dof: int) -> int:
    """Return the number of chains of N links and M freedoms without rigid sub-chains, fractionated ones included.

    Parameters
    ----------
    links, dof : int
        N, and M from 1 on.

    Examples
    --------
    >>> [count_connected(links, 2) for links in (5, 7, 9)]
    [1, 4, 40]
    """
    blocks = {
        (n, m): block_cycle_index(n, m)
        for m in range(1, dof + 1)
        for n in range(m + 3, links + 1, 2)
        if links - n >= dof - m and n - m <= links - dof  # the other blocks have M_i <= N_i - 1
    }
    derivative = {size: _derivative(index) for size, index in blocks.items()}
    shape = links + 1, dof + 1
    link, bridge = _term(shape, 1, 0), _term(shape, 0, 1)
    rooted, last = link, link * 0
    while (rooted != last).any():
        last = rooted
        planted = _substituted(derivative, rooted) + _product(bridge, rooted - link)
        rooted = _product(link, _exponential(planted))
    away = rooted - link
    at_link = away - _product(_product(link, bridge), away)
    pairs = (_product(away, away) + _raised(away, 2)) / 2
    at_block = _substituted(blocks, rooted) + _product(bridge, pairs)
    at_both = _product(rooted, _substituted(derivative, rooted)) + _product(bridge, _product(away, away))
    total: Fraction = (at_link + at_block - at_both)[links, dof]
    assert total.denominator == 1
    return total.numerator


def block_cycle_index(links: int, dof: int) -> dict[Monomial, Fraction]:
    """Return the sum of the cycle indices, over links, of all chains that nothing cuts.

    >>> index = block_cycle_index(4, 1)  # the dihedral group of a four-bar
    >>> index[((1, 4),)], index[((4, 1),)], index[((2, 2),)]
    (Fraction(1, 8), Fraction(1, 4), Fraction(3, 8))
    """
    total: dict[Monomial, Fraction] = defaultdict(Fraction)
    loops = (links - 1 - dof) // 2
    if loops == 1:
        for turn in range(links):
            for flip in (1, -1):
                image = [(turn + flip * i) % links for i in range(links)]
                total[_monomial(Counter(map(len, cycles(image))))] += Fraction(1, 2 * links)
        return dict(total)
    for n, codes in contracted_graphs(loops):
        if n <= links:
            for code in codes:
                for monomial, value in _index_of_graph(code, n, links):
                    total[monomial] += value
    return dict(total)


def _index_of_graph(code: Bytes, n: int, links: int) -> Iterator[tuple[Monomial, Fraction]]:
    """Yield the terms of the cycle index of the chains of a contracted graph."""
    frame = frame_of(code, n)
    for move, automorphism in zip(frame.moved, frame.automorphisms, strict=True):
        base = Counter(map(len, cycles(automorphism.tolist())))
        classes = list(_class_cycles(frame, move, automorphism))
        for types in product(*(list(_partitions(len(cycle[0]))) for cycle, _ in classes)):
            share = Fraction(1, len(frame.moved))
            joints, turned = [], []  # of each cycle of strings: its joints, and whether it comes back turned round
            for (cycle, flips), parts in zip(classes, types, strict=True):
                share /= _centraliser(parts)
                start = 0
                for part in parts:
                    joints.append([e for step in cycle for e in step[start : start + part]])
                    turned.append(flips and part % 2 == 1)
                    start += part
            for x in _placements(frame, joints, links - n):
                lengths = base.copy()
                for value, string, turns in zip(x, joints, turned, strict=True):
                    lengths[len(string)] += value % 2 if turns else value
                    lengths[2 * len(string)] += value // 2 if turns else 0
                yield _monomial(lengths), share


def _class_cycles(frame: Frame, move: Bytes, automorphism: Bytes) -> Iterator[tuple[list[list[int]], bool]]:
    """Yield the cycles of classes of parallel joints, and whether a class comes back with its ends exchanged."""
    ends = frame.ends
    members: dict[int, list[int]] = defaultdict(list)
    for e, start in enumerate(frame.first.tolist()):
        members[start].append(e)
    left = set(members)
    while left:
        start = min(left)
        cycle, e, end = [], start, int(ends[start, 0])
        while e in left:
            left.remove(e)
            cycle.append(members[e])
            e, end = int(move[e]), int(automorphism[end])
        yield cycle, end != int(ends[start, 0])


def _placements(frame: Frame, joints: list[list[int]], units: int) -> Iterator[list[int]]:
    """Yield the placements in which the joints of each cycle hold equally many binary links."""
    cost = np.array([len(cycle) for cycle in joints], np.int64)
    alone, identity = np.arange(len(cost)), np.arange(len(cost), dtype=np.uint8)[None]
    for bound in range(max(int(frame.needs[-1]), 0), min(units, 2 * len(frame.ends)) + 1):
        room, weight = conditions(frame.ends, frame.sets, frame.needs, bound)
        shares = np.array([weight[cycle].sum(axis=0) for cycle in joints], np.uint64).reshape(len(joints), len(room))
        left = Units(bound, units - bound, units)
        problem = room, shares, cost, alone, left, identity, no_prefix()
        count = place(*problem, np.zeros((0, len(cost)), np.uint8), np.zeros(0, np.int64))
        if count:
            x = np.zeros((count, len(cost)), np.uint8)
            place(*problem, x, np.zeros(count, np.int64))
            yield from x.tolist()


def _monomial(lengths: Counter[int]) -> Monomial:
    return tuple(sorted((length, count) for length, count in lengths.items() if count))


def _partitions(k: int, most: int | None = None) -> Iterator[tuple[int, ...]]:
    if k == 0:
        yield ()
    for part in range(min(k, most or k), 0, -1):
        for rest in _partitions(k - part, part):
            yield (part, *rest)


def _centraliser(parts: Sequence[int]) -> int:
    """Return how many permutations commute with one of this cycle type: the inverse of its share of the group."""
    return prod(part**count * factorial(count) for part, count in Counter(parts).items())


def _derivative(index: dict[Monomial, Fraction]) -> dict[Monomial, Fraction]:
    """Return the derivative by p_1."""
    terms = ((Counter(dict(monomial)), value) for monomial, value in index.items())
    return {_monomial(lengths - Counter([1])): value * lengths[1] for lengths, value in terms if lengths[1]}


def _substituted(blocks: dict[tuple[int, int], dict[Monomial, Fraction]], rooted: Series) -> Series:
    """Return the sum over the blocks of y^M times the cycle index with p_k read as R(x^k, y^k)."""

    @cache
    def power(length: int, count: int) -> Series:
        raised = _raised(rooted, length)
        return raised if count == 1 else _product(power(length, count - 1), raised)

    total: Series = _term(rooted.shape) * 0
    for (_, dof), index in blocks.items():
        for monomial, value in index.items():
            total += value * reduce(_product, (power(*part) for part in monomial), _term(rooted.shape, 0, dof))
    return total


def _term(shape: tuple[int, ...], links: int = 0, dof: int = 0) -> Series:
    """Return the series x^links y^dof; zero if it is cut off."""
    series = np.full(shape, Fraction(0))
    series[links : links + 1, dof : dof + 1] = Fraction(1)
    return series


def _product(a: Series, b: Series) -> Series:
    total: Series = a * 0
    for n, m in np.argwhere(a):
        total[n:, m:] += a[n, m] * b[: len(b) - n, : b.shape[1] - m]
    return total


def _raised(series: Series, k: int) -> Series:
    """Return a series in x and y read in x^k and y^k."""
    raised: Series = series * 0
    links, dof = raised[::k, ::k].shape
    raised[::k, ::k] = series[:links, :dof]
    return raised


def _exponential(series: Series) -> Series:
    """Return exp(sum over k of series(x^k, y^k) / k)."""
    exponent = sum(_raised(series, k) / k for k in range(1, max(series.shape)))
    result: Series = _term(series.shape)
    term = result
    k = 0
    while term.any():
        k += 1
        term = _product(term, exponent) / k
        result = result + term
    return result
