"""All dyads of many sets of five orientations at once, as arrays: `dyads_of_five` of each.

Kernels, eigenvalue problems and Newton's steps of all sets are done together. Sets of which something is not clear (a
small singular value, solutions near each other or nearly real) are solved one by one, as `dyads_of_five` does all.
Theory: docs/theory/dyads.md.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError, SynthedraError, numbered
from graphs.geometry import facing
from graphs.printing import Block, Printed, TableBlock, plain
from graphs.rank.singular_values import right_vectors, singular_values
from graphs.tolerances import DOUBLE, canonical_order
from graphs.types import Flags, Floats, Ints
from synth.linkages.guidance.orientations import Orientations
from synth.linkages.guidance.synthesis import NEARLY_REAL, PLACE, SOLVED, dyads_of_five, pencils

_SIX = 6
_STEPS = 12
_SURE = 1e3
"""By how much a set is clear of what decides: less is solved by itself."""


@dataclass(frozen=True, slots=True, repr=False)
class DyadTable(Printed):
    """All RR dyads of many sets of five orientations: N sets, at most six dyads each.

    Attributes
    ----------
    matrices : float[N, 5, 3, 3]
        The orientations.
    count : int[N]
        How many dyads there are; the other solutions, of six, are complex. -1 where there is no answer.
    fixed, moving : float[N, 6, 3]
        Axes in the fixed frame and in the body, in the order of `dyads_of_five`; nan where there are fewer.
    link_angle, misfit, residual : float[N, 6]
        As of `Dyad`.
    direction : int8[N, 6]
        1 where a counter-clockwise crank takes the orientations in their order, -1 a clockwise one, 0 neither.
    why : mapping of int to str
        Why sets have no answer, such as infinitely many dyads.

    Examples
    --------
    >>> from scipy.spatial.transform import Rotation
    >>> sets = Rotation.random(20, random_state=1).as_matrix().reshape(4, 5, 3, 3)
    >>> table = dyads_of_sets(sets)
    >>> table, table.fixed.shape
    (<DyadTable: 4 sets, 8 dyads>, (4, 6, 3))
    """

    matrices: Floats
    count: Ints
    fixed: Floats
    moving: Floats
    link_angle: Floats
    misfit: Floats
    residual: Floats
    direction: npt.NDArray[np.int8]
    why: dict[int, str]

    def __len__(self) -> int:
        return len(self.count)

    def __repr__(self) -> str:
        return f"<DyadTable: {numbered(len(self), 'set')}, {numbered(int(self.count.clip(0).sum()), 'dyad')}>"

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        numbers, sets = np.unique(self.count, return_counts=True)
        rows = [
            ("no answer" if count < 0 else str(count), str(many))
            for count, many in zip(numbers.tolist(), sets.tolist(), strict=True)
        ]
        lines: list[Block] = [f"{numbered(len(self), 'set')} of 5 orientations"]
        lines += [TableBlock(("dyads", "sets"), rows, ["dyads", "sets"])] if rows else []
        return [*lines, *(f"set {number}: {plain(why, 200)}" for number, why in list(self.why.items())[:10])]

    def to_json(self) -> dict[str, Any]:
        """Return all as plain data; of each set as many dyads as there are."""
        names = ("fixed", "moving", "link_angle", "misfit", "residual", "direction")
        counts = self.count.clip(0).tolist()
        return {
            "count": self.count.tolist(),
            **{
                name: [row[:count].tolist() for row, count in zip(getattr(self, name), counts, strict=True)]
                for name in names
            },
            "why": {str(number): why for number, why in self.why.items()},
        }


def dyads_of_sets(matrices: npt.ArrayLike) -> DyadTable:
    """Return all RR dyads that guide a body through each of many sets of five orientations.

    Parameters
    ----------
    matrices : float[N, 5, 3, 3]
        Rotation matrices, as of `Orientations.matrices`.

    Raises
    ------
    InvariantError
        If these are no rotations. Sets that have no answer say why in the table.

    Examples
    --------
    >>> from scipy.spatial.transform import Rotation
    >>> turned = Rotation.from_euler("ZX", [(0, 0), (40, 10), (70, 60), (120, 100), (200, 170)], degrees=True)
    >>> table = dyads_of_sets([turned.as_matrix()] * 3)
    >>> table.count.tolist() == [len(dyads_of_five(Orientations.from_rotation(turned)).dyads)] * 3
    True
    """
    m = np.asarray(matrices, dtype=float)
    if m.ndim != 4 or m.shape[1:] != (5, 3, 3):
        raise InvariantError("matrices", f"an array of shape {m.shape}", "float[N, 5, 3, 3]")
    off = np.abs(m @ np.swapaxes(m, -1, -2) - np.eye(3)).max(axis=(1, 2, 3), initial=0.0)
    bad = ~((off <= DOUBLE.parallel) & (np.linalg.det(m) > 0.0).all(axis=1))
    if bad.any():
        raise InvariantError(
            "rotation matrix", f"set {int(bad.argmax())} has a matrix that is no rotation", "rotations"
        )
    fixed, moving, real, clear = _solved(m)
    table = _empty(m)
    for number in range(len(m)):
        if clear[number]:
            _enter(table, number, fixed[number, real[number]], moving[number, real[number]])
            continue
        try:
            dyads = dyads_of_five(Orientations.from_matrices(m[number])).dyads
        except SynthedraError as error:
            table.why[number] = str(error)
            continue
        _enter(table, number, np.array([one.fixed for one in dyads]), np.array([one.moving for one in dyads]))
    _measure(table)
    return table


def _empty(m: Floats) -> DyadTable:
    count = np.full(len(m), -1, dtype=np.int64)
    fixed, moving = np.full((2, len(m), _SIX, 3), np.nan)
    link_angle, misfit, residual = np.full((3, len(m), _SIX), np.nan)
    direction = np.zeros((len(m), _SIX), dtype=np.int8)
    return DyadTable(m, count, fixed, moving, link_angle, misfit, residual, direction, {})


def _enter(table: DyadTable, number: int, fixed: Floats, moving: Floats) -> None:
    """Enter the dyads of one set in their order."""
    pairs = np.concatenate([fixed.reshape(-1, 3), moving.reshape(-1, 3)], axis=1)
    order = canonical_order(list(pairs))
    table.count[number] = len(order)
    table.fixed[number, : len(order)], table.moving[number, : len(order)] = np.split(pairs[order], 2, axis=1)


def _measure(table: DyadTable) -> None:
    """Write angles of links, misfits, residuals and directions of all dyads."""
    cosines = np.einsum("nda,niab,ndb->ndi", table.fixed, table.matrices, table.moving)
    angles = np.arccos(np.clip(cosines, -1.0, 1.0))
    table.link_angle[:] = angles.mean(axis=2)
    table.misfit[:] = np.abs(angles - angles.mean(axis=2, keepdims=True)).max(axis=2)
    table.residual[:] = np.abs(cosines - cosines[..., :1]).max(axis=2)
    carried = np.einsum("niab,ndb->ndia", table.matrices, table.moving)
    along = np.einsum("ndia,nda->ndi", carried, table.fixed)
    start = carried[:, :, 0] - along[:, :, :1] * table.fixed
    side = np.cross(table.fixed, start)
    turned = np.mod(
        np.arctan2(np.einsum("ndia,nda->ndi", carried, side), np.einsum("ndia,nda->ndi", carried, start)), 2.0 * np.pi
    )
    turned[..., 0] = 0.0
    for sign in (1, -1):
        grows = (np.diff(np.mod(sign * turned, 2.0 * np.pi), axis=2) > 0.0).all(axis=2)
        table.direction[grows] = sign


def _solved(m: Floats) -> tuple[Floats, Floats, Flags, Flags]:
    """Return axes float[N, 6, 3] of all sets, which are real, bool[N, 6], and of which sets all is clear, bool[N]."""
    conditions = m[:, 1:] - m[:, :1]
    with np.errstate(invalid="ignore", divide="ignore"):
        conditions /= np.linalg.norm(conditions, axis=(2, 3), keepdims=True)
    clear = np.asarray(np.isfinite(conditions).all(axis=(1, 2, 3)))
    conditions = np.where(clear[:, None, None, None], conditions, np.eye(3))
    equations = np.zeros((len(m), 4, 3, 6, 3))
    for i in range(3):
        for times in range(3):
            equations[:, :, times, PLACE[i, times]] += conditions[:, :, i]
    values, right = right_vectors(equations.reshape(-1, 12, 18))
    kernel = np.swapaxes(right[:, 12:], 1, 2).reshape(-1, 6, 3, 6)
    clear &= values[:, 11] > _SURE * DOUBLE.zero * values[:, 0]
    first, second, ratio = pencils(kernel)
    clear &= ratio > _SURE * DOUBLE.zero
    second = np.where(clear[:, None, None], second, np.eye(6))
    vectors = np.linalg.eig(np.linalg.solve(second, first))[1]
    products = np.einsum("najk,nkv->nvaj", kernel, vectors)
    moving = _longest(products)
    square = np.einsum("nvaj,nvj->nva", products, moving.conj())[
        :, :, [PLACE[a, b] for a in range(3) for b in range(3)]
    ]
    fixed = _longest(square.reshape(len(m), _SIX, 3, 3))
    fixed, moving = _polished(conditions, fixed, moving)
    clear &= _told_apart(conditions, fixed, moving)
    fixed, moving = (_turned(axes) for axes in (fixed, moving))
    apart = np.maximum(*(np.linalg.norm(axes.imag, axis=2) for axes in (fixed, moving)))
    real = apart < DOUBLE.same_configuration / 100.0
    clear &= (real | (apart > _SURE * NEARLY_REAL)).all(axis=1)
    fixed, moving = _polished(conditions, fixed.real, moving.real, real & clear[:, None])
    return facing(fixed.real), facing(moving.real), real, clear


def _longest(rows: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Return the longest row of matrices [N, 6, k, 3]: [N, 6, 3]."""
    place = np.linalg.norm(rows, axis=3).argmax(axis=2)
    return np.take_along_axis(rows, place[:, :, None, None], axis=2)[:, :, 0]


