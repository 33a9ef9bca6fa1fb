"""Surfaces and paths on which points are to lie: formulas, meshes, lines through points.

Each gives for points float[P, 3] by how much they miss, float[P, r], and the derivatives float[P, r, 3]. Theory:
docs/theory/design.md.
"""

import ast
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from types import CodeType
from typing import Any, Protocol

import numpy as np

from graphs.errors import FileError, InvariantError, UnsolvableError, shown
from graphs.files.formats import read
from graphs.geometry import unit
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import Sheet
from graphs.types import Floats
from synth.analysis.moving._configuration_of import sheet_of

_COMPLEX = 1e-40
_FUNCTIONS: Mapping[str, Callable[..., Any]] = {
    name: getattr(np, name) for name in ("sin", "cos", "tan", "sqrt", "exp", "log", "sinh", "cosh", "tanh", "arctan")
}
_ALLOWED = (
    ast.Expression, ast.BinOp, ast.UnaryOp, ast.Constant, ast.Name, ast.Call, ast.Load, ast.Add, ast.Sub, ast.Mult,
    ast.Div, ast.Pow, ast.USub, ast.UAdd,
)  # fmt: skip
_LONGEST, _DEEPEST = 500, 200


class Target(Protocol):
    """Where points are to lie."""

    def missed(self, points: Floats) -> tuple[Floats, Floats]:
        """Return misses float[P, r] of points float[P, 3], and their derivatives float[P, r, 3]."""


@dataclass(frozen=True)
class Formula:
    """A surface f(x, y, z) = 0: the miss is f over the size of its gradient, a distance near the surface.

    Attributes
    ----------
    text : str
        f of x, y, z, numbers, pi, ``+ - * / **``, and sin, cos, tan, sqrt, exp, log, sinh, cosh, tanh, arctan.
        `InvariantError` for anything else.

    Examples
    --------
    >>> sphere = Formula("x**2 + y**2 + z**2 - 4")
    >>> off, slope = sphere.missed(np.array([[2.001, 0.0, 0.0]]))
    >>> off.round(5).tolist(), slope.round(2).tolist()
    ([[0.001]], [[[1.0, 0.0, 0.0]]])
    """

    text: str

    def __post_init__(self) -> None:
        self._code  # noqa: B018  # a formula that is none is refused when it is made

    def __str__(self) -> str:
        return self.text

    @cached_property
    def _code(self) -> CodeType:
        try:
            if len(self.text) > _LONGEST:
                raise ValueError
            tree = ast.parse(self.text, mode="eval")
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            raise InvariantError("formula", f"the formula {shown(self.text)}", "one such as x**2 + y**2 - z") from None
        for number, node in enumerate(ast.walk(tree)):
            name = node.id if isinstance(node, ast.Name) else None
            known = name is None or name in "xyz" or name == "pi" or name in _FUNCTIONS
            constant = not isinstance(node, ast.Constant) or isinstance(node.value, int | float)
            if not isinstance(node, _ALLOWED) or not known or not constant or number > _DEEPEST:
                what = f"{shown(name)} in a formula" if name and not known else f"the formula {shown(self.text)}"
                raise InvariantError("formula", what, f"x, y, z, numbers, + - * / **, {', '.join(_FUNCTIONS)}")
        return compile(tree, "formula", "eval")

    def _value(self, points: Any) -> Any:
        names = {**_FUNCTIONS, "pi": np.pi, **dict(zip("xyz", points.T, strict=True))}
        with np.errstate(all="ignore"):
            value = eval(self._code, {"__builtins__": {}}, names)  # names and operations were checked
        return np.broadcast_to(value, len(points))

    def _gradient(self, points: Any) -> Any:
        columns = [self._value(points + 1j * _COMPLEX * way).imag / _COMPLEX for way in np.eye(3)]
        return np.stack(columns, axis=1)

    def missed(self, points: Floats) -> tuple[Floats, Floats]:
        """Return values over gradients; derivatives of gradients by central differences, where points are off."""
        value, gradient = np.real(self._value(points)), self._gradient(points)
        size = np.linalg.norm(gradient, axis=1)
        if not (np.isfinite(value).all() and np.isfinite(size).all() and (size > 0.0).all()):
            raise UnsolvableError(f"the surface {self.text} has no normal at a point of the mechanism")
        step = _STEP * max(1.0, float(np.abs(points).max()))
        turning = np.stack(
            [
                (self._gradient(points + step * way) - self._gradient(points - step * way)) / (2.0 * step)
                for way in np.eye(3)
            ],
            axis=2,
        )
        slope = gradient / size[:, None]
        by_size = np.einsum("pi,pij->pj", slope, turning)
        off = value / size
        return off[:, None], (slope - off[:, None] * by_size / size[:, None])[:, None, :]


