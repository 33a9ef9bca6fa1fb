"""A crease pattern with panels of a thickness: hinged solids, their verdict, and their fold angles.

Theory: docs/guides/thick-panels.md.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import networkx as nx
import numpy as np
from scipy.spatial.transform import Rotation

from graphs.errors import InvariantError, UnsolvableError, numbered
from graphs.files.accepted import MechanismLike, mechanism_for
from graphs.files.formats import write
from graphs.files.outputs import check_writable, write_as
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import Axis, HingedSolids
from graphs.printing import Block, Printed, TableBlock
from graphs.types import Floats
from synth.folding.configuration import SheetConfiguration
from synth.motion.driving import MotionOptions
from synth.motion.motion import motion_of
from synth.moving.made import configuration_of
from synth.templates.solids import SOLIDS, Solids
from synth.templates.template import GREATEST
from synth.thickening.heights import HingeHeights, hinge_heights
from synth.thickening.plates import ThickPlates, thick_plates
from synth.verdict.judged import verdict_of_motion
from synth.verdict.verdict import Verdict


@dataclass(frozen=True, eq=False, repr=False)
class ThickSheet(Printed):
    """A crease pattern with panels of a thickness.

    Attributes
    ----------
    solids : HingedSolids
        Links are the panels; axes in millimetres, in the flat state.
    heights : HingeHeights
        In units of the thickness.
    plates : ThickPlates
        The solids in the flat state.
    thickness : float
        Millimetres.
    verdict : Verdict
        Of the hinged solids, by their closure equations.
    angles : float[F, J]
        Joint angles of a motion of the solids from flat, radians.
    keeps_angles : bool
        Whether the fold angles are those of the thin sheet.
    residual : float
        The largest loop-closure residual of the solids on the motion.

    Examples
    --------
    >>> import synth
    >>> thick = synth.thicken(synth.generate("miura").mechanism, thickness=0.05)
    >>> thick.solids
    <HingedSolids: 9 links, 12 joints>
    """

    solids: HingedSolids
    heights: HingeHeights
    plates: ThickPlates
    thickness: float
    verdict: Verdict
    angles: Floats
    keeps_angles: bool
    residual: float

    def panel_motions(self) -> tuple[Floats, Floats]:
        """Return rotations, float[F, P, 3, 3], and translations, float[F, P, 3], of panels; panel 0 rests."""
        return _panel_motions(self.solids, self.angles)

    def blocks(self) -> list[Block]:
        """Return the sentence and the heights that are printed."""
        kinds = [one.linkage for one in self.heights.vertices]
        linkages = ", ".join(numbered(kinds.count(kind), f"{kind} vertex", f"{kind} vertices")
                             for kind in ("Bennett", "Myard", "Bricard") if kind in kinds)  # fmt: skip
        angles = "those of the thin sheet" if self.keeps_angles else "not those of the thin sheet"
        rows = [(str(joint), f"{height * self.thickness:.6g}") for joint, height in self.heights.hinges.items()]
        most = float(np.degrees(np.abs(self.angles).max(initial=0.0)))
        return [
            str(self.verdict),
            f"vertices: {linkages or 'none inside the sheet'}",
            f"fold angles: {angles}, up to {most:.6g}°; loop-closure residual {self.residual:.1g}",
            "collisions of the solids: not checked",
            TableBlock(("crease", "height in mm"), rows, ("crease", "height in mm")),
        ]

    def to_json(self) -> dict[str, Any]:
        """Return plain data: lengths in millimetres, angles in degrees."""
        return {
            "thickness": self.thickness,
            "verdict": self.verdict.to_json(),
            "heights": [
                {"joint": joint, "height": height * self.thickness} for joint, height in self.heights.hinges.items()
            ],
            "undersides": [height * self.thickness for height in self.heights.undersides],
            "vertices": [
                {"vertex": one.vertex, "linkage": one.linkage, "joints": list(one.joints)}
                for one in self.heights.vertices
            ],
            "keeps_angles": self.keeps_angles,
            "residual": self.residual,
            "angles_deg": np.degrees(self.angles).tolist(),
        }

    def write(self, path: str | Path, *, force: bool = False) -> tuple[str, ...]:
        """Write the hinged solids (.json) or the solids (.stl, .3mf, .obj; .gltf with the motion); return losses."""
        if Path(path).suffix == ".json":
            write(self.solids, path, force=force)
            return ()
        check_writable(path, SOLIDS, force=force)
        rotations, shifts = self.panel_motions()
        panels = list(self.plates.panels)
        solids = Solids(self.plates.meshes, "thick panels", (rotations[:, panels], shifts[:, panels]))
        return write_as(solids, path, SOLIDS, force=force)


def thicken(mechanism: MechanismLike, *, thickness: float, scale: float = 1.0) -> ThickSheet:
    """Give the panels of a flat crease pattern a thickness; hinges are moved off its plane so that it still folds.

    Parameters
    ----------
    mechanism : Sheet, str or Path
        A flat crease pattern of mountains and valleys.
    thickness : float
        Of panels, millimetres.
    scale : float, optional
        Millimetres per unit of the coordinates.

    Returns
    -------
    ThickSheet

    Raises
    ------
    InvariantError
        If the thickness or the scale is out of range.
    UnsolvableError
        If the sheet is not flat, has no assignment, a vertex suits no overconstrained linkage, conditions exclude
        each other, a panel is too narrow, or nothing moves.

    Examples
    --------
    >>> import synth
    >>> thick = synth.thicken(synth.generate("miura").mechanism, thickness=0.1)
    >>> thick.keeps_angles, thick.residual < 1e-9
    (True, True)
    """
    sheet = mechanism_for("thicken", mechanism, Sheet)
    for name, value in (("thickness", thickness), ("scale", scale)):
        if not 0 < value <= GREATEST:
            raise InvariantError(name, f"{name} {value!r}", f"a positive number, at most {GREATEST:g}")
    at = _flat_configuration(sheet)
    heights = hinge_heights(at.sheet, at.mechanism, at.tolerances)
    solids = _hinged_solids(at, heights, thickness, scale)
    plates = thick_plates(at.sheet, at.mechanism, heights, thickness, scale)
    thick = configuration_of(solids)
    verdict = verdict_of_motion(thick)
    thin = motion_of(at, MotionOptions()).path.angles
    keeps, residual = True, _residual(thick.closure, thin)
    angles = thin
    if not residual <= thick.tolerances.closed:
        keeps, angles = False, motion_of(thick, MotionOptions()).path.angles
        residual = _residual(thick.closure, angles)
    return ThickSheet(solids, heights, plates, thickness, verdict, angles, keeps, residual)


def _residual(closure: Any, angles: Floats) -> float:
    return max((float(np.abs(closure.at(row)[0]).max(initial=0.0)) for row in angles), default=0.0)


def _flat_configuration(sheet: Sheet) -> SheetConfiguration:
    """Return the configuration of a sheet; refuse one that is folded, or without an assignment."""
    at = configuration_of(sheet)
    assert isinstance(at, SheetConfiguration)
    if not at.flat:
        raise UnsolvableError("the sheet is folded; expected a flat one, with mountains and valleys")
    for joint in at.mechanism.sc.joints:
        letter = at.sheet.assignments[int(str(joint))]
        if letter not in "MV":
            raise UnsolvableError(f"crease {joint} has the assignment {letter}; expected M or V")
    if np.ptp(at.linkage.points[:, 2], axis=0) > at.tolerances.meant:
        raise UnsolvableError("the sheet is not in a plane z = constant; expected a flat crease pattern")
    return at


def _hinged_solids(at: SheetConfiguration, heights: HingeHeights, thickness: float, scale: float) -> HingedSolids:
    """Return the panels as links and their hinges at their heights."""
    linkage = at.linkage
    places = (linkage.points * linkage.extent + linkage.middle) * scale
    axes: dict[Any, Axis] = {}
    for place, joint in enumerate(at.mechanism.sc.joints):
        x, y, _ = places[place].tolist()
        u, v, w = linkage.directions[place].tolist()
        axes[joint] = (x, y, heights.hinges[int(str(joint))] * thickness), (u, v, w)
    return HingedSolids(SCGraph(at.mechanism.sc.nodes, at.mechanism.sc.joints), axes)


def _panel_motions(solids: HingedSolids, angles: Floats) -> tuple[Floats, Floats]:
    """Return how links stand at joint angles, by a tree of hinges from link 0."""
    joints: Mapping[Any, Any] = solids.chain.joints
    columns = {joint: place for place, joint in enumerate(joints)}
    links = list(solids.chain.nodes)
    rotations = np.tile(np.eye(3), (len(angles), len(links), 1, 1))
    shifts = np.zeros((len(angles), len(links), 3))
    graph = nx.Graph()
    graph.add_nodes_from(links)
    for joint, (first, second) in joints.items():
        if not graph.has_edge(first, second):
            graph.add_edge(first, second, joint=joint)
    number = {link: place for place, link in enumerate(links)}
    for near, far in nx.bfs_edges(graph, links[0]):
        joint = graph.edges[near, far]["joint"]
        point, along = (np.array(one) for one in solids.axes[joint])
        sign = 1.0 if joints[joint][0] == near else -1.0
        vectors = sign * angles[:, columns[joint], None] * along / np.linalg.norm(along)
        turns = Rotation.from_rotvec(vectors).as_matrix()
        here, there = number[near], number[far]
        rotations[:, there] = rotations[:, here] @ turns
        offset = point - turns @ point
        shifts[:, there] = (rotations[:, here] @ offset[..., None])[..., 0] + shifts[:, here]
    return rotations, shifts
