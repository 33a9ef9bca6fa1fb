"""Layer orders written and read, chosen by wishes, drawn."""

import json

import numpy as np
import pytest
from commands import run
from folded_sheets import folded_sheet, unassigned_map
from sizes import slow

import synth
from graphs.errors import FileError, InvariantError
from synth.analysis.layering import read_face_orders, wishes_of


@pytest.mark.parametrize("seed", [*range(4), *(slow(seed) for seed in range(4, 40))])
def test_face_orders_lead_back_to_the_order(seed, tmp_path):
    rng = np.random.default_rng(seed)
    sheet, _ = folded_sheet(rng, 4, 25)
    free = type(sheet)(sheet.vertices, sheet.edges, sheet.assignments.replace("M", "U"), sheet.faces, sheet.coordinates)
    answer = synth.layers(free)
    order = answer.sample(seed)
    synth.making.drawing.mechanisms.write_order(answer, order, tmp_path / "layered.fold")
    rows = read_face_orders(tmp_path / "layered.fold")
    assert rows == order.face_orders()
    again = synth.layers(tmp_path / "layered.fold")
    nearest, unmet = again.nearest(wishes_of(again, rows))
    assert nearest.stacks == order.stacks
    assert unmet == ()
    one, other, side = rows[0]
    assert again.nearest(wishes_of(again, [(one, other, -side), *rows[1:]]))[1] or len(rows) == 1 or again.orders > 1


def test_the_normal_of_the_second_face_counts():
    """A strip of two panels, a valley: each lies on the front of the other."""
    strip = unassigned_map(1, 2)
    valley = strip.assignments.replace("U", "V")
    order = synth.layers(type(strip)(strip.vertices, strip.edges, valley, strip.faces, strip.coordinates)).order()
    assert order.face_orders() == [(0, 1, 1)]
    assert order.stacks == ((0, 1),)


def test_wishes_are_met_in_the_largest_number():
    """Of a strip of three, 0 above 1 above 2 above 0 cannot be; two of them can, or one and its opposite's."""
    answer = synth.layers(unassigned_map(1, 3))
    order, unmet = answer.nearest([(0, 1), (1, 2), (2, 0)])
    assert len(unmet) == 1
    order, unmet = answer.nearest([(2, 0), (2, 1)])
    assert unmet == ()
    assert order.stacks[0][-1] == 2
    with pytest.raises(InvariantError, match="panels 0 and 5 do not overlap; expected two panels that do"):
        answer.nearest([(0, 5)])


def test_files_without_orders_and_with_wrong_ones(tmp_path):
    path = tmp_path / "a.fold"
    for rows, message in [
        (None, "faceOrders: missing; expected a list"),
        ([[0, 1]], r"faceOrders\[0\]: \[0, 1\]; expected \[face, face, -1, 0 or 1\]"),
        ([[0, 1, 1], [0, -1, 1]], r"faceOrders\[1\]: \[0, -1, 1\]"),
    ]:
        path.write_text(json.dumps({} if rows is None else {"file_frames": [{"faceOrders": rows}]}), encoding="utf-8")
        with pytest.raises(FileError, match=message):
            read_face_orders(path)
    answer = synth.layers(unassigned_map(1, 2))
    with pytest.raises(InvariantError, match="face 7; expected a face from 0 to 1"):
        wishes_of(answer, [(0, 7, 1)])


def test_commands(data, tmp_path):
    bird_base = data / "patterns" / "bird-base.fold"
    whole = json.loads(run("layers", bird_base, "--wish", "0,3", "--json", "-o", tmp_path / "layered.fold").stdout)
    assert whole["orders"] == 2
    assert whole["unmet"] in ([], [[0, 3]])
    again = json.loads(run("layers", tmp_path / "layered.fold", "--face-orders", "--json").stdout)
    assert again["order"]["cells"][0]["panels"] == whole["order"]["cells"][0]["panels"]
    assert again["unmet"] == []
    run("layers", bird_base, "--component", "0", "-o", tmp_path / "bird.svg")
    assert [(tmp_path / f"bird-{number}.svg").exists() for number in range(3)] == [True, True, False]
    drawn = (tmp_path / "bird-0.svg").read_text(encoding="utf-8")
    assert drawn != (tmp_path / "bird-1.svg").read_text(encoding="utf-8")
    assert run("layers", bird_base, "--component", "4", "-o", tmp_path / "x.svg", code=2).stderr.endswith(
        "component 4; expected a number from 0 to 0\n"
    )
    assert "exclude each other" in run("layers", bird_base, "--order", "0", "--sample", "1", code=2).stderr
    assert "'3' is not two numbers of panels such as 3,7" in run("layers", bird_base, "--wish", "3", code=2).stderr
    run("draw", bird_base, "--as", "flat-folded", "-o", tmp_path / "flat.pdf")
