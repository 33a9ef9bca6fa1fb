"""SCD graphs of one mechanism where there are none with so few sides, and the least number of sides that has any."""

import pytest
from commands import run

from enumerate.runner._run import total_of
from enumerate.scd.jobs import least_max_degree, mechanism_of, scd_count_job
from graphs.errors import UnsolvableError
from graphs.files.formats import read


@pytest.mark.parametrize(
    ("name", "least"),
    [("watt", 3), ("eight-bar", 4), ("stephenson", 5), ("watt-planar", 6), ("sarrus", None), ("six-bar-loop-spatial", None)],
)  # fmt: skip
def test_the_least_number_of_sides_is_where_lists_begin(name, least, data):
    mechanism = read(data / "wiener" / f"{name}.json")
    assert least_max_degree(mechanism_of(mechanism, 3)) == least
    has = [total_of(scd_count_job(mechanism_of(mechanism, most))) > 0 for most in range(3, 12)]
    assert has == [least is not None and most >= least for most in range(3, 12)]


def test_the_command_says_which_number_of_sides_has_any(data):
    said = "no SCD graph of it has links of up to 4 sides; --max-degree 5 is the least that has any\n"
    for more in ((), ("--count",), ("--json",)):
        assert run("enumerate", "scd", "--of", data / "wiener" / "stephenson.json", *more).stderr == said
    none = run("enumerate", "scd", "--of", data / "wiener" / "sarrus.json").stderr
    assert none == "no SCD graph of it has links of up to 4 sides; nor has any with more sides\n"
    more = run("enumerate", "scd", "--of", data / "wiener" / "watt.json", "--vertices", "40..").stderr
    assert more.endswith("and meets the options; try a larger --max-degree\n")
    with pytest.raises(UnsolvableError, match="cannot count by vertices"):
        least_max_degree(mechanism_of(read(data / "wiener" / "watt.json"), 3, vertices=40))


def test_centres_that_are_assumed_are_said():
    assert "is assumed to have a finite one" in run("enumerate", "scd", "--of", "k1:Cr").stderr
    assert run("enumerate", "scd", "--of", "m1:ab.ac.bd.cd").stderr == ""
