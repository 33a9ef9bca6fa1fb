"""Every generator: the freedoms that its source gives, flat and folded, over the range of its parameters."""

from math import pi, radians

import numpy as np
import pytest
from sizes import slow

import synth
from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read, write
from graphs.mechanism.sheet import Sheet
from synth.analysis.moving._configuration_of import configuration_of
from synth.analysis.moving.motion import move
from synth.analysis.verdict._mobility import mobility
from synth.catalogue.patterns import GENERATORS, generate
from synth.catalogue.patterns.creases import bird_base, polygon_twist
from synth.catalogue.patterns.hinged_rings import closed_chain

QUICK = ("miura", "bennett", "crash-lock")
HEAVY = ("beaked-box", "hexagon-twist", "slit-array", "square-twist", "waterbomb", "webbed-tray", "yoshimura")
"""Patterns that take longest to fold."""


def freedoms(thing):
    """By the ways that are found: the marked one, or the freest, followed with closed loops."""
    if isinstance(thing, Sheet):
        verdict = mobility(thing, exact=False).verdict
        assert verdict.certainty in ("proved", "numerical")
        return verdict.freedoms
    found = move(thing, drive={next(iter(configuration_of(thing).linkage.graph.joints)): 0.02}, frames=1).branches
    return max(branch.freedoms for branch in found.branches)


@pytest.mark.parametrize(
    "name", [name if name in QUICK else pytest.param(name, marks=pytest.mark.slow) for name in GENERATORS]
)
def test_finite_freedoms_are_those_of_the_source(name):
    made = generate(name)
    assert freedoms(made.mechanism) == made.freedoms
    if made.generator.foldable:
        folded = generate(name, fold=radians(40))
        assert freedoms(folded.mechanism) == made.freedoms


def ends(generator):
    """One parameter at an end of its range, the others as they are; counts one and two above their least."""
    for one in generator.parameters:
        most = min(one.most, one.least + 2) if one.unit == "count" else one.most
        yield from ({one.name: value} for value in (one.least, most))


@pytest.mark.slow
@pytest.mark.parametrize("name", GENERATORS)
def test_freedoms_hold_to_the_ends_of_the_ranges(name):
    for values in ends(GENERATORS[name]):
        made = generate(name, **values)
        assert freedoms(made.mechanism) == made.freedoms, values


@pytest.mark.parametrize(
    "name", [slow(name) if name == "6-uuu" else name for name in GENERATORS if name != "kaleidocycle"]
)
def test_generators_make_something_from_end_to_end(name):
    """Loops close, and no panels are lost."""
    for values in ends(GENERATORS[name]):
        made = generate(name, **values)
        if isinstance(made.mechanism, Sheet):
            assert np.isfinite(made.mechanism.coordinates).all()
            assert len(made.mechanism.faces) > 1
        assert made.count is not None


@pytest.mark.parametrize("name", GENERATORS)
def test_what_is_out_of_range_is_refused_in_one_line(name):
    generator = GENERATORS[name]
    for one in generator.parameters:
        for value in (one.least - 1, one.most + 1, float("nan"), *([one.least + 0.5] if one.unit == "count" else [])):
            with pytest.raises(InvariantError, match=f"{one.name} = .* expected .* from"):
                generate(name, **{one.name: value})
    with pytest.raises(InvariantError, match="has no parameter 'wings'"):
        generate(name, wings=2)
    if not generator.foldable:
        with pytest.raises(UnsolvableError, match="it is not folded"):
            generate(name, fold=1.0)


def test_no_such_generator():
    with pytest.raises(InvariantError, match="there is no generator 'crane'; expected miura"):
        generate("crane")


@pytest.mark.parametrize("name", ["miura", "bennett", "four-bar", "crash-lock"])
def test_what_is_made_goes_to_a_file_and_back(name, tmp_path):
    made = generate(name).mechanism
    file = tmp_path / ("a.fold" if isinstance(made, Sheet) else "a.json")
    assert write(made, file) == ()
    back = read(file)
    if isinstance(made, Sheet):
        assert back.coordinates == made.coordinates
        assert back.assignments == made.assignments
    else:
        assert dict(back.axes) == dict(made.axes)


def test_a_folded_sheet_has_the_angle():
    made = generate("miura", rows=2, columns=2, fold=radians(50))
    assert max(abs(angle) for angle in made.mechanism.fold_angles if angle is not None) == pytest.approx(radians(50))
    flat = generate("miura", rows=2, columns=2).mechanism
    assert made.mechanism.edges == flat.edges
    with pytest.raises(InvariantError, match="fold = 175 degrees; expected an angle from"):
        generate("miura", fold=radians(175))


