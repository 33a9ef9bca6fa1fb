"""How answers about one configuration are compared; a sample of mechanisms, and all of them."""

import numpy as np
import pytest

from graphs.mechanism.precision import in_space
from synth.catalogue.patterns.creases import miura
from tests.agreement.comparison import Table, disagreements
from tests.agreement.running import comparisons
from tests.agreement.specimens import is_wanted, named_specimens, specimens
from tests.agreement.variants import VARIANTS, variants_of
from tests.agreement.verbs import DOORS, VERBS, Outcome

SAMPLE = {
    "data/patterns/four-bar-vertex.fold": VARIANTS,
    "frames/four-bar-vertex": ("frame",),
    "data/linkages/bennett.json": ("as it is",),
    "generate/miura-medium": ("4 decimals",),
    "generate/deployable-cylinder-small": ("as it is",),
}
"""Mechanisms and their guises: every verb and every guise is among them; files are asked about at both doors."""


def told(**changed):
    """What a verb says of a hinge."""
    says = {
        "links": 2, "joints": ["a"], "loops": 0, "precision": 1e-16, "precision_source": "double precision",
        "flat": True, "branches": {"number": 1, "exhaustive": True}, "branch": "+", "freedoms": 1,
        "immobile_joints": [], "other_question": None,
    }  # fmt: skip
    return Outcome("told", {**says, **changed})


def of(**outcomes):
    return {(verb, "python"): outcome for verb, outcome in outcomes.items()}


def keys(**outcomes):
    return [one.key for one in disagreements(of(**outcomes))]


@pytest.mark.parametrize(
    ("key", "other"),
    [("links", 3), ("joints", ["b"]), ("loops", 1), ("precision", 1e-5), ("flat", False), ("freedoms", 2),
     ("branches", {"number": 1, "exhaustive": False}), ("branch", "-"), ("immobile_joints", ["a"])],
)  # fmt: skip
def test_each_part_of_an_answer_is_compared(key, other):
    assert keys(mobility=told(), explain=told()) == []
    assert keys(mobility=told(), explain=told(**{key: other})) == [key]


def test_another_question_may_say_less_but_nothing_else():
    silent = dict.fromkeys(("branches", "branch", "freedoms", "immobile_joints"))
    assert keys(mobility=told(), limits=told(other_question="of ride-alongs", **silent)) == []
    assert keys(mobility=told(), limits=told(other_question="of ride-alongs", freedoms=2)) == ["freedoms"]
    assert keys(mobility=told(), limits=told(other_question="of ride-alongs", links=3, **silent)) == ["links"]
    assert keys(mobility=told(), limits=told(**silent)) == ["branches", "branch", "freedoms", "immobile_joints"]


def test_with_other_coordinates_only_the_type_is_the_same():
    other = {"joints": ["b"], "precision": 1e-5, "flat": False, "other_question": "of other coordinates"}
    assert keys(mobility=told(), realise=told(**other)) == []
    assert keys(mobility=told(), realise=told(**other, links=3, loops=1)) == ["links", "loops"]


def test_numbers_and_ids_are_the_same_however_they_are_written():
    assert keys(mobility=told(joints=[0, 1]), fold=told(joints=["0", "1"])) == []
    assert keys(mobility=told(precision=1e-5), fold=told(precision=1e-5 * (1 + 1e-9))) == []
    assert keys(mobility=told(immobile_joints=["b", "a"]), fold=told(immobile_joints=["a", "b"])) == []


def test_refusing_is_agreed_on_where_nothing_moves():
    refused = Outcome("refused", why="nothing moves")
    assert keys(mobility=told(freedoms=0), move=refused) == []
    still = {"branches": {"number": 0, "exhaustive": True}, "branch": None, "freedoms": None}
    assert keys(mobility=told(**still), move=refused) == []
    assert keys(mobility=told(freedoms=1), move=refused) == ["refused"]
    assert keys(mobility=told(freedoms=1), explain=Outcome("indeterminate")) == []
    assert keys(mobility=refused, move=refused) == []
    assert keys(mobility=told(), positions=refused) == []
    doors = {("positions", "python"): refused, ("positions", "command"): told()}
    assert [one.key for one in disagreements(doors)] == ["refused"]


def test_what_says_nothing_or_fails_is_named():
    assert keys(mobility=told(), fold=Outcome("missing")) == ["missing"]
    (one,) = disagreements(of(mobility=told(), fold=Outcome("fault", why="KeyError: 3")))
    assert str(one) == "fault: KeyError: 3 (fold python)"


def test_the_table_counts_each_end():
    table = Table()
    unknown = Outcome("indeterminate")
    outcomes = of(
        mobility=told(), fold=told(freedoms=2), limits=Outcome("refused"), explain=unknown, view=Outcome("left out")
    )
    table.add("frame 3", outcomes, disagreements(outcomes))
    rows = [line.split() for line in str(table).splitlines()]
    assert ["frame", "1", "5", "2", "0", "1", "1", "1", "0", "0", "1"] in rows
    assert ["limits", "1", "0", "0", "1", "0", "0", "0", "0", "0"] in rows
    assert ["fold", "1", "1", "0", "0", "0", "0", "0", "0", "1"] in rows


def test_guises_have_the_shape_they_should():
    sheet = miura(2, 2, np.radians(60.0))
    guises = dict(variants_of(sheet))
    assert list(guises) == [name for name in VARIANTS if name != "frame"]
    before = np.array(sheet.coordinates)
    lengths = np.linalg.norm(np.diff(before, axis=0), axis=1)
    for name, factor in (("turned and moved", 1), ("scaled by 1e6", 1e6), ("scaled by 1e-6", 1e-6), ("mirrored", 1)):
        after = in_space(guises[name].coordinates)
        np.testing.assert_allclose(np.linalg.norm(np.diff(after, axis=0), axis=1), factor * lengths, rtol=1e-12)
    np.testing.assert_array_equal(guises["3 decimals"].coordinates, before.round(3))
    assert set(guises["without assignment"].assignments) == {"B", "U"}


def test_all_verbs_agree_on_a_sample(tmp_path):
    table, wrong, asked = Table(), [], set()
    for name, guises in SAMPLE.items():
        for guise in guises:
            doors = DOORS if name.startswith("data/") and guise == "as it is" else DOORS[:1]
            for one in comparisons(specimens(name), tmp_path, variants=guise, doors=doors):
                table.add(one.variant, one.outcomes, one.disagreements)
                wrong += [f"{one.file} | {one.variant} | {each}" for each in one.disagreements]
                asked.update(verb for (verb, _), outcome in one.outcomes.items() if outcome.kind == "told")
    assert wrong == []
    assert asked == {verb.name for verb in VERBS}
    assert set(table.files) == set(VARIANTS)


@pytest.mark.slow
@pytest.mark.night
@pytest.mark.parametrize("specimen", list(named_specimens()), ids=lambda one: one.name)
def test_all_verbs_agree_on(specimen, tmp_path):
    """As `python -m tests.agreement` asks, less what takes longer; a table is printed with `pytest -s`."""
    if not is_wanted(specimen):
        pytest.skip("no mechanism with coordinates, or too large")
    table, wrong = Table(), []
    doors = DOORS if specimen.file is not None and not specimen.name.startswith("fold/") else DOORS[:1]
    for one in comparisons([specimen], tmp_path, doors=doors, seconds=0.7):
        table.add(one.variant, one.outcomes, one.disagreements)
        wrong += [f"{one.variant} | {each}" for each in one.disagreements]
    print(table)
    assert wrong == []
