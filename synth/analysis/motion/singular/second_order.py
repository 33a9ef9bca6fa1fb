"""Which rates at a singular configuration can begin a motion, to second order, and proofs that none does.

Round a loop the twists x_i of the joints, at rates r_i, sum to zero to first order. To second order the sum over i
< j of r_i r_j [x_i, x_j] has to be made up for by accelerations, and what is across all twists sees none of these:
a self-stress w gives the equation w . sum r_i r_j [x_i, x_j] = 0. A loop has self-stresses of its own (a flat
vertex, the one across the sheet); several loops may have more together. Where an equation is a product of two
linear ones the rates fall into two subspaces: one or the other is taken, as long as any equation is left. If no
rates are left, nothing moves: a motion that begins as t^k r makes each self-stress's form vanish at r. A sum of
these forms that is positive on all rates is the shortest proof; else the rates may be used up case by case. R.
Connelly and W. Whiteley, Second-order rigidity and prestress stability, SIAM J. Discrete Mathematics 9 (1996).
Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf
from typing import Literal

import numpy as np
import scipy

from graphs.errors import NumericalError
from graphs.loops.loop import Centre
from graphs.rank.dissection import number_below
from graphs.rank.singular_values import inertia, null_space, null_vectors, row_space, singular_values, spectrum, split
from graphs.tolerances import DOUBLE, canonical_basis, canonical_order, pivots, signed
from graphs.types import Floats, Ints
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.linkage import Linkage, LinkageLoop
from synth.analysis.motion.tangent import TangentSpace
from synth.analysis.motion.walk.step import Allowance

MOST_ROWS, MOST_SHARED = 600, 12
"""Self-stresses of several loops together are looked for up to so many closure equations; of more, what they say of
no more rates than that."""


@dataclass(frozen=True, slots=True)
class Quadric:
    """A quadratic equation between the rates r of k joints: ``r @ form @ r`` has to vanish, the form symmetric."""

    joints: tuple[int, ...]
    form: Floats


def quadrics_of(linkage: Linkage, zero: float = DOUBLE.zero) -> list[Quadric]:
    """Return the equations of second order between the rates that the self-stresses of each loop alone give.

    Singular values below `zero` times the largest are zero, and forms whose entries are below it.
    """
    found: list[list[Quadric]] = [[] for _ in linkage.loops]
    about_points: dict[int, list[int]] = {}
    for number, loop in enumerate(linkage.loops):
        if loop.centre is Centre.FINITE and len(loop.joints) > 2:
            about_points.setdefault(len(loop.joints), []).append(number)
        else:
            found[number] = _quadrics_of_loop(linkage, loop, zero)
    for numbers in about_points.values():
        loops = [linkage.loops[number] for number in numbers]
        axes = linkage.directions[[loop.joints for loop in loops]]
        axes = axes * np.array([loop.signs for loop in loops], dtype=float)[..., None]
        ranks, stresses = null_vectors(axes, zero)
        flat = np.flatnonzero(ranks == 2)
        forms = _second_order(axes[flat].swapaxes(1, 2)) @ stresses[flat, None, :, None]
        for place, form in zip(flat.tolist(), forms[..., 0], strict=True):
            if np.abs(form).max() > zero:
                found[numbers[place]] = [Quadric(loops[place].joints, form)]
        for place in np.flatnonzero(ranks < 2).tolist():
            found[numbers[place]] = _quadrics_of_loop(linkage, loops[place], zero)
    return [quadric for of_loop in found for quadric in of_loop]


def _quadrics_of_loop(linkage: Linkage, loop: LinkageLoop, zero: float) -> list[Quadric]:
    """Return the equations of second order of one loop."""
    twists = _twists(linkage, loop)
    stresses = null_space(twists.T, zero)
    forms = np.moveaxis(_second_order(twists) @ stresses, -1, 0)
    return [Quadric(loop.joints, form) for form in forms if np.abs(form).max(initial=0.0) > zero]


def shared_quadrics(
    linkage: Linkage, tangent: Floats, alone: Sequence[Quadric], zero: float = DOUBLE.zero
) -> list[Quadric]:
    """Return the equations that self-stresses of several loops give beyond those of the loops alone.

    They are for the rates that agree to first order, orthonormal columns float[J, s]; none is a sum of others, or
    of those of the loops alone (`quadrics_of`), on these rates. The matrix of all closure equations is dense here.
    """
    size = tangent.shape[1]
    blocks, seen = _second_order_by_loops(linkage, tangent)
    rows = seen.shape[2]
    matrix, start = np.zeros((rows, len(tangent))), 0
    for loop, block in zip(linkage.loops, blocks, strict=True):
        matrix[start : start + len(block), list(loop.joints)] = block
        start += len(block)
    stresses = null_space(matrix.T, zero) if size and rows else np.zeros((rows, 0))
    if not stresses.shape[1]:
        return []
    forms = (seen @ stresses).reshape(size * size, -1).T
    known = local_forms(tangent, alone).reshape(-1, size * size)
    places, beyond = tuple(range(len(tangent))), _beyond(forms, known, zero).reshape(-1, size, size)
    return [Quadric(places, tangent @ form @ tangent.T) for form in beyond]


def _second_order_by_loops(linkage: Linkage, tangent: Floats) -> tuple[list[Floats], Floats]:
    """Return the twists of each loop, and what closure equations see of pairs of rates: float[s, s, rows]."""
    size = tangent.shape[1]
    twists = [_twists(linkage, loop) for loop in linkage.loops]
    rows = np.cumsum([0, *map(len, twists)])
    seen = np.zeros((size, size, rows[-1]))
    for loop, block, start, end in zip(linkage.loops, twists, rows, rows[1:], strict=False):
        here = tangent[list(loop.joints)]
        seen[:, :, start:end] = np.einsum("ia,ijw,jb->abw", here, _second_order(block), here, optimize=True)
    return twists, seen


def all_quadrics(linkage: Linkage, tangent: Floats, zero: float = DOUBLE.zero) -> list[Quadric]:
    """Return the equations of the loops alone and `shared_quadrics`; of many closure equations for few rates only.

    Loops without a centre that are listed are a choice among many: what they have alone is among the shared ones.
    """
    large = rows_of(linkage) > MOST_ROWS and tangent.shape[1]
    if large and (tangent.shape[1] > MOST_SHARED or _in_a_plane(linkage)):
        return quadrics_of(linkage, zero)
    centred = replace(linkage, loops=tuple(loop for loop in linkage.loops if loop.centre is not Centre.NONE))
    alone = quadrics_of(centred, zero)
    if not large:
        return alone + shared_quadrics(linkage, tangent, alone, zero)
    try:
        return alone + _shared_of_many(linkage, tangent, alone, zero)
    except NumericalError:
        return quadrics_of(linkage, zero)


def _in_a_plane(linkage: Linkage) -> bool:
    """Tell whether all axes lie in directions of a plane, and all loops are about points: none share a self-stress."""
    about = all(loop.centre is Centre.FINITE for loop in linkage.loops)
    return about and bool(singular_values(linkage.directions)[-1] <= DOUBLE.parallel)


def _shared_of_many(linkage: Linkage, tangent: Floats, alone: Sequence[Quadric], zero: float) -> list[Quadric]:
    """Return `shared_quadrics` of many closure equations, without their self-stresses.

    All self-stresses together see of second-order terms what no rates make up for. That part of them, for each pair of
    the rates, has the same row space as what an orthonormal basis of self-stresses sees.
    """
    size = tangent.shape[1]
    blocks, seen = _second_order_by_loops(linkage, tangent)
    lengths = [len(block) for block in blocks]
    joints = [np.tile(loop.joints, length) for loop, length in zip(linkage.loops, lengths, strict=True)]
    rows = np.repeat(np.arange(sum(lengths)), np.repeat([len(loop.joints) for loop in linkage.loops], lengths))
    entries = np.concatenate([block.ravel() for block in blocks]), (rows, np.concatenate(joints))
    space = TangentSpace(scipy.sparse.csr_matrix(entries, shape=(sum(lengths), len(tangent))))
    forms = np.zeros((sum(lengths), size, size))
    for one in range(size):
        for other in range(one, size):
            forms[:, one, other] = forms[:, other, one] = space.beyond(seen[one, other])
    known = local_forms(tangent, alone).reshape(-1, size * size)
    flat = np.asarray(np.linalg.qr(forms.reshape(-1, size * size), mode="r"))
    beyond = _beyond(flat, known, zero).reshape(-1, size, size)
    few = pivots(tangent)  # the rates of these joints are those of all
    shares = np.linalg.inv(tangent[few])
    return [Quadric(tuple(few), shares.T @ form @ shares) for form in beyond]


def rows_of(linkage: Linkage) -> int:
    """Return the number of closure equations: three of a loop about a point, six of any other."""
    return sum(3 if loop.centre is Centre.FINITE else 6 for loop in linkage.loops)


def local_forms(basis: Floats, quadrics: Sequence[Quadric]) -> Floats:
    """Return the forms of equations on a space of rates, each as part of its size: float[n, s, s]."""
    forms = np.zeros((len(quadrics), basis.shape[1], basis.shape[1]))
    for number, quadric in enumerate(quadrics):
        local = basis[list(quadric.joints)]
        forms[number] = local.T @ quadric.form @ local / np.abs(quadric.form).max()
    return forms


def _beyond(rows: Floats, known: Floats, zero: float) -> Floats:
    """Return orthonormal rows that span, together with known ones, what all rows span."""
    if len(known):
        spanned = row_space(known, zero)
        rows = rows - (rows @ spanned) @ spanned.T
    return row_space(rows, zero, scale=1.0).T  # stresses and rates are unit vectors, brackets of the size of one


def _twists(linkage: Linkage, loop: LinkageLoop) -> Floats:
    """Return the twists of a loop's joints at the configuration, as the loop passes them: float[3 or 6, k]."""
    joints = list(loop.joints)
    axes = linkage.directions[joints] * np.array(loop.signs, dtype=float)[:, None]
    if loop.centre is Centre.FINITE:  # about the centre there are no moments
        return np.asarray(axes.T)
    points = linkage.points[joints] - linkage.points[joints].mean(axis=0)
    return np.concatenate([axes, np.cross(points, axes)], axis=1).T


