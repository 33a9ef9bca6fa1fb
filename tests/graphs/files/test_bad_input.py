"""Every bad file gives one FileError: file, place, what is wrong, what was expected."""

import json
import os
import re

import pytest

from graphs.errors import ArgumentError, FileError, shown
from graphs.files.formats import read, read_all, write
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet

SC = {"format": "synthedra/sc", "version": 1, "links": 4, "joints": [[0, 1], [1, 2], [2, 3], [3, 0]],
      "loops": [{"joints": [0, 1, 2, 3], "centre": "finite"}]}  # fmt: skip
SCD = SC | {
    "format": "synthedra/scd",
    "rotation": {"0": [0, 3, None], "1": [1, 0, None], "2": [2, 1, None], "3": [3, 2, None]},
    "outer": {"joint": 0, "side": "right"},
}
MODEL = {"format": "synthedra/polyhedron", "version": 1, "vertices": 3, "rods": [[0, 1], [1, 2], [2, 0]]}
VERTEX_EDGE = {"format": "synthedra/vertex-edge", "version": 1, "vertices": [{"id": "A", "creases": ["a", "b"]}]}
SPHERICAL = {"joints": [0, 1, 2, 3], "centre": "finite"}

DOCUMENTS = {
    "no object": ([], "a list; expected an object with the key 'format'"),
    "no format": ({}, "format: missing; expected one of synthedra/conical, synthedra/cylindrical, synthedra/joints, synthedra/polyhedron"),
    "odd format": (SC | {"format": "synthedra/pdf"}, "format: 'synthedra/pdf'; expected one of"),
    "format of odd type": (SC | {"format": ["synthedra/sc"]}, "format: ['synthedra/sc']; expected one of"),
    "version": (SC | {"version": 2}, "version: 2; expected 1"),
    "version true": (SC | {"version": True}, "version: True; expected 1"),
    "unknown key": (SC | {"colour": 1}, "unknown key 'colour'; expected only closing, format, ground"),
    "missing key": ({k: v for k, v in SC.items() if k != "loops"}, "key 'loops' is missing"),
    "links of odd type": (SC | {"links": 1.5}, "links: 1.5; expected a list of names, or how many"),
    "negative links": (SC | {"links": -1}, "links: -1; expected 0 or more"),
    "too many links": (SC | {"links": 10**12}, "links: 1000000000000; expected at most 250000 (SYNTHEDRA_MOST=nodes=1000000000000 allows more)"),
    "link of odd type": (SC | {"links": [0, 1, 2, None]}, "links[3]: null; expected a name"),
    "link twice": (SC | {"links": [0, 1, 2, 2]}, "links: link 2 occurs twice"),
    "dangling link": (SC | {"joints": [[0, 1], [1, 2], [2, 3], [3, 9]]}, "joints[3][1]: link 9 of 4 links; expected a link from 0 to 3"),
    "self-joint": (SC | {"joints": [[0, 1], [1, 2], [2, 2], [3, 0]]}, "joints[2]: joint 2 joins link 2 to itself"),
    "three links": (SC | {"joints": [[0, 1, 2]]}, "joints[0]: a list of 3; expected two links"),
    "joint of odd type": (SC | {"joints": [[0, [1]]]}, "joints[0][1]: a list; expected a link"),
    "joint twice": (SC | {"joints": [{"id": 1, "links": [0, 1]}, [1, 2]]}, "joints[1]: the id 1 occurs twice"),
    "dangling joint": (SC | {"loops": [SPHERICAL | {"joints": [0, 1, 2, 7]}]}, "loops[0].joints[3]: joint 7 of 4 joints; expected a joint from 0 to 3: joints count from 0"),
    "joints from 1": (SC | {"loops": [SPHERICAL | {"joints": [1, 2, 3, 4]}]}, "loops[0].joints[3]: joint 4 of 4 joints; expected a joint from 0 to 3"),
    "dangling named joint": (SC | {"loops": [SPHERICAL | {"joints": [0, 1, 2, "x"]}]}, "loops[0]: loop '0 1 2 x' names 'x'"),
    "sides from 1": (SCD | {"rotation": {**SCD["rotation"], "3": [4, 2, None]}}, 'rotation["3"][0]: joint 4 of 4 joints'),
    "outer from 1": (SCD | {"outer": {"joint": 4, "side": "right"}}, "outer.joint: joint 4 of 4 joints"),
    "ground from 1": (SC | {"ground": 4}, "ground: link 4 of 4 links; expected a link from 0 to 3: links count from 0"),
    "center": (SC | {"loops": [{"joints": [0, 1, 2, 3], "center": "finite"}]}, "loops[0]: unknown key 'center' (did you mean 'centre'?); expected only at, centre, joints, name"),
    "no centre": (SC | {"loops": [{"joints": [0, 1, 2, 3]}]}, "loops[0]: key 'centre' is missing; expected \"centre\": \"finite\""),
    "loop for loops": ({k: v for k, v in SC.items() if k != "loops"} | {"loop": []}, "unknown key 'loop' (did you mean 'loops'?)"),
    "no version": ({k: v for k, v in SC.items() if k != "version"}, "key 'version' is missing; expected \"version\": 1"),
    "no cycle": (SC | {"loops": [SPHERICAL | {"joints": [0, 1, 2]}]}, "loops[0]: loop '0 1 2' meets link 0 in 1 joint"),
    "dependent loops": (SC | {"loops": [SPHERICAL, SPHERICAL]}, "loops[1]: loop '0 1 2 3' is the sum of others"),
    "centre": (SC | {"loops": [SPHERICAL | {"centre": "middle"}]}, "loops[0].centre: 'middle'; expected finite"),
    "centre of odd type": (SC | {"loops": [SPHERICAL | {"centre": []}]}, "loops[0].centre: a list; expected finite"),
    "name of odd type": (SC | {"loops": [SPHERICAL | {"name": 5}]}, "loops[0].name: 5; expected text"),
    "centre of nothing": (SC | {"loops": [{"joints": [0, 1, 2, 3], "centre": "none", "at": "O"}]},
                          "loops[0]: loop '0 1 2 3' has no centre but names one, 'O'; expected no 'at'"),
    "closing": (SC | {"closing": [SPHERICAL]}, "closing[0]: loop '0 1 2 3' is among the loops already"),
    "ground": (SC | {"ground": "sky"}, "ground: ground 'sky' is no link; expected one of the links"),
    "half a surrogate": (SC | {"ground": "\ud800"}, "ground: half of a surrogate pair; expected text"),
    "rotation of nothing": (SCD | {"rotation": {"sky": []}}, 'rotation["sky"]: \'sky\' is no link'),
    "rotation of odd type": (SCD | {"rotation": []}, "rotation: a list; expected an object"),
    "rule": (SCD | {"outer": {"joint": 0, "side": "left"}}, "the outer face has no centre and 0 open edges"),
    "outer": (SCD | {"outer": {"joint": 0}}, "outer: key 'side' is missing"),
    "dangling rod": (MODEL | {"rods": [[0, 3]]}, "rods[0][1]: vertex 3 of 3 vertices; expected a vertex from 0 to 2: vertices count from 0"),
    "rod of no name": (MODEL | {"rods": [[0, "x"]]}, "rod (0, 'x') names 'x', which is no vertex"),
    "rod to itself": (MODEL | {"rods": [[0, 0]]}, "a rod joins vertex 0 to itself; expected two vertices"),
    "rod twice": (MODEL | {"rods": [[0, 1], [1, 0]]}, "rod (1, 0) occurs twice; expected once"),
    "coordinates": (MODEL | {"vertices": [{"id": 0, "xyz": [0, 1]}]}, "vertices[0].xyz: a list of 2; expected three"),
    "coordinate of odd type": (MODEL | {"vertices": [{"id": 0, "xyz": [0, 1, "2"]}]}, "vertices[0].xyz[2]: '2'"),
    "coordinate too large": (MODEL | {"vertices": [{"id": 0, "xyz": [0, 1, 10**400]}]}, "a number too large"),
    "some coordinates": (MODEL | {"vertices": [{"id": 0, "xyz": [0, 0, 0]}, 1, 2]}, "vertices[1]: 1; expected an object"),
    "vertex called ground": (MODEL | {"vertices": ["ground"], "rods": []}, "or is called 'ground'"),
    "k": (MODEL | {"centres": [{"k": -1}]}, "centres[0].k: -1; expected 0 or more"),
    "centre of no rod": (MODEL | {"vertices": 4, "centres": [{"k": 3, "rods": [[0, 3]]}]}, "which is no rod"),
    "line": (MODEL | {"on_line": [{"vertex": 0, "line": [0, 1]}]}, "is spanned by [0, 1]; expected 2 other vertices"),
    "ground line": (MODEL | {"on_line": [{"vertex": 0, "line": "ground"}]}, "needs the ground link; expected 'ground'"),
    "scissors": (MODEL | {"scissors": [[0, 1, 2, 2]]}, "a scissors element has 3 exposed vertices; expected four"),
    "link of vertices": (MODEL | {"links": [{"id": "A", "vertices": [0, 1, 0]}]}, "link 'A' names a vertex twice"),
    "creases": (VERTEX_EDGE | {"vertices": [{"id": "A", "creases": ["a"]}]}, "expected two or more, each once"),
    "vertex twice": (VERTEX_EDGE | {"vertices": VERTEX_EDGE["vertices"] * 2}, "vertices[1]: vertex 'A' occurs twice"),
}  # fmt: skip

