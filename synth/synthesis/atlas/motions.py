"""The table of motions of an atlas: random members of each chain, and the search for those that move like a motion.

Rotations of links depend on the directions of axes alone. So all SC graphs of one chain without spatial and planar
loops share their motions, wherever their centres are, and members are taken of chains, as spherical linkages: axes
and a point of each link are random directions. Of each circuit the table has the signatures
(`synth.synthesis.atlas.signatures`) of all pairs of links that share no joint, and of the paths of points of one link
on the other.

The table ``motions`` has a row for each unit of members, its arrays as blobs that end with a checksum. A search
reads one kind of array of all units, one after the other, and keeps the nearest; so it needs little memory. They are
traced anew and compared exactly. Theory: docs/theory/atlas.md.
"""

from __future__ import annotations

import heapq
import sqlite3
import zlib
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass
from itertools import combinations, permutations
from math import degrees
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from enumerate.runner.store_units import naming, reading
from graphs.errors import FileError, InvariantError, StoreError, UnsolvableError, numbered, shown
from graphs.files.formats import mechanism_of_id, read
from graphs.files.native import holds_orientations
from graphs.files.text import read_text
from graphs.geometry import rigid_motion, unit
from graphs.joints.linkage import Vector, plain_vector
from graphs.mechanism.precision import in_space
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.plain_data import fields_to_json
from graphs.printing import Block, Printed, TableBlock, plain
from graphs.types import Floats, JointId, LinkId
from synth.analysis.members.circuits import MemberCircuits, circuits_of, product, relative, spherical_of
from synth.linkages.guidance.orientations import Orientations, read_orientations
from synth.synthesis.atlas.atlas_file import Atlas
from synth.synthesis.atlas.axis_fit import AxisFit
from synth.synthesis.atlas.in_order import QUICK, differences_in_order
from synth.synthesis.atlas.signatures import (
    CIRCUIT,
    FEW,
    NO_SPANS,
    ROUND,
    SPANS,
    MotionCurve,
    Signatures,
    arc_distances,
    difference,
    joined,
    nearest,
    signatures_of,
)

_VERSION = 1
"""Version of the table, and of what its numbers mean."""
_UNIT = 256
"""Members of a unit: a row of the table."""
_CANDIDATES, _OF_FEW, _MOST_SINGLE = 32, 1000, 24
"""Candidates by signature that are compared exactly; those that are first compared roughly with single orientations or
points; most of these."""
_STAGES = ((8, 1, 1), (20, 3, 10), (100, 10, 5))
"""Steps of a fit, with which part of the candidates of a chain, and with how many at least."""
_NOWHERE, _UNLIKE = 100.0, 10.0
"""Distances beyond are those of motions that have no signature; distance of other motions that hold no such arc."""
_FIRST, _AT_ONCE = 1 << 12, 1 << 16
"""Signatures of the first block, whose nearest ones bound which others are looked at; and of the largest ones."""
_TRIED = "try `synth atlas motions ATLAS.sqlite`"


class _Pair(NamedTuple):
    """Two links that share no joint: the motion of the second against the first, or the path of a point of it."""

    first: LinkId
    second: LinkId


def _pairs(chain: SCGraph, *, points: bool) -> list[_Pair]:
    """Return the pairs of links without a common joint; for points in both orders."""
    chosen = permutations(chain.nodes, 2) if points else combinations(chain.nodes, 2)
    return [_Pair(first, second) for first, second in chosen if not chain.has_edge(first, second)]


