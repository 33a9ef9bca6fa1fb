"""A mechanism at a configuration is made once, whoever asks of it."""

from collections import Counter

import numpy as np
import pytest
from sizes import slow

import synth
from graphs.convert import duality
from graphs.errors import UnsolvableError
from graphs.files.formats import read
from graphs.mechanism.sheet import Sheet
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.motion import linkage
from synth.analysis.motion.configuration import Configuration
from synth.analysis.motion.driven_motion import BranchChoice, beginning
from synth.analysis.moving._configuration_of import configuration_of
from synth.catalogue.patterns import generate
from synth.making.viewer.page_data import shown_of


@pytest.fixture
def counted(monkeypatch):
    """Count how often mechanisms of sheets and linkages are made, under whatever name they are called."""
    import sys

    made = Counter()
    for module, name in [(duality, "mechanism_of_sheet"), (linkage, "_linkage")]:
        function = getattr(module, name)

        def count(*given, _name=name, _function=function, **more):
            made[_name] += 1
            return _function(*given, **more)

        for other in list(sys.modules.values()):
            if getattr(other, name, None) is function:
                monkeypatch.setattr(other, name, count)
    return made


@pytest.mark.parametrize("name", [slow("bird-base.fold"), "four-bar-vertex.fold"])
@pytest.mark.parametrize("ask", [synth.mobility, synth.fold, shown_of, synth.explain], ids=lambda ask: ask.__name__)
def test_one_question_makes_the_linkage_once(data, name, ask, counted):
    sheet = read(data / "patterns" / name)
    counted.clear()
    ask(sheet)
    layers = name == "bird-base.fold" and ask in (synth.mobility, shown_of)  # of the sheet as drawn, not as mended
    assert counted == {"mechanism_of_sheet": 1 + layers, "_linkage": 1}


def test_a_configuration_is_asked_again_and_again_without_being_made(data, counted):
    at = configuration_of(read(data / "patterns" / "four-bar-vertex.fold"))
    counted.clear()
    answers = [synth.mobility(at), synth.move(at, frames=1), synth.explain(at)]
    assert counted == {}
    assert all(answer.configuration is at for answer in answers)
    synth.draw(at)  # its caption has the fold angles of the sheet that is shown
    assert counted == {"mechanism_of_sheet": 1, "_linkage": 1}


def test_of_a_frame_the_linkage_is_that_of_the_frame(data):
    sheet = read(data / "patterns" / "four-bar-vertex.fold")
    moved = synth.fold(sheet, frames=2)
    again = configuration_of_sheet(moved.frames()[1])
    np.testing.assert_allclose(again.linkage.angles, moved.path.angles[1], atol=1e-9)


def test_solids_know_their_precision_and_no_sides():
    at = configuration_of(generate("bennett").mechanism)
    assert type(at) is Configuration
    assert (at.flat, at.limited, at.mended) == (False, False, ())
    assert not at.marks.any()
    with pytest.raises(UnsolvableError, match="panels of a sheet"):
        synth.move(generate("bennett").mechanism, frames=1, collisions=True)


def test_the_branch_that_is_taken_begins_as_the_sheet_is_assigned(data):
    """`mobility` speaks of the branch that `fold` takes, where one begins with all marks."""
    at = configuration_of(generate("miura", rows=3, columns=3).mechanism)
    assert at.marked.marked == "has"
    assert synth.mobility(at).verdict.freedoms == synth.move(at, frames=1).freedoms == 1
    plain = Sheet(
        at.drawn.vertices,
        at.drawn.edges,
        at.drawn.assignments.replace("M", "U").replace("V", "U"),
        at.drawn.faces,
        at.drawn.coordinates,
    )
    assert configuration_of(plain).marked.number is None


@pytest.mark.parametrize("every", [4, slow(1)])
def test_a_motion_begins_as_the_sheet_is_assigned_where_one_can(every):
    """Rates nearest to the assignment may miss it where others of the branch have it: those are taken."""
    creases = [(0, k) for k in range(1, 6)]
    around = [(np.cos(t), np.sin(t)) for t in np.radians([0, 30, 75, 160, 265])]
    faces = tuple((0, 1 + k, 1 + (k + 1) % 5) for k in range(5))
    begun = 0
    for letters in range(0, 32, every):
        word = "".join("MV"[letters >> k & 1] for k in range(5))
        at = configuration_of(Sheet(6, tuple(creases), word, faces, ((0.0, 0.0), *around)))
        if at.marked.marked == "has":
            begun += 1
            _, rates = beginning(at, BranchChoice())
            assert (rates * at.marks).min() > 0.0
    assert begun
