"""Motion branches of a linkage from a configuration.

At a regular configuration there is one. At a singular one, such as a flat sheet, the rates that agree to second order
fall into spaces (`synth.analysis.motion.singular.second_order`), and equations left on one may part it into halves.
Each branch is followed to a fold of ten degrees; its degrees of freedom are those there. Branches are listed up to
the sign of all rates together; farther off, two of them may be one curve. Theory: docs/theory/folding.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice
from math import inf

import numpy as np

from graphs.rank.singular_values import inertia, rank_of, spectrum
from graphs.tolerances import DOUBLE, canonical_basis, canonical_order, signed
from graphs.types import Floats, Ints
from synth.analysis.motion.closure import ClosureEquations
from synth.analysis.motion.flat_vertices import FlatVertices
from synth.analysis.motion.germ import Branch, Branches, Certainty, Method, Part, product_of, signs_of
from synth.analysis.motion.linkage import Linkage, LinkagePart, part_of, parts_of
from synth.analysis.motion.singular import second_order
from synth.analysis.motion.singular.complete import PointRates, has_points_only, line_of, point_rates, work_of
from synth.analysis.motion.singular.immobile import immobile_joints, without
from synth.analysis.motion.singular.joint_order import in_order, joint_order
from synth.analysis.motion.singular.mode_count import count_of_modes
from synth.analysis.motion.singular.monodromy import is_irreducible
from synth.analysis.motion.singular.motion_near_rates import spaces_near
from synth.analysis.motion.singular.sampling import (
    TracedBranch,
    finite_rates,
    followed,
    general_rates,
    in_half_tangents,
    most_freedoms,
    rates_towards,
    same_part,
)
from synth.analysis.motion.walk.step import Allowance

MOST_JOINTS, MOST_SPARSE = 600, 10_000
"""Of linkages with more joints than the first branches are looked for only if they have few rates, and are listed only
if all are found; with more than the second they are not looked for."""
_MOST_TERMS = 1e8
"""So large are equations between the rates of such a linkage, at most: their number times the cube of the rates."""
_MOST_FOLLOWED = 16
"""So many branches of such a linkage are followed."""

MOST_BRANCHES, MOST_WORK = 128, 1e10
"""So many are looked for at most, with so many products of numbers (a minute): there may be twice as many for each
row of panels more."""

_FOLLOWED = 2500
"""Joints of all branches that are followed, together: a few seconds. A number, so that answers do not depend on
how fast a machine is."""

_LEAST_FOLLOWED = 4
_DEAD_ENDS = 20
"""After so many choices that leave nothing the space near to wanted rates is given up."""
_START = 2e5
"""Work of a start of Newton's method, in products of numbers."""
_STEPS, _AT_LEAST = 400, 20
"""All branches together may be followed so many steps, and each so many: ten degrees take nearly all 5 to 15."""
_MOST_EXCHANGED = 64
"""Of so many points on planes, of all spaces together, it is asked whether they are exchanged: a second or two. Unless
all spaces are irreducible the number of branches is "at least" anyway."""
_SAME = 1e-4
"""Rates, as unit vectors, that differ by less are one point: one of multiplicity is known so far."""
_MORE = 100
"""Factor on the limits of a search with --more."""


@dataclass(frozen=True, slots=True)
class Search:
    """How far branches are looked for.

    Attributes
    ----------
    most : int
        The search ends after so many spaces of rates.
    work : float
        It ends after so much work too, in products of numbers, and reports what it has.
    zero : float
        Singular values and eigenvalues below this part of the largest are zero: the resolution of the coordinates.
    follow : int, optional
        So many branches are followed; others are only listed as possible beginnings.
    towards : float[J], optional
        Signs of rates: if the search ends early, the branch near to these is among the listed.
    steps : int, optional
        All branches together may be followed so many steps, and each twenty.
    all_or_none : bool, optional
        No branch is followed unless all spaces of rates are found, and no equations are left on any.
    """

    most: int = 4096
    work: float = inf
    zero: float = DOUBLE.zero
    follow: int | None = None
    towards: Floats | None = None
    steps: int = _STEPS
    all_or_none: bool = False