@dataclass(frozen=True, slots=True)
class AtlasMotions(Printed):
    """What a table of motions holds, or will hold.

    Attributes
    ----------
    chains : tuple of str
        Ids of the chains of which there are members.
    members, motions, paths : int
        Members of all chains; relative motions of two links; paths of points.
    megabytes : float
        Size of the arrays in the file.
    """

    chains: tuple[str, ...]
    members: int
    motions: int
    paths: int
    megabytes: float

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on."""
        return fields_to_json(self, megabytes=round(self.megabytes, 2))

    def blocks(self) -> list[Block]:
        """Return the line that is printed."""
        of = f"{numbered(self.members, 'member')} of {numbered(len(self.chains), 'chain')}"
        return [
            f"{of}: {numbered(self.motions, 'motion')} of two links, {numbered(self.paths, 'path')} of points, "
            f"{self.megabytes:.1f} MB"
        ]


_BYTES = 4 * (CIRCUIT + ROUND * len(SPANS))


def planned_motions(atlas: Atlas, members: int, *, max_links: int = 8) -> AtlasMotions:
    """Return what `add_motions` will store, before it starts, if all circuits close."""
    chains = _chains(atlas, max_links)
    table = AtlasMotions((), 0, 0, 0, 0.0)
    for code in chains:
        chain = mechanism_of_id(code)
        motions, paths = len(_pairs(chain, points=False)), len(_pairs(chain, points=True))
        size = members * (_BYTES * (motions + paths) + 24 * (len(chain) + len(chain.joints)))
        table = AtlasMotions(
            chains, table.members + members, table.motions + members * motions, table.paths + members * paths,
            table.megabytes + size / 1e6,
        )  # fmt: skip
    return table


def add_motions(
    atlas: Atlas,
    *,
    members: int = 1000,
    max_links: int = 8,
    seed: int = 0,
    force: bool = False,
    report: Callable[[int], None] | None = None,
) -> AtlasMotions:
    """Add the motions of random members of each chain to an atlas, or continue a table that is not complete.

    Parameters
    ----------
    atlas : Atlas
        Its chains with one degree of freedom are taken; those with no SC graph in the atlas too.
    members : int, optional
        Of each chain. Members whose circuit does not close are left out.
    max_links : int, optional
        Largest number of links of a chain.
    seed : int, optional
        Random seed of the axes and points.
    force : bool, optional
        Replace the motions of another seed.
    report : callable, optional
        Called with the number of members that are done.

    Returns
    -------
    AtlasMotions

    Raises
    ------
    StoreError
        If the atlas cannot be written, or has motions of another seed.
    UnsolvableError
        If it has no such chains.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from synth.synthesis.atlas import AtlasPlan, build_atlas, open_atlas
    >>> with TemporaryDirectory() as folder:
    ...     _ = build_atlas(f"{folder}/a.sqlite", AtlasPlan(4, creases=0, orders_of=(), realised=False))
    ...     table = add_motions(open_atlas(f"{folder}/a.sqlite"), members=20)
    >>> table.members, table.motions
    (20, 40)
    """
    if members < 1:
        raise InvariantError("motions", numbered(members, "member"), "1 or more")
    chains = _chains(atlas, max_links)
    if not chains:
        raise UnsolvableError(f"the atlas has no chain with 1 degree of freedom and at most {max_links} links")
    done = 0
    with naming(atlas.path), closing(sqlite3.connect(atlas.path, isolation_level=None)) as connection:
        _make_table(connection, atlas.path, seed, force=force)
        for code in chains:
            chain = mechanism_of_id(code)
            for number, first in enumerate(range(0, members, _UNIT)):
                count = min(_UNIT, members - first)
                query = "SELECT wanted FROM motions WHERE chain = ? AND unit = ?"
                there = connection.execute(query, (code, number)).fetchone()
                if there is None or there[0] < count:
                    row = _unit_row(chain, code, number, count, seed)
                    connection.execute("INSERT OR REPLACE INTO motions VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)", row)
                done += count
                if report is not None:
                    report(done)
    return stored_motions(atlas)


def _chains(atlas: Atlas, max_links: int) -> tuple[str, ...]:
    rows = atlas.query(f"kind = 'chain' AND dof = 1 AND links <= {int(max_links)}", columns=["id"], limit=1_000_000)
    return tuple(row["id"] for row in rows)


def _make_table(connection: sqlite3.Connection, path: Path, seed: int, *, force: bool) -> None:
    connection.execute(
        "CREATE TABLE IF NOT EXISTS motions (chain TEXT, unit INTEGER, version INTEGER, seed INTEGER, wanted INTEGER, "
        "axes BLOB, motion_circuits BLOB, motion_spans BLOB, path_circuits BLOB, path_spans BLOB, "
        "PRIMARY KEY (chain, unit))"
    )
    other = connection.execute(
        "SELECT version, seed FROM motions WHERE version <> ? OR seed <> ? LIMIT 1", (_VERSION, seed)
    ).fetchone()
    if other is None:
        return
    if not force:
        what = f"has motions of version {shown(other[0])} and seed {shown(other[1])}"
        raise StoreError(f"{plain(path, 4096)}: {what}; expected version {_VERSION} and seed {seed}; try --force")
    connection.execute("DELETE FROM motions")


def _unit_row(chain: SCGraph, code: str, number: int, count: int, seed: int) -> tuple[Any, ...]:
    """Return the row of the table with members that are drawn by the seed, the chain and the number of the unit."""
    joints = len(chain.joints)
    random = np.random.default_rng([seed, zlib.crc32(code.encode()), number])
    directions = unit(random.normal(size=(_UNIT, joints + len(chain), 3))[:count])
    circuits = circuits_of(chain, directions[:, :joints])
    kept = circuits.closed
    rotations = MemberCircuits(circuits.chain, circuits.axes[kept], circuits.angles[kept], kept[kept]).rotations()
    arrays: list[npt.NDArray[Any]] = [directions[kept]]
    for points in (False, True):
        pairs = _pairs(chain, points=points)
        rows = np.stack([_curve(chain, rotations, pair, directions[kept], points=points) for pair in pairs], axis=1)
        arrays += signatures_of(rows.reshape(-1, *rows.shape[2:]))
    return (code, number, _VERSION, seed, count, *map(_blob, arrays))


def _curve(chain: SCGraph, rotations: dict[LinkId, Floats], pair: _Pair, directions: Floats, *, points: bool) -> Floats:
    """Return the motion of the second link against the first, float[n, M, 4], or the path of its point, [n, M, 3]."""
    turns = relative(rotations[pair.first], rotations[pair.second])
    if not points:
        return turns
    point = directions[:, len(chain.joints) + list(chain.nodes).index(pair.second)]
    still = np.concatenate([np.zeros((len(point), 1)), point], axis=1)[:, None]
    return product(product(turns, np.broadcast_to(still, turns.shape)), turns * [1.0, -1.0, -1.0, -1.0])[..., 1:]


def _blob(array: npt.NDArray[Any]) -> bytes:
    content = np.ascontiguousarray(array).tobytes()
    return content + zlib.crc32(content).to_bytes(4, "little")


def _array(path: Path, blob: object, kind: type, shape: tuple[int, ...]) -> npt.NDArray[Any]:
    """Return an array of a blob; StoreError if it is not as it was written."""
    if isinstance(blob, bytes) and len(blob) >= 4:
        content = memoryview(blob)[:-4]
        size = np.dtype(kind).itemsize * int(np.prod(shape[1:]))
        if len(content) % size == 0 and zlib.crc32(content) == int.from_bytes(blob[-4:], "little"):
            return np.frombuffer(content, kind).reshape(-1, *shape[1:])
    raise StoreError(f"{plain(path, 4096)}: the table of motions is damaged; try synth atlas motions --force")


def stored_motions(atlas: Atlas) -> AtlasMotions:
    """Return what the table of motions of an atlas holds; StoreError, with what to do, if there is none."""
    chains: dict[str, SCGraph] = {}
    members = motions = paths = size = 0
    with reading(atlas.path) as connection:
        _check_table(connection, atlas.path)
        lengths = " + ".join(
            f"length({name})" for name in ("axes", "motion_circuits", "motion_spans", "path_circuits", "path_spans")
        )
        for code, length, whole in connection.execute(f"SELECT chain, length(axes), {lengths} FROM motions"):
            chain = chains.setdefault(code, mechanism_of_id(code))
            count = length // (24 * (len(chain) + len(chain.joints)))
            members += count
            motions += count * len(_pairs(chain, points=False))
            paths += count * len(_pairs(chain, points=True))
            size += whole
    return AtlasMotions(tuple(chains), members, motions, paths, size / 1e6)


def _check_table(connection: sqlite3.Connection, path: Path) -> None:
    there = connection.execute("SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = 'motions'").fetchone()
    version = connection.execute("SELECT version FROM motions LIMIT 1").fetchone() if there else None
    if version is None:
        raise StoreError(f"{plain(path, 4096)}: the atlas has no table of motions; {_TRIED}")
    if version[0] != _VERSION:
        what = f"the table of motions has version {shown(version[0])}; expected {_VERSION}; {_TRIED} --force"
        raise StoreError(f"{plain(path, 4096)}: {what}")


@dataclass(frozen=True, slots=True, eq=False)
class NearMotion:
    """A member of a chain that moves like a motion.

    Attributes
    ----------
    distance : float
        Root mean square of differences of relative angles, radians (`synth.synthesis.atlas.signatures.difference`;
        for single orientations or points `differences_in_order`).
    chain, name : str, str or None
        Id of the chain, and its name in the literature.
    types : tuple of str
        Ids of the SC graphs of the atlas with this chain whose loops all have a finite centre.
    links : tuple of two link ids
        The motion is that of the second against the first.
    axes : mapping of joint id to 3 floats
        Directions, where the member was drawn, or as they were fitted.
    point : tuple of 3 floats, optional
        Direction of the point of the second link whose path was compared.
    """

    distance: float
    chain: str
    name: str | None
    types: tuple[str, ...]
    links: tuple[LinkId, LinkId]
    axes: dict[JointId, Vector]
    point: Vector | None

    @property
    def linkage(self) -> HingedSolids:
        """The member as a linkage about a centre, as `synth.design` takes it."""
        chain = spherical_of(mechanism_of_id(self.chain))
        return HingedSolids(chain, {joint: ((0.0, 0.0, 0.0), axis) for joint, axis in self.axes.items()})

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "distance_deg": degrees(self.distance), "chain": self.chain, "name": self.name, "types": list(self.types),
            "links": list(self.links),
            "axes": [{"joint": joint, "direction": list(axis)} for joint, axis in self.axes.items()],
            "point": None if self.point is None else list(self.point),
        }  # fmt: skip


@dataclass(frozen=True, slots=True, eq=False)
class NearMotions(Printed):
    """The members of an atlas that move most like a motion.

    Attributes
    ----------
    motion : MotionCurve
    rows : tuple of NearMotion
        Nearest first.
    compared : int
        Number of signatures.
    sparse : bool
        Whether the rows of the motion were compared as single orientations or points in order.
    fitted : int
        Number of members whose axes were changed to move more like the motion.
    """

    motion: MotionCurve
    rows: tuple[NearMotion, ...]
    compared: int
    sparse: bool = False
    fitted: int = 0

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on."""
        return {
            "motion": {
                "of": "two links" if self.motion.rotates else "a point", "closed": self.motion.closed,
                "length_deg": None if self.sparse else degrees(self.motion.length),
                "in_order": len(self.motion.rows) if self.sparse else None,
            },
            "compared": self.compared,
            "fitted": self.fitted,
            "nearest": [row.to_json() for row in self.rows],
        }  # fmt: skip

    def blocks(self) -> list[Block]:
        """Return the lines and the table that are printed."""
        kind = "a circuit" if self.motion.closed else "an arc"
        of = "the motion of two links" if self.motion.rotates else "the path of a point"
        along = f"{of} is {kind} of {degrees(self.motion.length):.1f}°, compared with {self.compared} of the atlas"
        if self.sparse:
            of = numbered(len(self.motion.rows), "orientation" if self.motion.rotates else "point")
            some = f"{_OF_FEW} of " if self.compared > _OF_FEW else ""
            along = f"{of} in order on one circuit, compared with {some}{self.compared} motions of the atlas"
        along += f"; the axes of {numbered(self.fitted, 'member')} were fitted to it" if self.fitted else ""
        if not self.rows:
            return [f"no member of the atlas moves so far: {along}"]
        best = self.rows[0]
        first = f"nearest: {best.name or best.chain}, {degrees(best.distance):.3g}° off (root mean square); {along}"
        table = [
            (f"{degrees(row.distance):.3g}", row.chain, row.name or "", ",".join(map(str, row.links)),
             " ".join(row.types))
            for row in self.rows
        ]  # fmt: skip
        return [first, TableBlock(("degrees off", "chain", "name", "links", "SC graphs"), table, ["degrees off"])]


