"""Sheets, solids and models in space: seen from a little above, panels shaded, what lies in front drawn last.

Panels that overlap in the picture are compared where they do: the one nearer to the eye there is drawn later.
Where that goes round in a circle, which it can among three panels, the one whose middle is farthest is drawn
first.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from graphs.errors import UnsolvableError, numbered
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.types import Floats, JointId, LinkId
from synth.analysis.folding.configuration import SheetConfiguration
from synth.analysis.moving._configuration_of import configuration_of
from synth.analysis.moving.motion import configurations_of_file
from synth.making.drawing.layout.mechanisms import layout_of
from synth.making.drawing.mechanisms.labelling import beside, placed
from synth.making.drawing.scene.frame import PLAIN, PictureOptions, captions_of, framed, page_of
from synth.making.drawing.scene.shapes import NORMAL, SMALL, STRONG, Disc, Label, Layer, Line, Point, Shape
from synth.making.drawing.scene.writing import Scene
from synth.making.drawing.space.captions import FoldedStates, camera_line
from synth.making.drawing.space.motion_files import strip_of_frames
from synth.making.drawing.space.panels import (
    SpatialPanels,
    bodies_of,
    panel_shapes,
    panels_of,
    view_from_above,
    view_of_motion,
)
from synth.making.drawing.space.solids import faces_of_shapes

_MANY = 60
"""Number of visible panels above which links are not numbered."""


def folded_scene(sheet: Sheet | SheetConfiguration, options: PictureOptions = PLAIN) -> Scene:
    """Return a picture of a folded sheet: panels shaded, creases in the colours of their letters.

    Numbers are those of links, on panels that are not covered. A file of several frames gives a strip of them. The
    lines below say which crease is folded most, from where it is seen, and which panels pass through each other.
    Raise UnsolvableError if the sheet has no coordinates.
    """
    drawn = sheet.drawn if isinstance(sheet, SheetConfiguration) else sheet
    sheets = configurations_of_file(drawn).sheets
    if sheets[0].coordinates is None:
        raise UnsolvableError("a picture in space requires a sheet with coordinates; try `synth realise`")
    states = FoldedStates(sheets)
    points = states.places[0]
    if len(sheets) > 1:
        lines = captions_of(options.caption, camera_line(view_of_motion(points)))
        return strip_of_frames(sheets[0], states.places, names=states.names(), said=[*lines, *states.lines()])
    panels = panels_of(sheet if isinstance(sheet, SheetConfiguration) else sheets[0])
    links, joints = (len(set(names.values())) for names in (panels.link_of, panels.joint_of))
    said = f"{numbered(links, 'link')}, {numbered(joints, 'joint')}; {camera_line(view_from_above(points))}"
    return _spatial_scene(panels, points, options, said, *(() if options.caption is None else states.lines()))


def solids_scene(solids: HingedSolids, options: PictureOptions = PLAIN) -> Scene:
    """Return a picture of solids hinged at edges: their shapes, or each the hull of its hinges, these orange.

    Numbers are those of links, on their visible parts, and of joints, beside their hinges. Raise InvariantError if
    the axes of a loop do not meet in its centre.
    """
    linkage = configuration_of(solids).linkage
    panels, points = bodies_of(linkage)
    if solids.shapes:
        shown = faces_of_shapes(solids, linkage)
        panels, points = shown.panels(linkage), shown.corners
    links, joints = numbered(len(solids.chain), "link"), numbered(len(solids.chain.joints), "joint")
    return _spatial_scene(panels, points, options, f"{links}, {joints}; in space, hinges orange")


def _spatial_scene(panels: SpatialPanels, points: Floats, options: PictureOptions, *said: str) -> Scene:
    """Return a picture of panels, or of the faces of solids, with corners at points, seen from above."""
    view = view_from_above(points)
    seen = view.places(points)
    extent = float(np.ptp(seen, axis=0).max()) or 1.0
    frame = framed(seen.tolist(), min(options.box) / extent, options.box)
    page = frame.row(seen.tolist())
    shapes, visible = panel_shapes(panels, points, view, page)
    labels: list[Label] = []
    if options.numbers and (panels.solid or len(visible) <= _MANY):
        labels = _numbers(visible, panels.link_of)
        labels += _numbers_of_hinges(panels, page, visible, labels) if panels.solid else []
    layers = [Layer("solids" if panels.solid else "panels", tuple(shapes)), Layer("labels", tuple(labels))]
    return page_of(frame, layers, captions_of(options.caption, *said))


def _numbers_of_hinges(
    panels: SpatialPanels, page: Sequence[Point], visible: Mapping[int, list[Point]], others: Sequence[Label]
) -> list[Label]:
    """Return the numbers of joints beside their visible hinges, off the numbers of links."""
    wishes: list[tuple[Label, list[Point]]] = [(label, [label.at]) for label in others]
    lines: list[tuple[Point, Point]] = []
    labelled: set[JointId] = set()
    for ends, joint in panels.joint_of.items():
        (ax, ay), (bx, by) = (page[end] for end in sorted(ends))
        middle = ((ax + bx) / 2, (ay + by) / 2)
        if joint not in labelled and _is_seen(panels, ends, middle, visible):
            labelled.add(joint)
            label = Label((0, 0), str(joint), 0.85 * SMALL, "class1", widest=8, data=(("joint", str(joint)),))
            wishes.append((label, beside(middle, 0.8 * SMALL)))
            lines.append(((ax, ay), (bx, by)))
    return placed(wishes, (), lines)[len(others) :]


def _is_seen(panels: SpatialPanels, ends: frozenset[int], middle: Point, visible: Mapping[int, list[Point]]) -> bool:
    """Check whether the middle of a hinge is on a face that is drawn, and on none of those drawn later."""
    from shapely.geometry import Point as Spot, Polygon as Area

    drawn = list(visible)
    own = [place for place, face in enumerate(drawn) if ends <= set(panels.faces[face])]
    spot = Spot(middle)
    return bool(own) and not any(Area(visible[face]).buffer(-0.5).contains(spot) for face in drawn[max(own) + 1 :])


def _numbers(visible: Mapping[int, list[Point]], link_of: Mapping[int, LinkId]) -> list[Label]:
    """Return the numbers of links on the parts of panels that later panels do not cover."""
    from shapely import union_all
    from shapely.geometry import Polygon as Area

    wishes: list[tuple[Label, list[Point]]] = []
    cover, above = Area(), [Area()]
    numbered_links: set[LinkId] = set()
    for face, row in reversed(list(visible.items())):
        area, link = Area(row).buffer(0), link_of.get(face)
        if link is None or link in numbered_links or area.area < 30:
            above.append(area)
            continue
        # Of solids with bores there are thousands of faces: those above are united only where one may be numbered.
        cover, above = union_all([cover, *above]), [area]
        free = area.difference(cover)
        if free.area < max(0.25 * area.area, 30):
            continue
        numbered_links.add(link)
        point = free.centroid if free.contains(free.centroid) else free.representative_point()
        label = Label((0, 0), str(link), SMALL, bold=True, halo=False, widest=8, data=(("link", str(link)),))
        wishes.append((label, [(point.x, point.y), *beside((point.x, point.y), 4)]))
    return placed(wishes)


def model_scene(model: PolyhedronModel, options: PictureOptions = PLAIN) -> Scene:
    """Return a picture of a polyhedron model: vertices, rods, remote centres and what else it has, in words.

    With coordinates it is seen from a little above; without, it is drawn as a graph.
    """
    vertices = list(model.nodes)
    scissors = [(four[i], four[(i + 1) % 4]) for four in model.scissors for i in range(4)]
    pairs = [*model.edges, *scissors]
    if model.coordinates:
        points = np.array([model.coordinates[v] for v in vertices])
        seen = view_from_above(points).places(points)
        places = dict(zip(vertices, seen.tolist(), strict=True))
        unit = 0.7 * min(options.box) / (float(np.ptp(seen, axis=0).max()) or 1.0)
    else:
        layout = layout_of(vertices, dict(enumerate(pairs)), as_bodies=False)
        places, unit = {vertex: list(place) for vertex, place in layout.links.items()}, 52.0
    frame = framed(places.values(), unit, options.box)
    page = {vertex: frame.at(place) for vertex, place in places.items()}
    ground = model.ground or frozenset()
    rods: list[Shape] = []
    for a, b in model.edges:
        fixed = a in ground and b in ground
        rods.append(Line([page[a], page[b]], "grey" if fixed else "ink", STRONG if fixed else NORMAL))
    rods += [Line([page[a], page[b]], "class1", NORMAL, (3.0, 2.0)) for a, b in scissors]
    dots = [Disc(page[v], 2.6, "ground" if v in ground else "paper", "ink") for v in vertices]
    lines = [(page[a], page[b]) for a, b in pairs]
    wishes = [(Label((0, 0), str(v), SMALL, widest=10), beside(page[v], 8)) for v in vertices]
    labels = placed(wishes, [(*page[v], 3.4) for v in vertices], lines if len(lines) < 200 else ())
    layers = [Layer("rods", tuple(rods)), Layer("vertices", tuple(dots)), Layer("labels", tuple(labels))]
    return page_of(frame, layers, captions_of(options.caption, *_terms(model)))


def _terms(model: PolyhedronModel) -> list[str]:
    said = f"{numbered(len(model), 'vertex', 'vertices')}, {numbered(model.number_of_edges(), 'rod')}"
    if model.scissors:
        said += f", {len(model.scissors)} scissors (dashed)"
    if model.ground:
        said += f"; ground link grey, {numbered(len(model.ground), 'vertex', 'vertices')}"
    lines = [said]
    if model.centres:
        lines.append("remote centres: " + ", ".join(f"S+{centre.k}" for centre in model.centres))
    if model.on_line or model.on_plane:
        lines.append(f"{numbered(len(model.on_line), 'point')} on lines, {len(model.on_plane)} on planes")
    return lines
