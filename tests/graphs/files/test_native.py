import copy
import json
import random
from pathlib import Path

import jsonschema
import pytest
from hypothesis import given, settings
from strategies import ODD_NAMES, models, randoms, sc_graphs, scd_graphs

from graphs.errors import FileError, UnsolvableError
from graphs.files.formats import read, write
from graphs.files.native import document, dumps, from_document
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.vertex_edge import VertexEdgeGraph, sc_from_vertex_edge
from tests.support.examples import fences_of

ROOT = Path(__file__).resolve().parents[3]
SCHEMAS = {
    path.name.split(".")[0]: json.loads(path.read_text(encoding="utf-8"))
    for path in (ROOT / "graphs" / "schema").glob("*.json")
}
VALIDATORS = {name: jsonschema.validators.validator_for(schema)(schema) for name, schema in SCHEMAS.items()}
"""Made once: jsonschema.validate looks first, every time, whether the schema is one."""
WHERE = Path("some.json")
NATIVE = [
    path for folder in ("wampler", "wiener", "linkages") for path in sorted((ROOT / "data" / folder).glob("*.json"))
]


def schema_of(doc):
    return SCHEMAS[doc["format"].split("/")[1]]


def again(thing):
    return from_document(json.loads(dumps(thing)), WHERE)


@given(sc_graphs)
def test_sc_graphs_survive_write_and_read(sc):
    assert again(sc).is_identical(sc)
    VALIDATORS["sc"].validate(document(sc))


@given(scd_graphs)
def test_scd_graphs_survive_write_and_read(scd):
    back = again(scd)
    assert isinstance(back, SCDGraph)
    assert back.is_identical(scd)
    assert back.counts == scd.counts
    VALIDATORS["scd"].validate(document(scd))


@given(models)
def test_models_survive_write_and_read(model):
    assert again(model).is_identical(model)
    VALIDATORS["polyhedron"].validate(document(model))


def test_vertex_edge_graphs_survive_write_and_read():
    graph = VertexEdgeGraph({"A": ("a", 1, "c"), 2: ("a", "d", "e")})
    assert again(graph).is_identical(graph)
    VALIDATORS["vertex-edge"].validate(document(graph))
    assert len(sc_from_vertex_edge(graph)) == 4


def test_a_file_survives(tmp_path):
    sc = SCGraph(["α", "b"], {"a": ("α", "b"), "b": ("b", "α")}, [Loop(("a", "b"), name="ring", at="O")], ground="b")
    assert write(sc, tmp_path / "a.json") == ()
    assert read(tmp_path / "a.json").is_identical(sc)
    assert [p.name for p in tmp_path.iterdir()] == ["a.json"]


@pytest.mark.parametrize("name", ODD_NAMES)
def test_odd_names_do_no_harm(name):
    sc = SCGraph([name, "other"], {name: (name, "other")})
    assert again(sc).is_identical(sc)


def test_ids_that_files_cannot_hold_are_named():
    with pytest.raises(UnsolvableError, match=r"the id \(0, 1\) cannot be written"):
        document(SCGraph([(0, 1), 2], [((0, 1), 2)]))
    with pytest.raises(UnsolvableError, match="the id True cannot be written"):
        document(SCGraph([True, 0], [(True, 0)]))


@pytest.mark.parametrize("path", NATIVE, ids=lambda path: path.stem)
def test_the_schema_accepts_the_data(path):
    doc = json.loads(path.read_text(encoding="utf-8"))
    jsonschema.validate(doc, schema_of(doc))
    assert dumps(from_document(doc, path)) == path.read_text(encoding="utf-8")


def mutated(doc, rng: random.Random):
    """Change one thing somewhere in a document."""
    doc = copy.deepcopy(doc)
    spots = [doc]
    for spot in spots:
        children = spot.values() if isinstance(spot, dict) else spot
        spots += [child for child in children if isinstance(child, dict | list) and child]
    spot = rng.choice(spots)
    key = rng.choice(list(spot)) if isinstance(spot, dict) else rng.randrange(len(spot))
    action = rng.randrange(4)
    if action == 0:
        del spot[key]
    elif action == 1:
        spot[key] = rng.choice([None, True, -1, 1.5, "x", [], {}, [1], {"id": 1}, 10**30, 99])
    elif isinstance(spot, list):
        spot.insert(key, copy.deepcopy(spot[key]))
    else:
        spot["extra"] = spot[key]
    return doc


@settings(max_examples=4 * settings.default.max_examples)
@given(randoms)
def test_reader_and_schema_refuse_alike(rng):
    """What the schema refuses the reader refuses; what only the reader refuses breaks an invariant."""
    path = rng.choice(NATIVE)
    doc = mutated(json.loads(path.read_text(encoding="utf-8")), rng)
    kind = doc.get("format") if isinstance(doc, dict) else None
    valid = False
    if isinstance(kind, str) and kind.startswith("synthedra/"):
        valid = jsonschema.Draft202012Validator(schema_of(doc)).is_valid(doc)
    try:
        from_document(doc, WHERE)
    except FileError as error:
        assert "\n" not in str(error)
        assert str(error).startswith("some.json: ")
    else:
        assert valid


def test_the_page_of_native_formats_has_an_example_of_each_that_its_schema_accepts():
    page = (ROOT / "docs" / "native-json.md").read_text(encoding="utf-8")
    documents = [json.loads(fence.text) for fence in fences_of(page) if fence.language == "json"]
    assert {doc["format"] for doc in documents} == {f"synthedra/{name}" for name in SCHEMAS}
    for doc in documents:
        jsonschema.validate(doc, schema_of(doc))
        assert f"graphs/schema/{doc['format'].split('/')[1]}.schema.json" in page
