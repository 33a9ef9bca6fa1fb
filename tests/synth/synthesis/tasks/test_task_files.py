"""Files of tasks: the schema, the reader, one plain line for whatever is wrong."""

import json
from pathlib import Path

import jsonschema
import pytest

from graphs.errors import FileError
from synth.synthesis.tasks import read_task, task_schema

ROOT = Path(__file__).resolve().parents[4]
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
