"""Catalogues: what is in them, that labels do not overlap, that they come page by page."""

import json
from itertools import combinations, islice
from xml.etree import ElementTree

import pytest
from commands import run

from enumerate.chains.kinematic import chain_rows
from graphs.errors import FileError, InvariantError
from synth.drawing.catalogue.entries import catalogue_entries
from synth.drawing.catalogue.pages import catalogue_pages
from synth.drawing.mechanisms.labelling import overlaps


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
        assert not overlaps(one, other), (one, other)


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
    assert {"1", "2", "k1:E`hW", "stephenson, M = 1, symmetry 4"} <= set(
        texts
    ) or "watt, M = 1, symmetry 4" in texts


def test_filters_keep_the_numbers(tmp_path):
    rows = listed(tmp_path / "a.jsonl", chain_rows(8, 1))
    out = tmp_path / "a.svg"
    run("draw", rows, "-o", out, "--where", "symmetry=4..", "--where", "assortment=4,4")
    numbers = [label for label in ElementTree.parse(out).iter() if label.get("font-weight") == "bold"]
    symmetric = [
        i for i, row in enumerate(chain_rows(8, 1), 1) if row["symmetry"] >= 4 and row["assortment"] == [4, 4]
    ]
    assert symmetric
    below = [
        label.text for label in numbers if label.get("fill") == "#1a1a1a" and label.get("text-anchor") == "start"
    ]
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


def test_orders_round_a_cone_are_said(tmp_path):
    """Their pictures are of one chain; the order tells them apart."""
    rows = listed(
        tmp_path / "a.jsonl", [{"chain": "k1:Cr", "order": order} for order in ([0, 1, 2, 3], [0, 2, 1, 3])]
    )
    assert [entry.said for entry in catalogue_entries(rows)] == [
        "four-bar, order 0 1 2 3",
        "four-bar, order 0 2 1 3",
    ]


def test_a_catalogue_as_pdf(six_links, tmp_path):
    pytest.importorskip("reportlab")
    for name in "ab":
        run("draw", six_links, "-o", tmp_path / f"{name}.pdf")
    assert (tmp_path / "a.pdf").read_bytes() == (tmp_path / "b.pdf").read_bytes()
    assert (tmp_path / "a.pdf").read_bytes().startswith(b"%PDF")
