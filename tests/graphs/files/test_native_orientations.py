"""Files of orientations: round trips, the schema, and one plain line for whatever is wrong."""

import copy
import json
import random
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from hypothesis import given, settings
from strategies import randoms

from graphs.errors import FileError, SynthedraError
from graphs.files.formats import read
from graphs.files.native import orientation_rows, orientations_document, rows_from_document
from synth.linkages.guidance.orientations import Orientations, read_orientations

ROOT = Path(__file__).resolve().parents[3]
SCHEMA = json.loads((ROOT / "graphs" / "schema" / "orientations.schema.json").read_text(encoding="utf-8"))
FILES = sorted((ROOT / "data" / "orientations").glob("*.json"))
QUATERNIONS = {"format": "synthedra/orientations", "version": 1,
               "quaternions": [[1, 0, 0, 0], [0, 1, 0, 0], [0.6, 0, 0.8, 0]]}  # fmt: skip
MATRICES = {"format": "synthedra/orientations", "version": 1,
            "matrices": [np.eye(3).tolist(), np.diag([1.0, -1, -1]).tolist(), np.diag([-1.0, -1, 1]).tolist()]}  # fmt: skip


def without(key):
    return {k: v for k, v in QUATERNIONS.items() if k != key}


DOCUMENTS = {
    "no object": ([], "a list; expected an object"),
    "no format": (without("format"), "key 'format' is missing"),
    "no version": (without("version"), "key 'version' is missing"),
    "odd format": (QUATERNIONS | {"format": "synthedra/sc"}, "format: 'synthedra/sc'; expected synthedra/orientations"),
    "version": (QUATERNIONS | {"version": 2}, "version: 2; expected 1"),
    "version true": (QUATERNIONS | {"version": True}, "version: True; expected 1"),
    "unknown key": (QUATERNIONS | {"angles": []}, "unknown key 'angles'; expected only format, matrices, quaternions"),
    "both": (QUATERNIONS | MATRICES, "both of 'quaternions' and 'matrices'; expected one of them"),
    "neither": (without("quaternions"), "neither of 'quaternions' and 'matrices'; expected one of them"),
    "no list": (QUATERNIONS | {"quaternions": {}}, "quaternions: an object; expected a list of quaternions"),
    "three numbers": (QUATERNIONS | {"quaternions": [[1, 0, 0]]}, "quaternions[0]: a list of 3; expected four numbers"),
    "no number": (QUATERNIONS | {"quaternions": [[1, 0, 0, "0"]]}, "quaternions[0][3]: '0'; expected a number"),
    "huge": (QUATERNIONS | {"quaternions": [[10**400, 0, 0, 0]]}, "quaternions[0][0]: a number too large"),
    "none": (QUATERNIONS | {"quaternions": []}, "quaternions: 0 orientations; expected 3 or more"),
    "two": (QUATERNIONS | {"quaternions": [[1, 0, 0, 0], [0, 1, 0, 0]]}, "quaternions: 2 orientations; expected 3"),
    "zero": (QUATERNIONS | {"quaternions": [[1, 0, 0, 0], [0, 0, 0, 0], [0, 1, 0, 0]]},
             "quaternions[1]: orientation 2 has a quaternion of norm 0; expected 1 to within 0.001"),
    "norm": (QUATERNIONS | {"quaternions": [[1.002, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]}, "quaternions[0]: orientation 1 has a"),
    "equal": (QUATERNIONS | {"quaternions": [[1, 0, 0, 0], [0, 1, 0, 0], [-1, 0, 0, 0]]},
              "quaternions[2]: orientations 1 and 3 are equal; expected different ones"),
    "large": (QUATERNIONS | {"quaternions": [[1e308, 1e308, 0, 0]] * 3}, "quaternions[0]: orientation 1 has a quaternion"),
    "two rows": (MATRICES | {"matrices": [[[1, 0, 0], [0, 1, 0]]]}, "matrices[0]: a list of 2; expected three rows"),
    "short row": (MATRICES | {"matrices": [[[1, 0, 0], [0, 1], [0, 0, 1]]]}, "matrices[0][1]: a list of 2; expected three"),
    "two matrices": (MATRICES | {"matrices": MATRICES["matrices"][:2]}, "matrices: 2 orientations"),
    "mirror": (MATRICES | {"matrices": [*MATRICES["matrices"], np.diag([1.0, 1, -1]).tolist()]},
               "matrices[3]: orientation 4 has a matrix that is no rotation; expected an orthogonal one of determinant 1"),
    "shear": (MATRICES | {"matrices": [[[1, 0.1, 0], [0, 1, 0], [0, 0, 1]]] * 3}, "matrices[0]: orientation 1 has a matrix"),
    "equal matrices": (MATRICES | {"matrices": MATRICES["matrices"][:1] * 3}, "matrices[1]: orientations 1 and 2 are equal"),
}  # fmt: skip


@pytest.mark.parametrize("name", DOCUMENTS)
def test_bad_documents(name, tmp_path):
    document, message = DOCUMENTS[name]
    path = tmp_path / "bad.json"
    path.write_text(json.dumps(document), encoding="utf-8")
    with pytest.raises(FileError) as error:
        read_orientations(path)
    assert message in str(error.value)
    assert str(error.value).startswith(f"{path}: ")
    assert "\n" not in str(error.value)


def test_good_documents(tmp_path):
    path = tmp_path / "good.json"
    for document in (QUATERNIONS, MATRICES):
        jsonschema.validate(document, SCHEMA)
        path.write_text(json.dumps(document), encoding="utf-8")
        assert len(read_orientations(path)) == 3


def test_files_that_are_none(tmp_path):
    for path, message in ((tmp_path / "none.json", "no such file"), (tmp_path, "a directory; expected a file")):
        with pytest.raises(FileError, match=message):
            orientation_rows(path)
    (tmp_path / "a.json").write_text('{"quaternions": [[NaN]]}')
    with pytest.raises(FileError, match="the number NaN; expected finite numbers"):
        orientation_rows(tmp_path / "a.json")


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_the_schema_accepts_the_data(path):
    document = json.loads(path.read_text(encoding="utf-8"))
    jsonschema.validate(document, SCHEMA)
    assert orientations_document(document["quaternions"]) == document
    assert len(read_orientations(path)) >= 3


def test_quaternions_and_matrices_are_the_same_orientations(tmp_path):
    given_ = read_orientations(FILES[0])
    path = tmp_path / "m.json"
    path.write_text(json.dumps(MATRICES | {"matrices": given_.matrices.tolist()}))
    same = np.abs((read_orientations(path).quaternions * given_.quaternions).sum(axis=1))
    assert np.allclose(same, 1.0)


def test_orientations_are_no_mechanism_and_the_commands_that_take_them_are_named():
    with pytest.raises(FileError, match=r"orientations of a body, which `synth order`.*; expected a mechanism"):
        read(FILES[0])


def mutated(document, rng: random.Random):
    document = copy.deepcopy(document)
    spots = [document]
    for spot in spots:
        spots += [child for child in (spot.values() if isinstance(spot, dict) else spot)
                  if isinstance(child, dict | list) and child]  # fmt: skip
    spot = rng.choice(spots)
    key = rng.choice(list(spot)) if isinstance(spot, dict) else rng.randrange(len(spot))
    action = rng.randrange(3)
    if action == 0:
        del spot[key]
    elif action == 1:
        spot[key] = rng.choice([None, True, -1, 0.0, 1.5, "x", [], {}, [1], 10**30, 1e308, 1e-320])
    elif isinstance(spot, list):
        spot.insert(key, copy.deepcopy(spot[key]))
    return document


@settings(max_examples=4 * settings.default.max_examples)
@given(randoms)
def test_reader_and_schema_refuse_alike(rng):
    """What the schema refuses the reader refuses; what only the reader refuses is no rotation."""
    document = mutated(rng.choice([QUATERNIONS, MATRICES]), rng)
    valid = jsonschema.Draft202012Validator(SCHEMA).is_valid(document)
    try:
        key, rows = rows_from_document(document, Path("some.json"))
        made = np.array(rows, dtype=float)
        (Orientations if key == "quaternions" else lambda m: Orientations.from_matrices(m.reshape(-1, 3, 3)))(made)
    except SynthedraError as error:
        assert "\n" not in str(error)
    else:
        assert valid
