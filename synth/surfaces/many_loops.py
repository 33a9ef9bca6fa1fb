"""Cones of many loops at once, as arrays: what `map_to_cones` gives for each.

Loop sums of all loops are solved together; loops of which rounding or half turns decide something are mapped one by
one, as all are by `map_to_cones`. Theory: docs/theory/loop-sums.md.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from graphs.errors import InvariantError, UnsolvableError, numbered
from graphs.printing import Block, Printed, TableBlock
from graphs.tolerances import DOUBLE
from graphs.types import Flags, Floats, Ints
from synth.fourbar.closing import can_close, rounding_of
from synth.surfaces import mapping
from synth.surfaces.circuit import circuits
from synth.surfaces.loop_maps import ConeMap, cone_reach, map_to_cones
from synth.surfaces.loop_sums import MOST_LINKS, half_steps, loop_roots

STATUSES = ("cones", "no cone", "cannot close", "no link angles")
"""What may be said of a loop: it lies on a cone, or on none; its links do not close; an angle is out of range."""
_CONES, _NO_CONE, _OPEN, _NO_LINKS = range(4)


class _Circles(NamedTuple):
    """Rows of circles, by the number of their loop."""

    loop: Ints
    size: Floats
    signs: npt.NDArray[np.int8]
    turns: Ints
    steps: Floats
    double: Flags


@dataclass(frozen=True, slots=True, repr=False)
class ConesOfLoops(Printed):
    """All cones of many loops: a row for each loop, and rows of cones that name their loop.

    Attributes
    ----------
    angles : float[N, n]
        Link angles as they were given, radians.
    status : str[N]
        One of "cones", "no cone" (perhaps the flat one), "cannot close", "no link angles" (an angle is not between 0
        and 2 pi).
    loop : int[M]
        The loop that each cone is of, in rising order; cones of one loop by their sizes.
    size : float[M]
        lambda, radians, from 0 (flat) to pi / 2.
    flat : bool[M]
        Whether the loop is in a plane there, which is no cone.
    signs : int8[M, n]
        Of the steps; the first is +.
    turns : int[M]
        k: the steps sum to 2 pi k.
    steps : float[M, n]
        Projected angles, radians.
    open : bool[M]
        Whether the circuit is open; else it is crossed.
    residual : float[M]
        Sum of the steps less 2 pi k, radians.
    double : bool[M]
        Whether the loop sum touches 2 pi k there within its rounding.
    family_loop : int[F]
        Loops that lie on a whole interval of cones, once for each pattern of signs.

    Examples
    --------
    >>> cones = cones_of_loops(np.radians([[70, 80, 120, 40], [170, 10, 20, 30]]))
    >>> cones.status.tolist(), cones.loop.tolist(), np.degrees(cones.size).round(2).tolist()
    (['cones', 'cannot close'], [0], [25.21])
    >>> cones[0]
    <ConeMap: 4 links, 1 cone>
    """

    angles: Floats
    status: npt.NDArray[np.str_]
    loop: Ints
    size: Floats
    flat: Flags
    signs: npt.NDArray[np.int8]
    turns: Ints
    steps: Floats
    open: Flags
    residual: Floats
    double: Flags
    family_loop: Ints

    def __len__(self) -> int:
        return len(self.angles)

    def __getitem__(self, loop: int) -> ConeMap:
        """Return all that is known of one loop; raise as `map_to_cones` does."""
        return map_to_cones(self.angles[loop])

    def __repr__(self) -> str:
        return f"<ConesOfLoops: {numbered(len(self), 'loop')}, {numbered(int((~self.flat).sum()), 'cone')}>"

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        rows = [(status, str(int((self.status == status).sum()))) for status in STATUSES]
        table = TableBlock(("status", "loops"), [row for row in rows if row[1] != "0"], ["loops"])
        cones = numbered(int((~self.flat).sum()), "cone")
        return [f"{numbered(len(self), 'loop')} of {self.angles.shape[1]} links: {cones}", table]

    def to_json(self) -> dict[str, Any]:
        """Return all as plain data, angles in degrees; cones in columns."""
        return {
            "angles_deg": np.degrees(self.angles).tolist(),
            "status": self.status.tolist(),
            "loop": self.loop.tolist(),
            "lambda_deg": np.degrees(self.size).tolist(),
            "flat": self.flat.tolist(),
            "circuit": np.where(self.open, "open", "crossed").tolist(),
            "signs": self.signs.tolist(),
            "k": self.turns.tolist(),
            "steps_deg": np.degrees(self.steps).tolist(),
            "residual_deg": np.degrees(self.residual).tolist(),
            "double": self.double.tolist(),
            "family_loop": self.family_loop.tolist(),
        }


def cones_of_loops(angles: npt.ArrayLike) -> ConesOfLoops:
    """Return every right cone of many spherical loops of as many links: `map_to_cones` by arrays.

    Parameters
    ----------
    angles : float[N, n]
        Link angles of each loop in loop order, radians, as `map_to_cones` takes them.

    Returns
    -------
    ConesOfLoops
        Loops that cannot close, or have angles out of range, have a status that says so, and no cones.

    Raises
    ------
    InvariantError
        If the angles are no rows of three or more numbers.
    UnsolvableError
        If the loops have too many links.

    Examples
    --------
    >>> angles = np.radians([[120, 95, 45, 85], [70, 80, 120, 40], [10, 20, 30, 100]])
    >>> cones = cones_of_loops(angles)
    >>> cones.status.tolist(), cones.loop.tolist()
    (['cones', 'cones', 'cannot close'], [0, 0, 1])
    """
    rows = np.asarray(angles, dtype=float)
    if rows.ndim != 2 or rows.shape[1] < 3:
        raise InvariantError("loops", f"an array of shape {rows.shape}", "float[N, n], n link angles in each row")
    if rows.shape[1] > MOST_LINKS:
        raise UnsolvableError(f"loops of {rows.shape[1]} links; expected 3 to {MOST_LINKS}")
    links = np.where(rows > np.pi, 2.0 * np.pi - rows, rows)
    good = np.asarray((np.isfinite(links) & (np.nan_to_num(links) >= DOUBLE.same_point)).all(axis=1))
    closed = np.array(good)
    closed[good] = can_close(links[good])
    numbers = np.flatnonzero(closed)
    circles, families = _circles(links[numbers])
    longest = links[numbers].max(axis=1, initial=0.0)
    flat = circles.size <= rounding_of(longest[:, np.newaxis])[circles.loop]
    status = np.where(good, np.where(closed, _NO_CONE, _OPEN), _NO_LINKS)
    status[numbers[circles.loop[~flat]]] = status[numbers[families]] = _CONES
    kinds = circuits(circles.steps)
    residual = circles.steps.sum(axis=1) - 2.0 * np.pi * circles.turns
    return ConesOfLoops(
        rows, np.array(STATUSES)[status], numbers[circles.loop], circles.size, flat, circles.signs, circles.turns,
        circles.steps, kinds.open, residual, circles.double, numbers[families],
    )  # fmt: skip


def _circles(links: Floats) -> tuple[_Circles, Ints]:
    """Return the circles of loops that close, float[N, n], in the order of loops and sizes; and loops of families."""
    reach = cone_reach(links)
    roots = loop_roots(reach, 1)
    special = np.union1d(roots.loop[roots.double], roots.family_loop)
    simple = ~np.isin(roots.loop, special)
    loop, signs, size = roots.loop[simple], roots.signs[simple], roots.size[simple]
    steps = signs * 2.0 * half_steps(size[:, np.newaxis], reach[loop], 1)
    plain = _Circles(loop, np.arctan(np.sqrt(size)), signs, roots.turns[simple], steps, np.zeros(len(loop), dtype=bool))
    parts, families = [plain], list[int]()
    for number in special.tolist():
        circles, of_families = mapping.mapped_loop(reach[number], 1, links[number])
        families += [number] * len(of_families)
        parts += [
            _Circles(
                np.array([number]), np.array([one.size]), np.array([one.signs], dtype=np.int8), np.array([one.turns]),
                np.array([one.steps]), np.array([one.double]),
            )
            for one in circles
        ]  # fmt: skip
    joined: list[Any] = [np.concatenate(columns) for columns in zip(*parts, strict=True)]
    order = np.lexsort((joined[1], joined[0]))
    return _Circles(*(column[order] for column in joined)), np.array(families, dtype=np.int64)
