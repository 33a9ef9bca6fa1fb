"""Motion branches from a configuration: the irreducible components of the germ of configuration space.

The closure equations of a linkage fall into parts that share no joint; the germ is the product of those of its parts,
and so are its branches: one choice for each part, degrees of freedom in sum. So a sheet may have more branches than
can be listed; the number of each says which choice it is. Theory: docs/theory/branches.md.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import degrees, prod
from typing import Any, Literal

import numpy as np

from graphs.tolerances import DOUBLE
from graphs.types import Floats, Ints, JointId
from synth.analysis.motion.linkage import Linkage
from synth.analysis.motion.singular.second_order import Quadric, RateSpace, Rigidity

Certainty = Literal["proved", "numerical", "not known"]
Method = Literal["regular pose", "all modes", "all solutions", "second order", "random starts"]
_WEAKEST: tuple[Certainty, ...] = ("not known", "numerical", "proved")
_METHODS: tuple[Method, ...] = ("random starts", "second order", "all solutions", "all modes", "regular pose")

MOST_LISTED = 256
"""So many branches of separate parts together are listed, the first by their numbers: a table that can be read."""


def signs_of(rates: Floats) -> str:
    """Return how each joint begins: ``+`` valley, ``-`` mountain, ``0`` not at all."""
    return "".join("0" if abs(rate) <= DOUBLE.zero_rate else "+-"[int(rate < 0)] for rate in rates)


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
    component : int or None
        Of equations that leave one space of rates with more than points: the number of that space. Ways to begin
        with one number, such as with vertices popped up or down, are counted as one branch.
    part_of_larger : bool
        Whether it has more freedoms than its space allows: it is part of a larger branch, whose own space the search
        did not come to. All such with as many freedoms may be parts of the same, and are counted as one.

    Examples
    --------
    >>> import synth
    >>> synth.move(synth.generate("miura", rows=2, columns=2).mechanism).branches.branches
    (<Branch: +---, freedoms 1, proved>, <Branch: +00+, freedoms 1, proved>)
    """

    freedoms: int | None
    certainty: Certainty
    space: RateSpace
    rates: Floats
    immobile: tuple[int, ...]
    modes: tuple[tuple[int, int] | None, ...]
    sample: Floats
    error: float
    followed: float
    begun: bool = True
    component: int | None = None
    part_of_larger: bool = False

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
class Part:
    """Joints whose closure equations share none with others: places, those of their loops, and their branches."""

    joints: Ints
    loops: tuple[int, ...]
    linkage: Linkage
    branches: Branches

    @property
    def choices(self) -> tuple[Branch, ...]:
        """The branches among which a branch of the whole chooses: those that were followed."""
        return tuple(branch for branch in self.branches.branches if branch.begun)


