"""Layer orders of panels in space by geometry: panels moved apart along the normal by their heights, strands drawn.

Round each segment a circle is drawn in the plane across it. Each panel that lies there meets it in one or two points,
moved along the circle by its height; what is one panel, or joined at a crease that runs along the segment, is joined
by a straight line. No two lines may cross. Only the cells of the answer are used: to say what has a height where.
"""

from __future__ import annotations

from itertools import combinations, permutations, product

import numpy as np
import shapely

_RADIUS, _STEP = 1e-3, 1e-5
"""Of the circle, in units of the extent, and in radians for one layer."""


class Strands:
    """The strands round all segments of panels that lie on each other (an answer of `synth.layers_at`)."""

    def __init__(self, answer, signs):
        self.answer, self.signs = answer, signs
        posed, self.planes = answer.state, answer.stacked.planes
        self.points, sheet = posed.points, posed.sheet
        self.radius = _RADIUS * np.ptp(self.points, axis=0).max()
        self.faces = [np.array([self.points[v] for v in face]) for face in sheet.faces]
        self.plate = {}
        for number, panels in enumerate(answer.stacked.plates):
            for face in (f for panel in panels for f in posed.mechanism.panels[panel]):
                self.plate[face] = number
        self.creases = []
        for joint, pieces in posed.mechanism.pieces.items():
            for a, b in pieces:
                beside = [f for f, around in enumerate(sheet.faces) if {a, b} <= set(around)]
                if len(beside) == 2 and self.plate[beside[0]] != self.plate[beside[1]]:
                    self.creases.append((joint, self.points[a], self.points[b], *map(self.plate.get, beside)))
        self.circles = [self._circle(middle, along) for middle, along in self._middles()]

    def _middles(self):
        image = self.answer.image
        for (a, b), strand in zip(image.segments.tolist(), image.strands, strict=True):
            cell = strand.left if strand.left >= 0 else strand.right
            if cell < 0:
                continue
            plane = self.planes[self.answer.stacked.plane_of_cell[cell]]
            ends = plane.lifted(image.nodes[[a, b]])
            yield ends.mean(axis=0), (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])

    def _cell(self, plate, point):
        """The cell over which a plate lies at a point, and the plane; None if it is over no cell of several."""
        for number, plane in enumerate(self.planes):
            if plate in plane.plates and abs((point - plane.origin) @ plane.frame[2]) < self.radius / 100.0:
                place = shapely.Point(plane.flat(point[None])[0])
                for cell, corners in enumerate(self.answer.image.cells):
                    if self.answer.stacked.plane_of_cell[cell] == number:
                        outline = shapely.Polygon(self.answer.image.nodes[list(corners)])
                        if outline.contains(place):
                            return cell, plane
        return None

    def _circle(self, middle, along):
        """Ends of plates on the circle: plate, angle, cell, and 1 if its height is counted with the angle, else -1."""
        across = np.cross(along, [0.3, 0.5, 0.8])
        across /= np.linalg.norm(across)
        third = np.cross(along, across)
        ends = {}
        for face, corners in enumerate(self.faces):
            normal = sum(np.cross(corners[k - 1] - corners[0], corners[k] - corners[0]) for k in range(2, len(corners)))
            normal = normal / np.linalg.norm(normal)
            if np.abs((middle - corners[0]) @ normal) > self.radius / 100.0 or abs(along @ normal) > 1e-6:
                continue
            way = np.cross(normal, along)
            outline = shapely.Polygon(np.column_stack([(corners - middle) @ along, (corners - middle) @ way]))
            for sign in (1.0, -1.0):
                if outline.contains(shapely.Point(0.0, sign * self.radius)):
                    direction = sign * way
                    angle = np.arctan2(direction @ third, direction @ across)
                    there = self._cell(self.plate[face], middle + self.radius * direction)
                    cell, turn = None, 0.0
                    if there is not None:
                        cell = there[0]
                        turn = np.sign(there[1].frame[2] @ np.cross(along, direction))
                    ends[self.plate[face], round(angle, 6)] = (angle, cell, turn)
        pairs = []
        used = set()
        for joint, a, b, one, other in self.creases:
            edge = b - a
            part = (middle - a) @ edge / (edge @ edge)
            if not 0.0 < part < 1.0 or np.linalg.norm(a + part * edge - middle) > self.radius / 100.0:
                continue
            mine = [[key for key in ends if key[0] == plate] for plate in (one, other)]
            assert len(mine[0]) == len(mine[1]) == 1
            pairs.append((mine[0][0], mine[1][0], joint))
            used |= {mine[0][0], mine[1][0]}
        for plate in {plate for plate, _ in ends}:
            mine = [key for key in ends if key[0] == plate and key not in used]
            if len(mine) == 2:
                pairs.append((*mine, None))
        return ends, pairs

    def good(self, heights):
        """Whether no strands cross, and creases are folded to their side; heights by cell and plate."""
        for ends, pairs in self.circles:
            lines = []
            for one, other, joint in pairs:
                places = []
                for key in (one, other):
                    angle, cell, turn = ends[key]
                    angle += 0.0 if cell is None else turn * _STEP * heights[cell, key[0]]
                    places.append((np.cos(angle), np.sin(angle)))
                lines.append(shapely.LineString(places))
                if joint in self.signs and ends[one][1] is not None and ends[one][1] == ends[other][1]:
                    cell = ends[one][1]
                    plane = self.planes[self.answer.stacked.plane_of_cell[cell]]
                    face = next(f for f, plate in self.plate.items() if plate == one[0])
                    corners = self.faces[face]
                    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
                    above = (heights[cell, other[0]] > heights[cell, one[0]]) == (normal @ plane.frame[2] > 0.0)
                    if above != self.signs[joint]:
                        return False
            if any(a.crosses(b) for a, b in combinations(lines, 2)):
                return False
        return True

    def orders(self):
        """The number of orders, by trying all permutations of the plates over each cell."""
        image = self.answer.image
        number = 0
        for stacks in product(*(permutations(above.tolist()) for above in image.above)):
            heights = {(cell, plate): h for cell, stack in enumerate(stacks) for h, plate in enumerate(stack)}
            number += self.good(heights)
        return number
