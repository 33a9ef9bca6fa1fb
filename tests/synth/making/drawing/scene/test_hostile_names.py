"""Names from files are inert in pictures of every kind, in catalogues, and on terminals."""

import json
from pathlib import Path
from xml.etree import ElementTree

import pytest
from commands import run

from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.solids import HingedSolids
from graphs.mechanism.surfaces import SurfaceLinkage
from synth.making.drawing.list_pages import catalogue_entries, catalogue_pages
from synth.making.drawing.mechanisms.pictures import draw
from synth.making.drawing.scene.writing import svg_text

HOSTILE = [
    '<script>alert("x")</script>',
    "&lt;&#x41;&amp;",
    '"\'onload="a',
    "a\x00\x1b[2J\x85b\x9b",
    "]]><!--",
    "\u202egnp.exe",
    "\ud800",
    "x" * 10_000,
]
NAMESPACE = "{http://www.w3.org/2000/svg}"
ELEMENTS = {NAMESPACE + tag for tag in ("svg", "title", "rect", "g", "path", "circle", "text")}


def ring(name):
    """A ring of four links in which a link and a joint have the name."""
    return SCGraph([name, "b", "c", "d"], {name: (name, "b"), 1: ("b", "c"), 2: ("c", "d"), 3: ("d", name)})


def of_kind(kind, name):
    chain = ring(name)
    if kind == "model":
        return PolyhedronModel([name, 1, 2], [(name, 1), (1, 2), (2, name)])
    if kind == "solids":
        axes = [((0, 0, 0), (0, 0, 1)), ((1, 0, 0), (0, 1, 1)), ((1, 1, 0), (1, 0, 1)), ((0, 1, 0), (1, 0, 0))]
        return HingedSolids(chain, dict(zip(chain.joints, axes, strict=True)))
    if kind == "circle":
        return SurfaceLinkage(chain, steps={(name, 1): 1.0, (1, 2): 1.0, (2, 3): 1.5})
    if kind == "stubs":
        return SCDGraph([name, "b"], {name: (name, "b")}, rotation={name: (name, None, None), "b": (name, None, None)})
    return chain


def assert_inert(text):
    """Only shapes and letters; no attribute that runs or loads; nothing that moves a cursor or turns text over."""
    elements = list(ElementTree.fromstring(text.encode("utf-8")).iter())
    assert {element.tag for element in elements} <= ELEMENTS
    assert max(len(element.text or "") for element in elements) <= 400
    keys = {key for element in elements for key in element.attrib}
    assert not any(key.startswith("on") or "href" in key or key == "style" for key in keys)
    assert not any((ord(letter) < 32 and letter != "\n") or letter in "\x7f\x85\x9b\u202e" for letter in text)


@pytest.mark.parametrize("name", HOSTILE)
@pytest.mark.parametrize("kind", ["chain", "graph", "model", "solids", "circle", "stubs"])
def test_names_are_inert(kind, name):
    text = svg_text(draw(of_kind(kind, name), None if kind == "stubs" else kind, caption=name))
    assert_inert(text)


@pytest.mark.parametrize("name", HOSTILE[:-2])
def test_names_of_a_catalogue_are_inert(tmp_path, name):
    rows = tmp_path / "a.jsonl"
    rows.write_text(json.dumps({"code": "k1:Cr", "name": name, "dof": name, "centres": name, "symmetry": name}))
    (page,) = catalogue_pages(catalogue_entries(rows), name)
    assert_inert(svg_text(page))


def test_names_of_orders_round_a_cone_are_inert(tmp_path):
    for name in HOSTILE[:-2]:
        rows = tmp_path / "a.jsonl"
        row = {"chain": "k1:Cr", "order": [name, "1", "2", "3"], "loops": [[name, "1", "2", "3"]]}
        rows.write_text(json.dumps({**row, "azimuths_deg": [0, 90, 180, 270], "symmetry": 1}))
        (page,) = catalogue_pages(catalogue_entries(rows), "orders")
        assert_inert(svg_text(page))


def test_names_of_files_are_inert_on_terminals(tmp_path):
    """What was written, what was left out, and what cannot be read."""
    bad = "a\x1b[2J\u202e"
    folder = tmp_path / bad
    folder.mkdir()
    (folder / f"{bad}.json").write_text("{}")
    (folder / f"{bad}.txt").write_text("0 1\n1 2\n2 3\n3 0\n")
    done = run("draw", folder, "-o", tmp_path / f"{bad}.svg")
    for line in (done.stdout, done.stderr):
        assert bad in str(Path(folder).name)
        assert "a\\x1b[2J" in line
        assert "\x1b" not in line
        assert "\u202e" not in line
    refused = run("draw", folder / f"{bad}.json", "-o", tmp_path / "b.svg", code=2)
    assert "\x1b" not in refused.output
