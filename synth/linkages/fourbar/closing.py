"""Four-bars, planar and spherical: types, Grashof's condition, which links close, supplementary linkages.

Links come in loop order from the fixed one: ground, input, coupler, output, (g, a, h, b) in the plane and (gamma,
alpha, eta, beta) on the sphere. All functions take many linkages at a time; what is zero is a sum of links within
its own rounding (`rounding_of`), nothing absolute. Sources: Hyatt et al. 2020, section 2.3, Eqs. 1 to 4; Hyatt et
al. 2021, Table 1, Eqs. 1 to 3; the types are those of McCarthy, *Geometric Design of Linkages*. Theory:
docs/theory/four-bars.md, docs/theory/rounding.md.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from math import degrees, floor, fsum, log10
from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.errors import ArgumentError, InvariantError
from graphs.tolerances import DOUBLE
from graphs.types import Floats

ILL_CONDITIONED = "ill-conditioned"
"""What a caution begins with where figures within rounding of zero decide."""


def rounding_of(terms: npt.ArrayLike) -> Floats:
    """Return how far rounding may take sums of terms, float[..., n], whatever their signs: float[...].

    (n + 4) eps of the sum of absolute values: a last digit for each term and each addition, three for what went
    before.
    """
    sizes = np.abs(np.asarray(terms, dtype=float))
    return np.asarray((sizes.shape[-1] + 4) * np.finfo(float).eps * sizes.sum(axis=-1))


_PLANAR = np.array([[1, 1, -1, -1], [1, -1, 1, -1], [-1, 1, 1, -1]])
"""Signs of g, a, h, b in the planar T1, T2, T3 (Hyatt et al. 2021, Eqs. 1 to 3)."""
_SPHERICAL = np.array([[1, -1, 1, -1], [1, -1, -1, 1], [-1, -1, 1, 1]])
"""Signs of gamma, alpha, eta, beta in the spherical T1, T2, T3 (Hyatt et al. 2020, Eqs. 1 to 3; McCarthy)."""


@dataclass(frozen=True, slots=True)
class FourBarKind:
    """What a four-bar can do.

    Attributes
    ----------
    differences : tuple of float
        T1, T2, T3 (lengths) or T1 to T4 (radians).
    grashof : {"Grashof", "non-Grashof", "folding"}
    name : str
        ``crank-rocker``, ``rocker-crank``, ``double-crank``, ``double-rocker``, or for linkages none of whose
        links turns fully how input and output pass their ground link: ``0-0``, ``0-pi``, ``pi-0``, ``pi-pi
        double-rocker``. Folding linkages reach ends of a range without passing them, and may have other pairs,
        such as ``crank and 0-rocker``.
    input, output : {"crank", "rocker", "0-rocker", "pi-rocker"}
        ``crank``: turns fully; ``0-rocker``: passes 0 only, ``pi-rocker``: passes pi only, ``rocker``: neither.
    rounding : float
        How far the rounding of the links may take a difference: no more than that is zero.
    caution : str
        Which differences are taken for zero though they are not quite; empty if none is.

    Examples
    --------
    >>> kind = kind_of_planar([4, 1, 4, 3])
    >>> kind.grashof, kind.input, kind.output
    ('Grashof', 'crank', 'rocker')
    """

    differences: tuple[float, ...]
    grashof: str
    name: str
    input: str
    output: str
    rounding: float
    caution: str

    def to_json(self, *, angular: bool) -> dict[str, Any]:
        """Return the kind as plain data; the differences of angles in degrees."""
        return {
            "T_deg" if angular else "T": self.rounded_differences(angular=angular),
            "grashof": self.grashof,
            "type": self.name,
            "type_caution": self.caution or None,
        }

    def rounded_differences(self, *, angular: bool) -> list[float]:
        """Return the differences, angles in degrees, without the digits that rounding spoils."""
        unit = degrees(1.0) if angular else 1.0
        places = -floor(log10(self.rounding * unit)) - 1
        return [round(t * unit, places) + 0.0 for t in self.differences]


def planar_differences(lengths: npt.ArrayLike) -> Floats:
    """Return T1, T2, T3 of planar four-bars: g + a - h - b, g - a + h - b, a + h - g - b, float[..., 3].

    Hyatt et al. 2021, Eqs. 1 to 3, their a, b, c, d being the sides in loop order. The first three spherical ones
    (`spherical_differences`) are, of the same links, T2, -T3 and -T1: another order, the same product.

    Parameters
    ----------
    lengths : float[..., 4]
        g, a, h, b.

    Examples
    --------
    >>> planar_differences([4, 3, 5, 1]).tolist()
    [1.0, 5.0, 3.0]
    """
    return _differences(lengths, _PLANAR)


def spherical_differences(angles: npt.ArrayLike) -> Floats:
    """Return T1 to T4 of spherical four-bars, radians (Hyatt et al. 2020, Eqs. 1 to 4): float[..., 4].

    gamma - alpha + eta - beta, gamma - alpha - eta + beta, eta + beta - gamma - alpha, and 2 pi less the sum.

    Parameters
    ----------
    angles : float[..., 4]
        gamma, alpha, eta, beta, between 0 and pi.

    Examples
    --------
    >>> np.degrees(spherical_differences(np.radians([85, 120, 95, 45]))).round(9).tolist()
    [15.0, -85.0, -65.0, 15.0]
    """
    angles = np.asarray(angles, dtype=float)
    last = 2.0 * np.pi - angles.sum(axis=-1, keepdims=True)
    return np.concatenate([_differences(angles, _SPHERICAL), last], axis=-1)


def _differences(links: npt.ArrayLike, signs: npt.NDArray[np.int_]) -> Floats:
    """Return signed sums of links, float[..., 4], one for each row of signs, added from left to right."""
    terms = np.asarray(links, dtype=float)[..., None, :] * signs
    return np.asarray(terms[..., 0] + terms[..., 1] + terms[..., 2] + terms[..., 3])


def grashof_class(differences: npt.ArrayLike, scale: float = 2.0 * np.pi) -> npt.NDArray[np.str_]:
    """Return ``Grashof``, ``non-Grashof`` or ``folding`` by the sign of the product of the differences.

    Parameters
    ----------
    differences : float[..., 3 or 4]
    scale : float, optional
        Sum of the links, for what rounding may leave of a zero. The default is for link angles made of azimuths.

    Examples
    --------
    >>> [str(grashof_class(planar_differences(sides), 10)) for sides in ([4, 3, 5, 1], [9, 5, 4, 3], [4, 3, 5, 2])]
    ['Grashof', 'non-Grashof', 'folding']
    """
    return _grashof(np.asarray(differences, dtype=float), rounding_of(np.full(4, scale / 4.0)))


def _grashof(t: Floats, zero: Floats) -> npt.NDArray[np.str_]:
    folds = (np.abs(t) <= zero).any(axis=-1)
    grashof = np.sign(t).prod(axis=-1) > 0
    return np.where(folds, "folding", np.where(grashof, "Grashof", "non-Grashof"))


def kind_of_planar(lengths: npt.ArrayLike) -> FourBarKind:
    """Return type and class of a planar four-bar.

    Parameters
    ----------
    lengths : float[4]
        g, a, h, b, positive and able to close, else `InvariantError`.

    Examples
    --------
    >>> kind_of_planar([4, 3, 5, 1]).name
    'rocker-crank'
    """
    sides = checked_link_lengths(lengths, 4)
    return _kind(sides, planar_differences(sides), _PLANAR)


def kind_of_spherical(angles: npt.ArrayLike) -> FourBarKind:
    """Return type and class of a spherical four-bar.

    Parameters
    ----------
    angles : float[4]
        gamma, alpha, eta, beta, radians, in range and able to close, else `InvariantError`.

    Examples
    --------
    >>> kind = kind_of_spherical(np.radians([85, 120, 95, 45]))
    >>> kind.grashof, kind.name
    ('Grashof', 'rocker-crank')
    """
    links = checked_link_angles(angles, 4)
    return _kind(links, spherical_differences(links), _SPHERICAL)


def _kind(links: Floats, differences: Floats, signs: npt.NDArray[np.int_]) -> FourBarKind:
    """Name a type: which ends of its range a link reaches follows from the signs (McCarthy, Table 2.1).

    With the spherical T1 to T4, the input passes 0 unless T1 T2 < 0 and pi unless T3 T4 < 0, the output passes pi
    unless T1 T3 > 0 and 0 unless T2 T4 > 0. For planar links the first three are the same sums, and T4 counts as +.
    """
    zero = float(rounding_of(links))
    sums = _differences(links, _SPHERICAL)
    t1, t2, t3, side = (1 if t >= -zero else -1 for t in (*sums, *(differences[3:] if len(differences) > 3 else [1.0])))
    zeros = np.abs(sums) <= zero
    input_ = _swing(t1 * t2 > 0 or zeros[0] or zeros[1], t3 * side > 0 or zeros[2])
    output = _swing(t2 * side < 0 or zeros[1], t1 * t3 < 0 or zeros[0] or zeros[2])
    return FourBarKind(
        tuple(differences.tolist()),
        str(_grashof(differences, np.asarray(zero))),
        _named(input_, output),
        input_,
        output,
        zero,
        _caution([*(row * links for row in signs), [2.0 * np.pi, *-links]], np.abs(differences) <= zero),
    )


def _caution(terms: Sequence[npt.ArrayLike], zeros: npt.NDArray[np.bool_]) -> str:
    """Name the differences that are taken for zero, and are not zero when no digit is lost on the way."""
    names = [f"T{i + 1}" for i in np.flatnonzero(zeros).tolist() if fsum(np.asarray(terms[i])) != 0.0]
    if not names:
        return ""
    are = "is" if len(names) == 1 else "are"
    return f"{ILL_CONDITIONED}: {', '.join(names)} {are} within the rounding of the links, and taken as 0"


def _named(input_: str, output: str) -> str:
    if {input_, output} <= {"crank", "rocker"}:
        return f"double-{input_}" if input_ == output else f"{input_}-{output}"
    short = {"0-rocker": "0", "pi-rocker": "pi"}
    both = input_ in short and output in short
    return f"{short[input_]}-{short[output]} double-rocker" if both else f"{input_} and {output}"


def _swing(passes_zero: bool, passes_pi: bool) -> str:
    if passes_zero:
        return "crank" if passes_pi else "0-rocker"
    return "pi-rocker" if passes_pi else "rocker"


def checked_link_angles(angles: npt.ArrayLike, links: int | None = None) -> Floats:
    """Return link angles, float[n], those over pi replaced by the other way round; refuse what no closed loop has.

    Angles are radians between 0 and 2 pi; a link of more than pi has the joint axes of one of 2 pi less its angle.
    """
    values = _listed(angles, "link angles", links)
    for place, angle in enumerate(values):
        if not 0.0 < angle < 2.0 * np.pi:
            listed = f"link angle {place + 1} is {_degrees(angle)} degrees"
            hint = f"; {angle:g} looks like degrees: angles are radians" if 4 * np.pi < angle <= 360 else ""
            raise InvariantError("link angle", listed + hint, "between 0 and 360", ("angles", place))
        if min(angle, 2.0 * np.pi - angle) < DOUBLE.same_point:
            listed = f"link angle {place + 1} is {np.degrees(angle):.12g} degrees"
            raise InvariantError("link angle", listed, "one that can be told from 0 and 360", ("angles", place))
    least = np.where(values > np.pi, 2.0 * np.pi - values, values)
    if not can_close(least):
        longest = least.max() > least.sum() - least.max()
        why = "the longest is longer than the others together" if longest else "they are too long for the sphere"
        listed = ", ".join(_degrees(angle) for angle in values[:20])
        raise InvariantError("closed loop", f"the link angles {listed} cannot close: {why}", "angles of a closed loop")
    return least


def read_the_other_way(angles: npt.ArrayLike) -> tuple[str, ...]:
    """Return a sentence for each link angle over pi that `checked_link_angles` replaces by the rest of the circle."""
    values = np.asarray(angles, dtype=float)
    return tuple(
        f"link {place + 1}: {_degrees(values[place])} degrees is read as {_degrees(2.0 * np.pi - values[place])}, "
        "the angle between the same two axes the shorter way"
        for place in np.flatnonzero(values > np.pi).tolist()
    )


def checked_link_lengths(lengths: npt.ArrayLike, links: int | None = None) -> Floats:
    """Return link lengths, float[n], in any unit; refuse what no closed loop has."""
    values = _listed(lengths, "lengths", links)
    for place, length in enumerate(values):
        if not length > 0.0:
            raise InvariantError(
                "link length", f"length {place + 1} is {length:.12g}", "a length above 0", ("lengths", place)
            )
        if length < DOUBLE.same_point * values.max():
            listed = f"length {place + 1} is {length:.12g}, the longest {values.max():.12g}"
            raise InvariantError("link length", listed, "lengths within a factor of 1e9", ("lengths", place))
    longest = values.max()
    if longest - (values.sum() - longest) > rounding_of(values):
        listed = ", ".join(f"{length:.12g}" for length in values[:20])
        raise InvariantError(
            "closed loop",
            f"the lengths {listed} cannot close: the longest is longer than the others together",
            "lengths of a closed loop",
        )
    return values


def can_close(angles: npt.ArrayLike) -> npt.NDArray[np.bool_]:
    """Check whether links of these angles close on the sphere, in some position: bool[...].

    They do unless, with the supplements taken of an odd number of them, the sum is less than pi. The least such
    sum takes the supplements of those over pi / 2, and of one more or one less if these are an even number: then
    pi falls out, and small links are compared with small links.

    Parameters
    ----------
    angles : float[..., n]
        Radians, between 0 and pi.

    Examples
    --------
    >>> can_close(np.radians([[120, 120, 120], [120, 120, 121], [30, 40, 71]])).tolist()
    [True, False, False]
    """
    angles = np.asarray(angles, dtype=float)
    least = np.minimum(angles, np.pi - angles)
    even = (angles > np.pi / 2).sum(axis=-1) % 2 == 0
    spare = least.sum(axis=-1) - np.where(even, 2.0 * least.max(axis=-1), np.pi)
    return np.asarray(spare >= -rounding_of(angles))


def _listed(values: npt.ArrayLike, what: str, links: int | None) -> Floats:
    try:
        numbers = np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise ArgumentError(f"{what}: an object of type {type(values).__name__}; expected a list of numbers") from None
    if numbers.ndim != 1 or len(numbers) < 3 or (links is not None and len(numbers) != links):
        raise InvariantError("loop", f"{numbers.size} {what}", f"{links or 'three or more'} in loop order")
    if not np.isfinite(numbers).all():
        raise InvariantError("loop", f"the {what} are not all numbers", "finite numbers")
    return numbers


def _degrees(angle: float) -> str:
    return f"{round(float(np.degrees(angle)), 9):.12g}"


def supplementary(angles: npt.ArrayLike) -> Floats:
    """Return the 16 linkages that have the same joint lines, the linkage itself first: float[..., 16, 4].

    To take the other end of a joint line changes the two links there to their supplements. Taking the other end of
    all four changes no angle, so there are eight different ones at most; their T4 are plus and minus T1 to T4, and
    the product T1 T2 T3 T4 is the same for all (Hyatt et al. 2020, section 2.3).

    Parameters
    ----------
    angles : float[..., 4]
        Link angles in loop order, radians, between 0 and pi. Joint j is between links j - 1 and j.

    Examples
    --------
    >>> linkages = np.degrees(supplementary(np.radians([85, 120, 95, 45]))).round(9)
    >>> len(np.unique(linkages, axis=0)), linkages[1].tolist()
    (8, [85.0, 120.0, 85.0, 135.0])
    """
    angles = np.asarray(angles, dtype=float)
    ends = np.array(list(product((0, 1), repeat=4)))
    turned = (ends + np.roll(ends, -1, axis=1)) % 2  # link i lies between joints i and i + 1
    angles = angles[..., np.newaxis, :]
    return np.where(turned == 1, np.pi - angles, angles)


def minimal_supplementary(angles: npt.ArrayLike) -> Floats:
    """Return the supplementary linkage with the smallest sum of angles and largest T4: float[..., 4].

    Parameters
    ----------
    angles : float[..., 4]

    Examples
    --------
    >>> np.degrees(minimal_supplementary(np.radians([170, 160, 150, 140]))).round(9).tolist()
    [10.0, 20.0, 30.0, 40.0]
    """
    every = supplementary(angles)
    sums = every.sum(axis=-1)
    is_least = sums <= sums.min(axis=-1, keepdims=True) + rounding_of(every)
    least = is_least.argmax(axis=-1)  # the first of equal ones
    return np.take_along_axis(every, least[..., np.newaxis, np.newaxis], axis=-2)[..., 0, :]