def search_for(joints: int, towards: Floats | None, *, more: bool = False) -> Search:
    """Return how far branches of so many joints are looked for: a few seconds, or a hundred times more."""
    if more:
        return Search(_MORE * MOST_BRANCHES, _MORE * MOST_WORK, towards=towards, steps=_MORE * _STEPS)
    return Search(MOST_BRANCHES, MOST_WORK, follow=max(_LEAST_FOLLOWED, _FOLLOWED // max(joints, 1)), towards=towards)


def branches_of(linkage: Linkage, closure: ClosureEquations | None = None, search: Search | None = None) -> Branches:
    """Return the motion branches of a linkage from its configuration.

    Parameters
    ----------
    linkage : Linkage
        With closed loops.
    closure : ClosureEquations, optional
        Of this linkage, if already computed.
    search : Search, optional
        Where it ends.

    Examples
    --------
    >>> from synth.analysis.moving._configuration_of import configuration_of
    >>> from synth.catalogue.patterns import generate
    >>> branches = branches_of(configuration_of(generate("miura", rows=2, columns=2).mechanism).linkage)
    >>> len(branches.branches), branches.exhaustive
    (2, True)
    """
    search = search or Search()
    parts = parts_of(linkage)
    if len(parts) > 1:
        return _branches_of_parts(parts, search)
    branch_search = _BranchSearch(linkage, closure, search)
    if branch_search.may_be_degenerate and (held := immobile_joints(linkage, search.zero)):
        return _branches_beside(linkage, held, search)
    return _branches_of_one(branch_search, linkage, closure)


def _branches_of_parts(parts: Sequence[LinkagePart], search: Search) -> Branches:
    """Return the branches of a linkage by those of its parts."""
    searches = (_search_of_part(search, part.joints, len(parts)) for part in parts)
    own = (branches_of(part.linkage, None, each) for part, each in zip(parts, searches, strict=True))
    return product_of([Part(*part, branches) for part, branches in zip(parts, own, strict=True)])


def _branches_beside(linkage: Linkage, held: Sequence[int], search: Search) -> Branches:
    """Return the branches of a linkage in which some joints are proved to be immobile: those of the others."""
    rest = without(linkage, set(held))
    numbers = set(range(len(linkage.loops))) - (set() if rest is None else set(rest.loops))
    rigid = part_of(linkage, held, sorted(numbers))
    proof = second_order.Rigidity("cases", 0, None, None, ())
    order = tuple(range(len(held)))
    rigid_part = Part(*rigid, Branches((), True, False, True, "second order", proof, order))
    if rest is None:
        return rigid_part.branches
    others = branches_of(rest.linkage, None, _search_of_part(search, rest.joints, 1))
    return product_of([rigid_part, Part(*rest, others)])


def _search_of_part(search: Search, joints: Ints, parts: int) -> Search:
    """Return the search for the branches of one of several parts: they share the work, and what is followed."""
    towards = None if search.towards is None else search.towards[joints]
    follow = None if search.follow is None else max(_LEAST_FOLLOWED, search.follow // parts)
    steps, work = max(_AT_LEAST, search.steps // parts), search.work / parts
    return replace(search, towards=towards, follow=follow, steps=steps, work=work)


def _branches_of_one(branch_search: _BranchSearch, linkage: Linkage, closure: ClosureEquations | None) -> Branches:
    """Return the motion branches of a linkage whose closure equations are of one part."""
    spaces, order = branch_search.spaces, branch_search.order
    if not spaces and branch_search.complete:
        refuted = branch_search.search.all_or_none  # of many joints in an order in which cases end early
        rigidity = second_order.rigidity_of(linkage, closure, branch_search.search.zero, refuted=refuted)
        proved = rigidity.certainty == "proved"
        return Branches((), proved, False, True, branch_search.method(spaces), rigidity, order)
    left = any(space.left for space in spaces)
    if branch_search.search.all_or_none and (left or not branch_search.complete):
        return Branches((), False, False, False, branch_search.method(spaces), order=order)
    regular = branch_search.is_regular(spaces)
    cone = branch_search.is_cone()
    branches = branch_search.branches(spaces, proved=cone or (regular and branch_search.full_row_rank()))
    if not branches:
        return Branches((), False, False, branch_search.complete, branch_search.method(spaces), order=order)
    agrees = regular and branches[0].freedoms == spaces[0].basis.shape[1]
    exhaustive = agrees or cone or (branch_search.vertices.linear and not any(space.left for space in spaces))
    exhaustive = exhaustive or branch_search.all_regular(branches)
    method: Method = "regular pose" if regular else branch_search.method(spaces)
    complete = branch_search.complete
    counted = complete and branch_search.all_rates and all(map(branch_search.is_whole, branches))
    answer = Branches(branches, exhaustive and complete, regular, complete, method, order=order, counted=counted)
    modes = count_of_modes(branch_search.linkage) if branch_search.vertices.linear and not complete else None
    if modes is None or modes.kinds.total() < answer.count:
        return answer
    return replace(answer, total=modes.kinds, counted=modes.all)


def all_branches_of_many(linkage: Linkage, closure: ClosureEquations, towards: Floats | None) -> Branches | None:
    """Return the motion branches of a large linkage if all are found; else None.

    That is where they or its rates are too many, equations are left on these, or neither a motion is found nor a proof
    that there is none.
    """
    if closure.joints > MOST_SPARSE:
        return None
    if len(linkage.loops) * second_order.rates_at_most(closure, linkage.angles) ** 3 > _MOST_TERMS:
        return None
    search = Search(_MOST_FOLLOWED, MOST_WORK / 10.0, follow=_MOST_FOLLOWED, towards=towards, all_or_none=True)
    branches = branches_of(linkage, closure, search)
    return branches if branches.complete and branches.no_motion != "not known" else None


def first_branch(linkage: Linkage, admitted: Callable[[Floats], bool], search: Search | None = None) -> Branch | None:
    """Return the first motion branch of a linkage that begins at admitted rates; None where there is none.

    Only such branches are followed, until one moves: a flat sheet may have a hundred others.

    Parameters
    ----------
    linkage : Linkage
        With closed loops.
    admitted : callable
        Takes rates, float[J], the largest 1 or -1, zero where a joint does not begin to move; returns whether they
        are admitted.
    search : Search, optional
        Where it ends.

    Examples
    --------
    A vertex of four creases, of which the first is to fold as a valley and the second as a mountain:

    >>> from synth.analysis.moving._configuration_of import configuration_of
    >>> from synth.catalogue.patterns import generate
    >>> linkage = configuration_of(generate("miura", rows=2, columns=2).mechanism).linkage
    >>> first_branch(linkage, lambda rates: rates[0] * rates[1] < 0.0).signs
    '+---'
    """
    branch_search = _BranchSearch(linkage, None, search or Search())
    for part in branch_search.parts(branch_search.spaces):
        ahead = replace(part, rates=branch_search.ahead(part.rates))
        if admitted(branch_search.as_filed(ahead.rates)):
            branch = branch_search.branch(ahead, proved=False, late=False)
            if branch.certainty != "not known":
                return branch_search.branch_as_filed(branch)
    return None


@dataclass(frozen=True, slots=True)
class _Beginning:
    """General rates of a part of the rates that agree to second order; whether they are certified to be regular."""

    space: second_order.RateSpace
    rates: Floats
    certified: bool = False
    component: int | None = None


class _BranchSearch:
    """A search for branches, in an order of the joints that does not depend on the file until its end."""

    def __init__(self, linkage: Linkage, closure: ClosureEquations | None, search: Search) -> None:
        self._order = joint_order(linkage, search.towards)
        self._place = np.argsort(self._order)
        self.linkage = in_order(linkage, self._order)
        self.closure = ClosureEquations(self.linkage)
        towards = None if search.towards is None else search.towards[self._order]
        self.search = replace(search, towards=towards)
        self.complete = self.all_spaces = self.all_rates = self._all_proved = True
        self._of_one_component: set[int] = set()
        self.vertices = FlatVertices(self.linkage)
        joints_of = [frozenset(self._order[list(loop.joints)].tolist()) for loop in self.linkage.loops]
        place_of_loop = {joints: place for place, joints in enumerate(joints_of)}
        self._places_of_loops = [place_of_loop[frozenset(loop.joints)] for loop in linkage.loops]
        self._work = Allowance(search.work)
        self._allowance = Allowance(search.steps)
        tangent = second_order.rates_at(closure or ClosureEquations(linkage), linkage.angles, search.zero)
        self._tangent = canonical_basis(tangent[self._order])
        self._stresses = self.closure.rows - len(self.linkage.angles) + self._tangent.shape[1]
        self._quadrics: list[second_order.Quadric] = second_order.all_quadrics(self.linkage, self._tangent, search.zero)

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
        pairs = [None if pair is None else sorted(order[list(pair)].tolist()) for pair in modes]
        return replace(
            branch,
            space=branch.space.in_order(self._place),
            rates=self.as_filed(branch.rates),
            immobile=tuple(sorted(order[list(branch.immobile)].tolist())),
            modes=tuple(None if pair is None else (pair[0], pair[1]) for pair in pairs),
            sample=self.as_filed(branch.sample),
        )

    @cached_property
    def spaces(self) -> list[second_order.RateSpace]:
        """Return the spaces of rates that agree to second order, as far as the search goes."""
        spaces: list[second_order.RateSpace] = []
        for space in second_order.spaces_within(self._tangent, self._quadrics, self.search.zero, self._work):
            if len(spaces) == self.search.most:
                self.complete = False
                break
            spaces.append(space)
        self.complete = self.all_spaces = self.complete and not self._work.used_up
        if not self.complete and (lines := self._all_points()):
            self.complete = self.all_spaces = True
            return lines
        if not self.complete:
            spaces = [*self._towards(), *spaces]
        return second_order.largest_only(spaces, self.search.zero)

    def _all_points(self) -> list[second_order.RateSpace]:
        """Return all rates that agree to second order where these are certified points, more than cases were listed."""
        whole = second_order.RateSpace(self._tangent, tuple(self._quadrics))
        if self.vertices.linear or self._stresses != len(self._quadrics) or not has_points_only(whole):
            return []
        points = point_rates(whole)
        return [line_of(rates) for rates in points.rates] if points and points.evidence == "proved" else []

    def _towards(self) -> list[second_order.RateSpace]:
        """Return the space near to the rates that are wanted, if any are."""
        wanted = self.search.towards
        if wanted is None:
            return []
        rates = second_order.rates_near(self.closure, self.linkage.angles, self._quadrics, wanted)
        near = wanted if rates is None else rates
        spaces = spaces_near(self._tangent, self._quadrics, near, self.search.zero)
        return [space for space in islice(spaces, _DEAD_ENDS) if space is not None][:1]

    @property
    def may_be_degenerate(self) -> bool:
        """Whether joints that a few loops make immobile may hide that all else is regular: their forms are squares."""
        spaces = self.spaces
        settled = not spaces or self.vertices.linear or self.is_regular(spaces) or self.is_cone()
        return not (settled or self.search.all_or_none)

    def is_regular(self, spaces: list[second_order.RateSpace]) -> bool:
        """Tell whether all rates that agree to first order agree to second."""
        alone = self.complete and len(spaces) == 1 and not spaces[0].left
        return alone and spaces[0].basis.shape[1] == self._tangent.shape[1]

    def is_cone(self) -> bool:
        """Tell whether all that second order adds is one nondegenerate equation (Morse's lemma)."""
        free = len(self.linkage.angles) - len({joint for loop in self.linkage.loops for joint in loop.joints})
        if self._stresses != 1 or len(self._quadrics) != 1:
            return False
        forms = second_order.local_forms(self._tangent, self._quadrics)
        rank = int((inertia(forms, max(self.search.zero, DOUBLE.clear), scale=1.0).signs != 0).sum())
        return bool(rank == self._tangent.shape[1] - free)

    def method(self, spaces: list[second_order.RateSpace]) -> Method:
        """Return how branches are found at a singular configuration."""
        if any(len(space.left) > 1 for space in spaces):
            return "all solutions" if self.all_rates and not self._of_one_component else "random starts"
        return "all modes" if self.vertices.linear else "second order"

    def full_row_rank(self) -> bool:
        """Tell whether the closure equations are independent at the configuration."""
        if self.closure.joints > second_order.MANY:
            return bool(self._stresses == 0)
        _, jacobian = self.closure.at(self.linkage.angles)
        return spectrum(jacobian.toarray(), DOUBLE.derivative).rank == self.closure.rows

    def parts(self, spaces: list[second_order.RateSpace]) -> list[_Beginning]:
        """Return general rates of each part of all spaces, with the space, in the order of branches."""
        parts: list[_Beginning] = []
        solved: list[PointRates] = []
        for number, space in enumerate(spaces):
            tried = has_points_only(space) and self._work.take(work_of(space))
            points = point_rates(space) if tried else None
            if points is None:
                parts += self._general(space, number)
            else:
                solved.append(points)
        self._all_proved = all(points.evidence == "proved" for points in solved)
        for points in solved:  # last: a point on a larger space is no part of its own
            before = tuple(parts)  # points of one space are distinct, however near
            near = DOUBLE.zero_rate if points.evidence == "proved" else _SAME  # a common point of two is singular
            for rates in points.rates:
                if not any(_is_on(rates, part.space, near) for part in before):
                    beginning = _Beginning(line_of(rates), rates / np.abs(rates).max(), points.evidence == "proved")
                    parts.append(beginning)
        return [parts[place] for place in canonical_order([_rank_of(part.space, part.rates) for part in parts])]

    def _general(self, space: second_order.RateSpace, number: int) -> list[_Beginning]:
        """Return general rates of each part of a space; of several equations, as far as random starts find them.

        If what these leave is irreducible all parts are ways to begin one branch.
        """
        several = len(space.left) > 1
        few = sum(2 ** len(other.left) for other in self.spaces if len(other.left) > 1) <= _MOST_EXCHANGED
        if several and few and self.all_spaces and is_irreducible(second_order.local_forms(space.basis, space.left)):
            self._of_one_component.add(number)
        self.all_rates = self.all_rates and (not several or number in self._of_one_component)
        search, work = self.search, self._work
        here, whole = general_rates(space, search.most, search.towards, lambda: not work.take(_START))
        self.complete = self.complete and whole
        line = space.basis.shape[1] == 1 and not space.left
        return [_Beginning(space, rates, line, number if several else None) for rates in here]

    def all_regular(self, branches: Sequence[Branch]) -> bool:
        """Tell whether branches are all there are: they begin at all rates that agree to second order, all regular.

        Motions begin at these rates, and beside regular ones there is one curve (`_freedoms_beside`).
        """
        lines = all(branch.space.basis.shape[1] == 1 and not branch.space.left for branch in branches)
        proved = all(branch.certainty == "proved" for branch in branches)
        return self.all_spaces and self.all_rates and self._all_proved and lines and proved

    def branches(self, spaces: list[second_order.RateSpace], *, proved: bool) -> tuple[Branch, ...]:
        """Return the branches of all spaces in the order of the file, those that were not followed last."""
        branches = [self.branch_as_filed(branch) for branch in self._branches(spaces, proved=proved)]
        ranks = canonical_order([_rank_of(branch.space, branch.rates) for branch in branches])
        ranked = [branches[place] for place in ranks]
        return tuple(sorted(ranked, key=lambda branch: (not branch.begun, branch.certainty == "not known")))

    def _branches(self, spaces: list[second_order.RateSpace], *, proved: bool) -> Iterator[Branch]:
        """Yield the branches of all spaces; that near to wanted rates, or the first, is followed in any case."""
        parts = self.parts(spaces)
        nearest = self._nearest(parts)
        begun, follow = 0, self.search.follow
        for number, part in enumerate(parts):
            late = number != nearest and (self._work.used_up if follow is None else begun >= follow)
            begun += not late
            branch = self.branch(replace(part, rates=self.ahead(part.rates)), proved=proved, late=late)
            self.complete = self.complete and branch.begun
            yield branch

    def ahead(self, rates: Floats) -> Floats:
        """Return rates or their negatives: those whose first is positive, in the order of the file."""
        return np.asarray(signed(self.as_filed(rates))[self._order])

    def _nearest(self, parts: Sequence[_Beginning]) -> int:
        """Return the number of the part on which most joints go as is wanted."""
        towards = self.search.towards
        if towards is None or len(parts) < 2:
            return 0
        agree = []
        for part in parts:
            near = rates_towards(part.space, towards)
            there = near if near.any() and same_part(part.space, near, part.rates) else part.rates
            agree.append(abs(float(np.sign(np.where(np.abs(there) > DOUBLE.zero_rate, there, 0.0)) @ towards)))
        return int(np.argmax(agree))

    def _freedoms_beside(self, rates: Floats) -> int | None:
        """Return the freedoms of the branch that begins at some rates; None where second order does not tell.

        If the equations of all self-stresses have independent slopes there, the configurations beside this one in
        that direction are a manifold: the implicit function theorem, on closure equations over the square of the
        time.
        """
        if len(self._quadrics) != self._stresses:
            return None
        slopes = np.zeros((self._stresses, self._tangent.shape[1]))
        for row, quadric in zip(slopes, self._quadrics, strict=True):
            joints = list(quadric.joints)
            row[:] = rates[joints] @ quadric.form @ self._tangent[joints] / np.abs(quadric.form).max()
        independent = rank_of(slopes, DOUBLE.clear, scale=1.0) == self._stresses
        return int(slopes.shape[1] - self._stresses) if independent else None

    def branch(self, part: _Beginning, *, proved: bool, late: bool) -> Branch:
        """Return a branch that begins at some rates, followed unless it is late."""
        space, rates = part.space, part.rates
        immobile = tuple(np.flatnonzero(np.abs(space.basis).max(axis=1) <= DOUBLE.zero_rate).tolist())
        linear = self.vertices.linear and not space.left
        beside = None if linear or proved else self._freedoms_beside(rates)
        if linear:
            end = in_half_tangents(self.closure, space, rates)
        elif late:
            end = TracedBranch(None, self.linkage.angles, self.closure.error(self.linkage.angles), 0.0)
        else:
            self._allowance.left = max(self._allowance.left, _AT_LEAST)
            counted = not (beside or proved)
            end = followed(self.linkage, self.closure, rates, immobile, self._allowance, counted=counted)
        certainty: Certainty = "numerical" if end.far else "not known"
        freedoms = beside or end.freedoms if end.far else None
        larger = False
        if freedoms is not None and freedoms > most_freedoms(space, rates):
            if self.all_spaces:
                freedoms = None  # where it was traced to it meets a branch with more; no larger space has its rates
            else:  # part of a larger branch, whose own space the search did not come to
                immobile = self._immobile_at(end.sample, immobile)
                larger = True
        if linear or proved:
            freedoms, certainty = space.basis.shape[1] - len(space.left), "proved"
        elif part.certified and beside == 1:
            freedoms, certainty = 1, "proved"
        modes, begun = self.vertices.modes(rates), not late or certainty == "proved"
        followed_to = (end.sample, end.error, end.far, begun, part.component, larger)
        return Branch(freedoms, certainty, space, rates, immobile, modes, *followed_to)

    def _immobile_at(self, sample: Floats, immobile: tuple[int, ...]) -> tuple[int, ...]:
        """Return those of the joints that do not begin to move, at a configuration on a branch, either."""
        _, rates = finite_rates(self.linkage, self.closure, sample)
        if rates is None:
            return immobile
        at_rest = np.abs(rates).max(axis=1, initial=0.0) <= DOUBLE.zero_rate
        return tuple(place for place in immobile if at_rest[place])

    def is_whole(self, branch: Branch) -> bool:
        """Tell whether a branch has all rates that second order leaves where it begins, and is alone there.

        One quadric of three squares or more is irreducible; of several that is shown by monodromy.
        """
        moves = branch.certainty != "not known"
        alone = len(branch.space.left) < 2 or branch.component in self._of_one_component
        return moves and alone and branch.freedoms == most_freedoms(branch.space, branch.rates)


def _is_on(rates: Floats, space: second_order.RateSpace, near: float) -> bool:
    """Tell whether rates, a unit vector, are among those of a space that its equations leave."""
    within = space.basis.T @ rates
    if np.linalg.norm(rates - space.basis @ within) > near:
        return False
    forms = second_order.local_forms(space.basis, space.left)
    return bool(np.abs(forms @ within @ within).max(initial=0.0) <= near)


def _rank_of(space: second_order.RateSpace, rates: Floats) -> Floats:
    """Return what branches are listed by: most joints that move, most rates, signs in order of joints, rates."""
    signs = [" +-0".index(sign) for sign in signs_of(rates)]
    return np.array([signs.count(3), -space.basis.shape[1], *signs, *rates], dtype=float)
