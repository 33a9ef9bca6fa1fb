"""The mark of special geometry: it survives files and new names, and the type stays the same."""

import json

import pytest

import synth
from graphs.errors import FileError, InvariantError
from graphs.identity.chains import class_code
from graphs.identity.drawings import map_id, mechanism_from_map_id
from graphs.mechanism.sc import SpecialGeometry
from graphs.mechanism.solids import HingedSolids

MIURA = "m1:a--b.acd-.b-ef.cfgh.di--.e--j.gj-k.hl-i.k--l"
MARK = SpecialGeometry(1, ["flat-foldable", "lines straight"])


def marked():
    return mechanism_from_map_id(MIURA).marked(MARK)


def test_files_keep_the_mark(tmp_path):
    scd = marked()
    ring = synth.generate("bennett").mechanism
    linkage = HingedSolids(ring.chain.marked(MARK), ring.axes)
    for name, mechanism in (("scd", scd), ("sc", scd.sc_graph()), ("solids", linkage)):
        synth.write(mechanism, tmp_path / f"{name}.json")
        back = synth.read(tmp_path / f"{name}.json")
        assert getattr(back, "chain", back).special == MARK, name


def test_ids_and_answers_do_not_depend_on_it():
    plain, scd = mechanism_from_map_id(MIURA), marked()
    assert plain.special is None
    assert map_id(scd) == map_id(plain) == MIURA
    assert class_code(scd) == class_code(plain)
    assert scd.is_identical(plain)
    assert synth.mobility(scd).to_json() == synth.mobility(plain).to_json()


def test_other_names_keep_it_and_other_loops_do_not():
    scd = marked()
    assert scd.relabel({0: "first"}).special == scd.sc_graph().relabel({0: "first"}).special == MARK
    assert scd.with_loops(scd.loops).special is None


def test_it_is_shown():
    assert "1 freedom by special geometry: flat-foldable, lines straight" in repr(marked())


@pytest.mark.parametrize(("freedoms", "conditions"), [(0, ["a"]), (1, []), (1, [""])])
def test_a_mark_says_something(freedoms, conditions, tmp_path):
    with pytest.raises(InvariantError):
        SpecialGeometry(freedoms, conditions)
    synth.write(marked(), tmp_path / "good.json")
    document = json.loads((tmp_path / "good.json").read_text())
    document["special"] = {"freedoms": freedoms, "conditions": conditions}
    (tmp_path / "bad.json").write_text(json.dumps(document))
    with pytest.raises(FileError):
        synth.read(tmp_path / "bad.json")