def _second_order(twists: Floats) -> Floats:
    """Return the forms of r -> sum over i < j of r_i r_j [x_i, x_j], one for each coordinate: float[..., k, k, e].

    Twists x_i are columns, float[..., e, k].
    """
    turn, shift = twists[..., :3, :].swapaxes(-1, -2), twists[..., 3:, :].swapaxes(-1, -2)
    brackets = np.cross(turn[..., :, None, :], turn[..., None, :, :])
    if shift.shape[-1]:
        moments = np.cross(turn[..., :, None, :], shift[..., None, :, :])
        moments = moments + np.cross(shift[..., :, None, :], turn[..., None, :, :])
        brackets = np.concatenate([brackets, moments], axis=-1)
    upper = brackets * np.triu(np.ones(brackets.shape[-3:-1]), 1)[..., None]  # twist i comes before twist j
    return np.asarray(upper + upper.swapaxes(-3, -2)) / 2.0


_MOST = 300
"""Eigenvectors looked at; beyond, what is left to gain is next to nothing."""
_NEAR, _GAINS = 1e-5, 1e-9
"""Where the hull comes so near to zero, or a further value brings it no nearer, there is no clear definite sum."""


def definite_weights(forms: Floats, clear: float) -> tuple[Floats, float] | None:
    """Return multiples of symmetric forms, float[n, s, s], whose sum is positive definite, and how clearly.

    The values that the forms take together, at unit vectors and mixtures of these, make a convex set. If its point
    nearest to zero is w, not zero itself, then the sum with multiples w is at least |w|^2 everywhere; if it is
    zero, no sum is definite. Wolfe's method: the least point of the hull of values seen so far says where to look
    next, at the eigenvector of its least eigenvalue. P. Wolfe, Finding the nearest point in a polytope,
    Mathematical Programming 11 (1976). The smallest eigenvalue as part of the largest is returned too, and more
    than `clear`.
    """
    if not len(forms) or not forms.shape[1]:
        return None
    size = float(np.abs(forms).max())
    if size <= DOUBLE.zero:  # forms of unit vectors that are zero but for rounding have no signs
        return None
    seen = np.trace(forms, axis1=1, axis2=2)[None] / forms.shape[1]
    for _ in range(_MOST):
        shares = _shares(seen / size)
        if shares is None:
            return None
        weights = shares @ seen
        total = inertia(np.tensordot(weights, forms, 1), clear)
        if (total.signs > 0).all():
            return weights, float(total.values[0] / total.values[-1])
        new = np.einsum("i,nij,j->n", total.vectors[:, 0], forms, total.vectors[:, 0])
        if np.linalg.norm(weights) <= _NEAR * size or weights @ (weights - new) <= _GAINS * (weights @ weights):
            return None
        seen = np.concatenate([seen[shares > 0.0], new[None]])
    return None


