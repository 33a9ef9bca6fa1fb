"""Orientations of a body about a fixed point, and the axes of the rotations between them.

Unit quaternions are scalar first, products are Hamilton's, rotations are active: q turns a vector v of the body
into q v q* of the fixed frame. Orientations are numbered from 1, as in the papers. Theory: docs/theory/order.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import numpy.typing as npt

from graphs.errors import FileError, InvariantError, UnsolvableError, numbered
from graphs.files.atomic import write_text
from graphs.files.native import orientation_rows, orientations_document
from graphs.files.text import json_text
from graphs.geometry import nearest_rotation, unit
from graphs.tolerances import DOUBLE
from graphs.types import Floats

if TYPE_CHECKING:
    from scipy.spatial.transform import Rotation


Pair: TypeAlias = tuple[int, int]
"""Two orientations i < j, numbered from 1."""

_NORM_TOLERANCE = 1e-3
"""Printed quaternions have five digits or so; more is a mistake and not rounding."""


_FEWEST = 3
_MOST_IN_PAIRS = 2000


@dataclass(frozen=True, slots=True, eq=False)
class Orientations:
    """Three or more different orientations of a body, in the order in which it is to take them.

    Attributes
    ----------
    quaternions : float[n, 4]
        Of norm one, scalar first. Read only. `InvariantError` if there are fewer than three, if a norm is further
        than 1e-3 from one, or if two are equal.

    Examples
    --------
    >>> quarter_turns = Orientations.from_axis_angles([(0, 0, 1)] * 3, [0, np.pi / 2, np.pi])
    >>> quarter_turns.matrices[1].round(6).tolist()
    [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
    """

    quaternions: Floats

    def __post_init__(self) -> None:
        q = np.array(self.quaternions, dtype=float)
        if q.ndim != 2 or q.shape[1] != 4 or not np.isfinite(q).all():
            raise InvariantError("quaternions", f"an array of shape {q.shape}", "finite numbers, n by 4")
        if len(q) < _FEWEST:
            raise InvariantError("orientations", numbered(len(q), "orientation"), f"{_FEWEST} or more", ("whole", 0))
        with np.errstate(over="ignore"):
            norms = np.linalg.norm(q, axis=1)
        for i in np.flatnonzero(np.abs(norms - 1.0) > _NORM_TOLERANCE):
            raise InvariantError(
                "unit quaternion",
                f"orientation {i + 1} has a quaternion of norm {norms[i]:.6g}",
                f"1 to within {_NORM_TOLERANCE:g}",
                ("item", int(i)),
            )
        q /= norms[:, None]
        q.setflags(write=False)
        object.__setattr__(self, "quaternions", q)
        self._check_different()

    def _check_different(self) -> None:
        from scipy.spatial import cKDTree

        n = len(self)
        both_signs = cKDTree(np.concatenate([self.quaternions, -self.quaternions]))
        pairs = sorted(sorted((i % n, j % n)) for i, j in both_signs.query_pairs(DOUBLE.parallel))
        for i, j in pairs:
            raise InvariantError(
                "different orientations", f"orientations {i + 1} and {j + 1} are equal", "different ones", ("item", j)
            )

    def __len__(self) -> int:
        return len(self.quaternions)

    def __repr__(self) -> str:
        return f"<Orientations: {numbered(len(self), 'orientation')}>"

    @classmethod
    def from_matrices(cls, matrices: npt.ArrayLike) -> Orientations:
        """Return the orientations that rotation matrices describe, float[n, 3, 3].

        Each is orthogonal to within 1e-3, else `InvariantError`; the nearest rotation is taken.
        """
        from scipy.spatial.transform import Rotation

        m = np.array(matrices, dtype=float)
        if m.ndim != 3 or m.shape[1:] != (3, 3) or not np.isfinite(m).all():
            raise InvariantError("matrices", f"an array of shape {m.shape}", "finite numbers, n by 3 by 3")
        far = np.abs(m).max(axis=(1, 2), initial=0.0) > 2.0
        m = np.where(far[:, None, None], 0.0, m)
        nearest = nearest_rotation(m)
        for i in np.flatnonzero(np.linalg.norm(m - nearest, ord=2, axis=(1, 2)) > _NORM_TOLERANCE):
            raise InvariantError(
                "rotation matrix",
                f"orientation {i + 1} has a matrix that is no rotation",
                "an orthogonal one of determinant 1",
                ("item", int(i)),
            )
        return cls(Rotation.from_matrix(nearest).as_quat(scalar_first=True) if len(m) else np.zeros((0, 4)))

    @classmethod
    def from_axis_angles(cls, axes: npt.ArrayLike, angles: npt.ArrayLike) -> Orientations:
        """Return the orientations that are rotations about axes, float[n, 3], by angles, float[n], radians.

        Raises `InvariantError` if an axis is zero.
        """
        unit = np.array([unit_vector(axis) for axis in np.asarray(axes, dtype=float)]).reshape(-1, 3)
        half = np.asarray(angles, dtype=float)[:, None] / 2.0
        return cls(np.hstack([np.cos(half), np.sin(half) * unit]))

    @classmethod
    def from_rotation(cls, rotation: Rotation) -> Orientations:
        """Return the orientations of a stack of scipy rotations."""
        return cls(np.atleast_2d(rotation.as_quat(scalar_first=True)))

    def to_rotation(self) -> Rotation:
        """Return the orientations as a stack of scipy rotations."""
        from scipy.spatial.transform import Rotation

        return Rotation.from_quat(self.quaternions, scalar_first=True)

    @property
    def matrices(self) -> Floats:
        """Rotation matrices: float[n, 3, 3]; column k is where the body's axis k points."""
        w, x, y, z = self.quaternions.T
        rows = [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
        return np.moveaxis(np.array(rows), 2, 0)

    def axis_angles(self) -> tuple[Floats, Floats]:
        """Return axes, float[n, 3], and angles, float[n], from 0 to pi; the axis of no rotation is z."""
        q = np.where(self.quaternions[:, :1] < 0, -self.quaternions, self.quaternions)
        sines = np.linalg.norm(q[:, 1:], axis=1)
        turned = sines > 0.0
        axes = np.tile([0.0, 0.0, 1.0], (len(q), 1))
        axes[turned] = q[turned, 1:] / sines[turned, None]
        return axes, 2.0 * np.arctan2(sines, q[:, 0])

    def pairs(self) -> list[Pair]:
        """Return all pairs (i, j) with i < j, numbered from 1."""
        return list(combinations(range(1, len(self) + 1), 2))

    def relative_axis(self, i: int, j: int) -> Floats:
        """Return S_ij, the axis in the fixed frame of the rotation M_j M_i^-1 from orientation i to j: float[3].

        Its sign has no meaning: a rotation by a about S is one by -a about -S. Tipparthi and Larochelle 2011; the
        convention reproduces their case studies (docs/misprints.md, 002-3).
        """
        return unit(_between(self.quaternions[i - 1], self.quaternions[j - 1])[1:])

    def relative_axes(self) -> dict[Pair, Floats]:
        """Return the relative axes S_ij of all pairs; `UnsolvableError` for more than 2000 orientations."""
        if len(self) > _MOST_IN_PAIRS:
            raise UnsolvableError(f"{len(self)} orientations have too many pairs; expected {_MOST_IN_PAIRS} at most")
        i, j = np.triu_indices(len(self), 1)
        axes = unit(_between(self.quaternions[i], self.quaternions[j])[:, 1:])
        return dict(zip(zip((i + 1).tolist(), (j + 1).tolist(), strict=True), axes, strict=True))

    def subset(self, numbers: Sequence[int]) -> Orientations:
        """Return some of the orientations, numbered from 1, in the order of the numbers."""
        return Orientations(self.quaternions[[number - 1 for number in numbers]])


def unit_vector(vector: npt.ArrayLike, name: str = "axis") -> Floats:
    """Return a vector of length one in the direction of another: float[3].

    Raises `InvariantError`, with its name, if it is not three finite numbers, or zero.
    """
    v = np.array(vector, dtype=float)
    if v.shape != (3,) or not np.isfinite(v).all():
        raise InvariantError(name, f"the {name} has not three finite numbers", "x, y, z")
    v /= np.abs(v).max() or 1.0  # so that squares neither vanish nor overflow
    length = float(np.linalg.norm(v))
    if length == 0.0:
        raise InvariantError(name, f"the {name} is zero", "a direction")
    return np.asarray(v / length)


def read_orientations(path: str | Path) -> Orientations:
    """Return the orientations of a file (``synthedra/orientations``, docs/native-json.md).

    Parameters
    ----------
    path : str or Path
        `FileError` if it cannot be read, or does not hold three or more different rotations.

    Examples
    --------
    >>> read_orientations("data/orientations/tipparthi.json")
    <Orientations: 5 orientations>
    """
    key, rows = orientation_rows(path)
    try:
        if key == "quaternions":
            return Orientations(np.array(rows, dtype=float).reshape(-1, 4))
        return Orientations.from_matrices(np.array(rows, dtype=float).reshape(-1, 3, 3))
    except InvariantError as error:
        place = f"{key}[{error.part[1]}]" if error.part is not None and error.part[0] == "item" else key
        raise FileError(path, place, error.offender, error.expected) from None


def write_orientations(quaternions: Floats, path: str | Path, *, force: bool = False) -> None:
    """Write a file of orientations, as quaternions.

    Parameters
    ----------
    quaternions : float[n, 4]
        Unit quaternions, scalar first.
    path : str or Path
        `FileError` if it cannot be written, or exists already.
    force : bool, optional
        Overwrite an existing file.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     write_orientations(np.eye(4)[:3], Path(folder, "turned.json"))
    """
    write_text(Path(path), json_text(orientations_document(quaternions.tolist())), force=force)


def _between(first: Floats, second: Floats) -> Floats:
    """Return the quaternions of second times the inverse of first: float[..., 4]."""
    a, b = second[..., :1], second[..., 1:]
    c, d = first[..., :1], -first[..., 1:]
    scalar = a * c - (b * d).sum(axis=-1, keepdims=True)
    return np.concatenate([scalar, a * d + c * b + np.cross(b, d)], axis=-1)
