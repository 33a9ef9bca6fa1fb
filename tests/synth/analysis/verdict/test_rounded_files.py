"""Rounded drawings under linear maps: the verdict is that of the exact ones, wherever the precision comes from."""

import json
from dataclasses import replace
from math import cos, pi, radians, sin

import numpy as np
import pytest
from commands import run
from sizes import slow, slow_but

import synth
from graphs.files.formats import read, write
from graphs.mechanism.precision import BY_DIGITS, extent_of
from graphs.mechanism.sheet import Sheet
from synth.analysis.moving._configuration_of import configuration_of, with_precision
from synth.catalogue.patterns import generate

COLOURS = {"M": "#ff0000", "V": "#0000ff", "B": "#000000"}


def tapered_miura(size):
    """Rays from a point, and zigzags that each ray mirrors: Kawasaki's condition holds at each vertex."""
    between, angle, radius = radians(8.0), radians(70.0), 60.0
    radii = [radius]
    for _ in range(size):
        radii.append(radii[-1] * sin(angle) / sin(angle - between))
        angle = pi - angle + between
    at = [
        (scale * r * cos(k * between), scale * r * sin(k * between))
        for scale in np.linspace(1.0, 2.6, size + 1)
        for k, r in enumerate(radii)
    ]
    wide = size + 1
    edges, letters = [], ""
    for i in range(wide):
        for k in range(wide):
            if k < size:
                edges.append((wide * i + k, wide * i + k + 1))
                letters += "B" if i in (0, size) else "MV"[i % 2]
            if i < size:
                edges.append((wide * i + k, wide * i + k + wide))
                letters += "B" if k in (0, size) else "MV"[(i + k + 1) % 2]
    faces = [
        (wide * i + k, wide * i + k + wide, wide * i + k + wide + 1, wide * i + k + 1)
        for i in range(size)
        for k in range(size)
    ]
    return Sheet(wide * wide, tuple(edges), letters, tuple(faces), tuple(at))


def placed(sheet, places):
    return replace(sheet, coordinates=tuple(map(tuple, places.tolist())))


def turned(places, degrees):
    c, s = cos(radians(degrees)), sin(radians(degrees))
    return places @ np.array([[c, s], [-s, c]])


def told(sheet, **options):
    """Freedoms, kind of evidence, and the freedoms of each way."""
    answer = synth.mobility(sheet, **options)
    ways = sorted(branch.freedoms for branch in answer.configuration.branches.branches)
    return answer.verdict.freedoms, ways


def svg_of(sheet, decimals, transform):
    rows = []
    for (a, b), letter in zip(sheet.edges, sheet.assignments, strict=True):
        ends = [f"{x:.{decimals}f}" for vertex in (a, b) for x in sheet.coordinates[vertex]]
        at = " ".join(f'{name}="{value}"' for name, value in zip(("x1", "y1", "x2", "y2"), ends, strict=True))
        rows.append(f'<line {at} stroke="{COLOURS[letter]}"/>')
    around = "".join(f'<g transform="{one}">' for one in transform)
    return f'<svg xmlns="http://www.w3.org/2000/svg">{around}{"".join(rows)}{"</g>" * len(transform)}</svg>'


def test_a_tapered_miura_in_svg_under_transforms(tmp_path):
    sheet = tapered_miura(5)
    exact = told(sheet)
    assert exact[0] == 1
    assert len(exact[1]) == 16
    (tmp_path / "a.svg").write_text(svg_of(sheet, 2, ("translate(60 20) rotate(7)", "scale(2.8346)")), encoding="utf-8")
    drawn = read(tmp_path / "a.svg")
    answer = synth.mobility(drawn)
    assert told(drawn) == exact
    assert answer.configuration.precision.source == "2 decimals"
    assert answer.mended


ROUNDED = {
    "turned, rounded, turned back": lambda places: turned(turned(places, 33).round(6), -33),
    "inches in millimetres": lambda places: turned(places, 33).round(6) * 25.4,
    "single precision, mapped": lambda places: turned(places, 33).astype(np.float32).astype(float) * 2.8346,
    "far away": lambda places: places + 1e6 * extent_of(places),
}


