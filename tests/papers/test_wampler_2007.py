"""Wampler, Larson, Erdman 2007: Eqs. 1, 2 and 5 to 10, and the figures."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from graphs.answer.mobility import counts_and_ranks
from graphs.count.equations import spherical_system, traditional_cgk, wampler_points, wampler_rods
from graphs.count.report import mobility_report
from graphs.files.formats import read
from graphs.mechanism.polyhedron import PolyhedronModel
from synth.analysis.verdict._mobility import mobility as judged

DATA = Path(__file__).resolve().parents[2] / "data" / "wampler"


def model(name: str) -> PolyhedronModel:
    thing = read(DATA / f"{name}.json")
    assert isinstance(thing, PolyhedronModel)
    return thing


def rod_mobility(rods: PolyhedronModel) -> int:
    """Second method: 3V - 6 less the rank of the rigidity matrix at random places."""
    place = dict(zip(rods, np.random.default_rng(5).normal(size=(len(rods), 3)), strict=True))
    column = {vertex: 3 * i for i, vertex in enumerate(rods)}
    matrix = np.zeros((rods.number_of_edges(), 3 * len(rods)))
    for row, (a, b) in zip(matrix, rods.edges, strict=True):
        row[column[a] : column[a] + 3] = place[a] - place[b]
        row[column[b] : column[b] + 3] = place[b] - place[a]
    return 3 * len(rods) - 6 - int(np.linalg.matrix_rank(matrix))


@pytest.mark.parametrize(
    ("name", "entry"),
    [
        ("fig6", "fig6"), ("fig7", "fig7"), ("fig8", "fig8"), ("fig9", "fig9"),
        ("fig9-diagonal", "fig9_diagonal"), ("fig10", "fig10"),
    ],
)  # fmt: skip
def test_figures_of_rods(name, entry, golden):
    values = golden["004"][entry]
    rods = model(name)
    assert {frozenset(rod) for rod in rods.edges} == {frozenset(rod) for rod in values["inputs"]["edges"]}
    report = mobility_report(rods)
    computed = values["computed"]
    assert (report.counts["vertices"], report.counts["edges"]) == (computed["V"], computed["E"])
    assert report.mobility == computed["M"] == rod_mobility(rods)
    applying = {key: one.value for key, one in report.equations.items() if one.applies}
    assert applying == {f"wampler_eq{n}": computed["M"] for n in (5, 6, 7, 8, 9)}
    assert report.equations["wampler_eq10"].value is None


def test_rigid_bodies(golden):
    """Misprint 004-3: the text points to Fig. 1 for Figs. 2 to 5. Two vertices: the spin about the rod is not counted."""
    values = golden["004"]["rigid_bodies"]
    for v, e, dof in zip(values["inputs"]["V"], values["computed"]["E"], values["computed"]["dof"], strict=True):
        body = model(f"fig{v}")
        assert body.number_of_edges() == e
        assert mobility_report(body).mobility == dof - 6


def test_fig_1(golden):
    """The count is 1 by Eq. 2 and by Eq. 5; that a folded branch has 2 (004-2) is no matter of counting."""
    values = golden["004"]["fig1"]
    rods = model("fig1")
    assert (len(rods), rods.number_of_edges()) == (values["inputs"]["V"], values["inputs"]["E"])
    assert wampler_rods(len(rods), rods.number_of_edges()) == values["computed"]["eq5"]
    assert spherical_system(values["inputs"]["N"], values["inputs"]["J"]) == values["computed"]["eq2"]
    assert rod_mobility(rods) == values["printed"]["open"]


def test_eq_1_on_fig_10_and_the_crr_platform(golden):
    """Eq. 1 fails on both: Fig. 10 has 2 freedoms, Tsai's platform 3."""
    assert traditional_cgk(8, [1] * 8 + [3], 6) == golden["004"]["fig10"]["computed"]["M_eq1"]
    assert traditional_cgk(8, [2] * 3 + [1] * 6, 6) == golden["004"]["tsai_3crr"]["computed"]["eq1"]
    assert traditional_cgk(2, [3], 6) == golden["004"]["fig6"]["computed"]["M"]


def test_eqs_1_and_2_on_loops(golden):
    computed = golden["004"]["eq1_eq2"]["computed"]
    for n, spherical, spatial in zip(range(4, 9), computed["spherical"], computed["spatial"], strict=True):
        assert spherical_system(n, n) == spherical
        assert traditional_cgk(n, [1] * n, 6) == spatial


def test_joint_costs_of_eq_6(golden):
    computed = golden["004"]["eq6_joint_costs"]["computed"]
    base = wampler_points(8, 12, 0, 0)
    assert base - wampler_points(8, 12, 0, 2) == computed["C"]
    assert base - wampler_points(8, 12, 3, 0) == computed["plane"]
    assert base - wampler_points(8, 12, 1, 2) == computed["prismatic"]
    assert wampler_rods(8, 12) - wampler_rods(8 - 2, 12 - 1) == computed["R_as_two_shared_vertices"]


