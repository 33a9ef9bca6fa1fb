"""First-order motion of any linkage from its conformed position, for many positions of its joints at once.

Rates q_j of the joints close a loop if sum +-q_j e_j = 0 over it, with e = (sin t, 1, cos t) at azimuth t: the
cone angle drops out of the axes of a cone, and a cylinder has the same equations. A link's motion is here w = sum
+-q_j e_j along a path from the ground. On a cone its angular velocity is (cos lambda w_x, -sin lambda w_y, cos
lambda w_z); on a cylinder w_y is its angular velocity and (w_x, w_z) / w_y its instant centre, in radii. A point
of it at azimuth t moves outward at the rate w_z sin t - w_x cos t. Hyatt et al. 2020, section 4; Hyatt et al.
2021, section 5. Theory: docs/theory/behaviour.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import networkx as nx
import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.loops.loop import Loop, cyclic_order
from graphs.mechanism.sc import SCGraph
from graphs.rank.singular_values import spectra
from graphs.tolerances import DOUBLE
from graphs.types import Floats, JointId, LinkId

NEARLY_DEGREES = 0.05
"""The error of azimuths, in degrees, that cutting a model brings: within it a linkage is nearly mobile."""


@dataclass(frozen=True, slots=True)
class ConformedChain:
    """A connected chain, ready for sums along its loops and paths.

    Attributes
    ----------
    links : tuple of link ids
        The ground link first.
    joints : tuple of joint ids
    joints_of : tuple of tuples of int
        The joints of each link.
    loops : int[L, J]
        Independent loops: +1 or -1 where one passes a joint, by its direction, else 0. Rates with matrix product 0
        close.
    paths : int[N, J]
        Likewise a path from the ground to each link.
    """

    links: tuple[LinkId, ...]
    joints: tuple[JointId, ...]
    joints_of: tuple[tuple[int, ...], ...]
    loops: npt.NDArray[np.int64]
    paths: npt.NDArray[np.int64]

    @classmethod
    def of(cls, chain: SCGraph, ground: LinkId | None = None) -> ConformedChain:
        """Prepare a chain; its loops' centres do not matter: all axes are ruling lines of one surface.

        The ground is by default that of the chain, or its first link. Raises `InvariantError` if it is no link, or
        the chain is not connected.
        """
        if ground is None:
            ground = chain.ground if chain.ground is not None else next(iter(chain.nodes), None)
        if ground not in chain:
            raise InvariantError("ground is a link", f"the ground {shown(ground)} is no link", "one of the links")
        joints = tuple(chain.joints)
        pairs = list(chain.joints.values())
        unit = np.eye(len(joints), dtype=np.int64)
        paths: dict[LinkId, npt.NDArray[np.int64]] = {ground: np.zeros(len(joints), dtype=np.int64)}
        tree: set[int] = set()
        work = [ground]
        while work:
            link = work.pop(0)
            for number, (a, b) in enumerate(pairs):
                other = b if a == link else a
                if link in (a, b) and other not in paths:
                    paths[other] = paths[link] + (unit[number] if link == a else -unit[number])
                    tree.add(number)
                    work.append(other)
        if len(paths) != len(chain):
            raise InvariantError("connected", "the chain is in several parts", "one that is connected")
        others = [(number, ends) for number, ends in enumerate(pairs) if number not in tree]
        loops = [paths[a] - paths[b] + unit[number] for number, (a, b) in others]
        links = (ground, *(link for link in chain if link != ground))
        return cls(
            links,
            joints,
            tuple(tuple(i for i, pair in enumerate(pairs) if link in pair) for link in links),
            np.array(loops, dtype=np.int64).reshape(-1, len(joints)),
            np.stack([paths[link] for link in links]),
        )


@dataclass(frozen=True, slots=True)
class FirstOrder:
    """First-order motions of many linkages of one chain.

    Attributes
    ----------
    freedoms : int[...]
        Infinitesimal freedoms: joints less rank.
    undecided, nearly : int[...]
        Singular values that may be noise or not: then freedoms are at most these, and rates are unknown. And those
        that an error of a thousandth would explain.
    singular_values : float[..., min(3 L, J)]
        Of the closure equations (with unit columns up to sqrt(2)), falling.
    gap : float[...]
        Ratio of the smallest singular value counted to the largest that is noise, or may be, at least to what
        noise makes; infinite where there is none.
    rates : float[..., J]
        Joint rates of a motion, of length 1; nan unless there is certainly one freedom. Its sense is arbitrary.
    motions : float[..., N, 3]
        w of each link of the chain, in the order of its links.
    """

    freedoms: npt.NDArray[np.int64]
    undecided: npt.NDArray[np.int64]
    nearly: npt.NDArray[np.int64]
    singular_values: Floats
    gap: Floats
    rates: Floats
    motions: Floats

    def rank(self) -> npt.NDArray[np.int64]:
        """Return the rank of the closure equations: int[...]."""
        return np.asarray(self.rates.shape[-1] - self.freedoms)


def first_order(chain: ConformedChain, places: npt.ArrayLike, error: float = DOUBLE.closed) -> FirstOrder:
    """Return rank and first-order motion of linkages at their conformed position.

    Parameters
    ----------
    chain : ConformedChain
    places : float[..., J]
        Azimuths of the joints, radians, in the order of the chain's joints; `InvariantError` if they are another
        number.
    error : float, optional
        Of the azimuths, radians: singular values are judged by it (`graphs.rank.singular_values`).

    Examples
    --------
    A square: the coupler turns about a point at infinity.

    >>> four_bar = ConformedChain.of(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)]))
    >>> motion = first_order(four_bar, np.radians([45, 135, 225, 315]))
    >>> int(motion.freedoms), bool(abs(motion.motions[2, 1]) < 1e-12)
    (1, True)
    """
    t = np.asarray(places, dtype=float)
    count = len(chain.joints)
    if t.shape[-1:] != (count,):
        raise InvariantError("azimuths", numbered(t.shape[-1] if t.ndim else 0, "azimuth"), f"{count}, one per joint")
    axes = np.stack([np.sin(t), np.ones_like(t), np.cos(t)], axis=-1)  # but for two scales that lambda sets
    closure = np.einsum("lj,...jc->...lcj", chain.loops, axes).reshape(*t.shape[:-1], -1, count)
    if not closure.shape[-2]:
        shape = t.shape[:-1]
        return FirstOrder(
            np.full(shape, count), np.zeros(shape, int), np.zeros(shape, int),
            np.zeros((*shape, 0)), np.full(shape, np.inf),
            np.full(t.shape, np.nan), np.full((*shape, len(chain.links), 3), np.nan),
        )  # fmt: skip
    # A joint is in two loops at most of a basis of a planar chain, in few of any: two entries of its column move.
    spectrum = spectra(closure, np.sqrt(2) * error, np.sqrt(2) * np.radians(NEARLY_DEGREES))
    judged = spectrum.verdict
    counted = ~judged.noise & ~judged.undecided
    freedoms = count - counted.sum(axis=-1)
    undecided = judged.undecided.sum(axis=-1)
    decided = (freedoms == 1) & (undecided == 0)
    rates = np.where(decided[..., np.newaxis], spectrum.rows[..., -1, :], np.nan)
    motions = np.einsum("nj,...j,...jc->...nc", chain.paths, rates, axes)
    least = np.where(counted, spectrum.parts, np.inf).min(axis=-1)
    rest = np.where(counted, 0.0, np.maximum(spectrum.parts, spectrum.floors)).max(axis=-1)
    with np.errstate(divide="ignore"):
        gap = np.asarray(least / rest)
    return FirstOrder(freedoms, undecided, judged.nearly.sum(axis=-1), spectrum.values, gap, rates, motions)


_MOST_LOOPS = 8
"""More independent loops have too many cycles to look at them all."""


def signed_cycles(chain: ConformedChain) -> npt.NDArray[np.int64]:
    """Return all simple cycles of a chain, short ones first, each one way round: int64[C, J].

    Rows are +1 or -1 where a cycle passes a joint, as in `ConformedChain.loops`, else 0. Raise `UnsolvableError`
    if there are more than eight independent loops.
    """
    independent = chain.loops
    if len(independent) > _MOST_LOOPS:
        raise UnsolvableError(f"the chain has {len(independent)} independent loops; expected {_MOST_LOOPS} at most")
    cycles: dict[tuple[int, ...], npt.NDArray[np.int64]] = {}
    for factors in product((0, 1, -1), repeat=len(independent)):
        if next((factor for factor in factors if factor), -1) < 0:  # each cycle one way round
            continue
        row = np.array(factors) @ independent
        if np.abs(row).max() == 1 and _is_simple(chain, row):
            cycles[tuple(np.flatnonzero(row))] = row
    return np.array([cycles[key] for key in sorted(cycles, key=lambda key: (len(key), key))], np.int64).reshape(
        -1, len(chain.joints)
    )


def _is_simple(chain: ConformedChain, row: npt.NDArray[np.int64]) -> bool:
    """Check whether joints with weights that sum to 0 at every link are one cycle: each link has two or none."""
    passed = [[joint for joint in joints if row[joint]] for joints in chain.joints_of]
    if any(len(joints) not in (0, 2) for joints in passed):
        return False
    return bool(nx.is_connected(nx.Graph([joints for joints in passed if joints])))


def loops_of_chain(chain: SCGraph) -> tuple[tuple[JointId, ...], ...]:
    """Return the joints of every loop of a chain, in loop order, short loops first."""
    joints = tuple(chain.joints)
    rows = signed_cycles(ConformedChain.of(chain))
    return tuple(
        cyclic_order(Loop(tuple(joints[i] for i in np.flatnonzero(row).tolist())), chain.joints) for row in rows
    )