_STEP = 1e-5
_ROUNDS = 5
"""Newton's steps to a target."""


@dataclass(frozen=True)
class Polyline:
    """A path through points: the miss is the vector from the nearest point of it.

    Attributes
    ----------
    points : tuple of (float, float, float)

    Examples
    --------
    >>> off, _ = Polyline(((0, 0, 0), (2, 0, 0))).missed(np.array([[1.0, 0.5, 0.0]]))
    >>> off.tolist()
    [[0.0, 0.5, 0.0]]
    """

    points: tuple[tuple[float, float, float], ...]

    def __str__(self) -> str:
        return f"a path of {len(self.points)} points"

    def missed(self, points: Floats) -> tuple[Floats, Floats]:
        """Return vectors from the path."""
        corners = np.array(self.points, dtype=float)
        start, along = corners[:-1], np.diff(corners, axis=0)
        square = (along**2).sum(axis=1)
        part = ((points[:, None] - start) * along).sum(axis=2) / np.where(square > 0.0, square, 1.0)
        inner = np.clip(part, 0.0, 1.0)
        off = points[:, None] - start - inner[..., None] * along
        best = np.linalg.norm(off, axis=2).argmin(axis=1)
        rows = np.arange(len(points))
        direction = unit(along)[best]
        within = (part[rows, best] == inner[rows, best])[:, None, None]
        across = np.eye(3) - direction[:, :, None] * direction[:, None, :]
        return off[rows, best], np.where(within, across, np.eye(3))


@dataclass(frozen=True, eq=False)
class Mesh:
    """A surface of triangles: the miss is the distance from the nearest, signed by its side.

    Attributes
    ----------
    name : str
    triangles : float[T, 3, 3]
        Corners, counter-clockwise seen from outside.

    Examples
    --------
    >>> floor = Mesh("floor", np.array([[(0, 0, 0), (4, 0, 0), (0, 4, 0)]], dtype=float))
    >>> floor.missed(np.array([[1.0, 1.0, 0.5]]))[0].tolist()
    [[0.5]]
    """

    name: str
    triangles: Floats

    def __str__(self) -> str:
        return self.name

    def missed(self, points: Floats) -> tuple[Floats, Floats]:
        """Return signed distances."""
        nearest, normals = self.nearest(points)
        off = points - nearest
        size = np.linalg.norm(off, axis=1)
        sign = np.where((off * normals).sum(axis=1) < 0.0, -1.0, 1.0)
        on = size <= _STEP * _STEP * np.abs(self.triangles).max()
        slope = np.where(on[:, None], normals, sign[:, None] * off / np.where(on, 1.0, size)[:, None])
        return (sign * size)[:, None], slope[:, None, :]

    def nearest(self, points: Floats) -> tuple[Floats, Floats]:
        """Return the nearest points of the surface, and the normals of their triangles: float[P, 3] each."""
        a, b, c = self.triangles.transpose(1, 0, 2)
        normals = unit(np.cross(b - a, c - a))
        places, ways = np.empty_like(points), np.empty_like(points)
        for row, point in enumerate(points):
            candidates = _nearest_of_triangles(point, a, b, c)
            best = int(np.linalg.norm(candidates - point, axis=1).argmin())
            places[row], ways[row] = candidates[best], normals[best]
        return places, ways


def nearest_on(target: Target, points: Floats) -> Floats:
    """Return points of a target near points float[P, 3]: float[P, 3].

    >>> nearest_on(Formula("x**2 + y**2 + z**2 - 4"), np.array([[2.5, 0.0, 0.0]])).round(9).tolist()
    [[2.0, 0.0, 0.0]]
    """
    there = np.array(points, dtype=float)
    for _ in range(_ROUNDS):
        off, slopes = target.missed(there)
        there -= np.stack([np.linalg.lstsq(by, one, rcond=None)[0] for by, one in zip(slopes, off, strict=True)])
    return there


