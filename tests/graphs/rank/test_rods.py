import random
from collections import Counter
from itertools import combinations

import numpy as np
import pytest
from strategies import random_scd

from graphs.convert.panels import polyhedron_of
from graphs.count.equations import mobility_of_model
from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read
from graphs.mechanism.polyhedron import PointConstraint, PolyhedronModel, RemoteCentre
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.rank.exact import exact_mobility
from graphs.rank.infinitesimal import infinitesimal_mobility_of_axes, infinitesimal_mobility_of_model
from graphs.rank.realisation import PRIMES, PrimeField
from graphs.rank.rods import exact_mobility_of_model, place_model


def test_models_of_wampler(data):
    # a rod alone has five freedoms, which Eq. 5 takes for six
    exceptions = {"tetrahedron-locked.json": (-1, 0), "fig2.json": (-1, 0)}
    found = 0
    for file in sorted((data / "wampler").glob("*.json")):
        model = read(file)
        if isinstance(model, PolyhedronModel):
            count = mobility_of_model(model)
            pair = count, exact_mobility_of_model(model).mobility
            assert pair == exceptions.get(file.name, (count, count)), file
            found += 1
    assert found >= 20


def test_both_roads_on_all_scd_graphs_of_the_papers(mechanisms):
    found = 0
    for file in mechanisms:
        scd = read(file)
        if isinstance(scd, SCDGraph):
            assert exact_mobility_of_model(polyhedron_of(scd)).mobility == exact_mobility(scd).mobility, file
            found += 1
    assert found >= 40


@pytest.mark.parametrize("seed", range(60))
def test_both_roads_on_random_scd_graphs(seed):
    scd = random_scd(random.Random(seed), refused=Counter())
    assert exact_mobility_of_model(polyhedron_of(scd)).mobility == exact_mobility(scd).mobility


def test_bodies_that_rods_show_get_an_apex():
    """Without their apexes the four coplanar points of each link would have 2 freedoms (docs/misprints.md 004-5)."""
    model = read("data/wampler/fig12.json")
    bare = PolyhedronModel(model.nodes, model.edges, centres=model.centres)
    assert exact_mobility_of_model(model).mobility == exact_mobility_of_model(bare).mobility == 1


def test_points_on_lines_and_planes():
    body = list(combinations(range(4), 2))
    line = PolyhedronModel(5, body, on_line=[PointConstraint(4, (0, 1))])
    assert exact_mobility_of_model(line).mobility == mobility_of_model(line) == 1
    plane = PolyhedronModel(5, body, on_plane=[PointConstraint(4, (0, 1, 2))])
    assert exact_mobility_of_model(plane).mobility == mobility_of_model(plane) == 2
    field = PrimeField(PRIMES[0])
    p = place_model(plane, field)
    rows = [[p[v][k] - p[0][k] for k in range(3)] for v in (1, 2, 4)]
    det = sum(
        s * rows[0][i] * rows[1][j] * rows[2][k]
        for (i, j, k), s in {
            (0, 1, 2): 1,
            (1, 2, 0): 1,
            (2, 0, 1): 1,
            (0, 2, 1): -1,
            (2, 1, 0): -1,
            (1, 0, 2): -1,
        }.items()
    )
    assert det % field.prime == 0


def test_what_cannot_be_placed():
    with pytest.raises(UnsolvableError, match="does not say which rods"):
        exact_mobility_of_model(PolyhedronModel(3, [(0, 1)], centres=[RemoteCentre(3)]))


def test_wamplers_first_figure_at_its_poses():
    """One freedom in general, two on the folded branch (B = F, C = E), three where all is flat."""
    names = dict(zip("BCHGFEAD", range(8), strict=True))
    links = {"".join(p): tuple(p) for p in ("BCHG", "FEHG", "AGB", "AGF", "DHC", "DHE")}
    rods = {frozenset(side) for around in links.values() for side in zip(around, around[1:] + around[:1], strict=True)}
    rods |= {frozenset(pair) for pair in ("BH", "CG", "FH", "EG")}

    def dof(places):
        made = PolyhedronModel(sorted(names), [tuple(sorted(rod)) for rod in rods], coordinates=places, links=links)
        return infinitesimal_mobility_of_model(made).dof

    base = {"G": (0.0, 0.0, 0.0), "H": (2.0, 0.0, 0.0), "B": (0.0, 1.0, 0.0), "C": (2.0, 1.0, 0.0)}
    angle = 0.8
    wing = {"F": (0.0, np.cos(angle), np.sin(angle)), "E": (2.0, np.cos(angle), np.sin(angle))}
    middle = np.array([0.0, np.cos(angle / 2), np.sin(angle / 2)])
    tips = {"A": tuple(np.array([-0.7, 0, 0]) + 0.6 * middle), "D": tuple(np.array([2.9, 0, 0]) + 0.5 * middle)}
    assert dof({**base, **wing, **tips}) == 1
    folded = {**base, "F": base["B"], "E": base["C"], "A": (-0.7, 0.2, 0.5), "D": (2.9, 0.3, 0.6)}
    assert dof(folded) == 2
    flat = {**folded, "A": (-0.7, 0.3, 0.0), "D": (2.9, 0.4, 0.0)}
    assert dof(flat) == 3


