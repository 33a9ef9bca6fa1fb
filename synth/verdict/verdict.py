"""What is said of the motion of a mechanism, and how it is known.

Theory: docs/theory/verdict.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import degrees
from typing import Any, Literal

import networkx as nx

from graphs.ids import JointId, LinkId
from graphs.mechanism.sc import SCGraph
from synth.motion.branches import Certainty

__all__ = ["Basis", "Verdict", "Way", "clusters_of"]

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
    """

    signs: str
    freedoms: int | None
    certainty: Certainty
    stiff_joints: tuple[JointId, ...]
    followed: float

    def to_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "signs": self.signs,
            "freedoms": self.freedoms,
            "certainty": self.certainty,
            "stiff_joints": list(self.stiff_joints),
            "followed_deg": degrees(self.followed),
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
        From the pose, where they were looked for.
    exhaustive : bool
        Whether there are no other ways.
    stiff_joints : tuple of joint ids
        That move on no way.
    clusters : tuple of tuple of link ids
        Links that move as one on every way, where they are several.
    places : mapping of joint id to two points
        Ends of stiff creases, in the unit of the coordinates.

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

    def to_json(self) -> dict[str, Any]:
        """Return the keys that scripts rely on (docs/command-json.md)."""
        return {
            "freedoms": self.freedoms,
            "basis": self.basis,
            "certainty": self.certainty,
            "branches": [way.to_json() for way in self.ways],
            "exhaustive": self.exhaustive,
            "stiff_joints": list(self.stiff_joints),
            "stiff_places": [
                {"joint": joint, "ends": [list(end) for end in ends]} for joint, ends in self.places.items()
            ],
            "clusters": [list(cluster) for cluster in self.clusters],
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
