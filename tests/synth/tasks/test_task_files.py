"""Files of tasks: the schema, the reader, one plain line for whatever is wrong, and the questions."""

import json
from pathlib import Path

import jsonschema
import pytest
from click.testing import CliRunner

from graphs.errors import FileError
from synth.cli.main import main
from synth.tasks import read_task, task_schema, write_task

ROOT = Path(__file__).resolve().parents[3]
SCHEMA = json.loads((ROOT / "graphs" / "schema" / "task.schema.json").read_text(encoding="utf-8"))
HEAD = {"format": "synthedra/task", "version": 1}
WISH = {"kind": "orientation", "at": "up", "link": "output", "quaternion": [1, 0, 0, 1]}
WHOLE = {
    **HEAD,
    "title": "a lid",
    "roles": ["base", "input", "output"],
    "degrees_of_freedom": 1,
    "links": [4, 6],
    "loops": [1, None],
    "centres": 1,
    "symmetry": [1, 8],
    "open_edges": 0,
    "explicit_centres": [0, None],
    "implicit_centres": [0, None],
    "system": "spherical",
    "form": "space",
    "types": ["sc", "generators"],
    "generators": {"bennett": {}, "miura": {"rows": 2}},
    "joints": ["R"],
    "spatial_loops": 0,
    "centres_at_infinity": False,
    "relative_mobility": [{"roles": ["base", "output"], "number": 1}],
    "distance": [{"roles": ["input", "output"], "number": [1, None]}],
    "wishes": {"configurations": [{"name": "up", "inputs": {"base-input": 40}}], "wishes": [WISH]},
}


def written(folder, document):
    place = folder / "task.json"
    place.write_text(json.dumps(document))
    return place


def test_the_schema_is_the_one_of_the_reader():
    assert task_schema() == SCHEMA
    jsonschema.Draft202012Validator.check_schema(SCHEMA)


def test_a_file_with_every_key_is_read_and_valid(tmp_path):
    jsonschema.validate(WHOLE, SCHEMA)
    assert set(WHOLE) == set(SCHEMA["properties"])
    task = read_task(written(tmp_path, WHOLE))
    assert task.joint_roles == (("base", "input"),)
    assert task.named_roles == {"base", "input", "output"}
    assert (task.symmetry.least, task.symmetry.most, task.loops.most) == (1, 8, None)


BAD = [
    ({"format": "synthedra/wishes"}, "format: 'synthedra/wishes'; expected synthedra/task"),
    ({"version": True}, "version"),
    ({"link": 4}, "unknown key 'link'"),
    ({"links": [6, 4]}, "links: 6 to 4; expected the smaller number first"),
    ({"links": [4, 40]}, "links: 4 to 40 links; expected at most 12"),
    ({"roles": ["base", "lid"]}, "roles[1]: 'lid'; expected one of base, input, output"),
    ({"system": "plane"}, "system: 'plane'"),
    ({"joints": ["X"]}, "joints[0]: 'X'"),
    ({"generators": {"benet": {}}}, "unknown key 'benet'"),
    ({"generators": {"miura": {"rows": 0}}}, "generators.miura: rows = 0"),
    ({"distance": [{"roles": ["base"], "number": 1}]}, "distance[0].roles: a list of 1; expected two roles"),
    ({"wishes": {"wishes": [{**WISH, "link": "2"}]}}, "wishes.wishes[0].link: the link '2'; expected a role"),
    (
        {"wishes": {"wishes": [{"kind": "angle", "at": "up", "joint": "3", "equals": 1}]}},
        "the joint '3'; expected two roles with a hyphen",
    ),
    ({"wishes": {"wishes": [WISH], "configurations": [{}]}}, "wishes.configurations[0]: key 'name' is missing"),
]


@pytest.mark.parametrize(("keys", "line"), BAD, ids=range(len(BAD)))
def test_whatever_is_wrong_is_said_with_its_place(keys, line, tmp_path):
    with pytest.raises(FileError) as caught:
        read_task(written(tmp_path, {**HEAD, **keys}))
    assert line in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_task_is_checked_before_it_is_written(tmp_path):
    with pytest.raises(FileError, match="unknown key"):
        write_task({**HEAD, "x": 1}, tmp_path / "task.json")
    assert not list(tmp_path.iterdir())


def test_a_sheet_is_asked_whether_its_centres_are_explicit(tmp_path):
    place = tmp_path / "sheet.json"
    result = CliRunner().invoke(main, ["task", "new", str(place)], input="a sheet\nn\n1\n4\n6\nsheet\nany\ny\n\n")
    assert result.exit_code == 0, result.output
    task = read_task(place)
    assert (task.form, task.implicit_centres.most, task.explicit_centres.most) == ("sheet", 0, None)


def test_questions_write_a_task(tmp_path):
    place = tmp_path / "lid.json"
    answers = "a lid\nn\n1\n4\n4\nspace\nspherical\n0.7,0.7,0,0\n\n"
    result = CliRunner().invoke(main, ["task", "new", str(place)], input=answers)
    assert result.exit_code == 0, result.output
    jsonschema.validate(json.loads(place.read_text()), SCHEMA)
    task = read_task(place)
    assert (task.title, task.links.most, task.system) == ("a lid", 4, "spherical")
    assert task.wishes["wishes"][0]["quaternion"] == [0.7, 0.7, 0.0, 0.0]
    again = CliRunner().invoke(main, ["task", "new", str(place)], input=answers)
    assert again.exit_code == 2
    strange = CliRunner().invoke(main, ["task", "old", str(place)])
    assert strange.exit_code == 2
    assert "expected TASK, or new TASK, got old" in strange.output