def _shares(points: Floats) -> Floats | None:
    """Return the shares of points in the point of their convex hull that is nearest to zero: float[points].

    None where it is so near to zero that they are not clear.
    """
    from scipy.optimize import nnls  # takes a third of a second to load

    with_sum = np.concatenate([points, np.ones((len(points), 1))], axis=1)
    try:
        shares = nnls(with_sum.T, np.eye(1, with_sum.shape[1], points.shape[1])[0], maxiter=30 * len(points))[0]
    except RuntimeError:  # its iterations do not end
        return None
    return np.asarray(shares / shares.sum())


_STEPS = 40
MANY = 600
"""The closure equations of more joints are taken as a full matrix only where sparse factors do not decide, and never
of more than `synth.analysis.motion.closure.MOST_WHOLE`."""
_CASE = 3e4
"""Work on a case besides that on its matrices, in products of numbers."""
_LOST = 10.0
"""Spaces that are this many times closer than what counts as zero are one."""


@dataclass(frozen=True, slots=True)
class RateSpace:
    """Rates that agree to second order: a linear space, on which a few equations may be left.

    The basis, float[J, s], is orthonormal; the equations are no products of linear ones on this space.
    """

    basis: Floats
    left: tuple[Quadric, ...]

    def in_order(self, order: Ints) -> RateSpace:
        """Return the same space with joints in another order, int[J]: their places in the present one."""
        place = np.argsort(order)
        left = (replace(one, joints=tuple(place[list(one.joints)].tolist())) for one in self.left)
        return RateSpace(self.basis[order], tuple(left))


