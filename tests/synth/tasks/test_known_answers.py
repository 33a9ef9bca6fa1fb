"""Tasks under data/: each is valid, and by structure alone it has the types that its answer is among."""

import json
from pathlib import Path

import jsonschema
import pytest

from synth.tasks import read_task, structure_of

ROOT = Path(__file__).resolve().parents[3]
SCHEMA = json.loads((ROOT / "graphs" / "schema" / "task.schema.json").read_text(encoding="utf-8"))
ADMITTED = {
    "lid": {"four-bar"},
    "five-orientations": {"four-bar", "watt", "stephenson"},
    "skew-axes": {"bennett"},
    "straight-lift": {"sarrus", "bricard-line-symmetric", "bricard-plane-symmetric"},
    "packing": {"miura", "map", "chickenwire"},
}


def test_every_task_has_an_answer():
    assert {path.stem for path in (ROOT / "data" / "tasks").iterdir()} == set(ADMITTED)


@pytest.mark.parametrize("name", ADMITTED)
def test_a_task_admits_the_types_of_its_answer(name, data):
    place = data / "tasks" / f"{name}.json"
    jsonschema.validate(json.loads(place.read_text(encoding="utf-8")), SCHEMA)
    structure = structure_of(read_task(place))
    assert {one.type.name for one in structure.placed} == ADMITTED[name]