def _polished(
    conditions: Floats, fixed: npt.NDArray[Any], moving: npt.NDArray[Any], which: Flags | None = None
) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
    """Return solutions as unit vectors by Newton's method, as `synthesis` does for one; others stay as they are."""
    g, w = (axes / np.linalg.norm(axes, axis=2, keepdims=True) for axes in (fixed, moving))
    number, place = np.nonzero(np.ones(g.shape[:2], dtype=bool) if which is None else which)
    one, other, of = g[number, place], w[number, place], conditions[number]
    active = np.arange(len(one))
    for _ in range(_STEPS):
        step = _newton_step(one[active], other[active], of[active])
        for axes, moved in ((one, one[active] + step[:, :3]), (other, other[active] + step[:, 3:])):
            axes[active] = moved / np.linalg.norm(moved, axis=1, keepdims=True)
        active = active[np.linalg.norm(step, axis=1) > DOUBLE.derivative]  # the error left is the square of a step
        if not len(active):
            break
    g[number, place], w[number, place] = one, other
    return g, w


def _newton_step(g: npt.NDArray[Any], w: npt.NDArray[Any], conditions: Floats) -> npt.NDArray[Any]:
    """Return changes of solutions, unit vectors [S, 3], across both: [S, 6]; zero where there is no one step."""
    by_w, by_g = np.einsum("si,skij->skj", g, conditions), np.einsum("skij,sj->ski", conditions, w)
    rows = np.zeros((len(g), 6, 6), dtype=g.dtype)
    rows[:, :4, :3], rows[:, :4, 3:], rows[:, 4, :3], rows[:, 5, 3:] = by_g, by_w, g.conj(), w.conj()
    right = np.zeros((len(g), 6), dtype=g.dtype)
    right[:, :4] = -np.einsum("skj,sj->sk", by_w, w)
    regular = np.abs(np.linalg.det(rows)) > 0.0
    step = np.zeros_like(right)
    step[regular] = np.linalg.solve(rows[regular], right[regular, :, None])[..., 0]
    return step


