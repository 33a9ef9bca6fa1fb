"""Motion branches of a linkage from a configuration.

At a regular configuration there is one. At a singular one, such as a flat sheet, the rates that agree to second
order fall into spaces (`synth.motion.singular.second_order`), and equations left on one may part it into halves.
Each branch is followed to a fold of ten degrees; its degrees of freedom are those there. Branches are listed up to
the sign of all rates together; farther off, two of them may be one curve. Theory: docs/theory/folding.md.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from math import degrees, inf, pi
from typing import Any, Literal

import networkx as nx
import numpy as np

from graphs.geometry import lines_meet, sectors, unit
from graphs.loops.loop import Centre
from graphs.rank.singular_values import inertia, rank_of, spectrum
from graphs.tolerances import DOUBLE, MARGIN, canonical_basis, canonical_order, signed
from graphs.types import Floats, Ints, JointId
from synth.motion.closure import ClosureEquations
from synth.motion.linkage import PosedLinkage, PosedLoop
from synth.motion.singular import second_order
from synth.motion.singular.joint_order import in_order, joint_order
from synth.motion.singular.nearest import spaces_near
from synth.motion.singular.sampling import (
    TracedBranch,
    followed,
    general_rates,
    in_half_tangents,
    most_freedoms,
    rates_towards,
    same_part,
)
from synth.motion.walk.step import Allowance


class FlatVertices:
    """The loops of a linkage that are flat vertices of four creases, each with two modes.

    In either mode one pair of opposite creases folds the same way and the other does not. `linear` says that in
    all loops opposite sectors make 180 degrees, and all creases are flat: tan(fold / 2) are in proportion in each
    mode.
    """

    def __init__(self, linkage: PosedLinkage) -> None:
        self._loops = linkage.loops
        self._ways: list[Floats | None] = []
        flat = [np.abs(linkage.angles).max(initial=0.0) <= DOUBLE.parallel]
        for loop in linkage.loops:
            outward, folds = _outward(linkage, loop), None
            if outward is not None:  # 1 for creases that fold one way at a positive angle, -1 for others
                folds = np.sign((outward * linkage.directions[list(loop.joints)]).sum(axis=1)) * loop.signs
            # opposite sectors make 180 degrees
            flat.append(outward is not None and abs(sectors(outward)[::2].sum() - pi) <= DOUBLE.parallel)
            self._ways.append(folds)
        self.linear = bool(all(flat))

    def modes(self, rates: Floats) -> tuple[tuple[int, int] | None, ...]:
        """Return the opposite creases (places) that fold alike at each vertex, by general rates; else None."""
        return tuple(_mode(loop, ways, rates) for loop, ways in zip(self._loops, self._ways, strict=True))


def _mode(loop: PosedLoop, ways: Floats | None, rates: Floats) -> tuple[int, int] | None:
    if ways is None:
        return None
    folds = rates[list(loop.joints)] * ways
    alike = folds[:2] * folds[2:]
    same = int(alike[1] > alike[0] + MARGIN * abs(float(alike[0])))
    first, second = sorted(loop.joints[same::2])
    return (first, second) if alike[same] > DOUBLE.zero_rate**2 else None


def _outward(linkage: PosedLinkage, loop: PosedLoop) -> Floats | None:
    """Return the directions of four creases away from a flat vertex: float[4, 3]; None of other loops."""
    joints = list(loop.joints)
    if loop.centre is not Centre.FINITE or len(joints) != 4:
        return None
    points = linkage.points[joints]
    away = points - lines_meet(points, linkage.directions[joints]).point
    if np.linalg.norm(away, axis=1).min() <= DOUBLE.same_point:  # no crease, but an axis through that point
        return None
    outward = unit(away)
    return outward if abs(sectors(outward).sum() - 2 * pi) <= DOUBLE.parallel else None


def straight_folds(linkage: PosedLinkage) -> tuple[Ints, ...]:
    """Return for each family of parallel lines along which a flat sheet folds straight the line of each joint, int[J].

    It is -1 for joints that are on none. A line is of creases that go on straight at every vertex, and beyond holes;
    all its creases fold alike. Parallel lines meet at no vertex, so their angles are free. Whether loops round holes
    close then is left to the caller.
    """
    size = len(linkage.angles)
    next_to, ends = nx.Graph(), np.zeros(size, dtype=bool)
    next_to.add_nodes_from(range(size))
    by_size: dict[int, list[tuple[int, ...]]] = {}
    for loop in linkage.loops:
        by_size.setdefault(len(loop.joints), []).append(loop.joints)
    for joints in map(np.array, by_size.values()):
        along, at = linkage.directions[joints][:, :, None], linkage.points[joints]
        turned = np.abs(np.cross(along, along.transpose(0, 2, 1, 3))).max(axis=3)
        beside = np.abs(np.cross(along, at[:, :, None] - at[:, None])).max(axis=3)
        same = (turned <= DOUBLE.parallel) & (beside <= DOUBLE.same_point)
        ends[joints[same.sum(axis=2) == 1]] = True  # of itself alone: the line does not go on
        loops, one, other = np.nonzero(np.triu(same, 1))
        next_to.add_edges_from(zip(joints[loops, one].tolist(), joints[loops, other].tolist(), strict=True))
    whole = [sorted(line) for line in nx.connected_components(next_to) if not ends[list(line)].any()]
    families: list[tuple[Floats, list[list[int]]]] = []
    for line in sorted(whole):
        along = linkage.directions[line[0]]
        near = (lines for first, lines in families if np.abs(np.cross(first, along)).max() <= DOUBLE.parallel)
        family = next(near, None)
        if family is None:
            families.append((along, family := []))
        family.append(line)
    numbers = []
    for _, family in families:
        number = np.full(size, -1)
        for place, line in enumerate(family):
            number[line] = place
        numbers.append(number)
    return tuple(numbers)


Certainty = Literal["proved", "numerical", "not known"]
Method = Literal["regular pose", "all modes", "second order", "random starts"]

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

_DEAD_ENDS = 20
"""After so many choices that leave nothing the space near to wanted rates is given up."""
_START = 2e5
"""Work of a start of Newton's method, in products of numbers."""
_STEPS, _AT_LEAST = 400, 20
"""All branches together may be followed so many steps, and each so many: ten degrees take nearly all 5 to 15."""
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
    return Search(MOST_BRANCHES, MOST_WORK, follow=max(4, _FOLLOWED // max(joints, 1)), towards=towards)


@dataclass(frozen=True, slots=True)
class Branch:
    """One motion branch from a configuration.

    Attributes
    ----------
    freedoms : int or None
        At a general configuration of the branch, to second order. None where no motion was found, or second order
        does not decide.
    certainty : {"proved", "numerical", "not known"}
        Proved: the configuration is regular, the branch is linear in tan(fold / 2), or all that second order adds
        is one equation that is not degenerate. Numerical: followed with closed loops. Not known: no motion was
        found.
    space : RateSpace
        The rates at which it can begin.
    rates : float[J]
        Initial rates of one motion along the branch; the largest is 1 or -1.
    immobile : tuple of int
        Places of the joints that are immobile on it.
    modes : tuple of (int, int) or None
        For each loop that is a moving flat vertex of four creases the places of the opposite ones that fold alike.
    sample : float[J]
        Joint angles of a configuration on it, radians.
    error : float
        Loop-closure residual there.
    followed : float
        How far the joint that moves most has moved there, radians.
    begun : bool
        Whether it was followed, or proved; False if the search had nothing left for it.

    Examples
    --------
    >>> import synth
    >>> synth.move(synth.generate("miura", rows=2, columns=2).mechanism).branches.branches
    (<Branch: +---, freedoms 1, proved>, <Branch: +00+, freedoms 1, proved>)
    """

    freedoms: int | None
    certainty: Certainty
    space: second_order.RateSpace
    rates: Floats
    immobile: tuple[int, ...]
    modes: tuple[tuple[int, int] | None, ...]
    sample: Floats
    error: float
    followed: float
    begun: bool = True

    @property
    def signs(self) -> str:
        """How each joint begins: ``+`` valley, ``-`` mountain, ``0`` not at all."""
        return signs_of(self.rates)

    def has_signs(self, signs: str) -> bool:
        """Tell whether it has these signs, or all of them turned."""
        return self.signs in (signs, signs.translate(str.maketrans("+-", "-+")))

    def __repr__(self) -> str:
        return f"<Branch: {self.signs}, freedoms {self.freedoms}, {self.certainty}>"

    def to_json(self, joints: Sequence[JointId]) -> dict[str, Any]:
        """Return plain data, joints by their ids: those of the linkage, in order."""
        return {
            "signs": self.signs,
            "freedoms": self.freedoms,
            "certainty": self.certainty,
            "immobile": len(self.immobile),
            "modes": [None if pair is None else [joints[place] for place in pair] for pair in self.modes],
            "followed_deg": degrees(self.followed),
            "closure": self.error,
        }


@dataclass(frozen=True, slots=True)
class Branches:
    """All branches that were found from a configuration.

    Attributes
    ----------
    branches : tuple of Branch
        Those on which most joints move first; of these, those with most rates; then by their signs in the order of
        the joints.
    exhaustive : bool
        Whether there are no others: every choice of modes was tried, and rates that agree to second order are all
        there are; the configuration is regular, and the one branch has as many freedoms as there are rates; all
        that second order adds is one equation that is not degenerate; or nothing moves, and that is proved.
    regular : bool
        Whether the configuration is regular, with one branch.
    complete : bool
        Whether the search came to its end.
    method : {"regular pose", "all modes", "second order", "random starts"}
        How they were found: by every combination of modes of vertices that are linear in tan(fold / 2); by all
        rates that agree to second order, each continued; random starts where several equations are left on these
        that are no products.
    rigidity : Rigidity or None
        Without branches: whether it is proved that nothing moves.
    order : tuple of int
        Places of the joints in an order that does not depend on the file.
    """

    branches: tuple[Branch, ...]
    exhaustive: bool
    regular: bool
    complete: bool
    method: Method
    rigidity: second_order.Rigidity | None = None
    order: tuple[int, ...] = ()

    @property
    def no_motion(self) -> Certainty | None:
        """Whether it is proved that nothing moves, or not known; None where something does."""
        if any(branch.certainty != "not known" for branch in self.branches):
            return None
        return "not known" if self.rigidity is None else self.rigidity.certainty

    def number_of(self, signs: str) -> int | None:
        """Return the number of the first branch with these signs, or all of them turned; None without one."""
        return next((number for number, branch in enumerate(self.branches) if branch.has_signs(signs)), None)


def branches_of(
    linkage: PosedLinkage, closure: ClosureEquations | None = None, search: Search | None = None
) -> Branches:
    """Return the motion branches of a linkage from its configuration.

    Parameters
    ----------
    linkage : PosedLinkage
        With closed loops.
    closure : ClosureEquations, optional
        Of this linkage, if already computed.
    search : Search, optional
        Where it ends.

    Examples
    --------
    >>> from synth.moving.made import configuration_of
    >>> from synth.patterns import generate
    >>> branches = branches_of(configuration_of(generate("miura", rows=2, columns=2).mechanism).linkage)
    >>> len(branches.branches), branches.exhaustive
    (2, True)
    """
    branch_search = _BranchSearch(linkage, closure, search or Search())
    spaces, order = branch_search.spaces(), branch_search.order
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
    agrees = regular and branches[0].freedoms == spaces[0].basis.shape[1]
    exhaustive = agrees or cone or (branch_search.vertices.linear and not any(space.left for space in spaces))
    method: Method = "regular pose" if regular else branch_search.method(spaces)
    return Branches(
        branches, exhaustive and branch_search.complete, regular, branch_search.complete, method, order=order
    )


def all_branches_of_many(linkage: PosedLinkage, closure: ClosureEquations, towards: Floats | None) -> Branches | None:
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


def first_branch(
    linkage: PosedLinkage, admitted: Callable[[Floats], bool], search: Search | None = None
) -> Branch | None:
    """Return the first motion branch of a linkage that begins at admitted rates; None where there is none.

    Only such branches are followed, until one moves: a flat sheet may have a hundred others.

    Parameters
    ----------
    linkage : PosedLinkage
        With closed loops.
    admitted : callable
        Takes rates, float[J], the largest 1 or -1, zero where a joint does not begin to move; returns whether they
        are admitted.
    search : Search, optional
        Where it ends.

    Examples
    --------
    A vertex of four creases, of which the first is to fold as a valley and the second as a mountain:

    >>> from synth.moving.made import configuration_of
    >>> from synth.patterns import generate
    >>> linkage = configuration_of(generate("miura", rows=2, columns=2).mechanism).linkage
    >>> first_branch(linkage, lambda rates: rates[0] * rates[1] < 0.0).signs
    '+---'
    """
    branch_search = _BranchSearch(linkage, None, search or Search())
    for space, part_rates in branch_search.parts(branch_search.spaces()):
        rates = branch_search.ahead(part_rates)
        if admitted(branch_search.as_filed(rates)):
            branch = branch_search.branch(space, rates, proved=False, late=False)
            if branch.certainty != "not known":
                return branch_search.branch_as_filed(branch)
    return None


class _BranchSearch:
    """A search for branches, in an order of the joints that does not depend on the file until its end."""

    def __init__(self, linkage: PosedLinkage, closure: ClosureEquations | None, search: Search) -> None:
        self._order = joint_order(linkage, search.towards)
        self._place = np.argsort(self._order)
        self.linkage = in_order(linkage, self._order)
        self.closure = ClosureEquations(self.linkage)
        towards = None if search.towards is None else search.towards[self._order]
        self.search = replace(search, towards=towards)
        self.complete = self.all_spaces = True
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

    def spaces(self) -> list[second_order.RateSpace]:
        """Return the spaces of rates that agree to second order, as far as the search goes."""
        spaces: list[second_order.RateSpace] = []
        for space in second_order.spaces_within(self._tangent, self._quadrics, self.search.zero, self._work):
            if len(spaces) == self.search.most:
                self.complete = False
                break
            spaces.append(space)
        self.complete = self.all_spaces = self.complete and not self._work.used_up
        if not self.complete:
            spaces = [*self._towards(), *spaces]
        return second_order.largest_only(spaces, self.search.zero)

    def _towards(self) -> list[second_order.RateSpace]:
        """Return the space near to the rates that are wanted, if any are."""
        wanted = self.search.towards
        if wanted is None:
            return []
        rates = second_order.rates_near(self.closure, self.linkage.angles, self._quadrics, wanted)
        near = wanted if rates is None else rates
        spaces = spaces_near(self._tangent, self._quadrics, near, self.search.zero)
        return [space for space in islice(spaces, _DEAD_ENDS) if space is not None][:1]

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
        """Return how branches are found at a singular pose."""
        if any(len(space.left) > 1 for space in spaces):
            return "random starts"
        return "all modes" if self.vertices.linear else "second order"

    def full_row_rank(self) -> bool:
        """Tell whether the closure equations are independent at the pose."""
        if self.closure.joints > second_order.MANY:
            return bool(self._stresses == 0)
        _, jacobian = self.closure.at(self.linkage.angles)
        return spectrum(jacobian.toarray(), DOUBLE.derivative).rank == self.closure.rows

    def parts(self, spaces: list[second_order.RateSpace]) -> list[tuple[second_order.RateSpace, Floats]]:
        """Return general rates of each part of all spaces, with the space, in the order of branches."""
        parts: list[tuple[second_order.RateSpace, Floats]] = []
        search, work = self.search, self._work
        for space in spaces:
            here, whole = general_rates(space, search.most, search.towards, lambda: not work.take(_START))
            self.complete = self.complete and whole
            parts += [(space, rates) for rates in here]
        return [parts[place] for place in canonical_order([_rank_of(*part) for part in parts])]

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
        for number, (space, rates) in enumerate(parts):
            late = number != nearest and (self._work.used_up if follow is None else begun >= follow)
            begun += not late
            self.complete = self.complete and not late
            yield self.branch(space, self.ahead(rates), proved=proved, late=late)

    def ahead(self, rates: Floats) -> Floats:
        """Return rates or their negatives: those whose first is positive, in the order of the file."""
        return np.asarray(signed(self.as_filed(rates))[self._order])

    def _nearest(self, parts: Sequence[tuple[second_order.RateSpace, Floats]]) -> int:
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

    def branch(self, space: second_order.RateSpace, rates: Floats, *, proved: bool, late: bool) -> Branch:
        """Return a branch that begins at some rates, followed unless it is late."""
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
        if freedoms is not None and self.all_spaces and freedoms > most_freedoms(space, rates):
            freedoms = None  # where it was traced to it meets a branch with more; no larger space has its rates
        if linear or proved:
            freedoms, certainty = space.basis.shape[1] - len(space.left), "proved"
        modes, begun = self.vertices.modes(rates), not late or linear
        return Branch(freedoms, certainty, space, rates, immobile, modes, end.sample, end.error, end.far, begun)


def signs_of(rates: Floats) -> str:
    """Return how each joint begins: ``+`` valley, ``-`` mountain, ``0`` not at all."""
    return "".join("0" if abs(rate) <= DOUBLE.zero_rate else "+-"[int(rate < 0)] for rate in rates)


def _rank_of(space: second_order.RateSpace, rates: Floats) -> Floats:
    """Return what branches are listed by: most joints that move, most rates, signs in order of joints, rates."""
    signs = [" +-0".index(sign) for sign in signs_of(rates)]
    return np.array([signs.count(3), -space.basis.shape[1], *signs, *rates], dtype=float)