@dataclass(frozen=True)
class Branches:
    """All branches that were found from a configuration.

    Attributes
    ----------
    branches : tuple of Branch
        Those on which most joints move first; of these, those with most rates; then by their signs in the order of
        the joints. Of several parts, the first `MOST_LISTED` by their numbers: the branch of the last part changes
        first.
    exhaustive : bool
        Whether it is proved that there are no others: every choice of modes was tried, and rates that agree to
        second order are all there are; the configuration is regular, and the one branch has as many freedoms as
        there are rates; all that second order adds is one equation that is not degenerate; or nothing moves.
    regular : bool
        Whether the configuration is regular, with one branch.
    complete : bool
        Whether the search came to its end.
    method : {"regular pose", "all modes", "all solutions", "second order", "random starts"}
        How they were found: by every combination of modes of vertices that are linear in tan(fold / 2); by all
        rates that agree to second order, each continued, which are all solutions of several equations that are no
        products, where these have points only; random starts where such equations leave more.
    rigidity : Rigidity or None
        Without branches: whether it is proved that nothing moves.
    order : tuple of int
        Places of the joints in an order that does not depend on the file.
    counted : bool
        Whether two methods agree that there are no others: the equations of second order leave no more, and a motion
        was followed along each.
    parts : tuple of Part
        Parts whose closure equations share no joint, if they are several.
    total : Counter or None
        How many branches have how many freedoms, counted without a list, where that ended before.

    Examples
    --------
    >>> import synth
    >>> branches = synth.move(synth.generate("miura", rows=2, columns=2).mechanism).branches
    >>> branches.count, branches.at_least, branches.proved
    (2, False, True)
    """

    branches: tuple[Branch, ...]
    exhaustive: bool
    regular: bool
    complete: bool
    method: Method
    rigidity: Rigidity | None = None
    order: tuple[int, ...] = ()
    counted: bool = False
    parts: tuple[Part, ...] = ()
    total: Counter[int | None] | None = None

    @property
    def no_motion(self) -> Certainty | None:
        """Whether it is proved that nothing moves, or not known; None where something does."""
        if self.parts:
            every = [part.branches.no_motion for part in self.parts]
            return None if None in every else _weakest([one for one in every if one is not None])
        if any(branch.certainty != "not known" for branch in self.branches):
            return None
        return "not known" if self.rigidity is None else self.rigidity.certainty

    @cached_property
    def numbers(self) -> tuple[int, ...]:
        """Of several parts: how many branches each has to choose from, 1 for one that does not move."""
        return tuple(max(len(part.choices), 1) for part in self.parts)

    @property
    def count(self) -> int:
        """How many branches are proved or were followed, of all parts together."""
        return self.kinds.total()

    @property
    def numbered(self) -> int:
        """How many branches have a number: those that are counted, and beginnings along which no motion is known."""
        return prod(self.numbers) if self.parts and self.branches else len(self.branches)

    @property
    def at_least(self) -> bool:
        """Whether there may be more than were counted: neither proved nor seen by two methods that there are not."""
        return not (self.exhaustive or self.counted)

    @property
    def proved(self) -> bool:
        """Whether the count is proved: there are no others, and each of these is a motion."""
        return self.exhaustive and all(certainty == "proved" for certainty in self._certainties)

    @property
    def _certainties(self) -> list[Certainty]:
        if self.parts:
            return [certainty for part in self.parts for certainty in part.branches._certainties]
        return [branch.certainty for branch in self.branches]

    @cached_property
    def kinds(self) -> Counter[int | None]:
        """How many branches have how many freedoms, exactly; None where these are unknown."""
        if self.total is not None:
            return self.total
        if not self.parts:
            known = [branch for branch in self.branches if branch.certainty != "not known"]
            whole = [branch for branch in known if not branch.part_of_larger]
            alone = Counter(branch.freedoms for branch in whole if branch.component is None)
            together = {branch.component: branch.freedoms for branch in whole if branch.component is not None}
            counted = alone + Counter(together.values())
            return counted + Counter({branch.freedoms for branch in known if branch.part_of_larger} - counted.keys())
        total: Counter[int | None] = Counter({0: 1})
        for part in self.parts:
            sums: Counter[int | None] = Counter()
            for freedoms, number in total.items():
                for more, times in (part.branches.kinds or _at_rest(part)).items():
                    both = None if freedoms is None or more is None else freedoms + more
                    sums[both] += number * times
            total = sums
        return total if self.branches and self.no_motion is None else Counter()

    def count_to_json(self) -> dict[str, Any]:
        """Return the count as plain data: how many, whether there may be more, whether that is proved."""
        return {"count": self.count, "at_least": self.at_least, "proved": self.proved}

    def branch(self, number: int) -> Branch:
        """Return a branch by its number, listed or not."""
        if number < len(self.branches) or not self.parts:
            return self.branches[number]
        return joined(self, number)

    def choice(self, number: int) -> tuple[int, ...]:
        """Return the number of the branch of each part in a branch of the whole."""
        places = []
        for size in reversed(self.numbers):
            number, place = divmod(number, size)
            places.append(place)
        return tuple(reversed(places))

    def number_of_choice(self, places: Sequence[int]) -> int:
        """Return the number of the branch that consists of a branch of each part, by their numbers."""
        number = 0
        for place, size in zip(places, self.numbers, strict=True):
            number = number * size + place
        return number

    def number_of(self, signs: str) -> int | None:
        """Return the number of the first branch with these signs, or all of them turned; None without one.

        Each part may have its own turned.
        """
        if not self.parts:
            return next((number for number, branch in enumerate(self.branches) if branch.has_signs(signs)), None)
        if len(signs) != sum(len(part.joints) for part in self.parts) or not self.branches:
            return None
        places = []
        for part in self.parts:
            own = "".join(signs[joint] for joint in part.joints.tolist())
            place = part.branches.number_of(own) if part.choices else (None if own.strip("0") else 0)
            if place is None or place >= max(len(part.choices), 1):
                return None
            places.append(place)
        return self.number_of_choice(places)