def _told_apart(conditions: Floats, fixed: npt.NDArray[Any], moving: npt.NDArray[Any]) -> Flags:
    """Return of which sets all six are solutions, far from each other, and isolated."""
    misses = np.abs(np.einsum("nvi,nkij,nvj->nvk", fixed, conditions, moving)).max(axis=(1, 2))
    products = np.einsum("nvi,nvj->nvij", fixed, moving).reshape(len(fixed), _SIX, 9)
    overlap = np.abs(products.conj() @ np.swapaxes(products, 1, 2)) - np.eye(_SIX)
    closest = np.sqrt(np.maximum(0.0, 1.0 - overlap.max(axis=(1, 2))))
    by_w, by_g = np.einsum("nvi,nkij->nvkj", fixed, conditions), np.einsum("nkij,nvj->nvki", conditions, moving)
    second = np.minimum(*(singular_values(rows)[..., 1].min(axis=1) for rows in (by_w, by_g)))
    isolated = (closest > _SURE * DOUBLE.same_configuration) & (second > _SURE * DOUBLE.zero)
    return np.asarray((misses < SOLVED) & isolated)


def _turned(axes: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Return complex directions, each times the number that makes it as real as it can be."""
    phase = np.sqrt(np.einsum("nvi,nvi->nv", axes, axes))
    size = np.abs(phase)
    turn = np.divide(phase.conj(), size, out=np.ones_like(phase), where=size > 0.0)
    return np.asarray(axes * turn[..., None])