def spaces_within(
    tangent: Floats, quadrics: Sequence[Quadric], zero: float = DOUBLE.zero, allowance: Allowance | None = None
) -> Iterator[RateSpace]:
    """Yield spaces that hold all rates which agree to second order, depth first; some may be part of others.

    The tangent, orthonormal float[J, s], holds the rates that agree to first order (`rates_at`). Eigenvalues below
    `zero` times the largest are zero. The search ends where the allowance, in products of numbers, is used up.
    """
    quadrics = tuple(quadrics)
    case = _Case(tangent, quadrics, local_forms(tangent, quadrics), zero)
    yield from _split(case, allowance or Allowance(inf))


def largest_only(spaces: Sequence[RateSpace], zero: float = DOUBLE.zero) -> list[RateSpace]:
    """Return the spaces that are not part of another, each once, in their order."""
    kept: dict[int, list[int]] = {}
    for size in sorted({space.basis.shape[1] for space in spaces}, reverse=True):
        for number, space in enumerate(spaces):
            if space.basis.shape[1] == size and not _within_one(space, spaces, kept, zero):
                kept.setdefault(size, []).append(number)
    return [spaces[number] for number in sorted(number for numbers in kept.values() for number in numbers)]


def rates_near(
    closure: ClosureEquations, angles: Floats, quadrics: Sequence[Quadric], wanted: Floats, zero: float = DOUBLE.closed
) -> Floats | None:
    """Return rates that agree to second order, near wanted ones, by Newton's method; for linkages of any size.

    Wanted are rates or their signs, float[J]; the answer is as long as they are, and leaves at most `zero` of the
    equations; None where none were found. Where two solutions cross, Newton's method comes near by halves and
    stays 1e-5 away, which squares of rates hardly show: of exact coordinates `zero` is far below other zeros.
    """
    _, entries = closure.evaluated(angles)
    jacobian = closure.matrix(entries)
    size = float(np.linalg.norm(wanted))
    rates = closure.space(entries).projected(wanted)
    groups = equations_by_size(quadrics)
    empty = np.zeros(0, dtype=np.int64)
    rows = np.concatenate([empty, *(np.repeat(numbers, joints.shape[1]) for numbers, joints, _ in groups)])
    columns = np.concatenate([empty, *(joints.ravel() for _, joints, _ in groups)])
    for _ in range(_STEPS):
        if not np.linalg.norm(rates) > DOUBLE.zero_rate * size:
            return None
        rates = rates * (size / np.linalg.norm(rates))
        slopes = [(forms @ rates[joints][..., None]).ravel() for _, joints, forms in groups]
        values = np.concatenate([np.zeros(0), *slopes])
        quadratic = scipy.sparse.csr_matrix((values, (rows, columns)), shape=(len(quadrics), len(rates)))
        off = np.concatenate([jacobian @ rates, quadratic @ rates])
        if np.abs(off).max(initial=0.0) <= zero:
            return rates
        both = scipy.sparse.vstack([jacobian, 2.0 * quadratic], format="csr")
        rates = rates + TangentSpace(both).step(off)
    return None


