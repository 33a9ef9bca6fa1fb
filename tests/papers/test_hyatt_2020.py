"""Hyatt, Magleby, Howell 2020 (linkages on right cones): the types of its linkages."""

from pathlib import Path

from graphs.files.formats import read
from graphs.report import mobility_report

DATA = Path(__file__).resolve().parents[2] / "data" / "hyatt"


def test_four_bars_on_cones_are_spherical_four_bars(golden):
    """Fig. 10: four sets of link angles, one type. Angles and cones are no part of a type."""
    assert all(f"fig10{case}_T" in golden["000"] for case in "abcd")
    report = mobility_report(read(DATA / "spherical-four-bar.json"))
    assert (report.mechanism_class, report.mobility) == ("spherical", 1)
    assert report.equations["traditional_cgk"].applies


def test_fig_11_is_a_stephenson_chain(golden):
    """000-8: six steps are an open spanning chain through the seven axes; one more closes it."""
    sc = read(DATA / "fig11-stephenson.json")
    steps = golden["000"]["fig11_stephenson2"]["printed"]["projected"]
    assert len(steps) + 1 == len(sc.joints)
    assert len(sc.centre_classes()) == 1
    assert mobility_report(sc).mobility == 1