TEXTS = {
    "empty": ("a.json", b"", "the file is empty; expected a mechanism"),
    "blank": ("a.json", b"  \n\n", "the file is empty"),
    "truncated": ("a.json", b'{"format": "synthedra/sc", "links": [', "line 1 column 38: not JSON: Expecting value"),
    "not a number": ("a.json", b'{"links": NaN}', "the number NaN; expected finite numbers"),
    "infinity": ("a.json", b'{"links": -Infinity}', "the number -Infinity"),
    "key twice": ("a.json", b'{"links": 1, "links": 2}', "links: the key occurs twice; expected once"),
    "huge integer": ("a.json", b'{"links": 1' + b"0" * 5000 + b"}", "not JSON: Exceeds the limit"),
    "binary": ("a.json", bytes(range(256)), "not text"),
    "zero byte": ("a.json", b'{"a": "\0"}', "byte 7: a zero byte: a binary file?"),
    "latin-1": ("a.json", "{é}".encode("latin-1"), "byte 1: not text; expected UTF-8 text"),
    "deep": ("a.json", b"[" * 20_000, "the JSON is nested too deeply"),
    "deep objects": ("a.fold", b'{"a":' * 20_000, "the JSON is nested too deeply"),
    "extension": ("a.pdf", b"%PDF", "files ending in '.pdf' are not known; expected one of .cp .csv .dxf .edgelist .edges .fold"),
    "no extension": ("mechanism", b"x", "the name has no extension"),
    "fold: no object": ("a.fold", b"[]", "a list; expected a FOLD document"),
    "fold: no faces": ("a.fold", b"{}", "faces_vertices: missing; expected faces, or edges with coordinates"),
    "fold: not flat": ("a.fold", b'{"vertices_coords": [[0,0,0],[1,0,1],[0,1,0],[0,0,1]], "edges_vertices": [[0,1]]}',
                       "faces_vertices: missing, and the pattern is not flat; expected the faces"),
    "fold: no length": ("a.fold", b'{"vertices_coords": [[1,1],[1,1]], "edges_vertices": [[0,1]]}',
                        "the pattern has no line of any length; expected lines"),
    "cp: type": ("a.cp", b"1 0 0 1 0\n7 0 0 1 1\n", "line 2: '7 0 0 1 1'; expected a type from 1 to 4 and four numbers"),
    "cp: short": ("a.cp", b"1 0 0 1\n", "line 1: '1 0 0 1'; expected a type from 1 to 4"),
    "cp: word": ("a.cp", b"1 0 0 1 x\n", "line 1: '1 0 0 1 x'; expected four numbers after the type"),
    "cp: infinite": ("a.cp", b"1 0 0 1 inf\n", "line 1: a number that is not finite, or too large"),
    "cp: a point": ("a.cp", b"1 0 0 0 0\n", "the pattern has no line of any length"),
    "opx: no XML": ("a.opx", b"<java", "not XML; expected an ORIPA file"),
    "opx: no line": ("a.opx", b"<java/>", "no object of class oripa.OriLineProxy; expected an ORIPA file"),
    "opx: entities": ("a.opx", b'<!DOCTYPE a [<!ENTITY b "c">]><java/>', "a document type definition; expected an"),
    "opx: type": ("a.opx", b'<a><object class="oripa.OriLineProxy"><void property="type"><int>9</int></void></object>'
                  b"</a>", "oripa.OriLineProxy 0: type '9'; expected a type from 0 to 4"),
    "opx: word": ("a.opx", b'<a><object class="oripa.OriLineProxy"><void property="y1"><double>x</double></void>'
                  b"</object></a>", "oripa.OriLineProxy 0 y1: 'x'; expected a number"),
    "opx: infinite": ("a.opx", b'<a><object class="oripa.OriLineProxy"><void property="x0"><double>-Infinity</double>'
                      b"</void></object></a>", "oripa.OriLineProxy 0 x0: a number that is not finite, or too large"),
    "opx: no value": ("a.opx", b'<a><object class="oripa.OriLineProxy"><void property="x0"/></object></a>',
                      "a property of 0 values; expected one"),
    "opx: points": ("a.opx", b'<a><object class="oripa.OriLineProxy"/></a>', "the pattern has no line of any length"),
    "obj: word": ("a.obj", b"v 0 0 x\n", "line 1: 'v 0 0 x'; expected three numbers"),
    "obj: infinite": ("a.obj", b"v 0 0 inf\n", "line 1: 'v 0 0 inf'; expected three numbers"),
    "obj: no faces": ("a.obj", b"v 0 0 0\n", "no faces; expected lines 'f a b c ...'"),
    "obj: vertex": ("a.obj", b"v 0 0 0\nf 1 2 3\n", "line 2: face 0 names vertex 1; expected a vertex from 0 to 0"),
    "obj: zero": ("a.obj", b"v 0 0 0\nf 0 1 2\n", "line 2: 'f 0 1 2'; expected numbers of vertices from 1 on"),
    "svg: no XML": ("a.svg", b"<svg", "not XML; expected SVG"),
    "svg: no line": ("a.svg", b'<svg xmlns="http://www.w3.org/2000/svg"/>', "the pattern has no line of any length"),
    "svg: far": ("a.svg", b'<svg xmlns="http://www.w3.org/2000/svg"><line x1="0" y1="0" x2="1e300" y2="0" '
                 b'stroke="red"/></svg>', "a coordinate that is not finite, or too large"),
    "fold: far vertex": ("a.fold", b'{"vertices_coords": [[0,0],[1,0],[0,1]], "faces_vertices": [[0, 1, 7]]}',
                         "faces_vertices[0]: face 0 names vertex 7; expected a vertex from 0 to 2"),
    "fold: repeated vertex": ("a.fold", b'{"faces_vertices": [[0, 1, 1]]}', "faces_vertices[0]: face 0 has the vert"),
    "fold: assignment": ("a.fold", b'{"faces_vertices": [[0, 1, 2]], "edges_vertices": [[0, 1]], '
                         b'"edges_assignment": ["X"]}', "edges_assignment[0]: 'X'; expected one of M V U F J B C"),
    "fold: short": ("a.fold", b'{"faces_vertices": [[0, 1, 2]], "edges_vertices": [[0, 1]], "edges_assignment": []}',
                    "edges_assignment: a list of 0; expected a list of 1, one an edge"),
    "fold: edge": ("a.fold", b'{"faces_vertices": [[0, 1, 2]], "edges_vertices": [[0, 1, 2]]}', "3 vertices; expec"),
    "fold: loop": ("a.fold", b'{"faces_vertices": [[0, 1, 2]], "edges_vertices": [[1, 1]]}', "edge 0 goes from vertex 1"),
    "fold: coordinates": ("a.fold", b'{"faces_vertices": [], "vertices_coords": [[0]]}', "1 numbers; expected two or"),
    "fold: overflow": ("a.fold", b'{"faces_vertices": [], "vertices_coords": [[0, 1e999]]}', "a number too large"),
    "fold: float vertex": ("a.fold", b'{"faces_vertices": [[0, 1, 2.0]]}', "faces_vertices[0][2]: 2.0; expected an int"),
    "g6: letters": ("a.g6", b"C~\nhello there", "line 2: not graph6: 'hello there'"),
    "g6: short": ("a.g6", b"C", "line 1: not graph6"),
    "g6: huge": ("a.g6", b"~~~~~~~~", "line 1: number of nodes: 68719476735; expected at most 250000"),
    "s6: self-joint": ("a.s6", b":Af", "line 1: a joint joins link"),
    "graphml: no XML": ("a.graphml", b"<graphml", "not XML"),
    "graphml: no graph": ("a.graphml", b"<html/>", "not GraphML"),
    "edges: one word": ("a.edges", b"0 1\n2\n", "line 2: 1 word; expected two links"),
    "edges: rows of an enumeration": (
        "a.csv",
        b"code,links,joints,dof\nk1:Cr,4,4,1\n",
        "line 1: columns of a list of mechanisms; expected edges; rows of an enumeration are read from .jsonl",
    ),
    "edges: comments": ("a.edges", b"# nothing\n", "no joints; expected lines with two links each"),
    "edges: self-joint": ("a.edges", b"0 1\n1 1\n", "a joint joins link 1 to itself"),
    "edges: joint twice": ("a.edges", b"0 1 a\n1 2 a\n", "the joint id 'a' occurs twice"),
}  # fmt: skip


