"""Declared S+k against coordinates: loops of scissors, identical or mirrored, and rods that meet."""

import numpy as np
import pytest
from seeded import seed_file

import synth
from graphs.answer.remote import notes_on_centres, scissors_pairs
from graphs.files.formats import read
from graphs.mechanism.polyhedron import PolyhedronModel, RemoteCentre


def _loop(number, arms, opening, centres=(4,)):
    """A regular spherical loop of straight scissors; arms (outer, inner) of rays in turn, mirror images."""
    (a, b), (c, d) = arms
    u, w = np.array([np.cos(opening), np.sin(opening)]), np.array([np.cos(opening), -np.sin(opening)])
    ends = a * u, b * w, -c * w, -d * u  # far and near on one ray, far and near on the next
    share = np.linalg.solve(np.array([ends[1] - ends[0], ends[2] - ends[3]]).T, ends[2] - ends[0])[0]
    apex = ends[0] + share * (ends[1] - ends[0])
    sizes = [float(np.linalg.norm(end - apex)) for end in ends]
    between = np.arccos((ends[0] - apex) @ (ends[2] - apex) / sizes[0] / sizes[2])
    slope = np.arcsin(np.sin(between / 2) / np.sin(np.pi / number))
    places = {}
    for i in range(number):
        turn = 2 * np.pi * i / number
        ray = np.array([np.sin(slope) * np.cos(turn), np.sin(slope) * np.sin(turn), np.cos(slope)])
        far, near = sizes[:2] if i % 2 == 0 else sizes[2:]
        places[f"A{i}"], places[f"B{i}"] = tuple(far * ray), tuple(near * ray)
    scissors = [(f"A{i}", f"B{i}", f"A{(i + 1) % number}", f"B{(i + 1) % number}") for i in range(number)]
    return PolyhedronModel(places, coordinates=places, scissors=scissors, centres=[RemoteCentre(k) for k in centres])


IDENTICAL, MIRRORED = ((1.0, 0.6), (1.0, 0.6)), ((1.0, 0.6), (1.3, 0.7))


@pytest.mark.parametrize("arms", [IDENTICAL, MIRRORED])
@pytest.mark.parametrize("number", [4, 6])
def test_the_declared_k_is_confirmed(arms, number):
    model = _loop(number, arms, 0.5)
    (note,) = notes_on_centres(model)
    assert note.startswith(f"declared k = 4, confirmed: a = a' and b = b' at all {number} pairs")
    answer = synth.mobility(model)
    assert answer.mobility == answer.exact.mobility == answer.infinitesimal.dof == number - 2
    assert note in answer.warnings
    one = scissors_pairs(model)[0]
    assert one.arms[0] == pytest.approx(arms[1])
    assert one.arms[1] == pytest.approx(arms[1])


def test_ratios_hold_at_every_opening():
    """The centre divides the distance of the ends of a ray alike however far the loop is open."""
    ratios = [np.array([pair.ratios for pair in scissors_pairs(_loop(4, MIRRORED, x))]) for x in (0.3, 0.5, 0.6)]
    assert all(np.allclose(one, ratios[0]) for one in ratios)


def test_the_declared_k_is_refused_with_the_numbers():
    good = _loop(4, IDENTICAL, 0.5)
    places = dict(good.coordinates)
    places["A1"] = tuple(1.1 * x for x in places["A1"])
    bent = PolyhedronModel(places, coordinates=places, scissors=good.scissors, centres=good.centres)
    (note,) = notes_on_centres(bent)
    assert note.startswith("declared k = 4, refused: a pair of scissors does not open with the others")
    assert "a = 0." in note
    assert "a' = 1," in note
    (note,) = notes_on_centres(_loop(4, IDENTICAL, 0.5, centres=(3,)))
    assert note.startswith("declared k = 3, refused: k = 4 for each of 1 independent loop")


def test_k_is_found_where_none_is_declared_and_not_checked_without_coordinates():
    (note,) = notes_on_centres(_loop(4, MIRRORED, 0.5, centres=()))
    assert note.startswith("k = 4 found for 1 independent loop of scissors, not declared")
    assert "declared k = 4, not checked: no coordinates" in synth.mobility(seed_file("scissors-4")).warnings


def test_rods_of_a_centre_meet_there_or_do_not():
    bare = read("data/wampler/fig12.json")
    rng = np.random.default_rng(1)
    places = {}
    for a, b in bare.centres[0].rods:
        ray = rng.normal(size=3)
        places[a], places[b] = tuple(ray), tuple(1.7 * ray)
    model = PolyhedronModel(bare.nodes, bare.edges, coordinates=places, centres=bare.centres, links=dict(bare.links))
    (note,) = notes_on_centres(model)
    assert note.startswith("declared k = 3: the lines of its 4 rods meet in a point")
    assert synth.mobility(model).infinitesimal.dof == 1
    off = {**places, 0: (0.3, 0.1, 2.0)}
    (note,) = notes_on_centres(PolyhedronModel(bare.nodes, bare.edges, coordinates=off, centres=bare.centres))
    assert note.startswith("declared k = 3, refused: the lines of its 4 rods do not meet in a point")
