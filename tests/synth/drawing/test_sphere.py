"""Pictures of orientations: what is on them, and that files are written whole."""

import sys

import numpy as np
import pytest
from cranks import random_orientations
from matplotlib.colors import to_rgba

from graphs.errors import FileError, UnsolvableError
from synth.drawing.figure import save_figure
from synth.drawing.labels import spread
from synth.drawing.sphere import CCW, CW, NEITHER, draw_hoop, draw_map, hammer, hammer_inverse
from synth.guidance.dyads import dyads_of_three
from synth.guidance.four import centre_axes
from synth.guidance.hoop_method import hoop
from synth.guidance.order import order_verdicts


def texts(figure):
    return [text.get_text() for axes in figure.axes for text in axes.texts]


def test_the_sphere_shows_every_axis_and_orientation(tmp_path):
    given = random_orientations(5, np.random.default_rng(61))
    turned = hoop(given, (1, 2, 3), "cw")
    figure = draw_hoop(given, (1, 2, 3), turned)
    written = texts(figure)
    for pair in given.pairs():
        assert "S{}{}".format(*pair) in written
    assert {"G", "1", "2", "3", "4", "5"} <= set(written)
    for crossing in turned.crossings:
        assert any(text.endswith(f"\n{np.degrees(crossing.angle):.1f}") for text in written)
    for name in ("a.svg", "a.png", "a.pdf"):
        save_figure(figure, tmp_path / name)
        assert (tmp_path / name).stat().st_size > 5000
    assert {path.name for path in tmp_path.iterdir()} == {"a.svg", "a.png", "a.pdf"}


def test_the_map_has_the_colours_of_the_verdicts():
    given = random_orientations(4, np.random.default_rng(62))
    figure = draw_map(given, curves=centre_axes(given, 100), width=120)
    (picture,) = (image.get_array() for image in figure.axes[0].images)
    x, y = np.linspace(-np.sqrt(8), np.sqrt(8), 120), np.linspace(-np.sqrt(2), np.sqrt(2), 60)
    points, inside = hammer_inverse(*np.meshgrid(x, y))
    verdicts = order_verdicts(given, points.reshape(-1, 3)).reshape(inside.shape)
    for verdict, colour in ((1, CCW), (-1, CW), (0, NEITHER)):
        there = inside & (verdicts == verdict)
        assert there.any()
        assert np.allclose(picture[there], to_rgba(colour))
    assert np.all(picture[~inside][:, 3] == 0.0)


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
    assert texts(draw_map(given, width=60)) == []
    many = random_orientations(16, np.random.default_rng(65))
    with pytest.raises(UnsolvableError, match="a picture of 16 orientations shows nothing; 15 at most"):
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


def test_without_matplotlib_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    given = random_orientations(3, np.random.default_rng(68))
    for draw in (lambda: draw_map(given), lambda: draw_hoop(given, (1, 2, 3), hoop(given, (1, 2, 3)))):
        with pytest.raises(UnsolvableError, match=r"pictures need matplotlib: pip install 'synthedra\[draw\]'"):
            draw()


def test_pictures_of_other_kinds_are_refused(tmp_path):
    given = random_orientations(3, np.random.default_rng(69))
    with pytest.raises(FileError, match="the extension is not known"):
        save_figure(draw_map(given, width=60), tmp_path / "a.jpeg")


def test_borders_of_regions_are_smooth():
    """On a border colours are mixed; whole regions have the three colours of the legend."""
    pytest.importorskip("matplotlib")
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    figure = draw_map(random_orientations(5, np.random.default_rng(61)), width=400)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    (image,) = figure.axes[0].images
    pixels = image.make_image(canvas.get_renderer())[0].reshape(-1, 4)
    colours, counts = np.unique(pixels[pixels[:, 3] == 255], axis=0, return_counts=True)
    assert len(colours) > 10
    assert np.sort(counts)[-3:].sum() > 0.9 * counts.sum()