def test_fig_12_remote_centre(golden):
    """004-5: the count is right; a rank of the rods is not, as the four points of each link are coplanar."""
    values = golden["004"]["fig12_remote"]
    closed, chain = mobility_report(model("fig12")), mobility_report(model("fig12-open"))
    computed = values["computed"]
    assert closed.mobility == closed.equations["wampler_eq7"].value == computed["M"]
    assert closed.equations["wampler_eq5"].value == computed["M_without_S3"]
    assert not closed.equations["wampler_eq5"].applies
    assert "leaves out remote centres" in closed.equations["wampler_eq5"].why
    assert (chain.counts["vertices"], chain.counts["edges"], chain.mobility) == tuple(
        computed["open_chain"][key] for key in "VEM"
    )
    assert closed.mobility - chain.mobility == computed["dM_true"]
    assert closed.equations["wampler_eq5"].value - chain.mobility == computed["dM_apparent"]
    assert mobility_report(read(DATA / "fig12-scd.json")).mobility == computed["M"]


@pytest.mark.parametrize("k", [1, 3, 4])
def test_s_k_is_what_the_rods_miscount(k, golden):
    entry = golden["004"]["fig12_remote" if k == 3 else f"S{k}"]["printed"]
    remote = PolyhedronModel(4, centres=[type(model("fig12").centres[0])(k)])
    report = mobility_report(remote)
    assert report.mobility - report.equations["wampler_eq6"].value == entry["dM_true"] - entry["dM_apparent"] == k
    assert report.equations["wampler_eq7"].applies == (k == 3)
    assert report.equations["wampler_eq8"].applies


def test_scissors(golden):
    """004-6: one S_{+4} an independent loop."""
    values = golden["004"]["scissors_spherical_loops"]
    for n, name in ((4, "spherical-scissors"), (5, "spherical-scissors-5"), (6, "spherical-scissors-6")):
        report = mobility_report(model(name))
        assert report.mobility == values["computed"][f"n={n}"]["eq9"] == values["computed"][f"n={n}"]["numeric"]
        assert [key for key, one in report.equations.items() if one.applies] == ["wampler_eq9"]
    before = values["printed"]["before"]
    assert wampler_rods(before["V"], before["E"]) == before["M"]
    element = PolyhedronModel(4, scissors=[(0, 1, 2, 3)])
    assert mobility_report(element).mobility + 6 == golden["004"]["scissors_element"]["printed"]["true_dof"]
    generic = counts_and_ranks(model("spherical-scissors")).exact.mobility
    assert generic == golden["004"]["scissors_planar"]["computed"]["numeric"]


def test_a_stretched_four_bar_is_rigid_and_shaky(golden):
    """The text before Eq. 3: an isolated real point with two freedoms to first order."""
    lengths = golden["004"]["degenerate_fourbar"]["inputs"]["lengths"]
    assert 2 * max(lengths) == pytest.approx(sum(lengths))
    linkage = read(DATA.parent / "joints" / "stretched-four-bar.json")
    places = np.array([point for point, _ in linkage.axes.values()])
    apart = np.linalg.norm(places - np.roll(places, -1, axis=0), axis=1)
    assert sorted(apart) == pytest.approx(sorted(lengths))
    assert (
        counts_and_ranks(linkage).infinitesimal.dof
        == golden["004"]["degenerate_fourbar"]["computed"]["infinitesimal_dof"]
    )
    verdict = judged(linkage).verdict
    assert (verdict.freedoms, verdict.certainty) == (0, "proved")


def test_crs_platform_leaves_ground_out(golden):
    values = golden["004"]["crs3"]
    report = mobility_report(model("crs-platform"))
    assert report.mobility == report.equations["wampler_eq10"].value == values["computed"]["M"]
    assert not report.equations["wampler_eq9"].applies


def test_collapsible_polyhedra(golden):
    """The general count; the perfect cube has two flexes more, not one (004-1), which no count can tell."""
    cube, free = golden["004"]["cube_locked"], golden["004"]["cube_unlocked"]
    assert mobility_report(model("cube-locked")).mobility == cube["computed"]["M"] == rod_mobility(model("cube-locked"))
    assert mobility_report(model("cube-unlocked")).mobility == free["computed"]["eq9_with_5_independent_S4"]
    locked = golden["004"]["tetra_locked"]["computed"]
    assert mobility_report(model("tetrahedron-locked")).mobility == locked["M"]
    assert rod_mobility(model("tetrahedron-locked")) == locked["numeric_general_bar_rank"][0]


def test_two_centres(golden):
    report = mobility_report(read(DATA / "two-centres.json"))
    assert (report.centres, report.mobility) == (2, golden["004"]["eq2_two_centres"]["computed"]["M"])
