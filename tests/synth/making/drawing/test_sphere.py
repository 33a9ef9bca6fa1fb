"""Pictures of orientations: what is on them, that regions are those of the verdicts, that SVG needs no more."""

import sys
from pathlib import Path

import numpy as np
import pytest
from commands import run
from cranks import random_orientations
from shapely.geometry import Point, Polygon
from sizes import slow

from graphs.errors import UnsolvableError
from synth.linkages.guidance._guiding_dyads import guiding_dyads
from synth.linkages.guidance.dyads import centre_axes, dyads_of_three
from synth.linkages.guidance.order import hoop, order_verdicts
from synth.linkages.guidance.orientations import read_orientations
from synth.making.drawing.scene import shapes
from synth.making.drawing.sphere import CCW, CW, NEITHER, draw_hoop, draw_map, hammer, hammer_inverse, spread

TASK = Path(__file__).resolve().parents[4] / "data" / "orientations" / "tipparthi.json"


def texts(scene):
    return [label.text for label in scene.labels()]


def layer(scene, name):
    return next(layer.shapes for layer in scene.layers if layer.name == name)


def test_the_sphere_shows_every_axis_and_orientation():
    given = random_orientations(5, np.random.default_rng(61))
    turned = hoop(given, (1, 2, 3), "cw")
    written = texts(draw_hoop(given, (1, 2, 3), turned))
    for pair in given.pairs():
        assert "S{}{}".format(*pair) in written
    assert {"G", "1", "2", "3", "4", "5"} <= set(written)
    for crossing in turned.crossings:
        assert f"{np.degrees(crossing.angle):.1f}" in written


def test_names_of_axes_keep_off_each_other_and_off_the_numbers_of_orientations():
    given = random_orientations(5, np.random.default_rng(61))
    scene = draw_hoop(given, (1, 2, 3), hoop(given, (1, 2, 3), "cw"))
    names = [shape.at for shape in layer(scene, "axes") if isinstance(shape, shapes.Label)]
    others = [shape.at for shape in layer(scene, "orientations") if isinstance(shape, shapes.Label)]
    apart = [np.hypot(a[0] - b[0], a[1] - b[1]) for i, a in enumerate(names) for b in [*names[:i], *others]]
    assert min(apart) > 5.0


def overlapping(labels):
    """Pairs of names of which letters lie on letters."""
    pairs = []
    for i, one in enumerate(labels):
        for other in labels[:i]:
            wide = min(one.box[2], other.box[2]) - max(one.box[0], other.box[0])
            high = min(one.box[3], other.box[3]) - max(one.box[1], other.box[1])
            if wide > 0.5 and high > 0.5:
                pairs.append((one.text, other.text))
    return pairs


def test_names_of_axes_do_not_lie_on_each_other_beside_a_crank_rocker():
    """Its relative axes are near each other: names keep a name's width off, not only its height."""
    given = read_orientations(TASK.with_name("crank-rocker.json"))
    for dyad in guiding_dyads(given).dyads:
        scene = draw_hoop(given, dyad.fixed, hoop(given, dyad.fixed))
        names = [shape for shape in layer(scene, "axes") if isinstance(shape, shapes.Label)]
        assert overlapping(names) == []


def painted(scene, spots):
    """The colour that is seen at each place of the map: of the last region that covers it."""
    seen = np.array([None] * len(spots), dtype=object)
    for shape in layer(scene, "regions"):
        if isinstance(shape, shapes.Polygon):
            area = Polygon(shape.points)
            for i, spot in enumerate(spots):
                if area.contains(Point(spot)):
                    seen[i] = shape.fill
    return seen