MotionLike: TypeAlias = str | Path | Sheet | Orientations | MotionCurve


def like(
    atlas: Atlas,
    motion: MotionLike | npt.ArrayLike,
    *,
    links: Sequence[int] = (),
    closed: bool | None = None,
    sparse: bool | None = None,
    limit: int = 10,
    fit: int = 0,
) -> NearMotions:
    """Find the members in the table of motions of an atlas that move most like a motion, as starts for design.

    Parameters
    ----------
    atlas : Atlas
        With a table of motions (`add_motions`).
    motion : path, Sheet, Orientations, MotionCurve or array
        A FOLD file or sheet with frames; orientations of one link in the frame of another, or quaternions
        float[n, 4], scalar first; the path of a point on a sphere, float[n, 3]; poses of two links, float[n, 8],
        quaternions of both. Frames of reference, direction and speed have no meaning.
    links : sequence of two int, optional
        The faces of a sheet, numbered from 0, whose motion against each other it is; required for a sheet.
    closed : bool, optional
        Whether the motion is a circuit; by default if its last row is its first one again. An arc of a third of a
        circuit or more is found in it.
    sparse : bool, optional
        Whether the rows are single orientations or points that a circuit is to pass in order, at most 24, and no
        frames of one motion; by default if they are fewer than 12, and `closed` is not stated.
    limit : int, optional
        Largest number of members.
    fit : int, optional
        Number of members, nearest by signature, whose axes are changed until they move more like the motion: all a
        few steps, the best of them further, and the best of these until no step makes them better. Of two links only.

    Returns
    -------
    NearMotions
        Of the 32 members nearest by signature, or those that were fitted, those that differ least; each pair of links
        of a member is one. With single orientations or points those of 1000, roughly compared.

    Raises
    ------
    StoreError
        If the atlas has no table of motions.
    InvariantError
        If there are fewer than three different rows, more than 24 that are sparse, no such faces, or members are to
        be fitted to a path of a point or to single orientations.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from synth.synthesis.atlas import AtlasPlan, add_motions, build_atlas, open_atlas
    >>> half = np.linspace(0, 0.5, 20)[:, None]
    >>> turning = np.hstack([np.cos(half), 0 * half, 0 * half, np.sin(half)])
    >>> with TemporaryDirectory() as folder:
    ...     _ = build_atlas(f"{folder}/a.sqlite", AtlasPlan(4, creases=0, orders_of=(), realised=False))
    ...     _ = add_motions(open_atlas(f"{folder}/a.sqlite"), members=20)
    ...     members = like(open_atlas(f"{folder}/a.sqlite"), turning)
    >>> members.rows[0].name, members.compared
    ('four-bar chain', 40)
    """
    curve = motion_curve(motion, links=links, closed=closed)
    if sparse is None:
        sparse = closed is None and len(curve.rows) < FEW
    if fit and (sparse or not curve.rotates):
        what = "single orientations" if curve.rotates else "the path of a point"
        raise InvariantError("fit", what, "a motion of two links")
    if sparse and len(curve.rows) > _MOST_SINGLE:
        raise InvariantError("motion", f"{len(curve.rows)} rows that are sparse", f"at most {_MOST_SINGLE}")
    with reading(atlas.path) as connection:
        _check_table(connection, atlas.path)
        most = fit or (_OF_FEW if sparse else _CANDIDATES)
        best, compared = _candidates(atlas.path, connection, curve, most, sparse=sparse)
        traced = _traced(atlas.path, connection, curve, best, fit=bool(fit))
    if sparse and traced:
        circuits = np.stack([one.rows for one in traced])
        few = np.argsort(differences_in_order(circuits, curve.rows, QUICK)[0], kind="stable")[:_CANDIDATES]
        traced, off = [traced[place] for place in few], differences_in_order(circuits[few], curve.rows)[0].tolist()
    else:
        off = [difference(curve, MotionCurve.of(one.rows, closed=True, even=True)) for one in traced]
    near = _near_motions(atlas, curve, traced, off)[:limit]
    return NearMotions(curve, near, compared, sparse, len(best) if fit else 0)


