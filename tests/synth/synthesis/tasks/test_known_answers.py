"""Tasks under data/ whose answer is in the papers: each is valid, admits it by structure, and finds it by design."""

import json
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import synth
from enumerate.chains.names import chain_named
from graphs.convert.conversions import to_sc
from graphs.identity.chains import chain_from_id, chain_id, class_code
from synth.analysis.motion.linkage import link_motions
from synth.analysis.moving._configuration_of import configuration_of
from synth.catalogue.patterns import generate
from synth.synthesis.tasks import candidates_of, read_task, structure_of
from synth.synthesis.tasks.dimensioning import CandidateSearch

ROOT = Path(__file__).resolve().parents[4]
SCHEMA = json.loads((ROOT / "graphs" / "schema" / "task.schema.json").read_text(encoding="utf-8"))
ADMITTED = {
    "lid": {"four-bar"},
    "five-orientations": {"four-bar", "watt", "stephenson"},
    "skew-axes": {"bennett"},
    "straight-lift": {"sarrus", "bricard-line-symmetric", "bricard-plane-symmetric"},
    "packing": {"miura", "map", "chickenwire"},
    "four-fingers": {"fortune-teller", "bird-base", "preliminary-base"},
    "on-a-cone": {"four-bar", "watt", "stephenson"},
    "pop-up": {"four-bar", "box-pop-up"},
    "carton": {"crash-lock", "m1:ab.ac.bde.cef.dgh.fhi.gj.ij", "m1:ab.ac.bde.cef.dgh.fhi.gj.ij;ifi"},
}
ANSWERS = [
    ("lid", "four-bar", lambda: chain_from_id(chain_named("four-bar")), 2),
    ("skew-axes", "bennett", lambda: to_sc(synth.read(ROOT / "data" / "linkages" / "bennett.json")), 2),
    ("straight-lift", "sarrus", lambda: to_sc(synth.read(ROOT / "data" / "linkages" / "sarrus.json")), 1),
    ("packing", "miura", lambda: to_sc(generate("miura", rows=2, columns=2).mechanism), 2),
    ("four-fingers", "fortune-teller", lambda: to_sc(synth.read(ROOT / "data" / "wiener" / "fortune-teller.json")), 1),
    ("on-a-cone", "watt", lambda: chain_from_id(chain_named("watt")), 4),
    ("on-a-cone", "stephenson", lambda: synth.read(ROOT / "data" / "hyatt" / "fig11-stephenson.json"), 4),
    ("pop-up", "box-pop-up", lambda: to_sc(generate("slit-array", strips=1).mechanism), 1),
    ("carton", "crash-lock", lambda: to_sc(generate("crash-lock", opening=0.5).mechanism), 1),
]
"""A task, the name of its answer, a mechanism of that type from elsewhere, and with how many starts it is found."""


def test_every_task_has_an_answer():
    assert {path.stem for path in (ROOT / "data" / "tasks").iterdir()} == set(ADMITTED)


@pytest.mark.parametrize("name", ADMITTED)
def test_a_task_admits_the_types_of_its_answer(name, data):
    place = data / "tasks" / f"{name}.json"
    jsonschema.validate(json.loads(place.read_text(encoding="utf-8")), SCHEMA)
    structure = structure_of(read_task(place))
    assert {one.type.name for one in structure.placed} == ADMITTED[name]


def off_orientations(task, design, roles):
    """By how much the wished orientations are missed, by the motions of the links alone."""
    linkage = configuration_of(design.mechanism).linkage
    off = [0.0]
    for wish in task.wishes["wishes"]:
        if wish["kind"] == "orientation":
            angles = np.array(list(design.angles[wish["at"]].values()))[None]
            turn = link_motions(linkage, angles, roles["base"])[roles[wish["link"]]][0][0]
            wished = Rotation.from_quat(wish["quaternion"], scalar_first=True).as_matrix()
            off.append(float(np.abs(turn - wished).max()))
    return max(off)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "answer", "other", "starts"), ANSWERS, ids=[f"{one[0]}-{one[1]}" for one in ANSWERS])
def test_the_known_answer_is_among_the_first_ten(name, answer, other, starts, data):
    task = read_task(data / "tasks" / f"{name}.json")
    found = synth.task(task, starts=starts, rounds=1)
    rank = next(place for place, one in enumerate(found.ranked, 1) if found.name(one) == answer)
    assert rank <= 10
    one = found.ranked[rank - 1]
    type_of = class_code if one.candidate.source == "generators" else chain_id
    assert type_of(one.candidate.type_of(task).mechanism) == type_of(other())
    design = found.design(one)
    assert off_orientations(task, design, dict(zip(task.roles, one.candidate.links, strict=True))) < 1e-6


def test_watt_takes_two_orientations_on_a_cone(data):
    """Its axes make the same angle with the axis of the cone, and the four-bar has too few dimensions."""
    task = read_task(data / "tasks" / "on-a-cone.json")
    roles = {"base": 0, "input": 1, "output": 2}
    code, links = chain_named("watt"), tuple(roles.values())
    watt = next(one for one in candidates_of(structure_of(task)) if (one.code, one.links) == (code, links))
    design = next(one for start in range(4) if (one := CandidateSearch(task, watt, 0).design(start)).success)
    assert off_orientations(task, design, roles) < 1e-9
    directions = configuration_of(design.mechanism).linkage.directions
    assert np.ptp(directions[:, 1]) < 1e-12