@pytest.mark.parametrize("seed", [61, slow(62)])
def test_the_map_has_the_colours_of_the_verdicts(seed):
    """At random places of the sphere, but where the verdict is another a thousandth beside it."""
    given = random_orientations(4, np.random.default_rng(seed))
    scene = draw_map(given, curves=centre_axes(given, 100), width=200)
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(600, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    verdicts = order_verdicts(given, points)
    near = [order_verdicts(given, points + 2e-3 * rng.normal(size=3)) == verdicts for _ in range(8)]
    sure = np.all(near, axis=0)
    points, verdicts = points[sure], verdicts[sure]
    assert {-1, 0, 1} == set(verdicts.tolist())
    whole = layer(scene, "regions")[0].points
    (left, right), (top, bottom) = ((min(p[i] for p in whole), max(p[i] for p in whole)) for i in (0, 1))
    x, y = hammer(points)
    across = (left + right) / 2 + x / np.sqrt(8) * (right - left) / 2
    down = (top + bottom) / 2 - y / np.sqrt(2) * (bottom - top) / 2
    colours = {1: CCW, -1: CW, 0: NEITHER}
    expected = [colours[int(verdict)] for verdict in verdicts]
    agree = painted(scene, list(zip(across, down, strict=True))) == np.array(expected, dtype=object)
    assert agree.mean() > 0.99


def test_borders_of_regions_are_no_steps():
    """A border turns little from one corner to the next, where steps would turn by a right angle each time."""
    scene = draw_map(random_orientations(5, np.random.default_rng(61)), width=200)
    turns = []
    for shape in layer(scene, "regions")[1:]:
        if isinstance(shape, shapes.Polygon):
            row = np.asarray(shape.points)
            along = np.diff(np.concatenate([row, row[:2]]), axis=0)
            angles = np.arctan2(along[:, 1], along[:, 0])
            turns += np.abs((np.diff(angles) + np.pi) % (2 * np.pi) - np.pi).tolist()
    assert len(turns) > 30
    assert np.median(turns) < np.radians(15)


def test_the_map_numbers_the_dyads():
    given = random_orientations(3, np.random.default_rng(63))
    written = texts(draw_map(given, dyads_of_three(given, [(1, 0, 2), (2, 1, 0)]), width=60))
    assert written.count("1") == written.count("2") == 2  # both ends of each axis


def test_many_orientations_are_drawn_without_their_pairs():
    given = random_orientations(12, np.random.default_rng(64))
    written = texts(draw_hoop(given, (1, 2, 3), hoop(given, (1, 2, 3))))
    assert "S13" in written
    assert "S1,12" in written
    assert "S34" not in written
    assert layer(draw_map(given, width=60), "axes") == ()
    many = random_orientations(16, np.random.default_rng(65))
    with pytest.raises(UnsolvableError, match="16 orientations are too many for a picture; at most 15"):
        draw_hoop(many, (1, 2, 3), hoop(many, (1, 2, 3)))


def test_the_hammer_map_keeps_areas_and_comes_back():
    rng = np.random.default_rng(66)
    points = rng.normal(size=(200_000, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    x, y = hammer(points)
    back, inside = hammer_inverse(x, y)
    assert inside.all()
    assert np.allclose(back, points, atol=1e-6)
    counts, *_ = np.histogram2d(x, y, bins=(8, 4), range=((-1.2, 1.2), (-0.6, 0.6)))
    assert counts.std() < 0.04 * counts.mean()


def test_labels_keep_their_distance():
    rng = np.random.default_rng(67)
    points = np.concatenate([rng.uniform(-1, 1, (20, 2)), np.zeros((3, 2))])
    places = spread(points, 0.08, 0.1)
    apart = np.linalg.norm(places[:, None] - places[None], axis=2) + np.eye(len(places))
    assert apart.min() > 0.08
    assert np.linalg.norm(places - points, axis=1).max() < 0.5
    row = spread(np.stack([np.linspace(0, 0.2, 6), np.zeros(6)], axis=1), 0.0, 0.1, only_x=True)
    assert np.all(row[:, 1] == 0.0)
    assert np.diff(np.sort(row[:, 0])).min() > 0.08


def test_svg_of_orientations_needs_no_matplotlib(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    axis = "--axis=-0.349,-0.144,0.926"
    for name in "ab":
        run("order", "--orientations", TASK, axis, "--direction", "cw", "-o", tmp_path / f"{name}.svg")
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()
    told = run("order", "--orientations", TASK, axis, "--direction", "cw", "-o", tmp_path / "a.png", code=2).stderr
    assert "PNG requires matplotlib; try pip install 'synthedra[draw]'" in told


def test_a_map_without_contourpy_is_refused_in_one_line(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "contourpy", None)
    told = run("draw", TASK, "-o", tmp_path / "a.svg", code=2).stderr
    assert "a map of the sphere requires contourpy; try pip install 'synthedra[draw]'" in told
    assert told.count("\n") == 1