@pytest.mark.parametrize(
    "name", [slow(name) if name in HEAVY else name for name, one in GENERATORS.items() if one.foldable]
)
def test_what_is_flat_folds_to_the_end_of_the_range(name):
    made = generate(name, fold=radians(170))
    angles = [angle for angle in made.mechanism.fold_angles if angle is not None]
    assert np.abs(np.abs(angles) - radians(170)).min() < 1e-10


@pytest.mark.slow
def test_a_hexagon_twist_with_two_other_vertices_has_15_ways():
    verdict = mobility(generate("hexagon-twist", other=2).mechanism, exact=False).verdict
    assert (verdict.freedoms, len(verdict.branches), verdict.exhaustive) == (1, 15, True)
    assert "with the given mountain-valley assignment" in verdict.text


def test_the_tips_of_the_bird_base_are_where_the_sides_come_to_the_diagonals(data):
    """From a corner they lie in the direction that halves the angle between side and diagonal."""
    for sheet in (bird_base(), synth.read(data / "patterns" / "bird-base.fold")):
        corner, tip = np.array(sheet.coordinates[1]), np.array(sheet.coordinates[9])
        side, diagonal = np.array([0.0, -1.0]), -corner / np.linalg.norm(corner)
        way = (tip - corner) / np.linalg.norm(tip - corner)
        assert way @ side == pytest.approx(way @ diagonal, abs=5e-9)  # nine decimals


@pytest.mark.parametrize("solids", [6, 7, 8, slow(9)])
def test_kaleidocycles_have_right_twists_and_equal_lengths(solids, data):
    """Of every solid, the last one too: a ring of seven that closes but for half a turn has another there."""
    rings = [generate("kaleidocycle", solids=solids).mechanism]
    if solids < 9:
        rings.append(synth.read(data / "linkages" / f"kaleidocycle-{solids}.json"))
    exact = 5e-9 if solids % 2 else 1e-12  # nine decimals are kept of what is solved for
    for ring in rings:
        feet, along = (np.array([ring.axes[i][k] for i in range(solids)]) for k in (0, 1))
        sides = np.roll(feet, -1, axis=0) - feet
        assert np.abs((along * np.roll(along, -1, axis=0)).sum(axis=1)).max() < exact
        assert np.abs((along * sides).sum(axis=1)).max() < exact
        assert np.abs((np.roll(along, -1, axis=0) * sides).sum(axis=1)).max() < exact
        np.testing.assert_allclose(np.linalg.norm(sides, axis=1), 1.0, atol=exact)


def test_a_ring_that_is_closed_numerically_is_the_flattest_and_the_same_from_any_start(monkeypatch):
    """Its angles are symmetric, and other starts lead to it."""
    angles = angles_of(closed_chain(7))
    assert np.cos(angles).sum() == pytest.approx(1.01661693, abs=1e-8)
    middle = int(np.argmin(np.abs(np.cos(angles) - np.cos(angles).min())))
    round_it = np.roll(angles, 3 - middle)
    np.testing.assert_allclose(round_it, round_it[::-1], atol=1e-9)
    first = np.random.default_rng
    monkeypatch.setattr(np.random, "default_rng", lambda seed: first((*seed, 1)))
    np.testing.assert_allclose(angles_of(closed_chain(7)), angles, atol=1e-9)


def angles_of(frames):
    """The angle of each joint of a chain, from its frames: about its z axis, from x to the next x."""
    x, y, after = frames[:-1, :3, 0], frames[:-1, :3, 1], frames[1:, :3, 0]
    return np.arctan2((y * after).sum(axis=1), (x * after).sum(axis=1))


@pytest.mark.parametrize("solids", [7, *(pytest.param(n, marks=pytest.mark.slow) for n in (6, *range(8, 25)))])
def test_kaleidocycles_have_six_freedoms_less_than_solids(solids):
    made = generate("kaleidocycle", solids=solids)
    assert freedoms(made.mechanism) == made.freedoms == max(solids - 6, 1)


def test_myards_linkage_is_goldbergs_with_a_right_angle():
    """Two axes meet, and a plane takes the linkage to itself."""
    myard = generate("myard").mechanism
    goldberg = GENERATORS["goldberg"].make(radians(60), radians(40), pi / 2, pi - radians(40))
    assert dict(myard.axes) == dict(goldberg.axes)
    feet, along = (np.array([myard.axes[i][k] for i in range(5)]) for k in (0, 1))
    np.testing.assert_allclose(feet[0], feet[4], atol=1e-12)
    mirrored = [4, 3, 2, 1, 0]
    near = np.abs(along @ along.T)
    np.testing.assert_allclose(near, near[np.ix_(mirrored, mirrored)], atol=1e-12)
    far = np.linalg.norm(feet[:, None] - feet, axis=2)
    np.testing.assert_allclose(far, far[np.ix_(mirrored, mirrored)], atol=1e-12)
    moved = move(myard, drive={0: 0.2}, frames=1)
    assert moved.path.stopped == ""
    assert moved.closure < 1e-12


