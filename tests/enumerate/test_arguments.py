"""Unknown and missing keywords of the functions that list and count: one line, with the name of the function."""

import pytest

import synth

COUNTED = ("chains", "sc_graphs", "scd_graphs", "strings", "conical_candidates")


@pytest.mark.parametrize("name", [*COUNTED, *(f"count_{name}" for name in COUNTED), "addenda"])
def test_an_unknown_keyword_is_refused_by_name(name):
    with pytest.raises(synth.SynthedraError) as refused:
        getattr(synth, name)(worker=2)
    assert isinstance(refused.value, TypeError)
    assert str(refused.value).startswith(f"{name}: there is no option 'worker'; expected one of ")
    if name not in ("strings", "count_strings"):  # these have no workers
        assert str(refused.value).endswith("; the nearest is 'workers'")


@pytest.mark.parametrize(
    ("name", "options", "text"),
    [
        (
            "strings",
            {"dof": 4},
            "strings: there is no option 'dof'; expected one of 'creases', 'max_panels', 'max_cluster'",
        ),
        ("chains", {"links": 6, "dof": 1, "inversion": True}, "the nearest is 'inversions'"),
        ("scd_graphs", {"links": 4, "sheet": True}, "the nearest is 'sheets'"),
        ("chains", {"links": 6}, "chains: missing a required argument: 'dof'; expected links, dof, workers, "),
        ("scd_graphs", {}, "scd_graphs: neither links nor of; expected one of them"),
        ("count_scd_graphs", {"links": 4, "of": "k1:Cr"}, "count_scd_graphs: both links and of; expected one"),
        ("scd_graphs", {"of": "k1:Cr", "dof": 1, "spatial": 1}, "scd_graphs: dof, spatial with of; expected"),
        ("scd_graphs", {"of": 3}, "scd_graphs: 3; expected a mechanism"),
    ],
)
def test_what_is_refused(name, options, text):
    with pytest.raises(synth.SynthedraError) as refused:
        getattr(synth, name)(**options)
    assert text in str(refused.value)


def test_scd_graphs_of_a_mechanism_as_the_command_lists_them(data):
    watt = data / "wiener" / "watt.json"
    codes = [scd.graph["code"] for scd in synth.scd_graphs(of=watt)]
    assert len(codes) == synth.count_scd_graphs(of=synth.read(watt), method="orbits") > 0
    assert len(set(codes)) == len(codes)
    assert len(list(synth.scd_graphs(of=watt, sheets=True))) < len(codes)
