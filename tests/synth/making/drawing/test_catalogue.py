"""Catalogues: what is in them, that labels do not overlap, that they come page by page."""

import json
import shutil
from itertools import combinations, islice
from math import atan2, pi
from pathlib import Path
from xml.etree import ElementTree

import pytest
from commands import run

import synth
from enumerate.chains.jobs import chain_rows
from enumerate.scd.jobs import scd_rows
from graphs.errors import FileError, InvariantError
from graphs.files.formats import read
from synth.catalogue.realisation import sheet_of_type
from synth.making.drawing.list_pages import catalogue_entries, catalogue_pages
from synth.making.drawing.mechanisms.pictures import draw

DATA = Path(__file__).resolve().parents[4] / "data"


def listed(path, rows):
    path.write_text("".join(json.dumps(row) + "\n" for row in rows))
    return path


@pytest.fixture(scope="module")
def six_links(tmp_path_factory):
    return listed(tmp_path_factory.mktemp("rows") / "chains.jsonl", chain_rows(6, 1))


def assert_no_two_labels_overlap(page):
    labels = page.labels()
    assert labels
    for one, other in combinations(labels, 2):
        a, b = one.box, other.box
        assert not (a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]), (one, other)


def test_labels_do_not_overlap(tmp_path):
    """Numbers of links in the pictures, and the lines below."""
    rows = listed(tmp_path / "a.jsonl", islice(chain_rows(10, 1), 0, 230, 60))
    (page,) = catalogue_pages(catalogue_entries(rows), "ten links")
    assert_no_two_labels_overlap(page)


@pytest.mark.slow
def test_labels_do_not_overlap_on_the_catalogue_of_ten_link_chains(tmp_path):
    pages = list(catalogue_pages(catalogue_entries(listed(tmp_path / "a.jsonl", chain_rows(10, 1))), "ten links"))
    assert len(pages) == 10
    for page in pages:
        assert_no_two_labels_overlap(page)


def test_a_catalogue_names_what_is_known(six_links):
    (page,) = catalogue_pages(catalogue_entries(six_links), "six links")
    texts = [label.text for label in page.labels()]
    said = " ".join(texts)
    assert {"1", "2", "k1:E`hW"} <= set(texts)
    assert "watt, M = 1, symmetry 4, assortment 4 + 2, 2 inversions" in said
    assert "stephenson, M = 1, symmetry 4, assortment 4 + 2, 3 inversions" in said


def panels_on(page):
    """The creases and borders of sheets on a page, by the layers that hold them."""
    return [layer for layer in page.layers if layer.name == "creases"]


def test_types_have_their_realised_sheet_beside_the_graph(tmp_path):
    rows = listed(tmp_path / "scd.jsonl", scd_rows(4, 1, 3))
    entries = list(catalogue_entries(rows))
    (page,) = catalogue_pages(entries, "vertices", realise=sheet_of_type)
    assert len(panels_on(page)) == len(entries) > 0
    assert len(panels_on(next(catalogue_pages(entries, "vertices")))) == 0
    assert_no_two_labels_overlap(page)
    assert "4 links of 3 sides" in " ".join(label.text for label in page.labels())


def test_a_type_without_a_sheet_says_why(tmp_path):
    for name in ("fortune-teller", "watt-planar"):
        shutil.copy(DATA / "wiener" / f"{name}.json", tmp_path)
    (page,) = catalogue_pages(catalogue_entries(tmp_path), realise=sheet_of_type)
    said = " ".join(label.text for label in page.labels())
    assert "no sheet: more than 12 links" in said
    assert "no sheet: no realisation was found in 4 tries" in said


def test_a_chain_without_centres_is_not_called_a_spherical_system():
    assert "spherical system)" not in str(synth.mobility("k1:E`hW")).replace("spherical system (Wiener", "")
    assert "kinematic chain" in synth.look("k1:E`hW").kind
    planar = DATA / "wiener" / "watt-planar.json"
    assert "1 centre, at infinity: the linkage is planar" in synth.look(planar).kind
    assert any("1 centre at infinity" in label.text for label in synth.draw(planar).labels())
    assert "spherical system)" in str(synth.mobility("m1:ab.ac.bde.cef.dg.fg"))


def test_filters_keep_the_numbers(tmp_path):
    rows = listed(tmp_path / "a.jsonl", chain_rows(8, 1))
    out = tmp_path / "a.svg"
    run("draw", rows, "-o", out, "--where", "symmetry=4..", "--where", "assortment=4,4")
    numbers = [label for label in ElementTree.parse(out).iter() if label.get("font-weight") == "bold"]
    symmetric = [i for i, row in enumerate(chain_rows(8, 1), 1) if row["symmetry"] >= 4 and row["assortment"] == [4, 4]]
    assert symmetric
    below = [label.text for label in numbers if label.get("fill") == "#1a1a1a" and label.get("text-anchor") == "start"]
    assert below == ["a.jsonl", *map(str, symmetric)]


def test_a_column_that_is_not_there(six_links):
    with pytest.raises(InvariantError, match="there is no column 'colour'; expected code, links"):
        list(catalogue_entries(six_links, {"colour": "red"}))


