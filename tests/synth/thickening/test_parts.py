"""Templates of thick panels: outlines of plies, holes on both sides of each hinge, the parts list."""

import re

import numpy as np
import pytest
import shapely
from commands import run

import synth
from graphs.files.formats import read


@pytest.fixture(scope="module")
def thick():
    return synth.thicken(synth.generate("miura").mechanism, thickness=3.0, scale=60.0, collisions=False)


def test_outlines_are_the_plies(thick):
    template = thick.template()
    area = sum(ply.outline.area for ply in thick.plates.plies)
    assert sum(piece.covered.area for piece in template.pieces) == pytest.approx(area)
    assert len(template.steps) == 1 + 9 + 12


def test_screws_of_both_panels_are_in_line_with_the_hinge(thick):
    for seat in thick.seats():
        holes = []
        for panel in seat.panels:
            there = [
                tuple(np.round(hole, 9).tolist())
                for low, high, outline in thick.plates.sections(panel) if low - 1e-9 <= seat.height <= high + 1e-9
                for hole in seat.holes(outline, 1.5, 0.9)
            ]  # fmt: skip
            holes.append(sorted(set(there)))
        one, other = holes
        assert len(one) == len(other) == 2
        start, end = seat.lines[0]
        line = shapely.LineString([start, end])
        for first, second in zip(one, other, strict=True):
            middle = shapely.Point((np.array(first) + np.array(second)) / 2.0)
            assert line.distance(middle) < 1e-8
            assert line.distance(shapely.Point(first)) == pytest.approx(1.5)


def test_the_note_names_heights_holes_and_bevels(thick):
    steps = "\n".join(thick.template().steps)
    assert "Panel 4: glue 3 plies on each other, -3 to 0; 0 to 3; 3 to 6." in steps
    assert (
        "Crease 5, valley, panels 1 and 2: axis at 9, 60 long, 4 holes of 0.9 for screws, 1.5 from the axis." in steps
    )
    sheet = synth.generate("miura").mechanism
    arguments = {"thickness": 3.0, "scale": 60.0, "angle": np.radians(120.0), "collisions": False}
    bevelled = synth.thicken(sheet, how="tapered", **arguments).template()
    assert len(bevelled.pieces) == 27
    bevels = re.findall(r"bevelled by ([0-9.]+) degrees", " ".join(bevelled.steps))
    assert max(map(float, bevels)) == pytest.approx(60.0)
    strips = " ".join(synth.thicken(sheet, how="hinge", **arguments).template().steps)
    gaps = [float(gap) for gap in re.findall(r"a strip over a gap of ([0-9.]*[0-9])", strips)]
    assert max(gaps) == pytest.approx(3.0 * np.tan(np.radians(60.0)), abs=1e-3)


def test_the_command_writes_templates(tmp_path):
    source, target = tmp_path / "miura.fold", tmp_path / "parts.dxf"
    synth.write(synth.generate("miura", rows=2, columns=2).mechanism, source)
    options = ("--thickness", "3", "--scale", "60", "--no-collisions")
    assert f"written: {target}" in run("thicken", source, *options, "-o", target).output
    assert {"CUT", "MOUNTAIN", "VALLEY"} <= set(re.findall(r"[A-Z]{3,}", target.read_text()))
    run("thicken", source, *options, "-o", tmp_path / "parts.svg")
    assert "4 holes of 0.9" in " ".join(path.read_text() for path in tmp_path.glob("parts*.svg"))
    assert read(source)
