"""Panels of a thickness as plane-faced solids: a slab, and risers from it to hinges at another height."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely

from graphs.convert.duality import SheetMechanism
from graphs.errors import UnsolvableError
from graphs.files.solids.meshes import Mesh
from graphs.mechanism.precision import in_space
from graphs.mechanism.sheet import Sheet
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.templates.solids import plate_of
from synth.thickening.heights import HingeHeights


@dataclass(frozen=True)
class ThickPlates:
    """Solids in the flat state.

    Attributes
    ----------
    meshes : tuple of Mesh
        Millimetres.
    panels : tuple of int
        The panel of each mesh.

    Examples
    --------
    >>> import synth
    >>> plates = synth.thicken(synth.generate("miura").mechanism, thickness=0.05).plates
    >>> len(plates.meshes) == len(plates.panels), len(set(plates.panels))
    (True, 9)
    """

    meshes: tuple[Mesh, ...]
    panels: tuple[int, ...]

    def placed(self, rotations: Floats, shifts: Floats) -> list[Mesh]:
        """Return the solids where panels, rotated by float[P, 3, 3], then translated by float[P, 3], are."""
        return [
            Mesh(mesh.name, mesh.corners @ rotations[panel].T + shifts[panel], mesh.triangles)
            for mesh, panel in zip(self.meshes, self.panels, strict=True)
        ]


def thick_plates(
    sheet: Sheet, mechanism: SheetMechanism, heights: HingeHeights, thickness: float, scale: float
) -> ThickPlates:
    """Return the solids of a flat sheet; risers are one thickness wide.

    Parameters
    ----------
    sheet : Sheet
    mechanism : SheetMechanism
        Of the sheet.
    heights : HingeHeights
        Of the sheet.
    thickness : float
        Millimetres.
    scale : float
        Millimetres per unit of the coordinates.

    Raises
    ------
    UnsolvableError
        If a panel is not one polygon without holes, or too narrow.

    Examples
    --------
    >>> import synth
    >>> from synth.moving.made import configuration_of
    >>> at = configuration_of(synth.generate("miura").mechanism)
    >>> from synth.thickening.heights import hinge_heights
    >>> heights = hinge_heights(at.sheet, at.mechanism, at.tolerances)
    >>> thick_plates(at.sheet, at.mechanism, heights, 0.05, 1.0).meshes[0].name
    'panel 0'
    """
    corners = in_space(sheet.coordinates or ())[:, :2] * scale
    outlines = [_outline(sheet, faces, corners, panel) for panel, faces in enumerate(mechanism.panels)]
    meshes: list[Mesh] = []
    panels: list[int] = []
    for panel, outline in enumerate(outlines):
        width = 2.0 * shapely.maximum_inscribed_circle(outline).length
        if thickness > width:
            allowed = f"panel {panel} allows at most {width:.6g} mm, the diameter of its inscribed circle"
            raise UnsolvableError(f"thickness {thickness:g} mm: {allowed}; try a smaller --thickness")
        base = heights.undersides[panel] * thickness
        meshes.append(_prism(outline, base, base + thickness, f"panel {panel}"))
        panels.append(panel)
    for joint, links in mechanism.sc.joints.items():
        height = heights.hinges[int(str(joint))]
        valley = sheet.assignments[int(str(joint))] == "V"
        for panel in (int(str(link)) for link in links):
            side = heights.undersides[panel] + (1.0 if valley else 0.0)
            if abs(height - side) <= DOUBLE.meant:  # in thicknesses: level with the side of the panel
                continue
            low, high = sorted((side * thickness, height * thickness))
            for number, (a, b) in enumerate(mechanism.pieces[int(str(joint))]):
                strip = shapely.LineString(corners[[a, b]]).buffer(thickness, cap_style="flat")
                part = shapely.intersection(strip, outlines[panel])
                if part.geom_type != "Polygon" or part.interiors:
                    raise UnsolvableError(
                        f"panel {panel} is narrower than the riser of crease {joint}, {thickness:g} mm wide; "
                        f"try a smaller --thickness"
                    )
                name = f"panel {panel} riser {joint}" + (f" part {number}" if number else "")
                meshes.append(_prism(part, low, high, name))
                panels.append(panel)
    return ThickPlates(tuple(meshes), tuple(panels))


def _outline(sheet: Sheet, faces: tuple[int, ...], corners: Floats, panel: int) -> Any:
    outline = shapely.union_all([shapely.Polygon(corners[list(sheet.faces[face])]) for face in faces])
    if outline.geom_type != "Polygon" or outline.interiors:
        raise UnsolvableError(f"panel {panel} has a hole or several parts; expected one polygon")
    return outline


def _prism(polygon: Any, low: float, high: float, name: str) -> Mesh:
    ring = np.array(shapely.orient_polygons(polygon).exterior.coords)[:-1]
    plate = plate_of(ring, high - low, name)
    return Mesh(name, plate.corners + np.array([0.0, 0.0, (low + high) / 2]), plate.triangles)
