"""Small files that call for huge work: answered soon, or refused by a limit that is told and can be raised."""

import json
import os
import re
import socket
from itertools import pairwise
from pathlib import Path

import networkx as nx
import numpy as np
import pytest

from graphs.convert.link_joint import sc_from_link_joint_graph
from graphs.errors import FileError, InvariantError
from graphs.files.formats import read, read_all
from graphs.input_limits import LIMITS, VARIABLE, most

SVG = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink">'
POLYHEDRON = {"format": "synthedra/polyhedron", "version": 1}
SC = {"format": "synthedra/sc", "version": 1}


def refused(path, limit):
    """The message names the limit and how to raise it."""
    with pytest.raises(FileError, match=f"{VARIABLE}={limit}=[0-9]+ allows more") as error:
        list(read_all(path))
    assert "\n" not in str(error.value)
    assert str(path) in str(error.value)
    return str(error.value)


def nested_uses(levels, each, key="href"):
    groups = [f'<g id="a{i}">' + f'<use {key}="#a{i - 1}"/>' * each + "</g>" for i in range(1, levels + 1)]
    line = '<line id="a0" x1="0" y1="0" x2="4" y2="3" stroke="red"/>'
    return f'{SVG}<defs>{line}{"".join(groups)}</defs><use {key}="#a{levels}"/></svg>'


def grid(n):
    """Lines of a square grid; the outermost are its border."""
    rows = [("1" if i in (0, n) else "2", f"{i} 0 {i} {n}") for i in range(n + 1)]
    rows += [("1" if i in (0, n) else "3", f"0 {i} {n} {i}") for i in range(n + 1)]
    return "".join(f"{kind} {ends}\n" for kind, ends in rows)


@pytest.mark.parametrize("document", [POLYHEDRON | {"vertices": 2_000_000, "rods": [[0, 1]]},
                                      SC | {"links": 2_000_000, "joints": [[0, 1]], "loops": []}])  # fmt: skip
def test_a_bare_number_of_nodes(tmp_path, document):
    """Without the limit these two took half a minute and a gigabyte."""
    path = tmp_path / "a.json"
    path.write_text(json.dumps(document))
    refused(path, "nodes")


def test_a_line_of_ten_bytes(tmp_path):
    path = tmp_path / "a.s6"
    path.write_bytes(b":~~" + bytes(63 + (2_000_000 >> 6 * i & 63) for i in range(5, -1, -1)))
    assert "line 1" in refused(path, "nodes")


@pytest.mark.parametrize("key", ["href", "xlink:href"])
def test_uses_of_uses(tmp_path, key):
    """Ten uses of ten uses, nine times: 10**9 lines in 2 kB. Drawn one by one they take a day."""
    path = tmp_path / "a.svg"
    path.write_text(nested_uses(9, 10, key))
    assert int(re.search(r"(\d+) shapes", refused(path, "shapes"))[1]) > 10**9


def test_a_few_uses_are_drawn(tmp_path):
    path = tmp_path / "a.svg"
    square = '<rect id="s" width="4" height="3" stroke="black"/><use href="#s" x="4"/>'
    path.write_text(SVG + square + '<line x1="4" y1="0" x2="4" y2="3" stroke="red"/></svg>')
    assert len(read(path).faces) == 2


def test_a_shape_that_uses_itself(tmp_path):
    path = tmp_path / "a.svg"
    path.write_text(f'{SVG}<g id="a"><use href="#b"/></g><g id="b"><use href="#a"/></g></svg>')
    with pytest.raises(FileError, match=r"the shape '[ab]' uses itself"):
        read(path)


def nested_groups(levels):
    """A square with a diagonal, a quarter to the right of where each group around it begins; levels in all."""
    around = levels - 2  # the svg element and the shapes
    shapes = '<rect width="4" height="3" stroke="black"/><line x1="0" y1="0" x2="4" y2="3" stroke="red"/>'
    return SVG + '<g transform="translate(0.25)">' * around + shapes + "</g>" * around + "</svg>"


def chained_uses(levels):
    """A line in a row of groups that use each other: each group is a level, and its use is another."""
    number = (levels - 3) // 2  # beside them the svg element, the last use, the line
    groups = "".join(f'<g id="a{i}"><use href="#a{i - 1}"/></g>' for i in range(1, number + 1))
    line = '<line id="a0" x2="4" y2="3" stroke="red"/>'
    return f'{SVG}<defs>{line}{groups}</defs><use href="#a{number}"/></svg>'


def test_shapes_nested_deeply(tmp_path, monkeypatch):
    """Up to the limit each group moves what is in it; beyond, time grew with the square and the stack ended."""
    path = tmp_path / "a.svg"
    path.write_text(nested_groups(LIMITS["levels"]))
    sheet = read(path)
    assert (len(sheet.faces), sheet.assignments.count("M")) == (2, 1)
    assert np.ptp(np.array(sheet.coordinates), axis=0).tolist() == [4, 3]
    assert np.min(np.array(sheet.coordinates)[:, 0]) == 0.25 * (LIMITS["levels"] - 2)
    for levels in (LIMITS["levels"] + 1, 900, 5_000):
        path.write_text(nested_groups(levels))
        assert f"{levels} levels" in refused(path, "levels")
    monkeypatch.setenv(VARIABLE, "levels=5000")
    path.write_text(SVG + "<g>" * 1_200 + "</g>" * 1_200 + "</svg>")
    with pytest.raises(FileError, match=r"a\.svg: elements nested more deeply than Python can follow; expected "):
        read(path)