def test_a_hexagon_twist_is_rigid_but_at_its_twist():
    assert mobility(polygon_twist(6, 0.4), exact=False).verdict.freedoms == 0
    verdict = mobility(generate("hexagon-twist", other=1).mechanism, exact=False).verdict
    assert (verdict.freedoms, len(verdict.branches), verdict.exhaustive) == (1, 6, True)
    assert "with the given mountain-valley assignment" in verdict.text
    inner = np.array(generate("hexagon-twist", other=2).mechanism.coordinates[:6])
    assert np.arctan2(inner[1, 1], inner[1, 0]) == pytest.approx(pi / 6 - np.arcsin(1 / 4), abs=1e-12)


@pytest.mark.parametrize("sides", [4, slow(5), slow(6)])
def test_a_storey_on_a_panel_moves_only_turned_by_half_a_side(sides):
    half = generate("kresling", sides=sides, ends=1, turn=pi / sides)
    assert freedoms(half.mechanism) == half.freedoms == (sides % 2 == 0)
    other = generate("kresling", sides=sides, ends=1, turn=pi / sides - 0.1)
    assert freedoms(other.mechanism) == other.freedoms == 0


def test_a_quadrilateral_that_is_none_is_refused():
    with pytest.raises(InvariantError, match="neither equal nor together 180 degrees"):
        GENERATORS["huffman-grid"].make(2, 2, 1.0, 1.0)
    with pytest.raises(InvariantError, match="no convex quadrilateral"):
        GENERATORS["huffman-grid"].make(2, 2, 1.3, 0.6, 3.0)
    with pytest.raises(InvariantError, match="links of 170, 20, 30, 40 degrees do not close"):
        generate("four-bar", **{f"arc{i + 1}": radians(x) for i, x in enumerate((170, 20, 30, 40))})


@pytest.mark.parametrize(
    ("name", "given", "told", "relation"),
    [
        ("four-bar", (175, 175, 175, 10), "too long for the sphere; .* no three", "no three by more than 360"),
        ("five-bar", (175, 175, 175, 175, 170), "too long for the sphere; .* no five", "no five by more than 720"),
        ("six-bar", (5, 175, 5, 5, 5, 5), "the longest is longer than the others", "longer than the others"),
    ],
)
def test_links_that_do_not_close_on_the_sphere_are_told_why(name, given, told, relation):
    with pytest.raises(InvariantError, match=told):
        generate(name, **{f"arc{i + 1}": radians(arc) for i, arc in enumerate(given)})
    assert relation in GENERATORS[name].relations


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("huffman-grid", {"first": radians(70), "second": radians(58), "side": 1.09, "holds": False}),
        ("huffman-grid", {"first": radians(70), "second": radians(58), "side": 1.06, "holds": True}),
        ("deployable-cylinder", {"pleats": 3, "short": radians(41), "slack": radians(10), "holds": False}),
        ("deployable-cylinder", {"pleats": 3, "short": radians(39), "slack": radians(10), "holds": True}),
        (
            "parallel-pop-up",
            {"left": 2.5, "right": 1.5, "opening": radians(10), "second": 4.0, "first": 2.6, "holds": False},
        ),
        ("parallel-pop-up", {"left": 2.5, "right": 1.5, "opening": radians(60), "first": 4.0, "holds": True}),
        ("goldberg", {"other": radians(100), "shared": radians(80), "holds": False}),
        ("3-uuu", {"base": 2.0, "top": 2.0, "holds": False}),
        ("beaked-box", {"width": 0.9, "reach": 0.91, "angle": radians(20), "holds": False}),
        ("beaked-box", {"width": 0.9, "reach": 0.89, "angle": radians(20), "holds": True}),
        ("beaked-box", {"depth": 0.8, "reach": 0.6, "angle": radians(54), "holds": False}),
        ("beaked-box", {"depth": 0.8, "reach": 0.6, "angle": radians(52), "holds": True}),
    ],
)
def test_relations_are_those_that_are_checked(name, values):
    given = {key: value for key, value in values.items() if key != "holds"}
    assert GENERATORS[name].relations
    if values["holds"]:
        generate(name, **given)
    else:
        with pytest.raises(InvariantError, match="expected"):
            generate(name, **given)