def _candidates(
    path: Path, connection: sqlite3.Connection, curve: MotionCurve, most: int, *, sparse: bool
) -> tuple[list[_Candidate], int]:
    """Return the motions that are nearest by signature, a number of them at most, and the number of signatures.

    Single orientations or points are joined by a spline: that says little, so many are taken, of small tables all.
    """
    best: list[_Candidate] = []
    compared, goals = 0, [] if curve.closed else curve.goals()
    for units, signatures in _blocks(path, connection, "motion" if curve.rotates else "path", arcs=not curve.closed):
        if curve.closed:
            distances = nearest(signatures.circuits, curve.circuit_numbers()[None])
        else:
            distances = arc_distances(signatures, goals, best[-1].distance if len(best) == most else np.inf)
        if sparse:
            distances = np.where(signatures.circuits[:, 0] < _NOWHERE, np.minimum(distances, _UNLIKE), np.inf)
        compared += len(distances)
        few = np.argsort(distances, kind="stable")[:most]
        first = np.cumsum([0, *(count for _, _, count in units)])
        for place in few[distances[few] < _NOWHERE].tolist():
            unit_of_it = int(np.searchsorted(first, place, side="right")) - 1
            code, number, _ = units[unit_of_it]
            best.append(_Candidate(float(distances[place]), code, number, place - int(first[unit_of_it])))
        best = heapq.nsmallest(most, best)
    return best, compared