@pytest.mark.parametrize("how", ROUNDED)
@pytest.mark.parametrize("name", ["square-twist", slow("map"), slow("miura")])
def test_what_another_program_mapped_moves_as_before(name, how):
    sheet = generate(name).mechanism
    assert told(placed(sheet, ROUNDED[how](np.array(sheet.coordinates)))) == told(sheet)


@pytest.mark.parametrize("noise", slow_but([1e-5], [1e-3, 1e-5, 1e-7]))
def test_noise_that_is_estimated_or_stated(noise):
    sheet = generate("miura").mechanism
    places = np.array(sheet.coordinates)
    size = noise * extent_of(places)
    noisy = placed(sheet, places + np.random.default_rng(7).uniform(-size, size, places.shape))
    assert told(noisy) == told(sheet)
    assert told(noisy, precision=size) == told(sheet)
    stated = configuration_of(noisy, precision=size).precision
    assert (stated.source, stated.size) == ("stated", pytest.approx(noise, rel=0.01))
    exactly = synth.mobility(noisy, precision=0.0, exact=False).verdict
    # as written only a line of creases that is straight but for the noise may turn, in double precision
    assert exactly.freedoms == 0 or (exactly.certainty, len(exactly.branches)) == ("numerical", 1)


def test_the_pose_far_away_is_ranked():
    sheet = generate("map").mechanism
    places = np.array(sheet.coordinates)
    near, far = synth.mobility(sheet).infinitesimal, synth.mobility(placed(sheet, places + 4e6)).infinitesimal
    assert far.dof == near.dof
    assert far.precision.size < 1e-8


def test_precision_on_the_command_line(tmp_path):
    sheet = generate("miura").mechanism
    places = np.array(sheet.coordinates)
    size = 1e-4 * extent_of(places)
    write(placed(sheet, places + np.random.default_rng(3).uniform(-size, size, places.shape)), tmp_path / "a.fold")
    [guessed] = json.loads(run("mobility", "--json", tmp_path / "a.fold").stdout)
    assert guessed["configuration"]["precision_source"] == "estimated"
    assert "relations" in guessed["configuration"]["precision_evidence"]
    assert guessed["configuration"]["precision_margin"] > 3.0
    assert "coordinates precise to " in run("mobility", tmp_path / "a.fold").stdout
    for words in (("mobility",), ("fold", "--frames", "2"), ("explain",)):
        answer = json.loads(run(*words, "--json", "--precision", repr(size), tmp_path / "a.fold").stdout)
        at = (answer[0] if isinstance(answer, list) else answer)["configuration"]
        assert at["precision_source"] == "stated"
        assert at["precision"] == pytest.approx(1e-4, rel=0.01)
    run("template", tmp_path / "a.fold", "--precision", repr(size), "--size", "150", "-o", tmp_path / "a.svg")
    for wrong in ("-1", "nan", "wide"):
        assert (
            "Invalid value for '--precision'"
            in run("mobility", tmp_path / "a.fold", "--precision", wrong, code=2).output
        )


def test_precision_of_what_is_no_sheet_is_that_of_its_configuration():
    bennett = generate("bennett").mechanism
    at = with_precision(bennett, 1e-3)
    assert (at.precision.source, at.exact) == ("stated", False)
    assert synth.mobility(bennett, precision=1e-3).configuration.precision.source == "stated"


def test_a_verdict_by_digits_alone_says_so():
    corners = ((0.0, 0.0), (1.0, 0.13), (0.31, 1.0), (-0.83, 0.41), (-0.21, -0.97))
    corners = tuple((x + 0.001 * x * x, y - 0.002 * x * y) for x, y in corners)
    sheet = Sheet(5, (), "", ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)), corners)
    answer = synth.mobility(sheet)
    assert answer.configuration.precision.evidence == BY_DIGITS
    assert BY_DIGITS in str(answer)
