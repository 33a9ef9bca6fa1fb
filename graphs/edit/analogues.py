"""Planar analogue, spherical analogue and generalised form of a mechanism.

All three change centres only: links, joints and loops stay. Source: Wiener 2016, sections 3.3.4 and 3.3.5.
Theory: docs/theory/sc-graphs.md.
"""

from collections.abc import Callable
from typing import TypeVar

from graphs.errors import UnsolvableError, numbered
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.sc import SCGraph

G = TypeVar("G", bound=SCGraph)


def planar_analogue(sc: G) -> G:
    """Make all axes parallel: every loop planar, one centre at infinity.

    Raises `UnsolvableError` if a loop is spatial; `InvariantError` for an SCD graph with an explicit centre, which
    cannot be at infinity.

    Parameters
    ----------
    sc : SCGraph or SCDGraph

    Examples
    --------
    >>> ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> planar_analogue(ring).centre_classes()[0].centre.value
    'infinite'
    """
    return _recentred(sc, Centre.INFINITE, "parallel", "planar")


def spherical_analogue(sc: G) -> G:
    """Let all axes meet in one point: every loop spherical, one finite centre.

    Parameters
    ----------
    sc : SCGraph or SCDGraph
        UnsolvableError if a loop is spatial.

    Examples
    --------
    >>> watt = SCGraph(6, [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0)],
    ...                [Loop((0, 1, 2, 3)), Loop((3, 4, 5, 6))])
    >>> len(watt.centre_classes()), len(spherical_analogue(watt).centre_classes())
    (2, 1)
    """
    return _recentred(sc, Centre.FINITE, "O", "spherical")


def generalised_form(sc: G) -> G:
    """Let the centres be as different as the joints allow: every loop with a centre has a finite one of its own.

    Parameters
    ----------
    sc : SCGraph or SCDGraph
        Loops without a centre stay as they are.

    Examples
    --------
    >>> ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> generalised_form(planar_analogue(ring)).loops[0].centre.value
    'finite'
    """
    return _changed(sc, lambda x: Loop(x.joints, Centre.FINITE, x.name) if x.has_centre else x)


def _recentred(sc: G, centre: Centre, at: str, kind: str) -> G:
    if sc.spatial_loops:
        loops = numbered(sc.spatial_loops, "spatial loop")
        raise UnsolvableError(f"a mechanism with {loops} has no {kind} analogue")
    return _changed(sc, lambda x: Loop(x.joints, centre, x.name, at))


def _changed(sc: G, change: Callable[[Loop], Loop]) -> G:
    changed = sc.with_loops(map(change, sc.loops), map(change, sc.closing))
    assert isinstance(changed, type(sc))
    return changed