class _Candidate(NamedTuple):
    """A signature: its distance, the chain and the number of its unit, and its place there."""

    distance: float
    chain: str
    unit: int
    place: int


_Unit = tuple[str, int, int]
"""The chain and the number of a unit, and how many signatures it has."""


def _blocks(
    path: Path, connection: sqlite3.Connection, kind: str, *, arcs: bool
) -> Iterator[tuple[list[_Unit], Signatures]]:
    """Yield the signatures of all units, some units at a time, with spans for arcs; the next ones take their memory."""
    units: list[_Unit] = []
    arrays: list[Signatures] = []
    memory = [np.zeros((0, CIRCUIT), np.float32), NO_SPANS]
    most = _FIRST
    spans_of = f"{kind}_spans" if arcs else "NULL"
    query = f"SELECT chain, unit, {kind}_circuits, {spans_of} FROM motions ORDER BY chain, unit"
    for code, number, circuits, spans in connection.execute(query):
        own = _array(path, circuits, np.float32, (-1, CIRCUIT))
        arrays.append(Signatures(own, _array(path, spans, np.float32, (-1, ROUND, len(SPANS))) if arcs else NO_SPANS))
        units.append((code, number, len(own)))
        if sum(count for _, _, count in units) >= most:
            yield units, joined(arrays, memory)
            units, arrays, most = [], [], min(4 * most, _AT_ONCE)
    if units:
        yield units, joined(arrays, memory)