def _weakest(certainties: Sequence[Certainty]) -> Certainty:
    return min(certainties, key=_WEAKEST.index)


def _at_rest(part: Part) -> Counter[int | None]:
    """Return the one choice of a part without branches: rigid, or its freedoms are unknown."""
    return Counter({0 if part.branches.no_motion == "proved" else None: 1})


def joined(branches: Branches, number: int) -> Branch:
    """Return the branch of several parts that consists of one of each, by its number."""
    size = sum(len(part.joints) for part in branches.parts)
    rates, sample, immobile = np.zeros(size), np.zeros(size), list[int]()
    bases: list[Floats] = []
    left, chosen = list[Quadric](), list[Branch]()
    modes: list[tuple[int, int] | None] = [None] * sum(len(part.loops) for part in branches.parts)
    for part, place in zip(branches.parts, branches.choice(number), strict=True):
        joints = part.joints
        sample[joints] = part.linkage.angles
        if not part.choices:
            immobile += joints.tolist()
            continue
        branch = part.choices[place]
        chosen.append(branch)
        rates[joints], sample[joints] = branch.rates, branch.sample
        immobile += joints[list(branch.immobile)].tolist()
        basis = np.zeros((size, branch.space.basis.shape[1]))
        basis[joints] = branch.space.basis
        bases.append(basis)
        left += [replace(one, joints=tuple(joints[list(one.joints)].tolist())) for one in branch.space.left]
        for loop, pair in zip(part.loops, branch.modes, strict=True):
            modes[loop] = None if pair is None else (int(joints[pair[0]]), int(joints[pair[1]]))
    moving = [branch for branch in chosen if branch.certainty != "not known"]
    each = [branch.freedoms for branch in chosen]
    unsure = len(moving) < len(chosen) or any(part.branches.no_motion == "not known" for part in branches.parts)
    known = None if unsure or None in each else sum(freedoms for freedoms in each if freedoms is not None)
    return Branch(
        known,
        _weakest([branch.certainty for branch in moving]) if moving else "not known",
        RateSpace(np.concatenate(bases, axis=1), tuple(left)),
        rates,
        tuple(sorted(immobile)),
        tuple(modes),
        sample,
        max(branch.error for branch in chosen),
        max(branch.followed for branch in chosen),
    )


def product_of(parts: Sequence[Part]) -> Branches:
    """Return the branches of a linkage by those of its parts."""
    each = [part.branches for part in parts]
    moving = any(part.choices for part in parts)
    sure = all(one.branches or one.no_motion == "proved" for one in each)
    whole = Branches(
        (),
        all(one.exhaustive for one in each),
        all(one.regular for one in each),
        all(one.complete for one in each),
        min((one.method for one in each), key=_METHODS.index),
        order=tuple(joint for part in parts for joint in part.joints[list(part.branches.order)].tolist()),
        counted=sure and all(not one.at_least or one.no_motion == "proved" for one in each),
        parts=tuple(parts),
    )
    if not moving:
        return whole
    first = (joined(whole, number) for number in range(min(prod(whole.numbers), MOST_LISTED)))
    return replace(whole, branches=tuple(first))