def refused(path, message):
    with pytest.raises(FileError, match=re.escape(message)) as error:
        read(path)
    text = str(error.value)
    assert text.startswith(f"{path}: ")
    assert "\n" not in text
    assert len(text) < len(str(path)) + 250


@pytest.mark.parametrize("name", DOCUMENTS)
def test_bad_documents(name, tmp_path):
    doc, message = DOCUMENTS[name]
    path = tmp_path / "bad.json"
    path.write_text(json.dumps(doc), encoding="utf-8")
    refused(path, message)


@pytest.mark.parametrize("name", TEXTS)
def test_bad_texts(name, tmp_path):
    file, raw, message = TEXTS[name]
    path = tmp_path / file
    path.write_bytes(raw)
    refused(path, message)


def test_the_documents_that_were_broken_are_good(tmp_path):
    for doc in (SC, SCD, MODEL, VERTEX_EDGE):
        path = tmp_path / "good.json"
        path.write_text(json.dumps(doc), encoding="utf-8")
        read(path)


def test_a_directory_a_missing_file_and_a_closed_one(tmp_path):
    folder = tmp_path / "folder.json"
    folder.mkdir()
    refused(folder, "a directory; expected a file")
    refused(tmp_path, "a directory; expected a file")
    refused(tmp_path / "none.json", "no such file; expected a file")
    refused(tmp_path / "none", "no such file")
    closed = tmp_path / "closed.json"
    closed.write_text("{}", encoding="utf-8")
    closed.chmod(0)
    root = os.geteuid() == 0
    if root:  # root may read anything: be nobody for a moment
        os.seteuid(65534)
    try:
        refused(closed, "no permission to read it")
    finally:
        if root:
            os.seteuid(0)


