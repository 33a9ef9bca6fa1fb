"""Templates cut out and folded up in software, by the places of panels alone; tabs as a motion carries them."""

from __future__ import annotations

from collections import defaultdict

import numpy as np
import shapely

from synth.making.templates.unfolding import nets_of


def check_cuts(piece):
    """The piece hangs together, its outline is cut, nothing outside it is, and no line is cut twice."""
    assert piece.covered.geom_type == "Polygon"
    ends = np.array([(one.start, one.end) for one in piece.strokes if one.kind == "CUT"])
    lines = shapely.linestrings(ends)
    cuts = shapely.union_all(lines)
    assert piece.covered.boundary.difference(cuts.buffer(1e-5)).is_empty
    assert piece.covered.buffer(1e-5).contains(cuts)
    assert abs(shapely.length(lines).sum() - cuts.length) < 1e-6 * cuts.length


def tabs_of(panels, piece, net):
    """Edge to (tab float[4, 2], face that it hangs on): what is enclosed by lines and is no panel."""
    lines = shapely.linestrings(np.array([(one.start, one.end) for one in piece.strokes]))
    shapes = shapely.polygonize([shapely.union_all(lines, grid_size=1e-7)]).geoms
    laid = {face: shapely.Polygon(corners) for face, corners in net.corners.items()}
    found = {}
    for shape in shapes:
        inner = shape.representative_point()
        if any(polygon.contains(inner) for polygon in laid.values()):
            continue
        edge, face, ends = _base(panels, net, shape)
        assert edge not in found
        found[edge] = (np.array(shape.exterior.coords[:-1]), face, ends)
    return found


def _base(panels, net, shape):
    """The edge at which a tab hangs: both its ends are corners of the tab."""
    corners = np.array(shape.exterior.coords[:-1])
    for edge, faces in panels.joins.items():
        for face in set(faces) & set(net.corners):
            ends = net.corners[face][list(panels.ends(face, edge))]
            if all(np.abs(corners - end).max(axis=1).min() < 1e-5 for end in ends):
                return edge, face, ends
    raise AssertionError("a part of a piece is neither a panel nor a tab")


def folded_up(panels, net):
    """Places of corners in space when a net is folded along its creases by their angles, from its first panel on."""
    motions = {next(iter(net.corners)): (np.eye(3), np.zeros(3))}
    waiting = list(motions)
    while waiting:
        face = waiting.pop()
        turn, shift = motions[face]
        for edge, pair in panels.joins.items():
            other = sum(pair) - face
            if face not in pair or other in motions or other not in net.corners:
                continue
            (a, b), (c, d) = panels.ends(face, edge), panels.ends(other, edge)
            start, end = net.corners[face][[a, b]]
            same_way = panels.sheet.faces[face][a] == panels.sheet.faces[other][c]
            there = net.corners[other][[c, d] if same_way else [d, c]]
            if np.abs(there - [start, end]).max() > 1e-6:
                continue  # glued, not folded
            along = np.append((end - start) / np.linalg.norm(end - start), 0)
            across = np.cross([[1, 0, 0], [0, 1, 0], [0, 0, 1]], along)
            angle = panels.fold_angle(edge)  # seen from the front of the first panel
            if (same_way and face != pair[0]) != net.turned[face]:
                angle = -angle
            if net.turned[face]:
                along, across = -along, -across  # its corners go round the other way
            # The other panel is on the right of the edge: a valley, which lifts it, turns it the negative way.
            bent = np.eye(3) - np.sin(angle) * across + (1 - np.cos(angle)) * across @ across
            hinge = np.append(start, 0)
            motions[other] = (turn @ bent, turn @ (hinge - bent @ hinge) + shift)
            waiting.append(other)
    flat = {face: np.column_stack([corners, np.zeros(len(corners))]) for face, corners in net.corners.items()}
    return {face: flat[face] @ turn.T + shift for face, (turn, shift) in motions.items()}


