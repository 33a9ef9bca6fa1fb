"""Tipparthi and Larochelle 2011 (hoop method): the type of its linkage."""

from pathlib import Path

from graphs.files.formats import read
from graphs.reduction import reduce_addenda
from graphs.report import mobility_report

DATA = Path(__file__).resolve().parents[2] / "data" / "tipparthi"


def test_two_rr_dyads_make_a_spherical_four_bar(golden):
    """Each dyad has one freedom beside the coupler's three; taken off as a dyad it leaves the mobility."""
    assert "hoop_case1" in golden["002"]
    sc = read(DATA / "spherical-4r.json")
    report = mobility_report(sc)
    assert (report.mechanism_class, report.mobility, sc.ground) == ("spherical", 1, 0)
    assert not reduce_addenda(sc).steps
    assert not reduce_addenda(sc, keep=[2]).steps
