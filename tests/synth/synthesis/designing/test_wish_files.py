"""Files of wishes: the schema, the reader, and one plain line for whatever is wrong."""

import json
from pathlib import Path

import jsonschema
import pytest

from graphs.errors import FileError, InvariantError, UnsolvableError
from synth.catalogue.patterns import GENERATORS, generate
from synth.synthesis.designing import (
    DesignPoint,
    Goal,
    JointAngle,
    PointPlace,
    WishedConfiguration,
    Wishes,
    design,
    read_wishes,
)
from synth.synthesis.designing.wish_files import wishes_schema

ROOT = Path(__file__).resolve().parents[4]
SCHEMA = json.loads((ROOT / "graphs" / "schema" / "wishes.schema.json").read_text(encoding="utf-8"))
HEAD = {"format": "synthedra/wishes", "version": 1, "configurations": [{"name": "open", "inputs": {"0": 40}}]}
ANGLE = {"kind": "angle", "at": "open", "joint": 3, "equals": 50}


def written(path, **keys):
    place = path / "wishes.json"
    place.write_text(json.dumps({**HEAD, "wishes": [ANGLE], **keys}))
    return place


def test_the_schema_is_the_one_of_the_reader():
    assert wishes_schema() == SCHEMA
    jsonschema.Draft202012Validator.check_schema(SCHEMA)


def test_a_file_of_every_kind_is_read_and_valid(tmp_path):
    vertex, point = {"vertex": 0}, {"link": 1, "point": [0, 0, 1]}
    wishes = [
        ANGLE,
        {"kind": "orientation", "at": "open", "link": "1", "quaternion": [1, 0, 0, 0], "weight": 2},
        {"kind": "direction", "at": "open", "link": 1, "vector": [1, 0, 0], "equals": [0, 1, 0]},
        {"kind": "place", "at": "open", "point": point, "equals": [None, 0, 1]},
        {"kind": "distance", "points": [vertex, vertex], "at_least": 1},
        {"kind": "on", "at": "open", "target": {"formula": "z - x**2"}},
        {"kind": "on", "at": "open", "target": {"path": [[0, 0, 0], [1, 1, 1]]}, "points": [point]},
        {"kind": "size", "at": "open", "of": "radius", "at_most": 1, "thickness": 0.1},
        {"kind": "ratio", "at": "open", "over": "pose", "of": "area", "at_most": 0.5},
        {"kind": "transmission", "at": "open", "near": 0, "joint": 1, "far": 2, "at_least": 40},
        {"kind": "arc", "joints": [0, 1], "at_least": 20, "at_most": 90},
        {"kind": "equal-arcs", "arcs": [[0, 1], [2, 3]]},
        {"kind": "area", "at_most": 4},
        {"kind": "edges", "edges": [[0, 1]], "at_least": 1},
        {"kind": "equal-lengths", "edges": [[0, 1], [1, 2]]},
        {"kind": "corners", "corners": [[0, 1, 2]], "equals": 90},
        {"kind": "curvature", "at": "open", "principal": [0.1, -0.1]},
        {"kind": "symmetry", "mirror": [[0, 0], [0, 1]]},
        {"kind": "symmetry", "turns": 4, "centre": [0, 1]},
    ]
    ranges = [{"joint": 0, "from": 10, "to": 50, "steps": 3}]
    path = written(tmp_path, wishes=wishes, ranges=ranges, fixed=[0], rules=[wishes[11]], driver="0", in_order=False)
    jsonschema.validate(json.loads(path.read_text()), SCHEMA)
    read = read_wishes(path)
    assert {definition for definition in SCHEMA["$defs"] if definition != "point"} == {one["kind"] for one in wishes}
    assert len(read.wishes) == len(wishes)
    assert read.names == ("pose", "open", "0 at 10", "0 at 30", "0 at 50")


