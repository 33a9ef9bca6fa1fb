"""Files of linkages with joints of all kinds: there and back, as JSON and GraphML, and what is refused."""

import json
from pathlib import Path

import jsonschema
import pytest
from random_joints import random_jointed

from graphs.errors import FileError
from graphs.files.formats import read, write
from graphs.files.native import document, dumps, from_document
from graphs.joints import JointedLinkage, JointKind, placed, revolutes_of
from graphs.mechanism.sc import SCGraph

WHERE = Path("some.json")
ROOT = Path(__file__).resolve().parents[3]
SCHEMA = json.loads((ROOT / "graphs" / "schema" / "joints.schema.json").read_text(encoding="utf-8"))
BALL = {
    "format": "synthedra/joints", "version": 1, "links": ["hip", "leg"],
    "joints": [{"id": "a", "links": ["hip", "leg"], "type": "S", "point": [0, 0, 1]}],
}  # fmt: skip


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("lies", [False, True])
def test_there_and_back(seed, lies, tmp_path):
    linkage = placed(random_jointed(seed)) if lies else random_jointed(seed)
    assert write(linkage, tmp_path / "a.json") == ()
    jsonschema.validate(json.loads((tmp_path / "a.json").read_text()), SCHEMA)
    back = read(tmp_path / "a.json")
    assert isinstance(back, JointedLinkage)
    assert back.chain.is_identical(linkage.chain)
    assert (dict(back.kinds), dict(back.places)) == (dict(linkage.kinds), dict(linkage.places))


@pytest.mark.parametrize("seed", range(5))
def test_graphml_has_the_types(seed, tmp_path):
    linkage = random_jointed(seed)
    lost = write(placed(linkage), tmp_path / "a.graphml")
    assert "the places of its joints" in lost
    back = read(tmp_path / "a.graphml")
    assert dict(back.kinds) == dict(linkage.kinds)
    assert {j: set(e) for j, e in back.chain.joints.items()} == {j: set(e) for j, e in linkage.chain.joints.items()}
    assert "the kinds of its joints" not in lost


def test_graphml_without_types_is_a_bare_graph(tmp_path):
    write(SCGraph(3, [(0, 1), (1, 2), (2, 0)]), tmp_path / "a.graphml", lossy=True)
    assert isinstance(read(tmp_path / "a.graphml"), SCGraph)


def test_graphml_with_some_types_has_revolutes_else(tmp_path):
    text = (
        '<graphml xmlns="http://graphml.graphdrawing.org/xmlns"><key id="t" for="edge" attr.name="type" '
        'attr.type="string"/><graph edgedefault="undirected"><node id="0"/><node id="1"/>'
        '<edge id="a" source="0" target="1"><data key="t">{}</data></edge><edge id="b" source="1" target="0"/>'
        "</graph></graphml>"
    )
    (tmp_path / "a.graphml").write_text(text.format("Universal"))
    assert dict(read(tmp_path / "a.graphml").kinds) == {"a": JointKind.UNIVERSAL, "b": JointKind.REVOLUTE}
    (tmp_path / "a.graphml").write_text(text.format("screw"))
    with pytest.raises(FileError, match="the joint type 'screw'; expected one of R"):
        read(tmp_path / "a.graphml")


def test_other_formats_hold_the_revolutes(tmp_path):
    leg = JointedLinkage(SCGraph(3, [(0, 1), (1, 2)]), {0: JointKind.UNIVERSAL})
    write(leg, tmp_path / "a.edges", lossy=True)
    assert len(read(tmp_path / "a.edges").joints) == len(revolutes_of(leg).axes) == 3


def test_words_of_people_are_understood():
    for word in ("s", "Spherical", "ball", " S "):
        doc = BALL | {"joints": [BALL["joints"][0] | {"type": word}]}
        jsonschema.validate(doc, SCHEMA)
        assert document(from_document(doc, WHERE))["joints"][0]["type"] == "S"
    plain = {"format": "synthedra/joints", "version": 1, "links": 2, "joints": [[0, 1]]}
    assert '"type": "R"' in dumps(from_document(plain, WHERE))


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"type": "screw"}, r"joints\[0\].type: the joint type 'screw'; expected one of R \(revolute\), P"),
        ({"type": 3}, r"joints\[0\].type: 3; expected text"),
        ({"type": "U"}, r"joints\[0\]: universal joint 'a' has 0 axes; expected 2"),
        ({"type": "P", "axes": [[0, 0, 0]]}, r"joints\[0\]: an axis of joint 'a' is \[0.0, 0.0, 0.0\]"),
        ({"point": [0, 1]}, r"joints\[0\].point: .*expected three numbers"),
        ({"point": [0, 1, "x"]}, r"joints\[0\].point\[2\]"),
        ({"axes": 3}, r"joints\[0\].axes: 3; expected a list of directions"),
        ({"links": ["hip", "toe"]}, r"joints\[0\]: joint 'a' ends at 'toe'"),
        ({"colour": "red"}, "unknown key 'colour'"),
    ],
)
def test_what_is_no_joint_is_refused(changes, told):
    with pytest.raises(FileError, match=told):
        from_document(BALL | {"joints": [BALL["joints"][0] | changes]}, WHERE)


def test_axes_need_a_point():
    joint = {"id": "a", "links": ["hip", "leg"], "type": "R", "axes": [[0, 0, 1]]}
    with pytest.raises(FileError, match=r"joints\[0\]: axes without a point"):
        from_document(BALL | {"joints": [joint]}, WHERE)
    assert not jsonschema.Draft202012Validator(SCHEMA).is_valid(BALL | {"joints": [joint]})