def beside_target(sheet: Sheet, target: Target) -> Sheet:
    """Return a sheet together with its panels laid on the target, which are one panel: to be drawn.

    >>> square = Sheet(3, (), "", ((0, 1, 2),), ((0, 0, 0.5), (1, 0, 0.5), (0, 1, 0.5)))
    >>> beside_target(square, Formula("z")).coordinates[3:]
    ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    """
    count = sheet.vertices
    places = in_space(sheet.coordinates or ())
    both = np.concatenate([places, nearest_on(target, places)])
    return replace(
        sheet,
        vertices=2 * count,
        edges=(*sheet.edges, *((a + count, b + count) for a, b in sheet.edges)),
        assignments=sheet.assignments + "".join("B" if letter == "B" else "F" for letter in sheet.assignments),
        faces=(*sheet.faces, *(tuple(vertex + count for vertex in face) for face in sheet.faces)),
        coordinates=tuple(map(tuple, both.tolist())),
        fold_angles=None,
        frames=None,
        reading=None,
    )


def _nearest_of_triangles(point: Floats, a: Floats, b: Floats, c: Floats) -> Floats:
    """Return the nearest point of each triangle: inside, else on the nearest of its sides."""
    u, v, w = b - a, c - a, point - a
    uu, uv, vv = (u * u).sum(1), (u * v).sum(1), (v * v).sum(1)
    wu, wv = (w * u).sum(1), (w * v).sum(1)
    det = uu * vv - uv * uv
    s, t = (
        np.divide(x, det, out=np.full_like(det, -1.0), where=det > 0.0) for x in (wu * vv - wv * uv, wv * uu - wu * uv)
    )
    inside = (s >= 0.0) & (t >= 0.0) & (s + t <= 1.0)
    best = a + s[:, None] * u + t[:, None] * v
    sides = []
    for start, end in ((a, b), (b, c), (c, a)):
        along = end - start
        square = (along * along).sum(1)
        part = np.clip(((point - start) * along).sum(1) / np.where(square > 0.0, square, 1.0), 0.0, 1.0)
        sides.append(start + part[:, None] * along)
    every = np.stack(sides)
    nearest = np.linalg.norm(every - point, axis=2).argmin(axis=0)
    return np.asarray(np.where(inside[:, None], best, every[nearest, np.arange(len(a))]))


def read_mesh(path: str | Path) -> Mesh:
    """Return the surface of a file: .stl, or .obj and other files of panels.

    Parameters
    ----------
    path : str or Path

    Raises
    ------
    FileError
        If it cannot be read.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder, "floor.stl")
    ...     _ = path.write_text("solid floor facet outer loop vertex 0 0 0 vertex 4 0 0 vertex 0 4 0 endloop endfacet")
    ...     read_mesh(path).triangles.shape
    (1, 3, 3)
    """
    path = Path(path)
    if path.suffix.lower() == ".stl":
        return Mesh(path.name, _stl_triangles(path))
    sheet = sheet_of(read(path))
    if sheet is None or sheet.coordinates is None:
        raise FileError(path, "", "no panels with coordinates", "a surface")
    corners = in_space(sheet.coordinates)
    triangles = [(face[0], face[i], face[i + 1]) for face in sheet.faces for i in range(1, len(face) - 1)]
    return Mesh(path.name, corners[np.array(triangles)])


_HEADER, _FACET = 84, 50


def _stl_triangles(path: Path) -> Floats:
    try:
        data = path.read_bytes()
    except OSError as error:
        raise FileError(path, "", f"cannot be read: {error.strerror}", "an .stl file") from None
    if data[:5] == b"solid" and b"vertex" in data:
        words = data.decode("ascii", "replace").split()
        try:
            corners = [float(x) for i, word in enumerate(words) if word == "vertex" for x in words[i + 1 : i + 4]]
            triangles = np.array(corners).reshape(-1, 3, 3)
        except ValueError:
            raise FileError(path, "", "a facet that is not three vertices", "an .stl file") from None
    else:
        count = int.from_bytes(data[_HEADER - 4 : _HEADER], "little") if len(data) >= _HEADER else 0
        if not count or len(data) < _HEADER + _FACET * count:
            raise FileError(path, "", "not an .stl file", "facets")
        kind = np.dtype([("numbers", "<f4", (4, 3)), ("rest", "<u2")])
        triangles = np.frombuffer(data, kind, count, _HEADER)["numbers"][:, 1:].astype(float)
    if not len(triangles) or not np.isfinite(triangles).all():
        raise FileError(path, "", "no facets, or numbers that are not finite", "a surface")
    return np.asarray(triangles)
