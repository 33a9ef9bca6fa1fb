"""Precision as the text of a file has it: through transforms, units and relative commands; stated in FOLD."""

import json
from dataclasses import replace

import numpy as np
import pytest

from graphs.files.formats import read, write
from graphs.mechanism.precision import extent_of, precision_of_sheet, stated
from graphs.mechanism.sheet import with_all_edges
from synth.catalogue.patterns import generate

COLOURS = {"M": "#ff0000", "V": "#0000ff", "B": "#000000"}


def lines_of(sheet):
    sheet = with_all_edges(sheet)
    places = np.array(sheet.coordinates)
    places = (places - places.min(axis=0)) / np.ptp(places, axis=0).max() * 190.0 + 5.0
    turn = np.radians(3.0)  # so that no line is along an axis, and rounding moves every vertex
    places = places @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    return [(places[a], places[b], letter) for (a, b), letter in zip(sheet.edges, sheet.assignments, strict=True)]


def svg_of(sheet, decimals, transform, form="line"):
    rows = []
    for a, b, letter in lines_of(sheet):
        (x1, y1), (x2, y2) = a.round(decimals), b.round(decimals)
        stroke = f'stroke="{COLOURS[letter]}"'
        if form == "relative":
            rows.append(
                f'<path d="m{x1:.{decimals}f} {y1:.{decimals}f} l{x2 - x1:.{decimals}f} {y2 - y1:.{decimals}f}" {stroke}/>'
            )
        else:
            at = {"x1": x1, "y1": y1, "x2": x2, "y2": y2}
            unit = "mm" if form == "mm" else ""
            rows.append("<line " + " ".join(f'{k}="{v:.{decimals}f}{unit}"' for k, v in at.items()) + f" {stroke}/>")
    around = "".join(f'<g transform="{one}">' for one in transform)
    return f'<svg xmlns="http://www.w3.org/2000/svg">{around}{"".join(rows)}{"</g>" * len(transform)}</svg>'


@pytest.mark.parametrize(
    ("transform", "form", "length"),
    [
        ((), "line", 0.005),
        (("translate(60 20) rotate(7)", "scale(2.8346)"), "line", 0.005 * 2.8346),
        (("matrix(0 2 -2 0 5 7)",), "line", 0.01),
        (("scale(1 3)",), "line", 0.015),
        ((), "mm", 0.005 * 96 / 25.4),
        (("rotate(20)",), "relative", 0.005 * 2**0.5),
    ],
)
def test_decimals_of_svg_go_through_transforms_and_units(tmp_path, transform, form, length):
    (tmp_path / "a.svg").write_text(svg_of(generate("chickenwire").mechanism, 2, transform, form), encoding="utf-8")
    sheet = read(tmp_path / "a.svg")
    assert sheet.precision.length == pytest.approx(length, rel=1e-6)
    found = precision_of_sheet(sheet)
    assert found.size >= length / extent_of(np.array(sheet.coordinates)) * 0.999


def test_decimals_of_matrices_and_of_shifts_that_differ_are_errors(tmp_path):
    rows = svg_of(generate("chickenwire").mechanism, 9, ()).replace("<line ", '<line transform="translate(0.25 0)" ')
    (tmp_path / "alike.svg").write_text(rows, encoding="utf-8")
    assert read(tmp_path / "alike.svg").precision.length == pytest.approx(0.5e-9)
    head, first, rest = rows.partition("<line ")
    (tmp_path / "differ.svg").write_text(
        head + first + rest.replace("translate(0.25 0)", "translate(0.2501 0)", 1), encoding="utf-8"
    )
    assert read(tmp_path / "differ.svg").precision.length == pytest.approx(0.5e-4, rel=1e-3)
    turned = svg_of(generate("chickenwire").mechanism, 9, ("matrix(0.99255 0.12187 -0.12187 0.99255 1 2)",))
    (tmp_path / "matrix.svg").write_text(turned, encoding="utf-8")
    assert 0.5e-3 < read(tmp_path / "matrix.svg").precision.length < 2e-3


def as_cp(rows):
    kinds = {"B": 1, "M": 2, "V": 3}
    return "".join(f"{kinds[letter]} {a[0]!r} {a[1]!r} {b[0]!r} {b[1]!r}\n" for a, b, letter in rows)


