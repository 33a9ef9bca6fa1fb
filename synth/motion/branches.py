"""Branches: the ways in which a linkage can move from a pose.

At a regular pose there is one. At a singular one, such as a flat sheet, the rates that agree to second order fall
into spaces (`synth.motion.second_order`), and what equations are left on one may part it into two halves that
only the pose joins. Each is followed to a fold of ten degrees; the freedoms there are those of the branch. Up to
the sign of all rates together; farther off, two branches may be one curve. Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from math import degrees, inf
from typing import Any, Literal

import numpy as np

from graphs.rank.singular_values import inertia, rank_of, spectrum
from graphs.tolerances import DOUBLE, canonical_basis, canonical_order, signed
from graphs.types import Floats, Ints, JointId
from synth.motion.closure import ClosureEquations
from synth.motion.linkage import PosedLinkage, PosedLoop
from synth.motion.second_order import RateSpace, largest_only, rates_at, rates_near, spaces_within
from synth.motion.singular.flat_vertices import FlatVertices
from synth.motion.singular.joint_order import in_order, joint_order
from synth.motion.singular.nearest import spaces_near
from synth.motion.singular.quadrics import Quadric, all_quadrics, local_forms
from synth.motion.singular.rigidity import Rigidity, rigidity_of
from synth.motion.singular.sampling import (
    Followed,
    followed,
    general_rates,
    in_half_tangents,
    rates_towards,
    same_part,
)
from synth.motion.walk.allowance import Allowance

__all__ = [
    "MOST_BRANCHES",
    "MOST_JOINTS",
    "Branch",
    "Branches",
    "Certainty",
    "Search",
    "branches_of",
    "first_branch",
    "search_for",
    "signs_of",
]

Certainty = Literal["proved", "numerical", "not known"]
Method = Literal["regular pose", "all modes", "second order", "random starts"]

MOST_JOINTS = 600
"""Of larger linkages the branches are not looked for: matrices are dense."""

MOST_BRANCHES, MOST_WORK = 128, 1e10
"""So many are looked for at most, with so many products of numbers (a minute): there may be twice as many for each
row of panels more."""

_FOLLOWED = 2500
"""Joints of all branches that are followed, together: a few seconds. A number, so that answers do not depend on
how fast a machine is."""

_DEAD_ENDS = 20
"""After so many choices that leave nothing the space near to wanted rates is given up."""
_START = 2e5
"""Work of a start of Newton's method, in products of numbers."""
_STEPS, _AT_LEAST = 400, 20
"""All branches together may be followed so many steps, and each so many: ten degrees take nearly all 5 to 15."""
_MORE = 100
"""So much more is looked for on request."""


@dataclass(frozen=True, slots=True)
class Search:
    """How far branches are looked for.

    Attributes
    ----------
    most : int
        After so many spaces of rates the search ends.
    work : float
        After so much work, in products of numbers, it ends too, and what was found by then is reported.
    zero : float
        Singular values and eigenvalues below this part of the largest are zero: what coordinates can tell apart.
    follow : int, optional
        So many branches are followed; of others it is told that they may begin.
    towards : float[J], optional
        Signs of rates: if the search ends before it is through, the branch near to these is among the listed.
    steps : int, optional
        All branches together may be followed so many steps, and each twenty.
    """

    most: int = 4096
    work: float = inf
    zero: float = DOUBLE.zero
    follow: int | None = None
    towards: Floats | None = None
    steps: int = _STEPS