def equations_by_size(quadrics: Sequence[Quadric]) -> list[tuple[Ints, Ints, Floats]]:
    """Return the equations between as many joints: numbers int[n], joints int[n, k] and forms float[n, k, k]."""
    sizes = np.array([len(quadric.joints) for quadric in quadrics], dtype=np.int64)
    groups = []
    for size in np.unique(sizes).tolist():
        numbers = np.flatnonzero(sizes == size)
        alike = [quadrics[number] for number in numbers.tolist()]
        joints = np.array([quadric.joints for quadric in alike], dtype=np.int64)
        groups.append((numbers, joints, np.array([quadric.form for quadric in alike])))
    return groups


def rates_at(closure: ClosureEquations, angles: Floats, zero: float = DOUBLE.zero) -> Floats:
    """Return the rates at which loops stay closed to first order: float[J, s], orthonormal columns.

    By singular values. Of many joints random rates are freed of what parts the loops, as many as there are singular
    values near zero; where one of these is not zero, by orthogonal columns, the largest of what is left first. The
    columns depend on the space alone (`graphs.tolerances`).
    """
    if closure.joints > MANY and closure.rows and zero <= _EXACTLY * DOUBLE.zero:
        rates = _freed_rates(closure, angles, zero)
        if rates is not None:
            return rates
    matrix = closure.at(angles)[1].toarray()
    if closure.joints <= MANY:
        return null_space(matrix, zero)
    columns, triangle, _ = scipy.linalg.qr(matrix.T, pivoting=True, overwrite_a=True, check_finite=False)
    sizes = np.abs(np.diag(triangle))
    return canonical_basis(columns[:, int((sizes > zero * sizes.max(initial=0.0)).sum()) :])


def rates_at_most(closure: ClosureEquations, angles: Floats) -> int:
    """Return how many rates close to first order, or nearly: singular values near zero, counted by inertia."""
    return number_below(closure.at(angles)[1], DOUBLE.singular)


def _least_part(closure: ClosureEquations, angles: Floats) -> float | None:
    """Return what the least singular value is at least, as part of the largest; None if one may be zero."""
    sizes = abs(closure.at(angles)[1])
    largest = np.sqrt(sizes.sum(axis=0).max() * sizes.sum(axis=1).max())  # no singular value is larger
    return None if rates_at_most(closure, angles) else float(DOUBLE.singular / largest)


_EXACTLY = 10.0
"""Times what is zero in few joints is zero in the largest linkages at coordinates that are exact but for rounding."""
_SPARE = 2
"""Random rates beyond those that are expected to be independent."""