def test_uses_count_as_levels(tmp_path):
    path = tmp_path / "a.svg"
    path.write_text(chained_uses(301))  # of 149 groups, none of them in another
    assert "301 levels" in refused(path, "levels")


@pytest.mark.parametrize(
    ("odd", "message"),
    [
        ('<polyline stroke="black" points="' + "1" * 5_000 + '"/>', "polyline: points: a number of more than 100"),
        ('<line stroke="rgb(' + "1" * 90_000 + '"/>', "line: stroke: a number of more than 100 digits"),
        ("<style>a{" + " " * 9_000 + "x</style>", "style: a rule that does not end; expected '}'"),
        ("<style>" + "x" * 200_000 + "</style>", f"200000 letters in a style sheet; .*{VARIABLE}=letters=200000 allows"),
        ('<g transform="' + "scale(" * 50_000 + '"/>', f"300000 letters in a transform; .*{VARIABLE}=letters=300000"),
    ],
    ids=["points", "colour", "open rule", "style", "transform"],
)  # fmt: skip
def test_text_that_is_looked_through_again_and_again(tmp_path, odd, message):
    """The patterns of svgelements take time with the square or cube of such text: minutes, or days."""
    path = tmp_path / "a.svg"
    path.write_text(f'{SVG}<rect width="4" height="3" stroke="black"/>{odd}</svg>')
    with pytest.raises(FileError, match=message):
        read(path)


def test_styles_transforms_and_long_numbers_are_read(tmp_path):
    path = tmp_path / "a.svg"
    style = "<style>rect {stroke: black} .m {stroke: red}</style>"
    line = '<line class="m" x1="0" y1="0" x2="4" y2="3.' + "0" * 90 + '" transform="translate(0)"/>'
    path.write_text(f'{SVG}{style}<rect width="4" height="3"/>{line}</svg>')
    assert sorted(read(path).assignments) == sorted("BBBBM")


def test_frames_that_inherit_from_frames(tmp_path):
    """Each of 20 000 frames was put together anew from all before it: 200 million steps."""
    path = tmp_path / "a.fold"
    frames = [{"frame_inherit": True, "frame_parent": i} for i in range(20_000)]
    frames[-1]["faces_vertices"] = [[0, 1, 2], [0, 2, 3]]
    path.write_text(json.dumps({"file_frames": frames, "vertices_coords": [[0, 0], [1, 0], [1, 1], [0, 1]]}))
    sheet = read(path)
    assert len(sheet.faces) == 2
    assert "the key frame is empty; frame 20000 of 20000 was read" in sheet.repairs
    frames[0]["frame_parent"] = 20_000
    path.write_text(json.dumps({"file_frames": frames}))
    with pytest.raises(FileError, match="frames inherit in a circle"):
        read(path)


def test_a_frame_keeps_what_is_empty_from_its_parent(tmp_path):
    """An empty list is not a missing key: the second frame has no faces, the third has its own."""
    path = tmp_path / "a.fold"
    frames = [{"frame_inherit": True, "frame_parent": 3, "faces_vertices": []},
              {"frame_inherit": True, "frame_parent": 1},
              {"faces_vertices": [[0, 1, 2]]}]  # fmt: skip
    path.write_text(json.dumps({"file_frames": frames}))
    assert "the key frame is empty; frame 3 of 3 was read" in read(path).repairs


def test_a_complete_graph_of_a_hundred_links(tmp_path):
    """A shortest cycle basis of its 4950 joints takes days; one of 20 links is answered."""
    path = tmp_path / "a.g6"
    path.write_bytes(nx.to_graph6_bytes(nx.complete_graph(100), header=False))
    refused(path, "basis")
    with pytest.raises(InvariantError, match="4950 joints in a part that is not planar"):
        sc_from_link_joint_graph(nx.complete_graph(100))
    assert len(sc_from_link_joint_graph(nx.complete_graph(9)).loops) == 28


def test_a_grid_of_lines(tmp_path):
    """90 000 crossings: each was welded at seven tolerances."""
    path = tmp_path / "a.cp"
    path.write_text(grid(300))
    refused(path, "crossings")
    path.write_text(grid(20))
    assert len(read(path).faces) == 400


def test_equal_lines_are_one(tmp_path):
    """20 000 equal lines have 200 million pairs, each of which was found, seven times."""
    path = tmp_path / "a.cp"
    square = "".join(f"1 {a} {b} {c} {d}\n" for (a, b), (c, d) in pairwise([(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)]))
    path.write_text(square + "4 0 0 1 1\n" + "3 0 0 1 1\n2 1 1 0 0\n" * 10_000)
    sheet = read(path)
    assert sorted(sheet.assignments) == sorted("BBBBM")
    assert "20000 lines drawn twice" in sheet.repairs


