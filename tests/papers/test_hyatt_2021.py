"""Hyatt et al. 2021 (mapping methods, cylinders): the type of its linkages."""

from pathlib import Path

from graphs.analogues import planar_analogue
from graphs.files.formats import read
from graphs.report import mobility_report

DATA = Path(__file__).resolve().parents[2] / "data" / "hyatt"


def test_four_bars_on_cylinders_are_planar_four_bars(golden):
    """Parallel axes: the planar analogue of the four-bar on a cone."""
    assert "table1_eq1_3" in golden["001"]
    planar = read(DATA / "planar-four-bar.json")
    report = mobility_report(planar)
    assert (report.mechanism_class, report.mobility, report.centres) == ("planar", 1, 1)
    cone = planar_analogue(read(DATA / "spherical-four-bar.json"))
    assert mobility_report(cone).to_json("") == report.to_json("")
