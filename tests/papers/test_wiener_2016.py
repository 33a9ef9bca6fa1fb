"""Wiener 2016 (MS thesis): Tables 1, 2, 3 and 6, section 4.1.4, Eqs. 1 to 8."""

from __future__ import annotations

from pathlib import Path

import pytest
from counted import counted_numbers
from oracle import numeric_mobility
from read_strings import string_of_chain

from enumerate.strings.panel_strings import ChainString, chain_scd, count_strings, joint_chain, strings
from graphs.convert.conversions import to_polyhedron
from graphs.count.equations import (
    modified_cgk,
    overconstraint,
    polyhedron_equation,
    relative_polyhedron,
    relative_spherical_system,
    spherical_system,
    traditional_cgk,
)
from graphs.count.report import mobility_report
from graphs.edit.edits import add_loop
from graphs.files.formats import read
from graphs.identity.chains import class_code
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.reduce.ride_alongs import reduce

DATA = Path(__file__).resolve().parents[2] / "data"
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
    """Printed and computed values, by the equation, by the model and by a rank.

    Misprint 003-4: the title of 4.1.4.4 says eight-bar; the fortune teller has 16 links.
    """
    entry = golden["003"][EXAMPLES[name]]
    scd = read(DATA / "wiener" / f"{name}.json")
    assert isinstance(scd, SCDGraph)
    found = counted_numbers(DATA / "wiener" / f"{name}.json")
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
        entry["inputs"]["n"], entry["computed"]["formula_spherical"], entry["computed"]["formula_spatial"], strict=True
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
    generic = golden["003"]["watt_stephenson"]["computed"]
    assert numeric_mobility(sc) == generic["M_eqn3"] == generic["watt_two_centres"][0]
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
    assert "1 of 2 loops spatial" in eq3.why


def test_concentric_loops(golden):
    """3.3.6: C-G-K says -3 and refuses; the closed-surface form says 0, as the rank does."""
    entry = golden["003"]["concentric"]
    sc = read(DATA / "wiener" / "concentric-loops.json")
    assert isinstance(sc, SCGraph)
    report = mobility_report(sc)
    assert report.mechanism_class == "closed"
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
    for (n, m), dv, de in zip(entry["inputs"]["n_m"], entry["computed"]["dV"], entry["computed"]["dE"], strict=True):
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
    assert isinstance(to_polyhedron(read(DATA / "wiener" / "miura-3x3.fold")), PolyhedronModel)


def test_4_2_5_1_a_spherical_chain(golden):
    """Six-bar with three freedoms, plus a chain of three links and four joints: four."""
    entry = golden["003"]["ex_4_2_5_1"]["printed"]
    six_bar = read(DATA / "wiener" / "six-bar-loop-spherical.json")
    assert mobility_report(six_bar).mobility == entry["M0"]
    edit = add_loop(six_bar, 0, 1, 3)
    assert (edit.predicted, edit.counted) == (entry["dM"], entry["dM"])
    assert edit.graph.is_identical(read(DATA / "wiener" / "six-bar-with-chain.json"))
    assert mobility_report(edit.graph).mobility == entry["M"]


def test_4_2_5_2_a_spatial_chain(golden):
    entry = golden["003"]["ex_4_2_5_2"]["computed"]
    six_bar = read(DATA / "wiener" / "six-bar-loop-spherical.json")
    edit = add_loop(six_bar, 0, 2, 4, centre="none", through=[0, 1])
    assert (edit.predicted, edit.counted) == (entry["dM"], entry["dM"])
    ten_bar = read(DATA / "wiener" / "hybrid-ten-bar.json")
    assert class_code(edit.graph) == class_code(ten_bar.sc_graph())
    assert mobility_report(ten_bar).mobility == entry["M"]


REDUCED = {
    "ride-along": ("ex_4_2_5_3", [None]),
    "adjunct-chain": ("ex_4_2_5_4", [1, 2, None]),
    "double-strip": ("ex_4_2_5_5", [1, 2, None]),
    "fortune-teller": ("ex_4_2_5_6", [None] * 4),
}


