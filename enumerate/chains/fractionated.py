"""Fractionated chains: blocks that share single links, and bridge joints.

A connected chain without rigid sub-chains is a tree of blocks: chains that nothing cuts, with N_i links and
M_i >= 1 freedoms each, and single joints between two links (N_i = 2, M_i = 1), which no leaf of the tree is. Links
- 1 and freedoms add up over the blocks. Chains made of different blocks differ, so the blocks are chosen first;
then they are put together in all ways, block after block, forms that correspond kept once. Only the forms of one
choice of blocks are held at a time. Theory: docs/theory/chains.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import combinations_with_replacement, groupby, product

from graphs.identity.chains import automorphisms_of

__all__ = ["Block", "block_choices", "glued", "shapes"]

Joints = tuple[tuple[int, int], ...]
Block = tuple[int, Joints]
"""Number of links, and joints between links 0, 1, ..."""

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
    """Yield all multisets of blocks of given sizes; those of the largest size are read one by one.

    The sizes (links, dof) are those of one of `shapes`; `blocks` yields all chains of such a size that nothing
    cuts.
    """
    runs = [(size, len(list(run))) for size, run in groupby(shape)]

    def of_size(size: tuple[int, int]) -> Iterator[Block]:
        return iter([_BRIDGE_BLOCK]) if size == _BRIDGE else blocks(*size)

    smaller = [list(combinations_with_replacement(list(of_size(size)), count)) for size, count in runs[1:]]
    size, count = runs[0]
    first = (
        ((block,) for block in of_size(size))
        if count == 1
        else combinations_with_replacement(of_size(size), count)
    )
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
                    rest = tuple(count - (k == kind) for k, count in zip(range(len(kinds)), missing, strict=True))
                    found = grown.setdefault(rest, {})
                    ends = sum(count for block, count in zip(kinds, rest, strict=True) if block != _BRIDGE_BLOCK)
                    for joints, links in partial.items():
                        for form in _attached((links, joints), kinds[kind]):
                            if _loose_ends(links + kinds[kind][0] - 1, form) <= ends:
                                found[form] = links + kinds[kind][0] - 1
        forms = grown
    [result] = forms.values()
    return sorted(result)


def _attached(form: Block, block: Block) -> set[Joints]:
    """Return all chains in which a link of a form is also a link of a block, in canonical form."""
    found = set()
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
            found.add(tuple(canonical))
    return found


def _representatives(block: Block) -> list[int]:
    """Return one link of each orbit under the automorphisms."""
    links, joints = block
    _, generators, _ = automorphisms_of(links, joints)
    seen: set[int] = set()
    chosen = []
    for link in range(links):
        if link in seen:
            continue
        chosen.append(link)
        stack = [link]
        while stack:
            here = stack.pop()
            if here not in seen:
                seen.add(here)
                stack += [generator[here] for generator in generators]
    return chosen


def _loose_ends(links: int, joints: Joints) -> int:
    """Return the number of links with one joint: each needs a block with a loop yet."""
    degrees = [0] * links
    for a, b in joints:
        degrees[a] += 1
        degrees[b] += 1
    return degrees.count(1)
