"""SC graphs: every planar chain, drawn on the sphere in every way, with every outer face; rows, forms, numbers.

A drawn chain is a contracted map (`enumerate.contracted.maps`) with binary links on its joints
(`enumerate.contracted.binary_links`); the bounded faces are its loops, with centres as general as the joints
allow. Work grows with the number of SC graphs. Numbers are found in two ways. The most general form of a chain is
the SC graph with the most centres: Watt's chain has two, Stephenson's one. Theory: docs/theory/sc-enumeration.md.

Source: Wiener 2016, sections 3.3 and 6.4, which names an exhaustive type synthesis as the use of SC graphs.
"""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import repeat
from string import ascii_letters
from typing import Any, Literal, Unpack

import numpy as np

from enumerate.chains.jobs import beginnings
from enumerate.chains.names import name_of
from enumerate.chains.rows import SIZE_COLUMNS, assortment_of, chain_ids
from enumerate.contracted.binary_links import EVERY, PlacementRange
from enumerate.contracted.graphs import graph_key
from enumerate.contracted.maps import contracted_maps, joint_matrix, outer_faces
from enumerate.kernel.maps import END, JOINT, OPEN, decode_map
from enumerate.machine_code.weights import drawing, placing
from enumerate.runner import job
from enumerate.runner._run import graphs_of, rows_of, total_of
from enumerate.sc import listing
from enumerate.sc.query import SCOptions, SCQuery
from graphs.arguments import keywords_checked
from graphs.errors import UnsolvableError
from graphs.identity.drawings import map_text, mechanism_from_map_id
from graphs.mechanism.sc import SCGraph
from graphs.types import Bytes, Ints

CENTRE_COLUMNS: dict[str, job.Column] = dict.fromkeys(("spatial", "centres", "infinite"), int)
SC_COLUMNS: dict[str, job.Column] = {
    "code": str,
    "chain": str,
    **SIZE_COLUMNS,
    **CENTRE_COLUMNS,
    "assortment": job.ListColumn(","),
    "loop_sizes": job.ListColumn(","),
    "outer_size": int,
    "symmetry": int,
    "reduced": str,
    "exact_dof": int,
}


UNIT_ROWS = 20_000
"""SC graphs of a unit, about, where a job does not say otherwise: a unit is what a stopped run does again,
and costs one transaction of the store, so neither a few nor millions."""

_MAPS = 256
"""Maps of a unit of counting: as of chains, enough that sending a unit to a worker costs little beside it."""


@dataclass(frozen=True, slots=True)
class MapPart:
    """SC graphs of one contracted map and outer face that begin in one way; an empty code is a ring.

    Of the binary links, so many are first or second ones on their joints (`only`), and the first are on `prefix`.
    """

    code: Bytes
    n: int
    outer: int
    only: int = EVERY
    prefix: Ints = field(default_factory=lambda: np.zeros(0, np.int64))


Maps = tuple[MapPart, ...]


@dataclass(frozen=True, slots=True)
class DrawnChains:
    """SC graphs of a part.

    Binary links on each joint are uint8[r, m], labels of the faces int64[r, F] (`enumerate.kernel.centres`);
    `order` is the number of symmetries.
    """

    x: Bytes
    labels: Ints
    order: Ints


def drawn_of(query: SCQuery, part: MapPart) -> DrawnChains:
    """Return the SC graphs of a part that a query admits."""
    strings = PlacementRange(query.links, query.chains.most, part.only)
    centres = listing.Centres(query.dof, query.spatial, query.infinite)
    x, labels, order = listing.list_drawn(part.code, part.n, part.outer, strings, part.prefix, centres)
    admitted = query.symmetry.admitted(order)
    if len(part.code) and query.longest_string.least > 0:
        admitted &= x.max(axis=1, initial=0) >= query.longest_string.least
    if query.centres != job.ANY_NUMBER:
        admitted &= query.centres.admitted(listing.centres_of_all(part.code, part.n, query.links, x, labels))
    return DrawnChains(x[admitted], labels[admitted], order[admitted])