@pytest.mark.parametrize("name", REDUCED)
def test_4_2_5_3_to_6_reductions_step_by_step(name, golden):
    """Each step takes two links and three joints off and leaves the mobility; the end is the printed one."""
    entry, sits_on = REDUCED[name]
    printed = golden["003"][entry]["printed"]
    scd = read(DATA / "wiener" / f"{name}.json")
    reduction = reduce(scd)
    end = reduction.graph
    assert (len(end), len(end.joints), mobility_report(end).mobility) == (printed["N"], printed["J"], printed["M"])
    assert [step.sits_on for step in reduction.steps] == sits_on
    for number in range(len(sits_on) + 1):
        between = reduction.undo(number)
        assert len(between) == printed["N"] + 2 * number
        assert len(between.joints) == printed["J"] + 3 * number
        assert mobility_report(between).mobility == printed["M"]
        assert numeric_mobility(between) == printed["M"]
    assert reduction.undo().is_identical(scd)


def test_table_8(golden):
    """The 20 strings, their order, labels and distances; RRR-RRR has 5 freedoms, the table notes why."""
    printed = golden["003"]["table8"]["printed"]
    computed = iter(golden["003"]["table8"]["computed"]["rows"])
    total = 0
    for n in range(1, 7):
        listed = list(strings(n))
        assert [[c.text, c.mechanism, c.distance.capitalize()] for c in listed] == printed["rows"][str(n)]
        total += len(listed)
        for chain in listed:
            row = next(computed)
            assert (row["string"], row["n_modes"]) == (chain.text, len(chain.modes()))
            assert row["modes"] == chain.modes()
            assert row["joint_twist_rank"] == [chain.dof]
            scd = read(DATA / "wiener" / f"chain-{chain.mechanism}.json")
            assert string_of_chain(scd)[0] == chain
    assert total == printed["total"] == sum(count_strings(n) for n in range(1, 7))


def test_table_7(golden):
    for text, number in golden["003"]["table7"]["printed"].items():
        chain = ChainString.parse(text)
        assert len(chain.modes()) == chain.count_modes() == number


def test_ups_chains(golden):
    entry = golden["003"]["ups_chain"]
    for (n, m), v, e in zip(entry["inputs"]["n_m"], entry["computed"]["V"], entry["computed"]["E"], strict=True):
        scd = chain_scd(joint_chain("UPS"), ends=(n, m))
        assert (scd.counts.vertices, scd.counts.edges, mobility_report(scd).mobility) == (v, e, 6)
    assert joint_chain("UPS").dof == entry["computed"]["joint_twist_rank"]
    assert traditional_cgk(7, [1] * 6, 6) == entry["computed"]["cgk"]


def test_remote_centres_of_n_bars(golden):
    """4.2.3: an n-bar with an implicit centre has n - 3 freedoms, by count and by rank."""
    for n, mobility in zip(range(5, 9), golden["003"]["implicit_centre"]["computed"]["formula"][1:], strict=True):
        scd = read(DATA / "wiener" / f"remote-{n}-bar.json")
        assert mobility_report(scd).mobility == mobility == numeric_mobility(scd)


def test_creases_give_a_freedom_each(golden):
    """4.2.2. Misprint 003-5: four creases in one edge row of a 4 x 4 mesh give 2 freedoms, not 1; the count says 1."""
    assert mobility_report(read(DATA / "wiener" / "creased-four-bar.json")).mobility == 2
    claim = golden["003"]["crease_claim"]["computed"]
    inner = read(DATA / "wiener" / "mesh-4x4-inner-creases.json")
    edge = read(DATA / "wiener" / "mesh-4x4-edge-creases.json")
    assert mobility_report(inner).mobility == numeric_mobility(inner) == claim["interior_panels_5_6_9_10"][0]
    assert mobility_report(edge).mobility == 1
    assert numeric_mobility(edge) == claim["first_row_panels_0_1_2_3"][0]


def test_sarrus(golden):
    """003-8: Eq. 4 covers the general type, which has 0; that Sarrus' geometry moves is no matter of counting."""
    computed = golden["003"]["sarrus"]["computed"]
    scd = read(DATA / "wiener" / "sarrus.json")
    report = mobility_report(scd)
    assert report.equations["traditional_cgk"].value == computed["generic_cgk"]
    assert report.equations["polyhedron"].value == computed["generic_polyhedron"] == numeric_mobility(scd)
    assert overconstraint(computed["numeric_sarrus"], report.mobility) == 1
