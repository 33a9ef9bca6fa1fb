"""Choices of a ground link and of input joints, up to the symmetries of a chain.

M joints are inputs of a chain of M freedoms if nothing moves once they are locked. In a chain a joint leaves one
of three freedoms, so it is two bars between its links, and a locked one three; a generic chain of N links is
rigid, and no bar is idle, exactly if any k links hold at most 3 (k - 1) of the bars (Tay 1984). The pebble game
decides that.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

__all__ = ["are_inputs", "input_choices"]

Joint = tuple[int, int]


def are_inputs(links: int, joints: Sequence[Joint], locked: Sequence[int]) -> bool:
    """Return whether locking some joints of a chain, by their indices, takes one freedom each.

    The chain has no rigid sub-chains.
    """
    bars = [
        end for index, end in zip(range(len(joints)), joints, strict=True) for _ in range(2 + (index in locked))
    ]
    return _is_sparse(links, bars)


def _is_sparse(nodes: int, bars: Sequence[Joint]) -> bool:
    """Tell whether any k nodes hold at most 3 (k - 1) bars: the (3, 3) pebble game.

    Every node has three pebbles; a bar takes one of an end's. It may lie if four pebbles can be brought to its
    ends, moving pebbles against the bars that took them.
    """
    pebbles = [3] * nodes
    out: list[list[int]] = [[] for _ in range(nodes)]
    for a, b in bars:
        while pebbles[a] + pebbles[b] < 4:
            if not (_fetch(a, b, pebbles, out) or _fetch(b, a, pebbles, out)):
                return False
        taker, other = (a, b) if pebbles[a] else (b, a)
        pebbles[taker] -= 1
        out[taker].append(other)
    return True


def _fetch(node: int, keep: int, pebbles: list[int], out: list[list[int]]) -> bool:
    """Bring one more pebble to a node, not from the node ``keep``; tell whether there was one."""
    came_from = {node: node, keep: keep}
    stack = [node]
    while stack:
        here = stack.pop()
        for there in out[here]:
            if there in came_from:
                continue
            came_from[there] = here
            if pebbles[there]:
                pebbles[there] -= 1
                pebbles[node] += 1
                while there != node:
                    before = came_from[there]
                    out[before].remove(there)
                    out[there].append(before)
                    there = before  # noqa: PLW2901 - walk back along the path
                return True
            stack.append(there)
    return False


def input_choices(
    links: int, joints: Sequence[Joint], generators: Sequence[Sequence[int]], dof: int
) -> Iterator[tuple[int, list[Joint]]]:
    """Yield choices of a ground link and `dof` input joints of a chain, one of each orbit, the least one.

    The generators are permutations of the links that generate the automorphisms.

    >>> ring = [(0, 1), (1, 2), (2, 3), (3, 0)]
    >>> list(input_choices(4, ring, [[1, 2, 3, 0], [0, 3, 2, 1]], 1))
    [(0, [(0, 1)]), (0, [(1, 2)])]
    """
    ordered = sorted((min(joint), max(joint)) for joint in joints)
    number = {joint: i for i, joint in zip(range(len(ordered)), ordered, strict=True)}
    moves = [
        (move, [number[min(move[a], move[b]), max(move[a], move[b])] for a, b in ordered]) for move in generators
    ]
    chosen = [c for c in combinations(range(len(ordered)), dof) if dof == 1 or are_inputs(links, ordered, c)]
    seen: set[tuple[int, tuple[int, ...]]] = set()
    for ground in range(links):
        for inputs in chosen:
            if (ground, inputs) in seen:
                continue
            yield ground, [ordered[i] for i in inputs]
            seen.add((ground, inputs))
            stack = [(ground, inputs)]
            while stack:
                link, taken = stack.pop()
                for move, joint_move in moves:
                    image = move[link], tuple(sorted(joint_move[i] for i in taken))
                    if image not in seen:
                        seen.add(image)
                        stack.append(image)