def test_lines_that_are_nearly_equal_are_too_many_pairs(tmp_path, monkeypatch):
    monkeypatch.setenv(VARIABLE, "meetings=10000")
    path = tmp_path / "a.cp"
    heights = np.linspace(0, 1e-9, 300)
    path.write_text("1 0 0 1 0\n1 1 0 1 1\n1 1 1 0 0\n" + "".join(f"2 0 {y!r} 1 {1 - y!r}\n" for y in heights.tolist()))
    refused(path, "meetings")


def test_many_lines_through_one_point_cross_once(tmp_path):
    path = tmp_path / "a.cp"
    turns = np.arange(120) * np.pi / 120
    x, y = np.cos(turns), np.sin(turns)
    rim = [*zip(x, y, strict=True), *zip(-x, -y, strict=True)]
    spokes = "".join(f"2 {a!r} {b!r} {-a!r} {-b!r}\n" for a, b in zip(x.tolist(), y.tolist(), strict=True))
    border = "".join(f"1 {a} {b} {c} {d}\n" for (a, b), (c, d) in pairwise([*rim, rim[0]]))
    path.write_text(spokes + border)
    sheet = read(path)
    assert (len(sheet.faces), sheet.vertices) == (240, 241)


def test_keys_and_ids_that_come_twice(tmp_path):
    """The second was looked for by counting each of 30 000 in all of them."""
    keys, ids = tmp_path / "a.json", tmp_path / "a.edges"
    keys.write_text("{" + ",".join(f'"k{i}":1' for i in range(30_000)) + ',"k29999":2}')
    ids.write_text("".join(f"{i} {i + 1} a{i}\n" for i in range(30_000)) + "5 6 a29999\n")
    with pytest.raises(FileError, match="k29999: the key occurs twice"):
        read(keys)
    with pytest.raises(FileError, match="the joint id 'a29999' occurs twice"):
        read(ids)


@pytest.mark.parametrize("filling", [" ", " {"])
def test_a_long_line_is_read_once(tmp_path, filling):
    """From each of its blanks on the rest was looked through for a dictionary: a megabyte took most of an hour."""
    path = tmp_path / "a.edges"
    path.write_text("0 1" + filling * 500_000 + "x\n1 2\n2 0\n")
    if filling == " ":
        assert len(read(path)) == 3
        return
    with pytest.raises(FileError, match=r"line 1: 500002 words; expected two links"):
        read(path)


def test_a_crease_at_many_vertices(tmp_path):
    """The ends of a crease were copied for each."""
    path = tmp_path / "a.json"
    vertices = [{"id": i, "creases": ["a", "b"]} for i in range(30_000)]
    path.write_text(json.dumps({"format": "synthedra/vertex-edge", "version": 1, "vertices": vertices}))
    with pytest.raises(FileError, match="ends in 30000 vertices; expected two at most"):
        read(path)


def test_a_file_too_large_is_not_begun(tmp_path):
    path = tmp_path / "a.json"
    with path.open("wb") as file:
        file.truncate(10**9)
    assert "1000 megabytes" in refused(path, "megabytes")


@pytest.mark.parametrize("suffix", [".json", ".svg", ".cp"])
def test_pipes_sockets_and_devices_are_no_files(tmp_path, monkeypatch, suffix):
    """Nobody writes to the pipe: to open it would wait for ever; /dev/zero never ends."""
    pipe, plug, device = (tmp_path / f"{name}{suffix}" for name in ("pipe", "socket", "device"))
    os.mkfifo(pipe)
    with socket.socket(socket.AF_UNIX) as server:
        monkeypatch.chdir(tmp_path)  # names of sockets are short
        server.bind(plug.name)
        device.symlink_to("/dev/zero")
        for path, kind in ((pipe, "a pipe"), (plug, "a socket"), (device, "a device")):
            with pytest.raises(FileError, match=re.escape(f"{path}: {kind}; expected a regular file")):
                read(path)


def test_limits_are_raised_and_lowered_by_name(tmp_path, monkeypatch):
    path = tmp_path / "a.json"
    path.write_text(json.dumps(SC | {"links": 250_001, "joints": [], "loops": []}))
    refused(path, "nodes")
    monkeypatch.setenv(VARIABLE, "nodes=250001, shapes=3")
    assert most("nodes") == 250_001
    assert len(read(path)) == 250_001
    path = tmp_path / "a.svg"
    path.write_text(nested_uses(3, 2))
    refused(path, "shapes")
    for odd in ("nodes", "nodes=-1", "edges=3", "nodes=3;shapes=4"):
        monkeypatch.setenv(VARIABLE, odd)
        with pytest.raises(FileError, match=f"{VARIABLE}: .*; expected NAME=NUMBER, the name one of megabytes"):
            read(path)


def test_the_guide_tells_every_limit():
    text = (Path(__file__).parents[3] / "docs" / "files.md").read_text(encoding="utf-8")
    for name, number in LIMITS.items():
        assert f"| `{name}` | {number:,} |".replace(",", " ") in text
