"""`synth realise`."""

import json

import pytest

from graphs.files.formats import read
from tests.support.commands import run

FOUR_BAR = "m1:a-b.ac-.b-d.cd-"


def test_a_type_is_written_and_read_back(tmp_path):
    place = tmp_path / "four-bar.fold"
    told = run("realise", FOUR_BAR, "--tries", "1", "-o", place).output
    assert "flat sheet of an SCD graph" in told
    assert "written: " in told
    assert len(read(place).faces) == 4
    assert FOUR_BAR in run("id", place).output


def test_json_in_space():
    found = json.loads(run("realise", FOUR_BAR, "--as", "space", "--tries", "1", "--json").output)
    assert found["drawing"] == FOUR_BAR
    assert found["freedoms"] == found["mobility"] == 1


def test_a_list_is_realised_into_a_folder(tmp_path):
    source = tmp_path / "types.jsonl"
    source.write_text(json.dumps({"code": FOUR_BAR}) + "\n")
    words = ("realise", source, "--as", "space", "--tries", "1", "-o", tmp_path / "things")
    assert "1 type: 1 realised, 0 not found, 0 refused" in run(*words).output
    assert FOUR_BAR in run("id", tmp_path / "things" / "0000001.fold").output
    assert "folders are not replaced" in run(*words, code=2).output
    found = json.loads(run(*words, "--resume", "--json").output)
    assert (found["realised"], found["types"][0]["code"]) == (1, FOUR_BAR)


@pytest.mark.parametrize(
    ("words", "told"), [((), "many types require -o FOLDER"), (("-o", "things.fold"), "a folder or a store")]
)
def test_many_types_need_a_folder_or_a_store(words, told, tmp_path):
    assert told in run("realise", tmp_path, *words, code=2).output


@pytest.mark.parametrize(("words", "told"), [(("m1:a.a",), "no drawing"), (("m1:ab",), "joint")])
def test_bad_input_is_one_line(words, told):
    output = run("realise", *words, code=2).output
    assert told in output
    assert output.count("\n") == 1


def test_on_a_cone_what_is_written_is_a_file_for_synth_cone(data, tmp_path):
    place, chain = tmp_path / "stephenson.json", data / "wiener" / "stephenson.json"
    told = run("realise", chain, "--as", "cone", "--lambda", "25", "-o", place).output
    assert "cones with these arcs: 1, this one included" in told
    for more in ((), ("--by-angles",)):
        (cone,) = json.loads(run("cone", "map", place, *more, "--json").output)["cones"]
        assert cone["lambda_deg"] == pytest.approx(25.0)
    assert json.loads(run("realise", chain, "--as", "cone", "--json").output)["lambda_deg"] == pytest.approx(30.0)


def test_what_is_no_linkage_on_a_cone_is_refused_in_one_line(data, tmp_path):
    for words, told in (
        ((data / "wiener" / "hybrid-ten-bar.json",), "1 loop without a centre"),
        ((data / "wiener" / "watt.json",), "2 centres"),
        (("k1:Cr", "--lambda", "nan"), "lambda is nan degrees"),
        (("k1:Cr", "-o", tmp_path / "cone.fold"), ".json"),
    ):
        output = run("realise", *words, "--as", "cone", code=2).output
        assert told in output
        assert output.count("\n") == 1
    assert "--size" in run("realise", "k1:Cr", "--as", "cone", "--size", "2", code=2).output
    assert "--lambda" in run("realise", FOUR_BAR, "--lambda", "20", code=2).output


def test_a_string_becomes_a_strip_of_panels(tmp_path):
    told = run("realise", "RR-R-RRR", "-o", tmp_path / "ups.fold").output
    assert "joints UPS" in told
    assert "6 infinitesimal degrees of freedom" in told
    assert len(read(tmp_path / "ups.fold").faces) == 7
    for words, why in ((("RR--R",), "without a crease"), (("RR-R", "--as", "cone"), "has no loop")):
        output = run("realise", *words, code=2).output
        assert why in output
        assert output.count("\n") == 1


def test_flat_foldable_and_symmetric_sheets_are_told(data):
    ridden = data / "wiener" / "ride-along.json"
    found = json.loads(run("realise", ridden, "--flat-foldable", "--symmetric", "--tries", "2", "--json").output)
    assert found["off_flat_folding"] < 1e-12
    assert found["off_symmetry"] < 1e-12
    assert "mirror" in found["symmetry"]
    for words, told in (
        ((data / "wiener" / "creased-four-bar.json", "--flat-foldable"), "5 creases, an odd number"),
        ((data / "wiener" / "six-bar.json", "--symmetric"), "no symmetry"),
        (("RR-R", "--symmetric"), "an R/- string"),
    ):
        output = run("realise", *words, code=2).output
        assert told in output
        assert output.count("\n") == 1
    assert "--as sheet" in run("realise", ridden, "--as", "space", "--symmetric", code=2).output


@pytest.mark.parametrize(
    "words",
    [("m1:a-b.ac-.bde.cef.d-g.fg-", "--symmetric"), (FOUR_BAR, "--as", "space"), ("k1:Cr", "--as", "cone"), ("RR-R",)],
)
def test_a_seed_gives_equal_files(words, tmp_path):
    ending = "json" if "cone" in words else "fold"
    files = []
    for number, seed in enumerate((7, 7, 8)):
        files.append(tmp_path / f"{number}.{ending}")
        run("realise", *words, "--tries", "1", "--seed", seed, "-o", files[-1])
    one, again, other = (file.read_bytes() for file in files)
    assert one == again != other


def test_what_no_sheet_can_be_is_refused_in_one_line():
    for words, told in ((("k1:E]ow",), "not planar"),):
        output = run("realise", *words, code=2).output
        assert told in output
        assert output.count("\n") == 1