class _Traced(NamedTuple):
    """A candidate: its chain and links, directions float[J + N, 3] of axes and points, its circuit float[M, d]."""

    chain: SCGraph
    code: str
    pair: _Pair
    directions: Floats
    rows: Floats


def _traced(
    path: Path, connection: sqlite3.Connection, curve: MotionCurve, best: Sequence[_Candidate], *, fit: bool
) -> list[_Traced]:
    """Return the circuits of candidates, traced anew, fitted to the motion or not, each member once."""
    traced = []
    for code in dict.fromkeys(candidate.chain for candidate in best):
        chain = mechanism_of_id(code)
        pairs = _pairs(chain, points=not curve.rotates)
        places = [(each.unit, *divmod(each.place, len(pairs))) for each in best if each.chain == code]
        shape = (-1, len(chain.joints) + len(chain), 3)
        query = "SELECT axes FROM motions WHERE chain = ? AND unit = ?"
        units = {
            number: _array(path, connection.execute(query, (code, number)).fetchone()[0], float, shape)
            for number in {number for number, _, _ in places}
        }
        sources: list[tuple[int, ...]] = [place if fit else place[:2] for place in places]  # fitted for each pair
        members = {source: place for place, source in enumerate(dict.fromkeys(sources))}
        directions = np.stack([units[source[0]][source[1]] for source in members])
        axes = directions[:, : len(chain.joints)]
        if fit:
            search = AxisFit(chain, axes, [pairs[source[2]] for source in members], curve)
            search.run([(steps, max(least, len(members) // part)) for steps, part, least in _STAGES])
            axes[:] = search.axes
        circuits = circuits_of(chain, axes)
        rotations = circuits.rotations()
        for source, (_, _, which) in zip(sources, places, strict=True):
            place = members[source]
            if circuits.closed[place]:
                turned = {link: rotations[link][[place]] for link in pairs[which]}
                rows = _curve(chain, turned, pairs[which], directions[[place]], points=not curve.rotates)[0]
                traced.append(_Traced(chain, code, pairs[which], directions[place], rows))
    return traced


def _near_motions(
    atlas: Atlas, curve: MotionCurve, traced: Sequence[_Traced], off: Sequence[float]
) -> tuple[NearMotion, ...]:
    """Return candidates in the order in which they differ from a motion; those that do not move so far are left out."""
    named = {code: _named(atlas, code) for code in dict.fromkeys(one.code for one in traced)}
    rows = []
    for one, distance in zip(traced, off, strict=True):
        if not np.isfinite(distance):
            continue
        axes = dict(zip(one.chain.joints, map(plain_vector, one.directions), strict=False))  # points follow the axes
        place = len(one.chain.joints) + list(one.chain).index(one.pair.second)
        point = None if curve.rotates else plain_vector(one.directions[place])
        links = (one.pair.first, one.pair.second)
        rows.append(NearMotion(float(distance), one.code, *named[one.code], links, axes, point))
    return tuple(sorted(rows, key=lambda row: (round(row.distance, 9), len(row.axes), row.chain)))


def _named(atlas: Atlas, code: str) -> tuple[str | None, tuple[str, ...]]:
    """Return the name of a chain, and the ids of SC graphs that have it and move as its spherical linkage."""
    quoted = code.replace("'", "''")
    chain = atlas.query(f"id = '{quoted}'", columns=["name"]).rows
    kinds = f"kind = 'sc' AND chain_id = '{quoted}' AND spatial = 0 AND infinite = 0"
    types = atlas.query(kinds, columns=["id"]).rows
    return (chain[0]["name"] if chain else None), tuple(row["id"] for row in types)


def motion_curve(
    motion: MotionLike | npt.ArrayLike, *, links: Sequence[int] = (), closed: bool | None = None
) -> MotionCurve:
    """Return what `like` compares: the curve of a file, a sheet with frames, orientations or an array."""
    if isinstance(motion, MotionCurve):
        return motion
    if isinstance(motion, Orientations):
        return MotionCurve.of(motion.quaternions, closed=closed)
    if isinstance(motion, Sheet):
        return MotionCurve.of(_of_frames(motion, links), closed=closed)
    if isinstance(motion, str | Path):
        path = Path(motion)
        try:
            return MotionCurve.of(_rows_of_file(path, links), closed=closed)
        except InvariantError as error:
            raise FileError(path, "", error.offender, error.expected) from None
    rows = np.asarray(motion, dtype=float)
    return MotionCurve.of(_of_two(rows) if rows.ndim == 2 else rows, closed=closed)


def _rows_of_file(path: Path, links: Sequence[int]) -> Floats:
    if holds_orientations(path):
        return read_orientations(path).quaternions
    if path.suffix.lower() in (".csv", ".txt"):
        return _of_two(_table_of(path))
    mechanism = read(path)
    if not isinstance(mechanism, Sheet):
        expected = "FOLD with frames, JSON of orientations, or CSV of 3, 4 or 8 numbers a row"
        raise FileError(path, "", "the file holds no motion", expected)
    return _of_frames(mechanism, links)


def _table_of(path: Path) -> Floats:
    """Return the numbers of a table, parted by commas, semicolons or spaces; a line of words may head it."""
    rows: list[list[float]] = []
    for number, line in enumerate(read_text(path).splitlines(), start=1):
        words = line.partition("#")[0].replace(",", " ").replace(";", " ").split()
        try:
            values = list(map(float, words))
        except ValueError:
            if rows or number > 1:
                raise FileError(path, f"line {number}", f"{shown(line[:40])} is no row of numbers", "numbers") from None
            continue
        if values and (len(values) not in (3, 4, 8) or (rows and len(values) != len(rows[0]))):
            expected = "3 (a point), 4 (a quaternion) or 8 (two quaternions), as many in each row"
            raise FileError(path, f"line {number}", numbered(len(values), "number"), expected)
        rows += [values] * bool(values)
    return np.array(rows, dtype=float).reshape(len(rows), -1)


def _of_two(rows: Floats) -> Floats:
    """Return the orientations of a second link in the frame of a first one, of rows of two quaternions."""
    return relative(unit(rows[:, :4]), unit(rows[:, 4:])) if rows.shape[1] == 8 else rows


def _of_frames(sheet: Sheet, links: Sequence[int]) -> Floats:
    """Return the rotations of a face against another in the frames of a sheet, as quaternions float[n, 4].

    The key frame, which is the pattern or repeats one of the others, is left out.
    """
    from scipy.spatial.transform import Rotation

    if len(links) != 2 or links[0] == links[1] or not all(0 <= link < len(sheet.faces) for link in links):
        what = f"links {', '.join(map(str, links))}" if links else "no links"
        expected = f"two different faces from 0 to {len(sheet.faces) - 1}, by links (--links A,B)"
        raise InvariantError("links", what, expected)
    if sheet.frames is None or not sheet.frames.others:
        raise InvariantError("frames", "the sheet has no frames", "a FOLD file with frames, as synth fold writes")
    frames = [sheet.frames.frame(number) for number in range(1, sheet.frames.others + 1)]
    places = np.array([in_space(frame.coordinates) for frame in frames if frame.coordinates is not None])
    turns = [rigid_motion(places[0][list(sheet.faces[link])], places[:, list(sheet.faces[link])])[0] for link in links]
    between = np.swapaxes(turns[0], -1, -2) @ turns[1]
    return np.asarray(Rotation.from_matrix(between).as_quat(scalar_first=True))
