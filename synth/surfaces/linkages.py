"""A linkage of one loop or several, as a file gives it, on its cones or cylinders.

Theory: docs/theory/multiloop.md.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import cos, degrees, inf
from typing import Any

import numpy as np

from graphs.errors import UnsolvableError, check_argument, numbered
from graphs.mechanism.surfaces import Cylinder, Pair, Surface, SurfaceLinkage
from graphs.printing import Block, Printed, TableBlock, plain
from graphs.types import JointId
from synth.surfaces.common import CommonFamily, CommonSurface, common_surfaces
from synth.surfaces.cone import cone_chords, link_angles
from synth.surfaces.cylinder import chords, joint_coordinates
from synth.surfaces.mapping import in_degrees, joints_text, signs_text
from synth.surfaces.several_loops import link_pairs, loop_steps

__all__ = ["LinkageMap", "by_sizes", "map_linkage", "sizes_on"]


@dataclass(frozen=True, slots=True)
class LinkageMap(Printed):
    """The cones, or the cylinders, on which a linkage lies.

    Attributes
    ----------
    linkage : SurfaceLinkage
    surfaces : tuple of CommonSurface
    families : tuple of CommonFamily
        Intervals of cones or cylinders.
    """

    linkage: SurfaceLinkage
    surfaces: tuple[CommonSurface, ...]
    families: tuple[CommonFamily, ...]

    def blocks(self) -> list[Block]:
        """Return the lines and tables that are printed."""
        blocks = [block for one in self.surfaces for block in self._of_surface(one)]
        for family in self.families:
            told = "; ".join(
                f"{joints_text(loop.joints)}: {signs_text(signs)}, k {turns}"
                for loop, signs, turns in zip(self.linkage.chain.loops, family.signs, family.turns, strict=True)
            )
            low, high = family.interval
            every = f"lambda between {degrees(low):.10g} and {degrees(high):.10g} degrees"
            if self.linkage.kind == "cylinder":
                every = f"radius from {low:.10g} on"
            blocks.append(f"every {every}   ({told})")
            blocks += [family.caution] if family.caution else []
        return blocks or [f"no {self.linkage.kind} is common to all loops"]

    def _of_surface(self, one: CommonSurface) -> list[Block]:
        chain, surface = self.linkage.chain, one.surface
        link_of = link_pairs(chain)
        loops = [
            (joints_text(loop.joints), circuit, signs_text(signs), str(turns))
            for loop, circuit, signs, turns in zip(chain.loops, one.circuits, one.signs, one.turns, strict=True)
        ]
        rows = [
            (plain(link_of[pair]), joints_text(pair), *(f"{size:.8g}" for size in sizes))
            for pair, sizes in _sizes_and_chords(self.linkage, one).items()
        ]
        heads = ["length"] if isinstance(surface, Cylinder) else ["angle (deg)", "chord"]
        blocks: list[Block] = [
            str(surface) if isinstance(surface, Cylinder) else f"{surface}, R {cos(surface.angle):.8g}",
            *([one.caution] if one.caution else []),
            TableBlock(("loop", "circuit", "signs", "k"), loops, ["k"]),
            TableBlock(("link", "joints", *heads), rows, heads),
        ]
        if isinstance(surface, Cylinder):
            blocks.append(_coordinates_table(surface, one.places))
        return blocks

    def __repr__(self) -> str:
        return f"<LinkageMap: {self.linkage!r}, {numbered(len(self.surfaces), self.linkage.kind)}>"

    def to_json(self) -> dict[str, Any]:
        """Return what scripts rely on (docs/command-json.md): circuit, signs and k are lists, an item a loop."""
        on_cone = self.linkage.kind == "cone"
        return {
            "loops": [list(map(str, loop.joints)) for loop in self.linkage.chain.loops],
            "cones" if on_cone else "cylinders": [
                {
                    **_size_json(one.surface),
                    "circuit": list(one.circuits),
                    "signs": [list(signs) for signs in one.signs],
                    "k": list(one.turns),
                    "azimuths_deg": dict(zip(map(str, one.places), in_degrees(one.places.values()), strict=True)),
                    **self._sizes_json(one),
                    "residual_deg": degrees(one.residual),
                    "caution": one.caution or None,
                }
                for one in self.surfaces
            ],
            "families": [
                {
                    **(
                        {"lambda_deg": [degrees(x) for x in family.interval]}
                        if on_cone
                        else {"radius": [None if x == inf else x for x in family.interval]}
                    ),
                    "signs": [list(signs) for signs in family.signs],
                    "k": list(family.turns),
                    "caution": family.caution or None,
                }
                for family in self.families
            ],
        }

    def _sizes_json(self, one: CommonSurface) -> dict[str, Any]:
        sizes = _sizes_and_chords(self.linkage, one)
        first = [[str(a), str(b), size[0]] for (a, b), size in sizes.items()]
        if isinstance(one.surface, Cylinder):
            points = _coordinates(one.surface, one.places)
            return {"link_lengths": first, "coordinates": {str(joint): at for joint, at in points.items()}}
        return {"link_angles_deg": first, "chords": [[str(a), str(b), size[1]] for (a, b), size in sizes.items()]}


def _size_json(surface: Surface) -> dict[str, float]:
    if isinstance(surface, Cylinder):
        return {"radius": surface.radius}
    return {"lambda_deg": degrees(surface.angle), "R": cos(surface.angle)}


def _sizes_and_chords(linkage: SurfaceLinkage, one: CommonSurface) -> dict[Pair, tuple[float, ...]]:
    """Return the lengths of links, or their angles in degrees and the chords of these."""
    found = sizes_on(linkage, one.surface, one.places)
    if isinstance(one.surface, Cylinder):
        return {pair: (size,) for pair, size in found.items()}
    return {pair: (in_degrees([size])[0], float(cone_chords(size))) for pair, size in found.items()}


def sizes_on(linkage: SurfaceLinkage, surface: Surface, places: Mapping[JointId, float]) -> dict[Pair, float]:
    """Return the link angles, radians, or lengths between all joints of each link on a surface.

    >>> from graphs.mechanism.surfaces import ring
    >>> square = SurfaceLinkage(ring(4), steps={})
    >>> places = dict(zip(square.chain.joints, np.radians([0, 90, 180, 270]), strict=True))
    >>> round(sizes_on(square, Cylinder(1.0), places)["1", "2"], 6)
    1.414214
    """

    def size(step: float) -> float:
        if isinstance(surface, Cylinder):
            return float(chords(step, surface.radius))
        return float(link_angles(step, surface.angle))

    return {
        (a, b): size(places[b] - places[a]) for a, b in link_pairs(linkage.chain) if a in places and b in places
    }


def _coordinates(surface: Cylinder, places: Mapping[JointId, float]) -> dict[JointId, list[float]]:
    """Return where joints are across the axis."""
    return dict(zip(places, joint_coordinates(surface.radius, list(places.values())).tolist(), strict=True))


def _coordinates_table(surface: Cylinder, places: Mapping[JointId, float]) -> TableBlock:
    """Return the azimuths and coordinates of joints as they are printed."""
    rows = [
        (plain(joint), *(f"{value + 0.0:.8g}" for value in (*in_degrees([places[joint]]), *at)))
        for joint, at in _coordinates(surface, places).items()
    ]
    heads = ["azimuth (deg)", "x", "y"]
    return TableBlock(("joint", *heads), rows, heads)


def by_sizes(linkage: SurfaceLinkage) -> SurfaceLinkage:
    """Return a linkage given by steps on a surface as one that is given by all its link angles or lengths.

    Parameters
    ----------
    linkage : SurfaceLinkage
        One that is given by its sizes is returned as it is.

    Returns
    -------
    SurfaceLinkage

    Raises
    ------
    UnsolvableError
        If the surface is not given.

    Examples
    --------
    Four quarter turns round a cone of lambda 45 degrees are links of 60 degrees:

    >>> from graphs.mechanism.sc import SCGraph
    >>> from graphs.mechanism.surfaces import Cone
    >>> chain = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])
    >>> steps = {(0, 1): np.pi / 2, (1, 2): np.pi / 2, (2, 3): np.pi / 2}
    >>> given = by_sizes(SurfaceLinkage(chain, steps=steps, surface=Cone(np.pi / 4)))
    >>> {pair: round(degrees(angle), 9) for pair, angle in given.angles.items()}
    {(0, 3): 60.0, (0, 1): 60.0, (1, 2): 60.0, (2, 3): 60.0}
    """
    if linkage.steps is None:
        return linkage
    if linkage.surface is None:
        told = "lengths: expected 'radius'" if linkage.kind == "cylinder" else "link angles: expected 'lambda_deg'"
        raise UnsolvableError(f"steps without a {linkage.kind} have no {told}")
    at = dict(zip(linkage.chain.joints, linkage.places(), strict=True))
    sizes = sizes_on(linkage, linkage.surface, at)
    if linkage.kind == "cylinder":
        return SurfaceLinkage(linkage.chain, lengths=sizes)
    return SurfaceLinkage(linkage.chain, angles=sizes)


def map_linkage(linkage: SurfaceLinkage, tolerance: float = 1e-7) -> LinkageMap:
    """Return the surfaces of a linkage: from the sizes of links, or, given steps, the one named or every one.

    Parameters
    ----------
    linkage : SurfaceLinkage
    tolerance : float, optional
        How well its loops must close together, radians; a loop of less than a turn in proportion.

    Returns
    -------
    LinkageMap

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> from graphs.mechanism.sc import SCGraph
    >>> chain = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop((0, 1, 2, 3))])
    >>> steps = {(i, i + 1): np.pi / 2 for i in range(3)}
    >>> [family.interval[0] for family in map_linkage(SurfaceLinkage(chain, steps=steps)).families]
    [0.0]
    """
    check_argument("map_linkage", linkage, SurfaceLinkage)
    if linkage.sizes is not None:
        by_lengths = linkage.lengths is not None
        return LinkageMap(linkage, *common_surfaces(linkage.chain, linkage.sizes, tolerance, lengths=by_lengths))
    places = np.array(linkage.places())
    loops = loop_steps(linkage.chain, places)
    mirror = -1 if loops[0].steps[0] < 0 else 1
    signs = tuple(tuple((mirror * np.sign(loop.steps)).astype(int).tolist()) for loop in loops)
    turns = tuple(int(mirror * loop.circuits.turns) for loop in loops)
    if linkage.surface is None:
        every = (0.0, np.pi / 2 if linkage.kind == "cone" else inf)
        return LinkageMap(linkage, (), (CommonFamily(every, signs, turns),))
    circuits = tuple(str(loop.circuits.names()) for loop in loops)
    residual = max(abs(float(loop.circuits.residual)) for loop in loops)
    named = dict(zip(linkage.chain.joints, places.tolist(), strict=True))
    return LinkageMap(linkage, (CommonSurface(linkage.surface, signs, turns, circuits, named, residual),), ())
