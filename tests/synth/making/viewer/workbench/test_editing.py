"""Edits of the workbench: words that are known, and what they make."""

import pytest

from graphs.convert.duality import mechanism_of_sheet
from graphs.creasing.edits import crease_sheet
from graphs.errors import SynthedraError, UnsolvableError
from graphs.files.formats import read
from synth.making.viewer.workbench.reading import are_edits, edited


@pytest.fixture
def square_twist(data):
    return read(data / "wiener" / "square-twist.fold")


@pytest.mark.parametrize(
    "edit",
    ["lock:3", "remove:0", "ride-alongs", "crease:0~12", "crease:0.5,1~3", "crease:-1e-3,2.~4,5,6", "crease:1,2~3,4"],
)
def test_words_that_are_known(edit):
    assert are_edits([edit])


@pytest.mark.parametrize(
    "edit",
    [
        "", "lock", "lock:", "lock:-1", "lock:1.5", "lock:" + "9" * 10, "crease:1", "crease:1~", "crease:1~2~3", "lock:3\n",
        "crease:nan,1~2", "crease:inf,1~2", "crease:1e999,1~2", "crease:1,2,3,4~5", "ride-alongs:1", "--motion", "-c",
        "crease:" + "1" * 25 + ",1~2", "lock:\u0663",
    ],
)  # fmt: skip
def test_words_that_are_not(edit):
    assert not are_edits([edit])


def test_not_too_many():
    assert are_edits(["lock:1"] * 200)
    assert not are_edits(["lock:1"] * 201)


def test_creases_are_added_between_vertices_and_points(square_twist):
    x, y = (sum(pair) / 2 for pair in zip(*(square_twist.coordinates[v][:2] for v in (0, 1)), strict=True))
    other = next(face for face in square_twist.faces if {0, 1} <= set(face))
    end = next(vertex for vertex in other if vertex not in (0, 1))
    made = edited(square_twist, [f"crease:{x!r},{y!r}~{end}"])
    assert made == crease_sheet(square_twist, (x, y), end).sheet
    assert len(made.faces) == len(square_twist.faces) + 1


def test_a_locked_crease_is_free_again_when_it_is_creased(square_twist):
    mechanism = mechanism_of_sheet(square_twist)
    joint, (start, end) = next(iter(mechanism.hinges.items()))
    locked = edited(square_twist, [f"lock:{joint}"])
    assert joint not in mechanism_of_sheet(locked).sc.joints
    freed = edited(locked, [f"crease:{start}~{end}"])
    assert set(mechanism_of_sheet(freed).sc.joints) == set(mechanism.sc.joints)


def test_what_cannot_be_edited_is_told(data, square_twist):
    with pytest.raises(UnsolvableError, match="only crease patterns can be edited here"):
        edited(read(data / "linkages" / "bennett.json"), ["lock:0"])
    with pytest.raises(UnsolvableError, match="no ride-alongs"):
        edited(square_twist, ["ride-alongs"])
    with pytest.raises(SynthedraError, match="99999 is no vertex"):
        edited(square_twist, ["crease:99999~0"])


def test_ride_alongs_are_taken_off_types_and_solids_too(data):
    graph = edited(read(data / "wiener" / "eight-bar.json"), ["ride-alongs"])
    assert len(graph) == 4
