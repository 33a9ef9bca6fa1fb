"""The lines below a picture in space: fold angles, panels that pass through each other, from where it is seen."""

from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from graphs.convert.duality import SheetMechanism, mechanism_of_sheet
from graphs.errors import InvariantError
from graphs.mechanism.precision import in_space, precision_of_sheet
from graphs.mechanism.sheet import Sheet, with_all_edges
from graphs.tolerances import Tolerances, leading
from graphs.types import Floats
from synth.analysis.folding.panel_collisions import shapes_of_panels
from synth.analysis.motion.linkage import linkage_of_sheet
from synth.making.drawing.space.panels import View

_LISTED = 8
"""Frames that are named, at most."""


def camera_line(view: View) -> str:
    """Return in words from where something is seen: a direction in the coordinates of the file.

    >>> from synth.making.drawing.space.panels import view_from
    >>> camera_line(view_from(np.array([0.0, -3.0, 4.0]), np.array([0.0, 0.0, 1.0])))
    'seen from the direction (0, -0.6, 0.8)'
    """
    return f"seen from the direction ({', '.join(f'{part + 0.0:.2g}' for part in view.towards.round(2).tolist())})"


@dataclass(frozen=True)
class FoldedStates:
    """A sheet in one or more configurations, each with coordinates and the same panels."""

    sheets: list[Sheet]

    @cached_property
    def places(self) -> Floats:
        """The vertices in each configuration: float[F, vertices, 3]."""
        return np.array([in_space(sheet.coordinates or ()) for sheet in self.sheets])

    @cached_property
    def mechanism(self) -> SheetMechanism:
        """Panels and creases, the same in all configurations."""
        return mechanism_of_sheet(with_all_edges(self.sheets[0]))

    @cached_property
    def angles(self) -> Floats:
        """The fold angles, degrees: float[F, J]; without columns if a crease has no length."""
        with suppress(InvariantError):
            linkages = [linkage_of_sheet(with_all_edges(sheet), self.mechanism) for sheet in self.sheets]
            return np.degrees([linkage.angles for linkage in linkages])
        return np.empty((len(self.sheets), 0))

    @cached_property
    def most_folded(self) -> int | None:
        """The column of the crease with the largest fold angle; None where none is folded."""
        largest = np.abs(self.angles).max(axis=0, initial=0.0)
        return int(leading(largest)) if largest.any() else None

    @cached_property
    def crossing(self) -> tuple[int, ...]:
        """The configurations in which panels pass through each other."""
        tolerances = Tolerances.of(precision_of_sheet(self.sheets[0]).size)
        shapes = shapes_of_panels(self.sheets[0], self.mechanism, self.places[0], tolerances)
        return tuple(number for number, points in enumerate(self.places) if shapes.crossing(points) is not None)

    def names(self) -> list[str]:
        """Return what is written beside each configuration: its number and the angle of the crease folded most."""
        most = self.most_folded
        if most is None:
            return [str(number) for number in range(len(self.sheets))]
        return [
            f"{number}: {angle:.4g}°" for number, angle in enumerate((self.angles[:, most] + 0.0).round(9).tolist())
        ]

    def lines(self) -> list[str]:
        """Return the lines on fold angles and on panels that pass through each other."""
        lines, most = [], self.most_folded
        if most is not None:
            crease = list(self.mechanism.hinges)[most]
            angles = self.angles[:, most].tolist()
            if len(angles) > 1:
                lines.append(f"fold angles of crease {crease}, which is folded most")
            else:
                lines.append(f"largest fold angle: {angles[0]:.4g}° at crease {crease}")
        if self.crossing and len(self.sheets) > 1:
            frames = ", ".join(map(str, self.crossing[:_LISTED])) + (", ..." if self.crossing[_LISTED:] else "")
            lines.append(f"panels pass through each other in frames {frames}")
        elif self.crossing:
            lines.append("panels pass through each other")
        return lines