WRONG = [
    ({"wishes": []}, "wishes: no wishes; expected one or more"),
    ({"wishes": [{"kind": "wish"}]}, "wishes[0].kind: 'wish'; expected orientation, direction, angle"),
    ({"wishes": [{**ANGLE, "equals": "x"}]}, "wishes[0].equals: 'x'; expected a number"),
    ({"wishes": [{"kind": "angle", "joint": 3}]}, "wishes[0]: a wish without a goal; expected equals, at_least or at_most"),
    ({"wishes": [{**ANGLE, "at": "shut"}]}, "there is no configuration 'shut'"),
    ({"wishes": [{**ANGLE, "more": 1}]}, "wishes[0]: unknown key 'more'"),
    ({"wishes": [{"kind": "arc", "joints": [0, 1], "at_least": 9, "at_most": 3}]}, "contradict each other"),
    ({"wishes": [{"kind": "on", "target": {"formula": "x +"}}]}, "wishes[0].target.formula: the formula 'x +'"),
    ({"wishes": [{"kind": "on", "target": {"formula": "open(x)"}}]}, "'open' in a formula"),
    ({"wishes": [{"kind": "on", "target": {"formula": "x.real"}}]}, "the formula 'x.real'"),
    ({"wishes": [{"kind": "on", "target": {"file": "none.stl"}}]}, "cannot be read"),
    ({"configurations": [{"name": "pose"}]}, "configurations[0].name: the name 'pose'"),
    ({"configurations": [{"name": "open"}, {"name": "open"}]}, "two configurations have one name"),
    ({"bounds": {"sector": [1]}}, "bounds.sector: a list of 1; expected a list of 2 numbers"),
    ({"wishes": [{"kind": "corners", "corners": [[0, 1]], "equals": 90}]}, "corners[0]: a list of 2; expected a list of 3 vertices"),
    ({"wishes": [{"kind": "symmetry", "turns": 1}]}, "wishes[0].turns: 1; expected"),
    ({"version": 2}, "version: 2; expected 1"),
]  # fmt: skip


@pytest.mark.parametrize(("keys", "message"), WRONG)
def test_what_is_wrong_is_one_line(keys, message, tmp_path):
    with pytest.raises(FileError) as caught:
        read_wishes(written(tmp_path, **keys))
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


FOUR_BAR = generate("four-bar").mechanism


@pytest.mark.parametrize(("joint", "given"), [("9", "0"), ("3", "9")])
def test_names_that_are_not_there_are_refused(joint, given):
    wish = JointAngle(at="open", joint=joint, goal=Goal(equals=0.4))
    with pytest.raises(InvariantError, match="'9'"):
        design(FOUR_BAR, Wishes((wish,), (WishedConfiguration("open", {given: 0.3}),)))


def test_wishes_that_contradict_each_other_are_named():
    wishes = tuple(JointAngle(at="open", joint="3", goal=Goal(equals=angle)) for angle in (0.4, 0.5))
    with pytest.raises(InvariantError, match="two different wishes for the angle of joint 3 at open contradict"):
        design(FOUR_BAR, Wishes(wishes, (WishedConfiguration("open", {"0": 0.3}),)))


OPEN = (WishedConfiguration("open", {"0": 0.3}),)


def test_a_wish_against_the_input_of_its_configuration_is_named():
    wish = JointAngle(at="open", joint="0", goal=Goal(at_least=0.5))
    with pytest.raises(InvariantError, match=r"joint 0 at open contradicts its input; expected .*17\.1887°"):
        design(FOUR_BAR, Wishes((wish,), OPEN))


def test_limits_of_one_angle_contradict_only_if_no_angle_meets_both():
    low, high = (JointAngle(at="open", joint="3", goal=goal) for goal in (Goal(at_least=0.2), Goal(at_most=0.9)))
    assert design(FOUR_BAR, Wishes((low, high), OPEN), starts=1).best.figures[0].met
    rule = JointAngle(at="open", joint="3", goal=Goal(at_most=0.1))
    with pytest.raises(InvariantError, match="contradict each other"):
        design(FOUR_BAR, Wishes((low,), OPEN, rules=(rule,)))


def test_coordinates_of_a_point_may_be_wished_apart():
    point = DesignPoint("2", (0.3, 0.2, 0.1))
    given = [(1.0, None, None), (None, 0.5, None), (0.5, None, None)]
    one, other, against = (PointPlace(at="open", point=point, equals=equals) for equals in given)
    assert not one.contradicts(other)
    assert one.contradicts(against)


def test_what_cannot_change_or_has_no_coordinates_is_refused():
    wish = Wishes((JointAngle(joint="3", goal=Goal(equals=0.4)),), fixed=("0", "1", "2", "3"))
    with pytest.raises(UnsolvableError, match="nothing of the mechanism may change"):
        design(FOUR_BAR, wish)
    with pytest.raises(UnsolvableError, match="has none; try `synth realise`"):
        design(str(ROOT / "data" / "wiener" / "watt.json"), Wishes(wish.wishes))
    with pytest.raises(InvariantError, match="there is no parameter 'width'"):
        design(GENERATORS["bennett"], Wishes(wish.wishes, fixed=("width",)))