def check_closes(panels, near=1e-9):
    """Every net that is folded up, its first panel where it stands, has all panels where they stand."""
    laid = set()
    for net in nets_of(panels):
        stands = folded_up(panels, net)
        assert set(stands) == set(net.corners)
        first = panels.planes[next(iter(net.corners))]
        for face, corners in stands.items():
            placed = corners @ first.axes.T + first.origin
            np.testing.assert_allclose(placed, panels.places[list(panels.sheet.faces[face])], rtol=0, atol=near)
        laid |= set(stands)
    assert laid == set(range(len(panels.sheet.faces)))


def check_tabs(panels, pieces, poses):
    """Tabs lie beside all else in their net; glued, within their panel, off other tabs; and in every pose they hinge.

    Returns how many there are.
    """
    glued, count = defaultdict(list), 0
    for net, piece in zip(nets_of(panels), pieces, strict=True):
        for edge, (corners, face, ends) in tabs_of(panels, piece, net).items():
            other = sum(panels.joins[edge]) - face
            along = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
            outward = np.array([along[1], -along[0]]) * (-1 if net.turned[face] else 1)
            local = np.column_stack([(corners - ends[0]) @ along, (corners - ends[0]) @ outward])
            assert shapely.Polygon(local).is_valid
            tab = shapely.Polygon(_across(panels.places, panels, other, edge, face, local))
            own = shapely.Polygon(_seen(panels.places, panels, other))
            assert own.buffer(1e-5).contains(tab)
            assert all(tab.intersection(one).area < 1e-4 for one in glued[other])
            glued[other].append(tab)
            count += 1
            for places in poses:  # it goes where its panel goes, and its fold stays on the edge of the one it is of
                stands = _in_space(places, panels, other, edge, face, local)
                line = places[list(panels.sheet.edges[edge])]
                base = stands[np.abs(local[:, 1]) < 1e-5]
                assert len(base) >= 2
                off = np.cross(base - line[0], (line[1] - line[0]) / np.linalg.norm(line[1] - line[0]))
                assert np.abs(off).max() < 1e-5
    return count


def _in_space(places, panels, other, edge, face, local):
    """Where a tab is that is glued to a panel: lengths along its edge, and from it to the side of the panel."""
    a, b = (panels.sheet.faces[face][corner] for corner in panels.ends(face, edge))
    along = (places[b] - places[a]) / np.linalg.norm(places[b] - places[a])
    inward = _inward(places, panels, other, places[a], along)
    return places[a] + local[:, :1] * along + local[:, 1:] * inward


def _inward(places, panels, face, start, along):
    """The direction in a panel at right angles to one of its edges, to where the panel is."""
    corners = places[list(panels.sheet.faces[face])]
    normal = np.cross(corners, np.roll(corners, -1, axis=0)).sum(axis=0)
    inward = np.cross(normal, along)
    inward /= np.linalg.norm(inward)
    around = list(panels.sheet.faces[face])
    step = places[around[(_place(places, around, start) + 1) % len(around)]] - start
    forward = step @ along > (1 - 1e-9) * np.linalg.norm(step)
    return inward if forward else -inward


def _place(places, around, start):
    return int(np.abs(places[around] - start).sum(axis=1).argmin())


def _frame(places, panels, face):
    corners = places[list(panels.sheet.faces[face])]
    normal = np.cross(corners, np.roll(corners, -1, axis=0)).sum(axis=0)
    first = (corners[1] - corners[0]) / np.linalg.norm(corners[1] - corners[0])
    second = np.cross(normal / np.linalg.norm(normal), first)
    return corners[0], np.column_stack([first, second])


def _seen(places, panels, face):
    """The corners of a panel in its plane."""
    origin, axes = _frame(places, panels, face)
    return (places[list(panels.sheet.faces[face])] - origin) @ axes


def _across(places, panels, other, edge, face, local):
    origin, axes = _frame(places, panels, other)
    return (_in_space(places, panels, other, edge, face, local) - origin) @ axes