@pytest.mark.parametrize("line", ["[]", "{", '{"code": 4}', '{"code": "k1:!!"}'])
def test_rows_that_are_none(tmp_path, line):
    path = tmp_path / "a.jsonl"
    path.write_text(line + "\n")
    with pytest.raises(FileError):
        list(catalogue_entries(path))


def test_pages_come_one_by_one(six_links):
    """The second page is not asked for before the first was taken."""
    taken = []

    def entries():
        (entry,) = islice(catalogue_entries(six_links), 1)
        for number in range(50):
            taken.append(number)
            yield entry

    pages = catalogue_pages(entries())
    next(pages)
    assert len(taken) == 24


def test_a_folder_is_drawn_and_what_cannot_be_is_told(tmp_path):
    folder = tmp_path / "folder"
    folder.mkdir()
    (folder / "a.json").write_text("{}")
    (folder / "b.txt").write_text("0 1\n1 2\n2 3\n3 0\n")
    result = run("draw", folder, "-o", tmp_path / "a.svg")
    assert "a.json" in result.stderr
    assert (tmp_path / "a.svg").exists()


def test_strings_are_strips(tmp_path):
    out = tmp_path / "strings.svg"
    run("draw", listed(tmp_path / "a.jsonl", [{"string": "RR-R", "dof": 3, "joints": "UR"}]), "-o", out)
    assert {element.get("data-joint") for element in ElementTree.parse(out).iter()} - {None} == {"0", "1", "2"}


def orders_of(tmp_path, *words):
    rows = tmp_path / "orders.jsonl"
    run("enumerate", "conical", *words, "-o", rows, "--workers", 1, "--quiet")
    return rows, [json.loads(line) for line in rows.read_text().splitlines()]


def test_orders_round_a_cone_are_said_and_drawn(tmp_path):
    """Joints follow each other on the circle as the row says; joints of a link have a chord."""
    rows, told = orders_of(tmp_path, "--chain", "four-bar")
    entries = list(catalogue_entries(rows))
    assert [entry.said for entry in entries] == [
        f"four-bar, order {' '.join(row['order'])}, symmetry {row['symmetry']}" for row in told
    ]
    for entry, row in zip(entries, told, strict=True):
        scene = draw(entry.mechanism, box=(130, 130), caption=None)
        dots = next(layer for layer in scene.layers if layer.name == "joints").shapes
        x, y = (sum(dot.centre[i] for dot in dots) / len(dots) for i in (0, 1))
        turn = {dot.data[0][1]: -atan2(dot.centre[1] - y, dot.centre[0] - x) - pi / 2 for dot in dots}
        assert sorted(turn, key=lambda name: round(turn[name] % (2 * pi), 6) % 6.283) == row["order"]
        chords = next(layer for layer in scene.layers if layer.name == "links").shapes
        assert len(chords) == 4
        assert draw(entry.mechanism, "chain").layers[0].name == "links"


@pytest.mark.parametrize("kind", [("--opposites",), ("--slots", 6), ("--sample", 1)])
def test_circuits_of_orders_are_those_drawn(tmp_path, kind):
    """Chords of a loop cross each other or not as azimuths say: one that is open all round is a convex polygon."""
    rows, told = orders_of(tmp_path, "--chain", "four-bar", "--ground", 0, *kind)
    for entry, row in zip(catalogue_entries(rows), told, strict=True):
        place = dict(zip(entry.mechanism.names, entry.mechanism.azimuths, strict=True))
        (loop,) = row["loops"]
        steps = [place[b] - place[a] for a, b in zip(loop, [*loop[1:], loop[0]], strict=True)]
        short = [(step + pi) % (2 * pi) - pi for step in steps]
        halves = any(abs(abs(step) - pi) < 1e-9 for step in short)
        convex = len({step > 0 for step in short}) == 1 and abs(abs(sum(short)) - 2 * pi) < 1e-6
        assert halves or not convex or row["circuits"] == ["open"]


def test_joints_with_names_of_their_own_are_drawn(tmp_path):
    """A chain from a file: ids do not know the names of its joints, loops do."""
    linkage = DATA / "surfaces" / "fig11-stephenson.json"
    rows, told = orders_of(tmp_path, "--chain", linkage, "--open", 3)
    entry = next(iter(catalogue_entries(rows)))
    names = entry.mechanism.names
    assert sorted(names) == sorted(told[0]["order"])
    chain = read(linkage).chain
    at_one_link = {
        frozenset(map(str, (a, b)))
        for link in chain
        for a, b in combinations([j for j in chain.joints if link in chain.joints[j]], 2)
    }
    assert {frozenset((names[a], names[b])) for a, b in entry.mechanism.pairs} == at_one_link


def test_an_order_that_is_none(tmp_path):
    rows = listed(tmp_path / "a.jsonl", [{"chain": "k1:Cr", "order": ["0"], "slots": [0, 1], "loops": []}])
    with pytest.raises(FileError, match="row 1: the order of the joints is invalid"):
        list(catalogue_entries(rows))


def test_a_catalogue_as_pdf(six_links, tmp_path):
    pytest.importorskip("reportlab")
    for name in "ab":
        run("draw", six_links, "-o", tmp_path / f"{name}.pdf")
    assert (tmp_path / "a.pdf").read_bytes() == (tmp_path / "b.pdf").read_bytes()
    assert (tmp_path / "a.pdf").read_bytes().startswith(b"%PDF")
