"""SCD graphs: every valid placement of open edges on every SC graph, and on every plane tree, listed and counted.

The thesis stops at single examples of SCD graphs (section 3.4); here are all of a size, by the rules of
`graphs.mechanism.scd` and with the exact rank under the forced geometry (rule S3). Theory:
docs/theory/scd-enumeration.md.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal, Unpack, cast

import numpy as np

from enumerate.chains.rows import SIZE_COLUMNS, chain_ids
from enumerate.kernel.centres import FINITE, MOST_JOINTS, OUTER, SPATIAL
from enumerate.kernel.maps import OPEN
from enumerate.machine_code.weights import PLACEMENT
from enumerate.runner._run import graphs_of, rows_of, total_of
from enumerate.runner.job import ANY_NUMBER, Column, ListColumn, QueryCount, QueryJob, Row, Unit, packed, row_as_dict
from enumerate.sc.jobs import CENTRE_COLUMNS, LABEL_LETTERS, UNIT_ROWS, map_ids
from enumerate.scd.fewest import fewest_open_edges
from enumerate.scd.listing import count_placements, list_placements_of, sides_of_all
from enumerate.scd.patterns import number_of_placements, outline
from enumerate.scd.query import (
    CodedMechanisms,
    Mechanisms,
    OneMechanism,
    PlacementOptions,
    PlacementQuery,
    SCDOptions,
    SCDQuery,
    Source,
)
from graphs.arguments import keywords_checked
from graphs.convert.conversions import graph_of
from graphs.count.report import mobility_report
from graphs.errors import ArgumentError, InvariantError, UnsolvableError, numbered
from graphs.files.mechanism_like import MechanismLike, mechanism_for
from graphs.identity.drawings import map_code, map_id, mechanism_from_map_id
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.types import Bytes, Ints

SCD_COLUMNS: dict[str, Column] = {
    "code": str,
    "sc": str,
    "chain": str,
    **SIZE_COLUMNS,
    **CENTRE_COLUMNS,
    "sides": ListColumn(","),
    "open_edges": int,
    "vertices": int,
    "explicit": int,
    "implicit": int,
    "symmetry": int,
    "exact_dof": int,
}


def placements_on(
    query: PlacementQuery, dof: int, code: Bytes, labels: Ints, first: int, last: int
) -> tuple[Bytes, Ints, Ints]:
    """Return the placements that a query asks for, as `enumerate.scd.listing.list_placements_of` does.

    The code is without open edges; labels begin with the outer face, and the last number is excluded.
    """
    codes, lengths, facts = list_placements_of(
        code, labels, query.max_degree, dof, first, last, query.sheets, query.symmetric
    )
    if query.vertices == ANY_NUMBER:
        return codes, lengths, facts
    admitted = query.vertices.admitted(facts[:, 1])
    return codes[admitted], lengths[admitted], facts[admitted]


def _rows_on(query: PlacementQuery, dof: int, code: Bytes, labels: Ints, first: int, last: int) -> list[Row]:
    """Return the rows of the placements on a mechanism; columns are `SCD_COLUMNS`. Arguments: `placements_on`."""
    return _rows_of(query, dof, code, labels, placements_on(query, dof, code, labels, first, last))


def _rows_of(
    query: PlacementQuery, dof: int, code: Bytes, labels: Ints, placements: tuple[Bytes, Ints, Ints]
) -> list[Row]:
    """Return the rows of placements on a mechanism, as `placements_on` returns them."""
    codes, lengths, facts = placements
    if not len(codes):
        return []
    faces = len(labels)
    text, joints, centres, infinite = outline(code, labels)
    links = int(joints.max()) + 1
    sc = map_ids(text[None], np.array([len(text)]), faces)[0]
    chain = chain_ids(links, joints[None])[0][0]
    spatial = int((labels == SPATIAL).sum())
    common = sc, chain, links, len(joints), dof, faces - 1, spatial, centres, infinite
    sides = sides_of_all(codes, lengths, faces, query.max_degree)[:, 3:].tolist()
    return [
        (code_text, *common, _without_last_zeros(degrees), *values)
        for code_text, degrees, values in zip(map_ids(codes, lengths, faces), sides, facts.tolist(), strict=True)
    ]


def _without_last_zeros(counts: list[int]) -> tuple[int, ...]:
    return tuple(counts[: max(i for i, count in enumerate(counts) if count) + 1])


_PLACEMENTS = 40_000
"""Placements of a unit, about; symmetric ones counted apart."""

_MECHANISMS = 5_000
"""Mechanisms of a unit, about."""


@dataclass(frozen=True, slots=True)
class _Placements:
    """Placements on some mechanisms: on one, those with some numbers, the last excluded; on several, all of them.

    Mechanisms are listed once, when units are made: the rows on each take far more room.
    """

    mechanisms: CodedMechanisms
    first: int = 0
    last: int = 1 << 62

    def __len__(self) -> int:
        """Return the number of mechanisms."""
        return len(self.mechanisms)

    def each(self) -> Iterator[tuple[Bytes, Ints, int, int]]:
        """Yield code and labels of each mechanism, as compiled functions take them, and the range of numbers."""
        for code, labels in self.mechanisms.each():
            yield code, labels, self.first, self.last


@dataclass(frozen=True)
class SCDJob(QueryJob[Mechanisms]):
    """All placements of open edges on some mechanisms, as rows.

    Attributes
    ----------
    query : SCDQuery or OneMechanism
    unit_rows : int
        Placements of a unit, about, symmetric ones counted apart; a mechanism with more is split.
    """

    unit_rows: int = _PLACEMENTS
    columns = SCD_COLUMNS
    listed = "scd"

    def units(self) -> list[Unit]:
        """Units of some thousands of placements each."""
        return _units(self.query, self.unit_rows)

    def work(self, payload: tuple[_Placements, ...]) -> list[Row]:
        """Return the rows of a unit."""
        query, dof = self.query.placements, self.query.dof
        return [row for part in payload for which in part.each() for row in _rows_on(query, dof, *which)]

    def interpreted(self, weight: int) -> float:
        """Return about how many seconds the job takes with kernels interpreted, for so many placements."""
        return self.query.interpreted + PLACEMENT * weight

    def number(self, payload: tuple[_Placements, ...]) -> int:
        """Return the number of rows of a unit."""
        query, dof = self.query.placements, self.query.dof
        return sum(len(placements_on(query, dof, *which)[0]) for part in payload for which in part.each())


def _units(mechanisms: Mechanisms, unit_rows: int) -> list[Unit]:
    """Return units whose payloads are placements."""
    return list(packed(_ranges(mechanisms, unit_rows), unit_rows, len, _MECHANISMS))


def _ranges(mechanisms: Mechanisms, unit_rows: int) -> Iterator[tuple[_Placements, int]]:
    """Yield ranges of no more placements than fit a unit, and their numbers."""
    most = mechanisms.placements.max_degree
    for source in mechanisms.sources(UNIT_ROWS):  # in other parts they would come in another order
        for drawn in mechanisms.drawn(source.payload):
            counts = [int(number_of_placements(code, labels, most)) for code, labels in drawn.each()]
            if min(counts, default=0) < 0:
                raise UnsolvableError(
                    f"one mechanism has more than 10^18 placements of open edges for links of up to {most} sides; "
                    "try a smaller --max-degree"
                )
            yield from _ranges_on(drawn, counts, unit_rows)


def _ranges_on(drawn: CodedMechanisms, counts: list[int], unit_rows: int) -> Iterator[tuple[_Placements, int]]:
    """Yield ranges of the placements on mechanisms that have so many each."""
    start = weight = 0
    for row, count in zip(range(len(counts)), counts, strict=True):
        if weight and (weight + count > unit_rows or row - start >= _MECHANISMS):
            yield _Placements(drawn.slice(start, row)), weight
            start, weight = row, 0
        if count > 2 * unit_rows:
            for first in range(0, count, unit_rows):
                last = min(first + unit_rows, count)
                yield _Placements(drawn.slice(row, row + 1), first, last), last - first
            start = row + 1
        elif count == 0 and weight == 0:
            start = row + 1
        else:
            weight += count
    if weight:
        yield _Placements(drawn.slice(start, len(counts))), weight


@dataclass(frozen=True)
class SCDCountJob(QueryCount[Mechanisms]):
    """The number of placements of open edges on some mechanisms; rows are numbers to be added.

    Attributes
    ----------
    query : SCDQuery or OneMechanism
    method : {"burnside", "orbits"}
        ``orbits`` makes the placements, ``burnside`` none.
    """

    counted = "scd"

    @property
    def details(self) -> dict[str, Any]:
        """What would be listed."""
        return {"enumerate": "scd"}

    def units(self) -> Sequence[Unit]:
        """Units of some thousands of mechanisms, or of placements."""
        if self.method == "orbits":
            return _units(self.query, _PLACEMENTS)
        return list(self.query.sources(_MECHANISMS))

    def interpreted(self, weight: int) -> float:
        """Return about how many seconds the job takes with kernels interpreted, for units of so much weight."""
        return self.query.interpreted + PLACEMENT * weight

    def work(self, payload: Any) -> list[Row]:
        """Return the number of placements of a unit."""
        listing = SCDJob(self.query)
        return [(listing.number(payload) if self.method == "orbits" else self._counted(payload),)]

    def _counted(self, source: Source) -> int:
        query, dof = self.query.placements, self.query.dof
        total = 0
        for drawn in self.query.drawn(source):
            for code, labels in drawn.each():
                count = int(count_placements(code, labels, query.max_degree, dof, query.sheets))
                if count < 0:
                    raise UnsolvableError("one mechanism has more than 10^18 placements of open edges")
                total += count
        return total


def scd_count_job(mechanisms: Mechanisms, method: str | None = None) -> SCDCountJob:
    """Return the job that counts placements, by Burnside's lemma where it can.

    Parameters
    ----------
    mechanisms : SCDQuery or OneMechanism
    method : {"burnside", "orbits"}, optional
        ``orbits`` makes the placements, ``burnside`` none; UnsolvableError if the lemma cannot count by all that
        the query limits.

    Examples
    --------
    >>> from enumerate.runner._run import total_of
    >>> four = SCDQuery(4, 1, PlacementQuery(4))
    >>> [total_of(scd_count_job(four, method)) for method in ("orbits", "burnside")]
    [7, 7]
    """
    counted = mechanisms.placements.counted
    if method == "burnside" and not counted:
        raise UnsolvableError("Burnside's lemma cannot count by vertices or symmetry; try --method orbits")
    return SCDCountJob(mechanisms, method or ("burnside" if counted else "orbits"))


@keywords_checked
def scd_graphs(
    links: int | None = None,
    dof: int | None = None,
    max_degree: int = 4,
    *,
    of: MechanismLike | None = None,
    workers: int = 1,
    **options: Unpack[SCDOptions],
) -> Iterator[SCDGraph]:
    """Yield all SCD graphs of N links and M degrees of freedom, or of a mechanism, with their `scd_rows` as attributes.

    Parameters
    ----------
    links, dof : int, optional
        With M = N - 1 open chains, else as for `enumerate.sc.jobs.sc_graphs`; M is 1 by default.
    max_degree : int, optional
        The most sides of a link.
    of : Mechanism, str or Path, optional
        In place of links: a mechanism, its file or id, whose SC graph is taken, as for `mechanism_of`. If it was a
        bare chain, its centres are assumed, as its `notes` say, and decide M.
    workers : int
        Processes.
    **options
        Other fields of `PlacementQuery` and `SCDQuery`, with their errors: ``sheets``, ``symmetric``,
        ``vertices``, ``spatial``, ``infinite``; the last two with links only.

    Raises
    ------
    ArgumentError
        If there are neither links nor a mechanism, or both.

    Examples
    --------
    >>> [scd.counts.vertices for scd in scd_graphs(4, 1, 4)]
    [8, 5, 6, 7, 7, 8, 9]
    >>> len(list(scd_graphs(of="k1:Cr")))
    7
    """
    return _graphs(_source("scd_graphs", links, dof, max_degree, of, options), workers)


@keywords_checked
def scd_graphs_of(
    mechanism: SCGraph, max_degree: int, *, workers: int = 1, **options: Unpack[PlacementOptions]
) -> Iterator[SCDGraph]:
    """Yield all SCD graphs of an SC graph, with their rows as attributes; see `mechanism_of`.

    Parameters
    ----------
    mechanism, max_degree, **options
        As for `mechanism_of`, with its errors.
    workers : int
        Processes.

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> four_bar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> len(list(scd_graphs_of(four_bar, 4)))
    7
    """
    yield from _graphs(mechanism_of(mechanism, max_degree, **options), workers)


def simplest_scd_graph(mechanism: SCGraph, max_degree: int) -> SCDGraph | None:
    """Return the first of `scd_graphs_of` with the fewest open edges, or None; the others are not made.

    Parameters
    ----------
    mechanism, max_degree
        As for `mechanism_of`, with its errors; UnsolvableError, too, if more than 22 corners may have open edges or
        none.

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> four_bar = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> simplest_scd_graph(four_bar, 4).graph["open_edges"]
    4
    """
    source = mechanism_of(mechanism, max_degree)
    code, labels = next(source.source.each())
    placements = fewest_open_edges(code, labels, max_degree, source.dof)
    rows = _rows_of(source.placements, source.dof, code, labels, placements)
    named = (row_as_dict(SCD_COLUMNS, row) for row in rows)
    scd = next(graphs_of(named, mechanism_from_map_id), None)
    assert scd is None or isinstance(scd, SCDGraph)
    return scd


def least_max_degree(mechanism: OneMechanism) -> int | None:
    """Return the least largest number of sides, at least that of the query, for which a mechanism has an SCD graph.

    None: no SCD graph, with links of any number of sides, meets the query. More sides are never worse, and a corner
    that has to be opened needs one open edge: so at most one open edge at each joint of a link is enough. Raises
    UnsolvableError if Burnside's lemma cannot count by what the query limits.

    Examples
    --------
    >>> from graphs.loops.loop import Centre, Loop
    >>> pairs = [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0)]
    >>> watt = [Loop((0, 1, 2, 3), Centre.INFINITE), Loop((3, 4, 5, 6), Centre.INFINITE)]
    >>> least_max_degree(mechanism_of(SCGraph(6, pairs, watt), 4))
    6
    """
    code, labels = next(mechanism.source.each())
    joints = int(np.bincount(outline(code, labels)[1].ravel()).max())  # of the link with the most
    first = max(mechanism.placements.max_degree, joints)
    for most in range(first, max(3, 2 * joints) + 1):
        wider = replace(mechanism, placements=replace(mechanism.placements, max_degree=most))
        if total_of(scd_count_job(wider, "burnside")):
            return most
    return None


def _graphs(mechanisms: Mechanisms, workers: int) -> Iterator[SCDGraph]:
    for scd in graphs_of(rows_of(SCDJob(mechanisms), workers=workers), mechanism_from_map_id):
        assert isinstance(scd, SCDGraph)
        yield scd


@keywords_checked
def scd_rows(
    links: int, dof: int, max_degree: int, *, workers: int = 1, **options: Unpack[SCDOptions]
) -> Iterator[dict[str, Any]]:
    """Yield a dictionary for each SCD graph.

    Keys: ``code`` (its id), ``sc`` (id of its SC graph), ``chain`` (id of the link-joint graph), ``links``,
    ``joints``, ``dof``, ``loops``, ``spatial``, ``centres``, ``infinite`` (as for
    `enumerate.sc.jobs.sc_rows`), ``sides`` (numbers of links with 3, 4, ... sides), ``open_edges``,
    ``vertices`` (of the polyhedron model), ``explicit``, ``implicit`` (centres of loops), ``symmetry``,
    ``exact_dof`` (joints minus rank, vertices placed too).

    Parameters
    ----------
    links, dof, max_degree, workers, **options
        As for `scd_graphs`.

    Examples
    --------
    >>> [(row["sides"], row["open_edges"], row["symmetry"]) for row in scd_rows(4, 1, 3)]
    [([4], 4, 8)]
    """
    yield from rows_of(SCDJob(all_mechanisms(links, dof, max_degree, **options)), workers=workers)


@keywords_checked
def count_scd_graphs(
    links: int | None = None,
    dof: int | None = None,
    max_degree: int = 4,
    method: Literal["burnside", "orbits"] | None = None,
    *,
    of: MechanismLike | None = None,
    workers: int = 1,
    **options: Unpack[SCDOptions],
) -> int:
    """Return the number of SCD graphs of N links and M degrees of freedom, or of a mechanism.

    Parameters
    ----------
    links, dof, max_degree, of, **options
        As for `scd_graphs`.
    method : {"burnside", "orbits"}, optional
        Two ways: ``orbits`` makes every placement and compares it with its images, ``burnside`` makes none.
        UnsolvableError as of `scd_count_job`, or if one mechanism has more than 10^18.
    workers : int
        Processes.

    Examples
    --------
    >>> [count_scd_graphs(links, 1, 3) for links in (4, 6, 8)]
    [1, 1, 2]
    """
    mechanisms = _source("count_scd_graphs", links, dof, max_degree, of, options)
    return total_of(scd_count_job(mechanisms, method), workers=workers)


def _source(
    verb: str, links: int | None, dof: int | None, max_degree: int, of: MechanismLike | None, options: SCDOptions
) -> Mechanisms:
    """Return the mechanisms that a verb was called with: those of a size, or one."""
    if (links is None) == (of is None):
        raise ArgumentError(
            f"{verb}: {'neither links nor' if of is None else 'both links and'} of; expected one of them"
        )
    if of is None:
        assert links is not None
        return all_mechanisms(links, 1 if dof is None else dof, max_degree, **options)
    of_a_size = {"dof": dof, "spatial": options.pop("spatial", 0) or None, "infinite": options.pop("infinite", False)}
    excluded = [name for name, value in of_a_size.items() if value is not None and value is not False]
    if excluded:
        raise ArgumentError(f"{verb}: {', '.join(excluded)} with of; expected links in place of it")
    return mechanism_of(graph_of(mechanism_for(verb, of)), max_degree, **cast("PlacementOptions", options))


def all_mechanisms(
    links: int,
    dof: int,
    max_degree: int,
    *,
    spatial: int = 0,
    infinite: bool = False,
    **options: Unpack[PlacementOptions],
) -> SCDQuery:
    """Return the mechanisms of a size as a source of `SCDJob`.

    Parameters
    ----------
    links, dof, max_degree, spatial, infinite, **options
        As for `scd_graphs`, with its errors.

    Examples
    --------
    Of the seven with four links and one freedom all but one are sheets:

    >>> [len(list(rows_of(SCDJob(all_mechanisms(4, 1, 4, sheets=only))))) for only in (False, True)]
    [7, 6]
    """
    return SCDQuery(links, dof, PlacementQuery(max_degree, **options), spatial, infinite)


def mechanism_of(mechanism: SCGraph, max_degree: int, **options: Unpack[PlacementOptions]) -> OneMechanism:
    """Return a mechanism as a source of `SCDJob`; options are fields of `PlacementQuery`.

    Its loops are the bounded faces of a drawing. Of an SCD graph, the open edges are placed anew. Names and the
    ground link do not count. Raises `UnsolvableError` if the loops are not faces
    (`graphs.identity.drawings.map_id`), or the mobility cannot be counted, `InvariantError` if there are too many
    joints.
    """
    query = PlacementQuery(max_degree, **options)
    if len(mechanism.joints) + len(mechanism.loops) > MOST_JOINTS:
        raise InvariantError(
            "joints",
            f"{numbered(len(mechanism.joints), 'joint')} and {numbered(len(mechanism.loops), 'loop')}",
            f"{MOST_JOINTS} in all",
        )
    symbols, letters = map_code(mechanism)
    code = np.array([symbol for symbol in symbols if symbol != OPEN], np.uint8)
    faces = len(mechanism.joints) - len(mechanism) + 1
    labels = [OUTER, *(LABEL_LETTERS.index(letter) for letter in letters or faces * LABEL_LETTERS[FINITE])]
    dof = mobility_report(mechanism).mobility
    if dof is None:
        raise UnsolvableError("the mobility of the mechanism cannot be counted")
    return OneMechanism(map_id(mechanism), dof, CodedMechanisms(code[None], np.array([labels], np.uint8)), query)