def _freed_rates(closure: ClosureEquations, angles: Floats, zero: float) -> Floats | None:
    """Return the rates that close of many joints by sparse factors; None where it is unclear how many there are."""
    count = rates_at_most(closure, angles)
    space = closure.space(closure.evaluated(angles)[1])
    chance = np.random.default_rng(closure.joints).normal(size=(count + _SPARE, closure.joints))
    try:
        freed = np.array([space.free(rates) for rates in chance]).T
    except NumericalError:
        return None
    independent = row_space(freed.T, DOUBLE.zero_rate)
    parted = np.abs(closure.at(angles)[1] @ independent).max(initial=0.0)
    return independent if independent.shape[1] == count and parted <= zero else None


def _within_one(space: RateSpace, spaces: Sequence[RateSpace], kept: Mapping[int, Sequence[int]], zero: float) -> bool:
    """Tell whether all rates of a space are those of one of the spaces kept, which are listed by their size."""
    same = max(DOUBLE.clear, _LOST * zero)
    one = space.basis.sum(axis=1)  # most spaces differ here already
    for numbers in kept.values():
        bases = np.concatenate([spaces[number].basis for number in numbers], axis=1)
        inside = ((one @ bases).reshape(len(numbers), -1) ** 2).sum(axis=1)
        near = np.flatnonzero(inside > (1.0 - same) * (one @ one))
        if any(_within(space, spaces[numbers[place]], zero) for place in near.tolist()):
            return True
    return False


def _within(space: RateSpace, other: RateSpace, zero: float) -> bool:
    """Tell whether all rates of one space are those of another."""
    outside = space.basis - other.basis @ (other.basis.T @ space.basis)
    if np.abs(outside).max(initial=0.0) > max(DOUBLE.clear, _LOST * zero):
        return False
    theirs = [quadric for quadric in other.left if not any(quadric is mine for mine in space.left)]
    return bool(np.abs(local_forms(space.basis, theirs)).max(initial=0.0) <= zero)


@dataclass(frozen=True, slots=True)
class _Case:
    """A space, and the equations that need not hold on it: what they are as forms on it."""

    basis: Floats
    left: tuple[Quadric, ...]
    forms: Floats
    zero: float

    def only(self, places: Ints) -> _Case:
        """Return the same space with some of the equations."""
        return replace(self, left=tuple(self.left[place] for place in places), forms=self.forms[places])

    def across(self, normals: Floats) -> _Case:
        """Return the part of the space across one normal, float[s], or several, float[s, n]."""
        parts = split(normals.reshape(len(normals), -1).T, self.zero)
        part = parts.right[parts.rank :].T
        return replace(self, basis=self.basis @ part, forms=part.T @ self.forms @ part)


def _split(case: _Case, allowance: Allowance) -> Iterator[RateSpace]:
    """Yield the spaces of solutions within a space, depth first, until an allowance of work is used up."""
    if not allowance.take(_CASE + (len(case.left) + 1) * case.basis.shape[1] ** 3):
        return
    case, factors = _simplified(case)
    if not case.basis.shape[1]:
        return
    if factors is not None:
        by_joints = [signed(case.basis @ normal) for normal in factors]
        for place in canonical_order([one / np.linalg.norm(one) for one in by_joints]):
            yield from _split(case.across(factors[place]), allowance)
    elif len(case.left) < 2 or definite_weights(case.forms, max(case.zero, DOUBLE.clear)) is None:
        yield RateSpace(canonical_basis(case.basis), case.left)