def _rows_of_maps(query: SCQuery, maps: Maps) -> list[job.Row]:
    return [row for part in maps for row in _rows(query, part, drawn_of(query, part))]


def _rows(query: SCQuery, part: MapPart, drawn: DrawnChains) -> list[job.Row]:
    """Return the rows of the SC graphs of a part; columns are `SC_COLUMNS`."""
    if not len(drawn.x):
        return []
    codes, joints, sizes, facts, left = listing.describe(
        part.code, part.n, query.links, part.outer, drawn.x, drawn.labels, not query.plain
    )
    ids = map_ids(codes, np.full(len(codes), codes.shape[1]), 0 if query.plain else drawn.labels.shape[1])
    chains, _ = chain_ids(query.links, joints)
    whole = (1 << query.chains.joints) - 1  # without ride-alongs, all joints are left: the chain itself
    reduced = [
        chain if mask == whole else _reduced(joints[i], mask)
        for i, (chain, mask) in enumerate(zip(chains, left.tolist(), strict=True))
    ]
    common = query.links, query.chains.joints, query.dof, query.loops, query.spatial
    assortment = assortment_of(Counter(np.bincount(joints[0].ravel()).tolist()))
    centres, infinite, exact = facts.T.tolist()
    loops, outer = map(tuple, np.sort(sizes[:, 1:], axis=1).tolist()), sizes[:, 0].tolist()
    columns = centres, infinite, repeat(assortment), loops, outer, drawn.order.tolist(), reduced, exact
    return list(zip(ids, chains, *map(repeat, common), *columns, strict=False))


def _reduced(joints: Ints, mask: int) -> str:
    """Return the id of the chain of the joints whose bits are set."""
    pairs = [pair for k, pair in enumerate(joints.tolist()) if mask >> k & 1]
    number: dict[int, int] = {}
    named = [[number.setdefault(link, len(number)) for link in pair] for pair in pairs]
    return chain_ids(len(number), np.array([named], np.int64))[0][0]


def maps_for(query: SCQuery) -> Iterator[tuple[int, Bytes]]:
    """Yield the contracted maps whose chains a query may admit, most links first."""
    if not query.possible or query.loops < 2:
        return
    for n, codes in contracted_maps(query.loops):
        if n > query.links:
            continue
        if query.assortment is None:
            yield n, codes
        else:
            yield n, codes[[_admits(query, code, n) for code in codes]]


def _admits(query: SCQuery, code: Bytes, n: int) -> bool:
    degrees = Counter(np.bincount(decode_map(code)[1], minlength=n).tolist())
    degrees[2] = query.links - n
    return query.chains.admits_assortment(degrees)


def map_units(query: SCQuery, size: int = UNIT_ROWS) -> Iterator[job.Unit]:
    """Yield units whose payloads are `Maps`; their weights are numbers of drawn chains, about ``size`` at most."""
    if query.possible and query.loops == 1:
        degrees = Counter({2: query.links})
        if query.links in query.longest_string and query.chains.admits_assortment(degrees):
            yield job.Unit((MapPart(np.zeros(0, np.uint8), 0, 0),))
    yield from job.packed(_parts(query, size), size)