def test_the_perfect_cube_has_two_infinitesimal_flexes():
    model = read("data/wampler/cube-locked.json")
    corners = [(float(x), float(y), float(z)) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    places = {v: corners[v] if v < 8 else (0.0, 0.0, 0.0) for v in model}
    cube = PolyhedronModel(model.nodes, model.edges, coordinates=places)
    found = infinitesimal_mobility_of_model(cube)
    assert (found.dof, found.self_stresses) == (2, 1)
    assert exact_mobility_of_model(model).mobility == 1


def test_bricards_octahedron_flexes():
    """Line-symmetric: three pairs of points, each the other turned by half a turn about an axis."""
    half = np.random.default_rng(4).normal(size=(3, 3))
    points = np.vstack([half, half * [-1, -1, 1]])
    rods = [(a, b) for a, b in combinations(range(6), 2) if b - a != 3]
    made = PolyhedronModel(6, rods, coordinates={v: tuple(points[v]) for v in range(6)})
    assert infinitesimal_mobility_of_model(made).dof == 1
    assert exact_mobility_of_model(made).mobility == 0
    moved = points + np.random.default_rng(5).normal(scale=0.05, size=points.shape)
    assert (
        infinitesimal_mobility_of_model(
            PolyhedronModel(6, rods, coordinates=dict(zip(range(6), map(tuple, moved), strict=True)))
        ).dof
        == 0
    )


def bennett(alpha, theta, ratio):
    """Axes of a Bennett linkage: opposite links equal, a / sin(alpha) = b / sin(beta)."""
    beta = np.arcsin(ratio * np.sin(alpha))
    lengths, twists = (1.0, ratio) * 2, (alpha, beta) * 2
    second = 2 * np.arctan(np.sin((beta + alpha) / 2) / np.sin((beta - alpha) / 2) / np.tan(theta / 2))
    frame, axes = np.eye(4), []
    for length, twist, turn in zip(lengths, twists, (theta, second, -theta, -second), strict=True):
        c, s = np.cos(turn), np.sin(turn)
        about_z = np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
        ct, st = np.cos(twist), np.sin(twist)
        along_x = np.array([[1, 0, 0, length], [0, ct, -st, 0], [0, st, ct, 0], [0, 0, 0, 1]])
        axes.append((frame[:3, 3], frame[:3, 2]))
        frame = frame @ about_z @ along_x
    return axes, frame


def test_bennetts_linkage_moves():
    ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])
    axes, frame = bennett(0.6, 1.1, 1.4)
    assert np.allclose(frame, np.eye(4))
    assert infinitesimal_mobility_of_axes(ring, dict(zip(range(4), axes, strict=True))).dof == 1
    assert exact_mobility(ring).mobility == 0
    tilted = [(p, u + 0.01 * np.array([1, 2, -1]) * (i == 0)) for i, (p, u) in zip(range(4), axes, strict=True)]
    assert infinitesimal_mobility_of_axes(ring, dict(zip(range(4), tilted, strict=True))).dof == 0


def test_bennetts_linkage_with_noise():
    """Noise takes its one freedom, and that is told: the answer is 1, or 0 and nearly mobile, or none."""
    ring = SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)])
    axes, _ = bennett(0.6, 1.1, 1.4)
    rng = np.random.default_rng(0)
    for noise in (*np.repeat(10.0 ** -np.arange(4, 15), 5),):
        moved = {i: (p + rng.normal(size=3) * noise, u + rng.normal(size=3) * noise) for i, (p, u) in enumerate(axes)}
        found = infinitesimal_mobility_of_axes(ring, moved)
        assert found.dof in (None, 1) or (found.dof, found.spectrum.nearly) == (0, 1)


def test_odd_poses():
    with pytest.raises(UnsolvableError, match="require coordinates"):
        infinitesimal_mobility_of_model(PolyhedronModel(2, [(0, 1)]))
    with pytest.raises(InvariantError, match="has no length"):
        infinitesimal_mobility_of_model(PolyhedronModel(2, [(0, 1)], coordinates={0: (0, 0, 0), 1: (0, 0, 0)}))
    with pytest.raises(InvariantError, match="has no direction"):
        infinitesimal_mobility_of_axes(SCGraph(2, [(0, 1)]), {0: ((0, 0, 0), (0, 0, 0))})