def _simplified(case: _Case) -> tuple[_Case, tuple[Floats, Floats] | None]:
    """Use up the equations that are linear on a space; return what is left, and one that is a product.

    A product is among those left too: it vanishes on either part. An equation whose form has one sign holds only
    where all linear ones do that it is a sum of squares of.
    """
    while case.basis.shape[1]:
        case = case.only(np.flatnonzero(np.abs(case.forms).max(axis=(1, 2), initial=0.0) > case.zero))
        if not case.left:
            return case, None
        local = inertia(case.forms, case.zero)
        definite = np.flatnonzero((local.positive == 0) | (local.negative == 0))
        if not len(definite):
            products = np.flatnonzero((local.positive == 1) & (local.negative == 1))
            return case, _factors(local.values[products[0]], local.vectors[products[0]]) if len(products) else None
        normals = [local.vectors[one][:, local.signs[one] != 0] for one in definite]
        case = case.across(np.concatenate(normals, axis=1))
    return case.only(np.zeros(0, dtype=np.int64)), None


def _factors(values: Floats, vectors: Floats) -> tuple[Floats, Floats]:
    """Return the normals of the two linear equations whose product a form is, by its eigenvectors."""
    plus, minus = np.sqrt(values[-1]) * vectors[:, -1], np.sqrt(-values[0]) * vectors[:, 0]
    return plus + minus, plus - minus


Proof = Literal["no rates", "definite stress", "cases"]


@dataclass(frozen=True, slots=True)
class Rigidity:
    """Whether a linkage is proved to be rigid at its configuration, and how.

    Attributes
    ----------
    proof : {"no rates", "definite stress", "cases"} or None
        None without a proof: it may move or not.
    flexes : int
        Independent rates that close to first order.
    margin : float or None
        Evidence of the proof: the smallest singular value of the closure equations (no rates) or eigenvalue of
        the form (definite stress), as part of the largest; None for a proof by cases, each of which stands on
        values above 1e-9 of the largest.
    stress : float[n]
        Multiples of the equations whose sum is positive on all flexes; None for other proofs.
    equations : tuple of Quadric
        Those that second order adds.
    """

    proof: Proof | None
    flexes: int
    margin: float | None
    stress: Floats | None
    equations: tuple[Quadric, ...]

    @property
    def certainty(self) -> Literal["proved", "not known"]:
        """Whether it is proved that nothing moves."""
        return "proved" if self.proof else "not known"


def rigidity_of(
    linkage: Linkage, closure: ClosureEquations | None = None, zero: float = DOUBLE.zero, *, refuted: bool = False
) -> Rigidity:
    """Look for a proof that a linkage cannot move from its configuration.

    Parameters
    ----------
    linkage : Linkage
        With closed loops.
    closure : ClosureEquations, optional
        Of this linkage, if already computed.
    zero : float, optional
        Singular values and eigenvalues below this part of the largest are zero.
    refuted : bool, optional
        Whether all cases are known to leave no rates.

    Examples
    --------
    A flat vertex with a sector of more than half a turn has two flexes, and does not fold:

    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.analysis.motion.linkage import linkage_of_sheet
    >>> corners = ((0, 0), (1, 0), (.8, .6), (.4, .9), (-.1, 1))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> rigidity = rigidity_of(linkage_of_sheet(Sheet(5, (), "", faces, corners)))
    >>> rigidity.flexes, rigidity.proof, rigidity.margin > .01
    (2, 'definite stress', True)
    """
    closure = closure or ClosureEquations(linkage)
    tangent = rates_at(closure, linkage.angles, zero)
    flexes = tangent.shape[1]
    if not flexes:
        if closure.joints > MANY:
            margin = _least_part(closure, linkage.angles)
            return Rigidity("no rates" if margin else None, 0, margin, None, ())
        values = spectrum(closure.at(linkage.angles)[1].toarray(), DOUBLE.derivative)
        proved = values.rank == closure.joints
        return Rigidity("no rates" if proved else None, 0, values.smallest if closure.joints else None, None, ())
    quadrics = tuple(all_quadrics(linkage, tangent, zero))
    definite = definite_weights(local_forms(tangent, quadrics), max(zero, DOUBLE.clear))
    if definite is not None:
        stress = definite[0] / [np.abs(quadric.form).max() for quadric in quadrics]
        return Rigidity("definite stress", flexes, definite[1], stress, quadrics)
    proof: Proof | None = "cases" if refuted or not next(spaces_within(tangent, quadrics, zero), None) else None
    return Rigidity(proof, flexes, None, None, quadrics)