def _parts(query: SCQuery, size: int) -> Iterator[tuple[MapPart, int]]:
    """Yield parts of no more than twice so many SC graphs, where it can be done, and their numbers."""
    for n, codes in maps_for(query):
        for code in codes:
            for outer in outer_faces(code).tolist():
                number = partial(_number_in, query, MapPart(code, n, outer))
                ways = beginnings(number, query.links - n, (len(code) - n) // 2, 2 * size)
                for only, prefix, count in ways:
                    yield MapPart(code, n, outer, only, prefix), count


def _number_in(query: SCQuery, part: MapPart, only: int, prefix: Ints) -> int:
    """Return the number of drawn chains of a part that begin in one way."""
    return int(listing.count_on_map(part.code, part.n, part.outer, query.links, query.chains.most, only, prefix))


@dataclass(frozen=True)
class SCJob(job.QueryJob[SCQuery]):
    """All SC graphs of a query, as rows.

    Attributes
    ----------
    query : SCQuery
    unit_rows : int
        SC graphs of a unit, about; a map with more is split.
    """

    unit_rows: int = UNIT_ROWS
    columns = SC_COLUMNS
    listed = "sc"

    def units(self) -> list[job.Unit]:
        """Units of some thousands of rows each."""
        return list(map_units(self.query, self.unit_rows))

    def work(self, payload: Maps) -> list[job.Row]:
        """Return the rows of a unit."""
        return _rows_of_maps(self.query, payload)

    def interpreted(self, weight: int) -> float:
        """Return about how many seconds the job takes with kernels interpreted, for so many drawn chains."""
        return placing(self.query.loops, self.query.dof) + drawing(weight, plain=self.query.plain)

    def number(self, payload: Maps) -> int:
        """Return the number of SC graphs of a unit, without their attributes."""
        return sum(len(drawn_of(self.query, part).x) for part in payload)


@dataclass(frozen=True)
class SCCountJob(job.QueryCount[SCQuery]):
    """The number of SC graphs, chosen only by what their chains show; rows are numbers to be added.

    Attributes
    ----------
    query : SCQuery
    method : {"orbits", "burnside"}
    outside : bool
        Whether an outer face is chosen; else embeddings in the sphere are counted.
    """

    outside: bool = True
    counted = "sc"

    @property
    def details(self) -> dict[str, Any]:
        """Whether an outer face is chosen."""
        return {"outside": self.outside}

    def units(self) -> Sequence[job.Unit]:
        """Units of some hundreds of maps each."""
        return [
            job.Unit((n, some), len(some)) for n, codes in maps_for(self.query) for some in job.batches(codes, _MAPS)
        ]

    def interpreted(self, weight: int) -> float:
        """Return about how many seconds the job takes with kernels interpreted, whatever its units weigh."""
        del weight
        return placing(self.query.loops, self.query.dof)

    def work(self, payload: tuple[int, Bytes]) -> list[job.Row]:
        """Return the number of SC graphs of a unit."""
        (n, codes), query = payload, self.query
        count = listing.count_drawn_by_burnside if self.method == "burnside" else listing.count_drawn
        return [(query.chains.number_within(lambda most: count(codes, n, query.links, most, self.outside)),)]


def sc_count_job(query: SCQuery, method: str = "orbits", *, outside: bool = True) -> SCCountJob | job.RowCount:
    """Return the job that counts the SC graphs of a query: its rows are numbers to be added.

    Parameters
    ----------
    query : SCQuery
    method : {"orbits", "burnside"}, optional
    outside : bool, optional
        Whether an outer face is chosen; else embeddings in the sphere are counted.

    Raises
    ------
    UnsolvableError
        If Burnside's lemma, or embeddings without an outer face, cannot be counted by all that the query limits.

    Examples
    --------
    >>> from enumerate.runner._run import total_of
    >>> [total_of(sc_count_job(SCQuery(6, 1), method)) for method in ("orbits", "burnside")]
    [4, 4]
    """
    if query.unfiltered and query.loops > 1:
        return SCCountJob(query, method, outside)
    if method == "burnside" and query.loops > 1:
        raise UnsolvableError(
            "Burnside's lemma cannot count by centres or symmetries, nor spatial loops or centres at infinity; "
            "try --method orbits"
        )
    if not outside and query.loops > 1:
        raise UnsolvableError("embeddings without an outer face have no centres by which to choose them")
    return job.RowCount(SCJob(query), {"count": "sc", **query.key})


_COLUMNS: dict[str, job.Column] = {
    "code": str,
    "chain": str,
    "name": str,
    **SIZE_COLUMNS,
    "assortment": job.ListColumn(","),
    "sc_graphs": int,
    "centres": int,
    "forms": int,
}
_CODE, _CHAIN, _CENTRES = (list(SC_COLUMNS).index(name) for name in ("code", "chain", "centres"))


@dataclass(frozen=True)
class FormJob(job.QueryJob[SCQuery]):
    """One row for each planar chain: how many SC graphs it has, and one with the most centres.

    ``centres`` of the query limits what counts as a form: chains without such SC graphs have no row.

    >>> [(row["name"], row["centres"]) for row in rows_of(FormJob(SCQuery(6, 1)))]
    [('watt', 2), ('stephenson', 1)]
    """

    columns = _COLUMNS
    listed = "sc forms"

    def units(self) -> Sequence[job.Unit]:
        """Units of whole contracted graphs: all drawings of a chain are in one."""
        rings = [job.Unit((unit.payload,), unit.weight) for unit in map_units(self.query) if self.query.loops == 1]
        return [*rings, *job.packed(self._graphs(), UNIT_ROWS)]

    def _graphs(self) -> Iterator[tuple[Maps, int]]:
        """Yield the maps of each contracted graph, with all their outer faces, and the number of SC graphs."""
        for n, codes in maps_for(self.query):
            graphs: dict[bytes, list[MapPart]] = {}
            for code in codes:
                parts = [MapPart(code, n, outer) for outer in outer_faces(code).tolist()]
                graphs.setdefault(graph_key(joint_matrix(code, n), n).tobytes(), []).extend(parts)
            for maps in graphs.values():
                count = sum(_number_in(self.query, part, part.only, part.prefix) for part in maps)
                if count:
                    yield tuple(maps), count

    def interpreted(self, weight: int) -> float:
        """Return about how many seconds the job takes with kernels interpreted, for so many drawn chains."""
        return placing(self.query.loops, self.query.dof) + drawing(weight, plain=self.query.plain)

    def work(self, payload: tuple[Maps, ...]) -> list[job.Row]:
        """Return the rows of a unit."""
        return [row for maps in payload for row in self._forms(maps)]

    def _forms(self, maps: Maps) -> list[job.Row]:
        """Return a row for each chain drawn in some maps."""
        chains: dict[str, list[job.Row]] = {}
        for row in _rows_of_maps(self.query, maps):
            chains.setdefault(row[_CHAIN], []).append(row)
        rows = []
        for chain, drawings in chains.items():
            most = max(row[_CENTRES] for row in drawings)
            forms = sorted(row[_CODE] for row in drawings if row[_CENTRES] == most)
            values = dict(zip(SC_COLUMNS, drawings[0], strict=True))
            values |= {"code": forms[0], "name": name_of(chain), "sc_graphs": len(drawings), "centres": most}
            values["forms"] = len(forms)
            rows.append(tuple(values[column] for column in _COLUMNS))
        return rows


@keywords_checked
def sc_graphs(links: int, dof: int, *, workers: int = 1, **options: Unpack[SCOptions]) -> Iterator[SCGraph]:
    """Yield all SC graphs of N links and M degrees of freedom, in a fixed order.

    Parameters
    ----------
    links, dof : int
        N >= 4 and M >= 1. N - 1 and M + 3 S must be both even or both odd, else there is none.
    workers : int
        Processes.
    **options
        Other fields of `SCQuery`, with its errors: ``spatial``, ``infinite``, ``centres``, ``symmetry``,
        ``assortment``, ``longest_string``.

    Yields
    ------
    SCGraph
        The loops are the bounded faces. Graph attributes hold the row of `sc_rows`.

    Examples
    --------
    >>> [len(sc.centre_classes()) for sc in sc_graphs(6, 1)]
    [2, 1, 1, 1]
    """
    yield from graphs_of(sc_rows(links, dof, workers=workers, **options), mechanism_from_map_id)


@keywords_checked
def sc_rows(links: int, dof: int, *, workers: int = 1, **options: Unpack[SCOptions]) -> Iterator[dict[str, Any]]:
    """Yield a dictionary for each SC graph.

    Keys: ``code`` (its id), ``chain`` (id of the link-joint graph), ``links``, ``joints``, ``dof``, ``loops``,
    ``spatial`` (loops without a centre), ``centres`` (classes), ``infinite`` (how many of them lie at infinity),
    ``assortment`` (numbers of binary, ternary, ... links), ``loop_sizes``, ``outer_size`` (joints round the
    faces), ``symmetry`` (their number), ``reduced`` (id of the chain without ride-alongs), ``exact_dof`` (joints
    minus rank).

    Parameters
    ----------
    links, dof, workers, **options
        As for `sc_graphs`.

    Examples
    --------
    >>> sorted((row["loop_sizes"], row["outer_size"]) for row in sc_rows(6, 1))
    [([4, 4], 6), ([4, 5], 5), ([4, 6], 4), ([5, 5], 4)]
    """
    yield from rows_of(SCJob(SCQuery(links, dof, **options)), workers=workers)


@keywords_checked
def count_sc_graphs(
    links: int,
    dof: int,
    method: Literal["orbits", "burnside"] = "orbits",
    *,
    outside: bool = True,
    workers: int = 1,
    **options: Unpack[SCOptions],
) -> int:
    """Return the number of SC graphs of N links and M degrees of freedom.

    Parameters
    ----------
    links, dof, **options
        As for `sc_graphs`.
    method : {"orbits", "burnside"}
        Two ways that share the contracted maps and the conditions of rigidity only. UnsolvableError as of
        `sc_count_job`.
    outside : bool
        Whether an outer face is chosen; without it, embeddings of the chains in the sphere are counted.
    workers : int
        Processes.

    Examples
    --------
    >>> [count_sc_graphs(links, 1) for links in (4, 6, 8, 10)]
    [1, 4, 54, 1564]
    >>> [count_sc_graphs(links, 1, "burnside", outside=False) for links in (4, 6, 8)]
    [1, 2, 20]
    """
    return total_of(sc_count_job(SCQuery(links, dof, **options), method, outside=outside), workers=workers)


LABEL_LETTERS = "ofis"
"""Letters of the labels of `enumerate.kernel.centres`."""

_LETTERS = np.full(256, ord("?"), np.uint8)
_LETTERS[[OPEN, END]] = np.frombuffer(b"-.", np.uint8)
_LETTERS[JOINT : JOINT + len(ascii_letters)] = np.frombuffer(ascii_letters.encode("ascii"), np.uint8)


def map_ids(codes: Bytes, lengths: Ints, labels: int) -> list[str]:
    """Return the ids of codes, one in each row of uint8[r, width] with anything after it.

    A length includes the labels at the end, so many for each code, the first that of the outer face.

    >>> map_ids(np.array([[2, 3, 1, 2, 3, 1, 0, 1, 2]], np.uint8), np.array([9]), 3)
    ['m1:ab.ab;fi']
    """
    if not len(codes):
        return []
    width = codes.shape[1]
    ends = (lengths - labels).tolist()
    if codes.max() < JOINT + len(ascii_letters):
        text = _LETTERS[codes].tobytes().decode("ascii")
        texts = ["m1:" + text[i * width : i * width + end - 1] for i, end in enumerate(ends)]
    else:
        texts = [map_text(row[:end]) for row, end in zip(codes.tolist(), ends, strict=True)]
    if not labels:
        return texts
    suffixes = [
        "".join(LABEL_LETTERS[label] for label in row[end + 1 : end + labels])
        for row, end in zip(codes.tolist(), ends, strict=True)
    ]
    return [f"{text};{suffix}" if set(suffix) - {"f"} else text for text, suffix in zip(texts, suffixes, strict=True)]