def test_several_mechanisms_in_a_file_are_not_one(tmp_path):
    path = tmp_path / "two.g6"
    path.write_text("C~\nCl\n", encoding="ascii")
    with pytest.raises(FileError, match=r"2 mechanisms; expected one; try its line, .*two\.g6:1"):
        read(path)
    assert read(f"{path}:2").number_of_edges() == 4
    assert [entry.label for entry in read_all(f"{path}:2")] == [f"{path}:2"]
    with pytest.raises(FileError, match=r"two\.g6: line 3: no mechanism; expected one of 2 lines"):
        read(f"{path}:3")
    (tmp_path / "two.g6:2").write_text("C~\n", encoding="ascii")  # a name of its own is meant first
    with pytest.raises(FileError, match=r"files ending in '\.g6:2' are not known"):
        read(f"{path}:2")


def test_nothing_half_written(tmp_path):
    sc = SCGraph(2, [(0, 1)])
    with pytest.raises(FileError, match=r"there is no folder"):
        write(sc, tmp_path / "no" / "a.json")
    with pytest.raises(
        FileError, match=r"files ending in '\.pdf' are not known; .*\.stl \.3mf \.gltf .*\.csv .*\.usda"
    ):
        write(sc, tmp_path / "a.pdf")
    (tmp_path / "a.json").mkdir()
    with pytest.raises(FileError, match="a directory; expected a file to write"):
        write(sc, tmp_path / "a.json")
    assert [p.name for p in tmp_path.iterdir()] == ["a.json"]


def test_what_was_there_is_kept_when_writing_fails(tmp_path, monkeypatch):
    path = tmp_path / "a.json"
    path.write_text("old", encoding="utf-8")

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.replace", full)
    with pytest.raises(FileError, match="No space left on device"):
        write(SCGraph(2, [(0, 1)]), path, force=True)
    assert path.read_text(encoding="utf-8") == "old"
    assert [p.name for p in tmp_path.iterdir()] == ["a.json"]


def test_messages_are_short_whatever_the_name():
    assert len(shown("x" * 10_000)) == 60
    assert shown("\x1b[31m") == "'\\x1b[31m'"
    assert len(str(FileError("f" * 10, "", shown(list(range(10**4)))))) < 80


def test_a_mechanism_of_another_kind_than_stated_is_refused():
    assert isinstance(read("k1:Cr", kind=SCGraph), SCGraph)
    with pytest.raises(FileError, match="k1:Cr: a mechanism of the kind SCGraph; expected Sheet"):
        read("k1:Cr", kind=Sheet)
    with pytest.raises(ArgumentError, match=r"read: the kind .sheet.; expected a class of mechanisms"):
        read("k1:Cr", kind="sheet")