def search_for(joints: int, towards: Floats | None, *, more: bool = False) -> Search:
    """Return how far branches of so many joints are looked for: a few seconds, or a hundred times more."""
    if more:
        return Search(_MORE * MOST_BRANCHES, _MORE * MOST_WORK, towards=towards, steps=_MORE * _STEPS)
    return Search(MOST_BRANCHES, MOST_WORK, follow=max(4, _FOLLOWED // max(joints, 1)), towards=towards)


@dataclass(frozen=True, slots=True)
class Branch:
    """One way to move from a pose.

    Attributes
    ----------
    freedoms : int or None
        At a general pose of the branch, to second order. None where no motion was found, or second order does not
        tell.
    certainty : {"proved", "numerical", "not known"}
        Proved: the pose is regular, the branch is linear in tan(fold / 2), or all that second order adds is one
        equation that is not degenerate. Numerical: followed with closed loops. Not known: rates agree to second
        order, and no motion was found.
    space : RateSpace
        The rates at which it can begin.
    rates : float[J]
        Of one motion along the branch, at the pose; the largest is 1 or -1.
    still : tuple of int
        Places of the joints that do not move on it.
    modes : tuple of (int, int) or None
        Of each loop that is a flat vertex of four creases: the places of the opposite ones that fold the same way.
        None of other loops, and of vertices that are still.
    sample : float[J]
        Joint angles of a pose on it, radians.
    error : float
        By how much loops do not close there.
    followed : float
        How far the joint that moves most has moved there, radians.
    begun : bool
        Whether it was followed, or proved; False of those that the search had nothing left for.

    Examples
    --------
    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.folding.configuration import configuration_of_sheet
    >>> corners = ((0, 0), (1, 0), (.5, 1), (-1, 0), (.5, -1))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> branches = configuration_of_sheet(Sheet(5, (), "", faces, corners)).branches.branches
    >>> [(one.freedoms, one.certainty) for one in branches]
    [(1, 'proved'), (1, 'proved')]
    """

    freedoms: int | None
    certainty: Certainty
    space: RateSpace
    rates: Floats
    still: tuple[int, ...]
    modes: tuple[tuple[int, int] | None, ...]
    sample: Floats
    error: float
    followed: float
    begun: bool = True

    @property
    def signs(self) -> str:
        """How each joint begins: ``+`` valley, ``-`` mountain, ``0`` not at all."""
        return signs_of(self.rates)

    def to_json(self, joints: Sequence[JointId]) -> dict[str, Any]:
        """Return plain data, joints by their ids: those of the linkage, in order."""
        return {
            "signs": self.signs,
            "freedoms": self.freedoms,
            "certainty": self.certainty,
            "still": len(self.still),
            "modes": [None if pair is None else [joints[place] for place in pair] for pair in self.modes],
            "followed_deg": degrees(self.followed),
            "closure": self.error,
        }


@dataclass(frozen=True, slots=True)
class Branches:
    """All branches that were found at a pose.

    Attributes
    ----------
    branches : tuple of Branch
        Those on which most joints move first; of these, those with most rates; then by their signs in the order of
        the joints.
    exhaustive : bool
        Whether there are no others: every choice of modes was tried, and rates that agree to second order are
        all there are; the pose is regular, and the one branch has as many freedoms as there are rates; all that
        second order adds is one equation that is not degenerate; or nothing moves, and that is proved.
    regular : bool
        Whether the pose is a general one, with one branch.
    complete : bool
        Whether the search came to its end.
    method : {"regular pose", "all modes", "second order", "random starts"}
        How they were found. All modes: of vertices that are linear in tan(fold / 2), every combination. Second
        order: the rates that agree to it, all of them, each continued. Random starts: rates were looked for so
        where several equations are left that are no products.
    rigidity : Rigidity or None
        Where there are no branches: whether it is proved that nothing moves.
    order : tuple of int
        Places of the joints in an order that does not depend on the file.
    """

    branches: tuple[Branch, ...]
    exhaustive: bool
    regular: bool
    complete: bool
    method: Method
    rigidity: Rigidity | None = None
    order: tuple[int, ...] = ()

    @property
    def no_motion(self) -> Certainty | None:
        """Whether it is proved that nothing moves, or not known; None where something does."""
        if any(branch.certainty != "not known" for branch in self.branches):
            return None
        return "not known" if self.rigidity is None else self.rigidity.certainty


def branches_of(
    linkage: PosedLinkage, closure: ClosureEquations | None = None, search: Search | None = None
) -> Branches:
    """Return the ways in which a linkage can move from its pose.

    Parameters
    ----------
    linkage : PosedLinkage
        Closed at its pose.
    closure : ClosureEquations, optional
        Of this linkage, where they are at hand.
    search : Search, optional
        Where it ends.

    Examples
    --------
    Four creases that meet in a point, flat: two ways to fold.

    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.motion.linkage import linkage_of_sheet
    >>> corners = ((0, 0), (1, 0), (.5, .9), (-1, 0), (-.5, -.7))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> found = branches_of(linkage_of_sheet(Sheet(5, (), "", faces, corners)))
    >>> [(branch.freedoms, branch.certainty) for branch in found.branches], found.exhaustive
    ([(1, 'proved'), (1, 'proved')], True)
    """
    looking = _Looking(linkage, closure, search or Search())
    spaces = looking.spaces()
    if not spaces and looking.complete:
        rigidity = rigidity_of(linkage, closure, looking.search.zero)
        return Branches(
            (), rigidity.certainty == "proved", False, True, looking.method(spaces), rigidity, looking.order
        )
    regular = looking.is_regular(spaces)
    cone = looking.is_cone()
    branches = looking.branches(spaces, proved=cone or (regular and looking.full_row_rank()))
    agrees = regular and branches[0].freedoms == spaces[0].basis.shape[1]
    all_told = agrees or cone or (looking.vertices.linear and not any(space.left for space in spaces))
    method: Method = "regular pose" if regular else looking.method(spaces)
    return Branches(
        branches, all_told and looking.complete, regular, looking.complete, method, order=looking.order
    )


def first_branch(
    linkage: PosedLinkage, admitted: Callable[[Floats], bool], search: Search | None = None
) -> Branch | None:
    """Return the first branch in which a linkage can move from its pose that begins at rates that will do.

    Only such branches are followed, until one moves: a flat sheet may have a hundred others.

    Parameters
    ----------
    linkage : PosedLinkage
        Closed at its pose.
    admitted : callable
        Takes rates, float[J], the largest 1 or -1, zero where a joint does not begin to move; tells whether they
        will do.
    search : Search, optional
        Where it ends.

    Examples
    --------
    Four creases that meet in a point, flat; the first two are to fold alike:

    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.motion.linkage import linkage_of_sheet
    >>> corners = ((0, 0), (1, 0), (.5, .9), (-1, 0), (-.5, -.7))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> linkage = linkage_of_sheet(Sheet(5, (), "", faces, corners))
    >>> first_branch(linkage, lambda rates: rates[0] * rates[1] > 0.0).signs
    '++-+'
    >>> first_branch(linkage, lambda rates: abs(rates).min() > 1.0)
    """
    looking = _Looking(linkage, None, search or Search())
    parts = [(space, looking.ahead(rates)) for space, rates in looking.parts(looking.spaces())]
    parts = [(space, rates) for space, rates in parts if admitted(looking.as_filed(rates))]
    ways = (looking.branch(space, rates, proved=False, late=False) for space, rates in parts)
    return next((looking.branch_as_filed(way) for way in ways if way.certainty != "not known"), None)


class _Looking:
    """A search for branches: what it needs to know, and whether it came to its end.

    All arrays are in an order of the joints that does not depend on the file (`joint_order`), until branches are
    told.
    """

    def __init__(self, linkage: PosedLinkage, closure: ClosureEquations | None, search: Search) -> None:
        self._order = joint_order(linkage, search.towards)
        self._place = np.argsort(self._order)
        self.linkage = in_order(linkage, self._order)
        self.closure = ClosureEquations(self.linkage)
        towards = None if search.towards is None else search.towards[self._order]
        self.search = replace(search, towards=towards)
        self.complete = True
        self.vertices = FlatVertices(self.linkage)
        self._places_of_loops = _places_of(self.linkage.loops, linkage.loops, self._order)
        self._work = Allowance(search.work)
        self._allowance = Allowance(search.steps)
        tangent = rates_at(closure or ClosureEquations(linkage), linkage.angles, search.zero)
        self._tangent = canonical_basis(tangent[self._order])
        self._stresses = self.closure.rows - len(self.linkage.angles) + self._tangent.shape[1]
        self._quadrics: list[Quadric] = all_quadrics(self.linkage, self._tangent, search.zero)

    @property
    def order(self) -> tuple[int, ...]:
        """The places in the file of the joints."""
        return tuple(self._order.tolist())

    def as_filed(self, values: Floats) -> Floats:
        """Return values of the joints, float[J] or float[J, n], in the order of the file."""
        return np.asarray(values[self._place])

    def branch_as_filed(self, branch: Branch) -> Branch:
        """Return a branch by the joints and loops in the order of the file."""
        order = self._order
        modes = [branch.modes[place] for place in self._places_of_loops]
        pairs = [None if one is None else sorted(order[list(one)].tolist()) for one in modes]
        return replace(
            branch,
            space=branch.space.in_order(self._place),
            rates=self.as_filed(branch.rates),
            still=tuple(sorted(order[list(branch.still)].tolist())),
            modes=tuple(None if one is None else (one[0], one[1]) for one in pairs),
            sample=self.as_filed(branch.sample),
        )

    def spaces(self) -> list[RateSpace]:
        """Return the spaces of rates that agree to second order, as far as the search goes."""
        found: list[RateSpace] = []
        for space in spaces_within(self._tangent, self._quadrics, self.search.zero, self._work):
            if len(found) == self.search.most:
                self.complete = False
                break
            found.append(space)
        self.complete = self.complete and not self._work.used_up
        if not self.complete:
            found = [*self._towards(), *found]
        return largest_only(found, self.search.zero)

    def _late(self) -> bool:
        """Tell whether there is no work left for a start of Newton's method."""
        return not self._work.take(_START)

    def _towards(self) -> list[RateSpace]:
        """Return the space near to the rates that are wanted, if any are."""
        wanted = self.search.towards
        if wanted is None:
            return []
        rates = rates_near(self.closure, self.linkage.angles, self._quadrics, wanted)
        near = wanted if rates is None else rates
        spaces = spaces_near(self._tangent, self._quadrics, near, self.search.zero)
        return [space for space in islice(spaces, _DEAD_ENDS) if space is not None][:1]

    def is_regular(self, spaces: list[RateSpace]) -> bool:
        """Tell whether all rates that agree to first order agree to second."""
        return (
            self.complete
            and len(spaces) == 1
            and not spaces[0].left
            and spaces[0].basis.shape[1] == self._tangent.shape[1]
        )

    def is_cone(self) -> bool:
        """Tell whether one equation is all that second order adds, and its form is not degenerate.

        Then the configurations near the pose are as its solutions are, by Morse's lemma. Joints in no loop turn
        freely, whatever the equation says.
        """
        free = len(self.linkage.angles) - len({joint for loop in self.linkage.loops for joint in loop.joints})
        if self._stresses != 1 or len(self._quadrics) != 1:
            return False
        forms = local_forms(self._tangent, self._quadrics)
        rank = int((inertia(forms, max(self.search.zero, DOUBLE.clear)).signs != 0).sum())
        return bool(rank == self._tangent.shape[1] - free)

    def method(self, spaces: list[RateSpace]) -> Method:
        """Return how branches are found at a singular pose."""
        if any(len(space.left) > 1 for space in spaces):
            return "random starts"
        return "all modes" if self.vertices.linear else "second order"

    def full_row_rank(self) -> bool:
        """Tell whether the closure equations are independent at the pose."""
        _, jacobian = self.closure.at(self.linkage.angles)
        return spectrum(jacobian.toarray(), DOUBLE.derivative).rank == self.closure.rows

    def parts(self, spaces: list[RateSpace]) -> list[tuple[RateSpace, Floats]]:
        """Return general rates of each part of all spaces, with the space, in the order of branches."""
        found: list[tuple[RateSpace, Floats]] = []
        for space in spaces:
            here, whole = general_rates(space, self.search.most, self.search.towards, self._late)
            self.complete = self.complete and whole
            found += [(space, rates) for rates in here]
        return [found[place] for place in canonical_order([_rank_of(*part) for part in found])]

    def branches(self, spaces: list[RateSpace], *, proved: bool) -> tuple[Branch, ...]:
        """Return the branches of all spaces in the order of the file, those that were not followed last."""
        found = [self.branch_as_filed(one) for one in self._branches(spaces, proved=proved)]
        ranks = canonical_order([_rank_of(one.space, one.rates) for one in found])
        return tuple(sorted((found[place] for place in ranks), key=_listed_last))

    def _branches(self, spaces: list[RateSpace], *, proved: bool) -> Iterator[Branch]:
        """Yield the branches of all spaces; that near to wanted rates, or the first, is followed in any case."""
        parts = self.parts(spaces)
        nearest = self._nearest(parts)
        begun, follow = 0, self.search.follow
        for number, (space, rates) in enumerate(parts):
            late = number != nearest and (self._work.used_up or (follow is not None and begun >= follow))
            begun += not late
            self.complete = self.complete and not late
            yield self.branch(space, self.ahead(rates), proved=proved, late=late)

    def ahead(self, rates: Floats) -> Floats:
        """Return rates or their negatives: those whose first is positive, in the order of the file."""
        return np.asarray(signed(self.as_filed(rates))[self._order])

    def _nearest(self, parts: Sequence[tuple[RateSpace, Floats]]) -> int:
        """Return the number of the part on which most joints go as is wanted."""
        towards = self.search.towards
        if towards is None or len(parts) < 2:
            return 0
        agree = []
        for space, rates in parts:
            near = rates_towards(space, towards)
            there = near if near.any() and same_part(space, near, rates) else rates
            agree.append(abs(float(np.sign(np.where(np.abs(there) > DOUBLE.zero_rate, there, 0.0)) @ towards)))
        return int(np.argmax(agree))

    def _freedoms_beside(self, rates: Floats) -> int | None:
        """Return the freedoms of the branch that begins at some rates; None where second order does not tell.

        If the equations of all self-stresses have independent slopes there, the configurations beside the pose in
        that direction are a manifold, by the implicit function theorem: the closure equations are divided by the
        square of the time.
        """
        if len(self._quadrics) != self._stresses:
            return None
        slopes = np.zeros((self._stresses, self._tangent.shape[1]))
        for row, quadric in zip(slopes, self._quadrics, strict=True):
            joints = list(quadric.joints)
            row[:] = rates[joints] @ quadric.form @ self._tangent[joints] / np.abs(quadric.form).max()
        independent = rank_of(slopes, DOUBLE.clear) == self._stresses
        return int(slopes.shape[1] - self._stresses) if independent else None

    def branch(self, space: RateSpace, rates: Floats, *, proved: bool, late: bool) -> Branch:
        """Return a branch that begins at some rates, followed unless it is late."""
        still = tuple(np.flatnonzero(np.abs(space.basis).max(axis=1) <= DOUBLE.zero_rate).tolist())
        linear = self.vertices.linear and not space.left
        if linear:
            came = in_half_tangents(self.closure, space, rates)
        elif late:
            came = Followed(None, self.linkage.angles, self.closure.error(self.linkage.angles), 0.0)
        else:
            self._allowance.left = max(self._allowance.left, _AT_LEAST)
            came = followed(self.linkage, self.closure, rates, still, self._allowance)
        certainty: Certainty = "numerical" if came.far else "not known"
        freedoms = self._freedoms_beside(rates) or came.freedoms if came.far else None
        if linear or proved:
            freedoms, certainty = space.basis.shape[1] - len(space.left), "proved"
        modes = self.vertices.modes(rates)
        return Branch(
            freedoms, certainty, space, rates, still, modes, came.sample, came.error, came.far, not late or linear
        )


def _places_of(loops: Sequence[PosedLoop], filed: Sequence[PosedLoop], order: Ints) -> list[int]:
    """Return the place of each loop of a file among the same loops by joints in another order."""
    place = {frozenset(order[list(loop.joints)].tolist()): number for number, loop in enumerate(loops)}
    return [place[frozenset(loop.joints)] for loop in filed]


def signs_of(rates: Floats) -> str:
    """Return how each joint begins: ``+`` valley, ``-`` mountain, ``0`` not at all.

    >>> signs_of(np.array([1.0, -0.5, 1e-12]))
    '+-0'
    """
    return "".join("0" if abs(rate) <= DOUBLE.zero_rate else "+-"[int(rate < 0)] for rate in rates)


def _listed_last(branch: Branch) -> tuple[bool, bool]:
    """Return a key that lists branches without a motion late, and those that were not followed last."""
    return not branch.begun, branch.certainty == "not known"


def _rank_of(space: RateSpace, rates: Floats) -> Floats:
    """Return what branches are listed by: most joints that move, most rates, signs in order of joints, rates."""
    signs = [" +-0".index(sign) for sign in signs_of(rates)]
    return np.array([signs.count(3), -space.basis.shape[1], *signs, *rates], dtype=float)