def as_dxf(rows):
    groups = ["0", "SECTION", "2", "ENTITIES"]
    names = {"B": "BORDER", "M": "MOUNTAIN", "V": "VALLEY"}
    for a, b, letter in rows:
        groups += [
            "0",
            "LINE",
            "8",
            names[letter],
            "10",
            repr(a[0]),
            "20",
            repr(a[1]),
            "11",
            repr(b[0]),
            "21",
            repr(b[1]),
        ]
    return "\n".join([*groups, "0", "ENDSEC", "0", "EOF"]) + "\n"


def as_opx(rows):
    kinds = {"B": 1, "M": 2, "V": 3}
    objects = "".join(
        '<object class="oripa.OriLineProxy">'
        + "".join(
            f'<void property="{name}"><double>{value!r}</double></void>'
            for name, value in zip(("x0", "y0", "x1", "y1"), (*a, *b), strict=True)
        )
        + f'<void property="type"><int>{kinds[letter]}</int></void></object>'
        for a, b, letter in rows
    )
    return f"<java>{objects}</java>"


@pytest.mark.parametrize(("suffix", "text"), [(".cp", as_cp), (".dxf", as_dxf), (".opx", as_opx)])
@pytest.mark.parametrize("decimals", [2, 5])
def test_decimals_of_lines_are_those_before_welding(tmp_path, suffix, text, decimals):
    rng = np.random.default_rng(2)
    shift = [
        [rng.uniform(-1, 1, 2) * 10.0**-decimals for _ in "ab"] for _ in lines_of(generate("square-twist").mechanism)
    ]
    rows = [
        ((a + da).round(decimals).tolist(), (b + db).round(decimals).tolist(), letter)
        for (a, b, letter), (da, db) in zip(lines_of(generate("square-twist").mechanism), shift, strict=True)
    ]
    (tmp_path / f"a{suffix}").write_text(text(rows), encoding="utf-8")
    sheet = read(tmp_path / f"a{suffix}")
    assert (sheet.precision.source, sheet.precision.length) == (
        f"{decimals} decimals",
        pytest.approx(0.5 * 10.0**-decimals),
    )
    assert sheet.spread > 0.0


@pytest.mark.parametrize("suffix", [".fold", ".obj"])
def test_decimals_of_fold_and_obj_times_a_unit(tmp_path, suffix):
    sheet = generate("miura", fold=0.7).mechanism
    rotation, _ = np.linalg.qr(np.random.default_rng(4).normal(size=(3, 3)))
    places = (np.array(sheet.coordinates) @ rotation).round(6)
    rounded = replace(sheet, coordinates=tuple(map(tuple, places.tolist())))
    write(rounded, tmp_path / f"a{suffix}")
    assert read(tmp_path / f"a{suffix}").precision.length == pytest.approx(5e-7)
    scaled = replace(sheet, coordinates=tuple(map(tuple, (25.4 * places).tolist())))
    write(scaled, tmp_path / f"b{suffix}")
    again = read(tmp_path / f"b{suffix}")
    inches = precision_of_sheet(again).size * extent_of(25.4 * places) / 25.4
    assert 5e-7 / 3 < inches < 3 * 5e-7  # six decimals of inches, in millimetres: estimated, or by the digits left


def test_a_fold_file_states_its_precision(tmp_path):
    sheet = stated(generate("miura").mechanism, 0.02)
    write(sheet, tmp_path / "a.fold")
    document = json.loads((tmp_path / "a.fold").read_text(encoding="utf-8"))
    assert document["synthedra:precision"] == 0.02
    again = read(tmp_path / "a.fold")
    assert again.precision.stated
    assert again.frames.left_out == ()
    assert precision_of_sheet(again).size == pytest.approx(0.02 / extent_of(np.array(again.coordinates)))
    document["synthedra:precision"] = -1
    (tmp_path / "b.fold").write_text(json.dumps(document), encoding="utf-8")
    with pytest.raises(ValueError, match=r"synthedra:precision.*zero or more"):
        read(tmp_path / "b.fold")


def test_what_an_svg_file_knew_a_fold_file_keeps(tmp_path):
    text = svg_of(generate("chickenwire").mechanism, 2, ("translate(60 20) rotate(7)", "scale(2.8346)"))
    (tmp_path / "a.svg").write_text(text, encoding="utf-8")
    sheet = read(tmp_path / "a.svg")
    write(sheet, tmp_path / "a.fold")
    assert read(tmp_path / "a.fold").precision.length == sheet.precision.length
    plain = read(tmp_path / "a.fold")
    write(replace(plain, precision=None), tmp_path / "b.fold")
    assert "precision" not in (tmp_path / "b.fold").read_text(encoding="utf-8")
