"""Wiener 2016 (MS thesis): Tables 1, 2, 3 and 6, section 4.1.4, Eqs. 1 to 8."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from oracle import numeric_mobility

from graphs.conversion import to_polyhedron
from graphs.files.formats import read
from graphs.mobility import (
    modified_cgk,
    overconstraint,
    polyhedron_equation,
    spherical_system,
    traditional_cgk,
)
from graphs.polyhedron import PolyhedronModel
from graphs.relative import relative_polyhedron, relative_spherical_system
from graphs.report import mobility_report
from graphs.sc import SCGraph
from graphs.scd import SCDGraph

DATA = Path(__file__).resolve().parents[2] / "data"
INDEX = json.loads((DATA / "index.json").read_text(encoding="utf-8"))
KEYS = {"N": "links", "J": "joints", "V": "vertices", "C": "implicit_centres",
        "E_ext": "external_edges", "E_int": "internal_edges", "E": "edges", "L": "on_line"}  # fmt: skip


def numbers_of(path) -> dict[str, int]:
    """Everything the index may name, from the report."""
    report = mobility_report(read(path)).to_json("")
    merged = report["counts"] | {k: report[k] for k in ("links", "joints")}
    return {short: merged[long] for short, long in KEYS.items() if merged.get(long) is not None} | {
        "M": report["mobility"]
    }


@pytest.mark.parametrize("row", INDEX, ids=[row["file"] for row in INDEX])
def test_every_mechanism_has_the_numbers_of_its_paper(row, golden):
    expected = {key: value for key, value in row.items() if key in (*KEYS, "M")}
    found = numbers_of(DATA / row["file"])
    assert {key: found[key] for key in expected} == expected
    paper, name = row["golden"].split("/")
    assert name in golden[paper]


EXAMPLES = {
    "table3-row1": "table3_row1",
    "table3-row2": "table3_row2",
    "table3-row3": "table3_row3",
    "table3-row4": "table3_row4",
    "six-bar": "ex_4_1_4_1",
    "eight-bar": "ex_4_1_4_2",
    "three-link-chain": "ex_4_1_4_3",
    "fortune-teller": "ex_4_1_4_4",
    "nine-bar-mesh": "ex_4_1_4_5",
    "hybrid-ten-bar": "ex_4_1_4_6_links_0_2",
}


@pytest.mark.parametrize("name", EXAMPLES)
def test_table_3_and_the_examples_of_4_1_4(name, golden):
    """Printed and computed values, by the equation, by the model and by a rank."""
    entry = golden["003"][EXAMPLES[name]]
    scd = read(DATA / "wiener" / f"{name}.json")
    assert isinstance(scd, SCDGraph)
    found = numbers_of(DATA / "wiener" / f"{name}.json")
    for source in (entry["printed"], entry["computed"]):
        shared = source.keys() & found.keys()
        assert shared >= {"V", "C", "E_ext", "E_int"}
        assert {key: found[key] for key in shared} == {key: source[key] for key in shared}
    report = mobility_report(scd)
    computed = entry["computed"]
    assert report.mobility == report.equations["polyhedron"].value == computed["M_eqn4"]
    assert report.equations["spherical_system"].value == computed.get(
        "M_eqn3", report.equations["spherical_system"].value
    )
    assert computed.get("open_edges", scd.counts.open_edges) == scd.counts.open_edges
    assert computed.get("loops", scd.independent_loops) == scd.independent_loops
    assert mobility_report(to_polyhedron(scd)).mobility == report.mobility
    assert numeric_mobility(scd) == computed.get("numeric_hinge_jacobian", [1])[0]


def test_table_1(golden):
    """Misprint 003-1: the text below Eq. 1 swaps spherical and spatial; the table is right."""
    printed = golden["003"]["table1"]["printed"]
    for kind in ("planar", "spherical", "spatial"):
        report = mobility_report(read(DATA / "wiener" / f"six-bar-loop-{kind}.json"))
        assert report.mechanism_class == kind
        assert report.mobility == printed[kind]
        assert report.equations["traditional_cgk"].value == printed[kind]
        assert report.equations["traditional_cgk"].applies


def test_loops_of_n_bars(golden):
    entry = golden["003"]["nbar_loops"]
    for n, spherical, spatial in zip(
        entry["inputs"]["n"],
        entry["computed"]["formula_spherical"],
        entry["computed"]["formula_spatial"],
        strict=True,
    ):
        assert traditional_cgk(n, [1] * n, 3) == modified_cgk(n, n, 3) == spherical_system(n, n) == spherical
        assert traditional_cgk(n, [1] * n, 6) == modified_cgk(n, n, 6) == spatial


def test_rods_of_a_link(golden):
    entry = golden["003"]["polyhedron_link"]
    for n, total in zip(entry["inputs"]["n"], entry["computed"]["total"], strict=True):
        assert n + max(0, 2 * n - 6) == total == 3 * n - 6


@pytest.mark.parametrize("name", ["watt", "watt-planar", "stephenson", "stephenson-planar"])
def test_table_2_and_the_generalised_forms(name, golden):
    """Watt generalises to two centres, Stephenson stays concurrent (3.3.5)."""
    row = golden["003"]["table2"]["computed"]
    sc = read(DATA / "wiener" / f"{name}.json")
    report = mobility_report(sc)
    assert (report.links, report.joints, report.mobility) == (row["N"], row["J"], row["M"])
    assert modified_cgk(row["N"], row["J"], row["lam"]) == row["M"]
    assert numeric_mobility(sc) == 1
    assert report.centres == (2 if name == "watt" else 1)
    assert report.mechanism_class == {"watt": "spherical system", "stephenson": "spherical"}.get(name, "planar")


TABLE_6 = {
    "spherical": "wampler/fig12-scd",
    "system": "wiener/six-bar",
    "hybrid": "wiener/hybrid-ten-bar",
    "spatial": "wiener/three-link-chain",
}


@pytest.mark.parametrize("kind", TABLE_6)
def test_table_6_which_equations_apply(kind, golden):
    table = golden["003"]["table6"]["printed"]
    report = mobility_report(read(DATA / f"{TABLE_6[kind]}.json"))
    assert report.mechanism_class.endswith(kind)
    keys = {"traditional": "traditional_cgk", "modified": "modified_cgk",
            "spherical_system": "spherical_system", "polyhedron": "polyhedron"}  # fmt: skip
    for column, key in keys.items():
        one = report.equations[key]
        assert one.applies == (kind in table[column])
        assert one.why
        if one.applies:
            assert one.value == report.mobility


def test_a_hybrid_is_not_a_spherical_system():
    """Eq. 3 gives 5 for the hybrid ten-bar, which has 2 freedoms."""
    report = mobility_report(read(DATA / "wiener" / "hybrid-ten-bar.json"))
    eq3 = report.equations["spherical_system"]
    assert (eq3.value, eq3.applies, report.mobility) == (5, False, 2)
    assert "1 of 2 loop(s) are spatial" in eq3.why


def test_concentric_loops(golden):
    """3.3.6: C-G-K says -3 and refuses; the closed-surface form says 0, as the rank does."""
    entry = golden["003"]["concentric"]
    sc = read(DATA / "wiener" / "concentric-loops.json")
    assert isinstance(sc, SCGraph)
    report = mobility_report(sc)
    assert report.mechanism_class == "exceptional"
    for name in ("traditional_cgk", "modified_cgk", "spherical_system"):
        assert not report.equations[name].applies
        assert report.equations[name].value == entry["computed"]["M_eqn3"]
    assert report.mobility == entry["computed"]["numeric_random"][0] == numeric_mobility(sc)


@pytest.mark.parametrize("name", ["ex_4_2_5_1", "ex_4_2_5_2"])
def test_relative_mobility(name, golden):
    """Misprint 003-2: 4.2.5.2 prints dM = 3 dV - 2 dE, which is -20; Eq. 7 gives the printed -1."""
    entry = golden["003"][name]
    given = entry["inputs"]
    if "dN" in given:
        change = relative_spherical_system(given["dN"], given["dJ"])
    else:
        change = relative_polyhedron(given["dV"], 0, given["dE_ext"] + given["dE_int"])
        assert 3 * given["dV"] - 2 * (given["dE_ext"] + given["dE_int"]) == entry["computed"]["as_printed_value"]
    assert change == entry["computed"]["dM"]


def test_relative_mobility_of_ride_alongs_creases_and_centres(golden):
    """Misprint 003-3: 4.2.4.3 lacks parentheses, dM = 3(n + m - 5) - (3n + 3m - 15) = 0."""
    entry = golden["003"]["ride_along_vertex_edge"]
    for (n, m), dv, de in zip(
        entry["inputs"]["n_m"], entry["computed"]["dV"], entry["computed"]["dE"], strict=True
    ):
        assert (dv, de) == (n + m - 5, 3 * n + 3 * m - 15)
        assert relative_polyhedron(dv, 0, de) == 0
    entry = golden["003"]["crease"]["computed"]
    assert [relative_polyhedron(dv, 0, de) for dv, de in zip(entry["dV"], entry["dE"], strict=True)] == entry["dM"]
    entry = golden["003"]["implicit_centre"]
    for n, mobility in zip(entry["inputs"]["n"], entry["computed"]["formula"], strict=True):
        assert relative_polyhedron(n - 1, 1, 3 * n) == entry["printed"]["dM"]
        assert polyhedron_equation(2 * n, 1, 5 * n) == mobility
    assert relative_spherical_system(-1, -1) == golden["003"]["lock"]["printed"]["dM"]


def test_miura_meshes_are_overconstrained(golden):
    """6.1.2: the count is 1 - (i - 2)(j - 2); a folded mesh has 1."""
    for size, values in golden["003"]["miura_h"]["computed"].items():
        i, j = map(int, size.split("x"))
        count = spherical_system(i * j, 2 * i * j - i - j)
        assert count == values["generic_formula"]
        assert overconstraint(values["miura_numeric"], count) == values["h_geom"]
    assert isinstance(to_polyhedron(read(DATA / "patterns" / "miura-3x3.fold")), PolyhedronModel)
