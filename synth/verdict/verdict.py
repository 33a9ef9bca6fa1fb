"""What is said of the motion of a mechanism, and how it is known.

Theory: docs/theory/verdict.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import degrees
from typing import Any, Literal

import networkx as nx

from graphs.mechanism.sc import SCGraph
from graphs.types import JointId, LinkId
from synth.motion.branches import Certainty

__all__ = ["AsWritten", "Basis", "Verdict", "Way", "WithinPrecision", "clusters_of"]

Basis = Literal["motion", "pose", "generic", "count"]


@dataclass(frozen=True, slots=True)
class Way:
    """One way to move from the pose of a file.

    Attributes
    ----------
    signs : str
        How each joint begins: ``+`` valley, ``-`` mountain, ``0`` not at all.
    freedoms : int or None
    certainty : {"proved", "numerical", "not known"}
    stiff_joints : tuple of joint ids
        That do not move on it.
    followed : float
        How far the joint that moves most was followed, radians.
    misfit : float or None
        Largest displacement of a vertex, in units of the extent, in the mechanism that has this branch; 0 where
        the coordinates have it as they are written, None of what has no vertices.
    from_folded : (float, float) or None
        Where it was found at a folded state: the largest fold angles there, and at the end of the way back towards
        the flat state, radians.
    """

    signs: str
    freedoms: int | None
    certainty: Certainty
    stiff_joints: tuple[JointId, ...]
    followed: float
    misfit: float | None = None
    from_folded: tuple[float, float] | None = None

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "signs": self.signs,
            "freedoms": self.freedoms,
            "certainty": self.certainty,
            "stiff_joints": list(self.stiff_joints),
            "followed_deg": degrees(self.followed),
            "misfit": self.misfit,
            "from_folded_deg": None if self.from_folded is None else [degrees(at) for at in self.from_folded],
        }


@dataclass(frozen=True, slots=True)
class AsWritten:
    """What holds for the coordinates exactly as they are written.

    Attributes
    ----------
    freedoms : int or None
        As those of a verdict; None where they are not known.
    certainty : {"proved", "numerical", "not known"}
    """

    freedoms: int | None
    certainty: Certainty

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {"freedoms": self.freedoms, "certainty": self.certainty}


@dataclass(frozen=True, slots=True)
class WithinPrecision:
    """What holds for some mechanism within the precision of the coordinates: four times their error.

    Attributes
    ----------
    freedoms : int or None
    certainty : {"proved", "numerical", "not known"}
        Of no freedoms, proved if no rates nearly agree, and numerical if for all that do the nearest mechanism is
        farther off or none was found.
    misfit : float or None
        Largest displacement of a vertex, in units of the extent, in the mechanism found; of a rigid pattern in the
        nearest one that moves, beyond the precision. None where no mechanism was found nearby.
    precision : float
        Error of a coordinate, in units of the extent.
    """

    freedoms: int | None
    certainty: Certainty
    misfit: float | None
    precision: float

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "freedoms": self.freedoms,
            "certainty": self.certainty,
            "misfit": self.misfit,
            "precision": self.precision,
        }


@dataclass(frozen=True, slots=True)
class Verdict:
    """Whether a mechanism moves, in a sentence and in numbers.

    Attributes
    ----------
    freedoms : int or None
        Of the branch through a folded pose; of the branch that the marks of a flat sheet choose, or the most that
        any has; else of the type. None where that is not known.
    basis : {"motion", "pose", "generic", "count"}
        Motion: followed, or proved from the pose on. Pose: a regular pose, at which rates are motions. Generic:
        the exact rank of a general member. Count: a formula.
    certainty : {"proved", "numerical", "not known"}
    text : str
    ways : tuple of Way
        From the pose, where they were looked for; those that the search had nothing left to follow are left out.
    exhaustive : bool
        Whether there are no other ways.
    stiff_joints : tuple of joint ids
        That move on no way.
    clusters : tuple of tuple of link ids
        Links that move as one on every way, where they are several.
    places : mapping of joint id to two points
        Ends of stiff creases, in the unit of the coordinates.
    as_written : AsWritten or None
        What holds exactly as written; None of a type, and where motion was not looked for.
    within_precision : WithinPrecision or None
        What holds within the precision of the coordinates of a crease pattern: the verdict is about that.
    further : int or None
        If the search ended at its allowance: how many beginnings of ways it had found and not followed; there may
        be more. None if it came to its end.

    Examples
    --------
    >>> from graphs.mechanism.sheet import Sheet
    >>> from synth.folding.configuration import configuration_of_sheet
    >>> from synth.verdict.of_motion import verdict_of_motion
    >>> corners = ((0, 0), (1, 0), (.5, 1), (-1, 0), (.5, -1))
    >>> faces = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1))
    >>> verdict = verdict_of_motion(configuration_of_sheet(Sheet(5, (), "", faces, corners)))
    >>> verdict.freedoms, verdict.certainty, verdict.exhaustive, len(verdict.ways)
    (1, 'proved', True, 2)
    """

    freedoms: int | None
    basis: Basis
    certainty: Certainty
    text: str
    ways: tuple[Way, ...] = ()
    exhaustive: bool = False
    stiff_joints: tuple[JointId, ...] = ()
    clusters: tuple[tuple[LinkId, ...], ...] = ()
    places: dict[JointId, tuple[tuple[float, ...], tuple[float, ...]]] = field(default_factory=dict)
    as_written: AsWritten | None = None
    within_precision: WithinPrecision | None = None
    further: int | None = None

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on (docs/command-json.md)."""
        return {
            "freedoms": self.freedoms,
            "basis": self.basis,
            "certainty": self.certainty,
            "branches": [way.to_json() for way in self.ways],
            "exhaustive": self.exhaustive,
            "not_followed": self.further,
            "stiff_joints": list(self.stiff_joints),
            "stiff_places": [
                {"joint": joint, "ends": [list(end) for end in ends]} for joint, ends in self.places.items()
            ],
            "clusters": [list(cluster) for cluster in self.clusters],
            "as_written": None if self.as_written is None else self.as_written.to_json(),
            "within_precision": None if self.within_precision is None else self.within_precision.to_json(),
            "text": self.text,
        }

    def __str__(self) -> str:
        return self.text


def clusters_of(graph: SCGraph, still: Sequence[JointId]) -> tuple[tuple[LinkId, ...], ...]:
    """Return links that stiff joints make one, in the order of the graph.

    Examples
    --------
    >>> clusters_of(SCGraph(4, [(0, 1), (1, 2), (2, 3)]), [0, 1])
    ((0, 1, 2),)
    """
    together = nx.Graph()
    together.add_edges_from(graph.joints[joint] for joint in still)
    order = {link: place for place, link in enumerate(graph)}
    found = [tuple(sorted(links, key=order.__getitem__)) for links in nx.connected_components(together)]
    return tuple(sorted(found, key=lambda links: order[links[0]]))
