"""What a template can be asked of: R/- strings in each mode, ids, rows of stores and lists."""

import json
from dataclasses import replace

import pytest
from commands import run
from measured import lines_of_svg
from read_strings import string_of_chain

from enumerate.strings.panel_strings import ChainString, strings
from graphs.convert.conversions import to_scd
from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read
from graphs.mechanism.surfaces import Cylinder
from synth.making.templates.on_surface import template_on_surface
from synth.making.templates.template import linkage_on_a_surface, panels_of_mechanism, template_of

FOUR_BAR = "m1:a-b.ac-.b-d.cd-"
LISTED = [(chain, mode) for creases in range(1, 7) for chain in strings(creases) for mode in chain.modes()]


@pytest.mark.parametrize("every", [5, pytest.param(1, marks=pytest.mark.slow)])
def test_each_string_of_table_8_prints_in_each_mode_and_is_read_back_as_it(every):
    assert len({chain for chain, _ in LISTED}) == 20
    assert len(LISTED) == 30
    for chain, mode in LISTED[::every]:
        sheet, told = panels_of_mechanism(chain, mode=mode)
        assert told
        again = string_of_chain(to_scd(sheet))
        assert again in ((chain, mode), (chain.reverse, mode[::-1]))
        (piece,) = template_of(sheet, size=150).pieces
        assert sum(stroke.kind != "CUT" for stroke in piece.strokes) == chain.creases
        assert piece.covered.area == pytest.approx(template_of(sheet, size=75).pieces[0].covered.area * 4)


@pytest.mark.parametrize("mode", ["S", "D"])
def test_a_string_is_printed_in_the_mode_that_is_asked_for(mode, tmp_path):
    run("template", "RR-R-RRR", "--mode", mode, "--size", 150, "-o", tmp_path / "a.svg")
    found = string_of_chain(to_scd(read(tmp_path / "a.svg")))
    assert found in ((ChainString((2, 1, 3)), mode), (ChainString((3, 1, 2)), mode))


def test_a_row_of_a_list_prints_as_what_it_is_a_row_of(tmp_path):
    rows = tmp_path / "types.jsonl"
    rows.write_text("".join(json.dumps(row) + "\n" for row in ({"code": FOUR_BAR}, {"string": "RR-RRR", "mode": "D"})))
    run("template", rows, "--row", 1, "--size", 150, "-o", tmp_path / "first.svg")
    run("template", FOUR_BAR, "--size", 150, "-o", tmp_path / "id.svg")
    first, by_id = (lines_of_svg(tmp_path / f"{name}.svg")[0] for name in ("first", "id"))
    for kind in first.keys() & by_id.keys():
        assert (first[kind] == by_id[kind]).all()
    run("template", rows, "--row", 2, "--size", 150, "-o", tmp_path / "second.svg")
    assert string_of_chain(to_scd(read(tmp_path / "second.svg")))[1] == "D"


def test_which_one_of_many_has_to_be_said_and_be_there(tmp_path):
    rows = tmp_path / "types.jsonl"
    rows.write_text(json.dumps({"code": FOUR_BAR}) + "\n")
    place = tmp_path / "a.svg"
    assert "requires --row N" in run("template", rows, "-o", place, code=2).stderr
    assert "a number up to 1" in run("template", rows, "--row", 2, "-o", place, code=2).stderr
    assert "--row requires a store" in run("template", FOUR_BAR, "--row", 1, "-o", place, code=2).stderr
    assert not place.exists()


def test_modes_and_ways_to_realise_are_of_types(data):
    bird = read(data / "patterns" / "bird-base.fold")
    with pytest.raises(UnsolvableError, match="requires a type, and the mechanism has coordinates"):
        panels_of_mechanism(bird, kind="space")
    with pytest.raises(InvariantError, match=r"the mode 'S' for <SCDGraph: 4 links.*expected an R/- string"):
        panels_of_mechanism(read(FOUR_BAR), mode="S")
    with pytest.raises(InvariantError, match="expected 1 letter S or D"):
        panels_of_mechanism(ChainString((2, 2)), mode="X")
    standing, _ = panels_of_mechanism(ChainString((2, 2)), kind="space")
    kinds = {stroke.kind for stroke in template_of(standing, size=150).pieces[0].strokes}
    assert kinds == {"CUT", "MOUNTAIN", "VALLEY"}


def test_a_type_gets_a_size(tmp_path):
    done = run("template", "RR-R-RRR", "-o", tmp_path / "ups.svg")
    assert "its longer side is 150 mm; --size changes it" in done.stderr
    assert (tmp_path / "ups.svg").is_file()


def test_a_template_names_the_configuration_of_what_it_is_made_of(data, tmp_path):
    file, made = data / "surfaces" / "fig11-stephenson.json", tmp_path / "a.dxf"
    told = json.loads(run("template", file, "-o", made, "--json").stdout)
    assert (told["configuration"]["links"], told["configuration"]["loops"]) == (6, 2)
    assert (told["pieces"], told["output"]) == (7, [str(made)])
    on_any_cone = replace(linkage_on_a_surface(read(file)), surface=None)
    assert template_on_surface(on_any_cone, Cylinder(50.0)).to_json()["configuration"] is None
