"""Designs of a task are ranked by the kinds of their defects and by figures; the sentences about them do not matter."""

import json
from dataclasses import replace

import numpy as np
import pytest

import synth
from enumerate.runner import Limits
from synth.synthesis.designing.defects import SENTENCES, Defect, DefectKind
from synth.synthesis.tasks import candidates_of, ranked_types, ranking, read_task, report_page, structure_of
from synth.synthesis.tasks.ranking import Outcome

BRANCH = Defect(DefectKind.BRANCH, ("pose 2", "pose 3"))
ORDER = Defect(DefectKind.ORDER, ("pose 2", "pose 3"))
FREEDOMS = Defect(DefectKind.FREEDOMS, values=(2, 1))
NO_MEMBER = Defect(DefectKind.NO_MEMBER, reason="no member at this start")


def apart(*names):
    return Defect(DefectKind.CIRCUIT, names, reference="pose")


@pytest.fixture(scope="module")
def structure(data):
    return structure_of(read_task(data / "tasks" / "five-orientations.json"))


@pytest.fixture(scope="module")
def number(structure):
    return {one.type_of().name: one.number for one in candidates_of(structure)}


def row_of(candidate, start, *defects, misses=(0.0,), sensitivity=1.0, inputs=()):
    """A row as `synth.synthesis.tasks.dimensioning` makes it, with figures that are given."""
    record = {"defects": [defect.to_json() for defect in defects]}
    if NO_MEMBER not in defects:
        wished = [{"part": miss, "sensitivity": {"0": 0.1, "1": sensitivity}} for miss in misses]
        record |= {"figures": wished, "inputs": list(inputs), "error": 0.0}
    return {"candidate": candidate, "start": start, "record": json.dumps(record)}


def starts_in_order(structure, rows):
    """The starts of rows of one candidate, best first: the best is taken away, again and again."""
    rows, order = list(rows), []
    while rows:
        found = ranked_types(structure, rows)
        [one] = [*found.ranked, *found.missed]
        order.append(one.start)
        rows = [row for row in rows if row["start"] != one.start]
    return order


def test_designs_of_a_type_come_by_defects_then_sensitivity_then_start(structure, number):
    """Successes; of designs equally near those whose motion has a defect, fewest configurations apart; then others."""
    four_bar = number["four-bar"]
    rows = [
        row_of(four_bar, 0, NO_MEMBER),
        row_of(four_bar, 1, misses=(1e-3,)),
        row_of(four_bar, 2, FREEDOMS),
        row_of(four_bar, 3, apart("pose 2", "pose 3", "pose 4")),
        row_of(four_bar, 4, apart("pose 2, and a comma"), sensitivity=9.0),
        row_of(four_bar, 5, apart("pose 3"), sensitivity=8.0),
        row_of(four_bar, 6, BRANCH, sensitivity=9.0),
        row_of(four_bar, 7, ORDER, sensitivity=8.0),
        row_of(four_bar, 8, sensitivity=3.0000001),
        row_of(four_bar, 9, sensitivity=3.0),
        row_of(four_bar, 10, sensitivity=2.0),
        row_of(four_bar, 11, ORDER, misses=(5e-4,)),
        row_of(four_bar, 12, FREEDOMS, BRANCH, sensitivity=10.0),
    ]
    assert starts_in_order(structure, rows[::-1]) == [10, 8, 9, 7, 6, 12, 5, 4, 3, 2, 11, 1, 0]


def test_what_is_counted_of_a_start(structure, number):
    four_bar = number["four-bar"]
    rows = [
        row_of(four_bar, 0, NO_MEMBER),
        row_of(four_bar, 1, BRANCH, misses=(2e-6,)),
        row_of(four_bar, 2, FREEDOMS, BRANCH),
        row_of(four_bar, 3, misses=(1e-6,)),
        row_of(four_bar, 4, misses=(0.0, 1e-6)),
    ]
    found = ranked_types(structure, rows)
    [outcomes] = found.outcomes.values()
    expected = {DefectKind.BRANCH: 1, Outcome.MISSED: 1, DefectKind.NO_MEMBER: 1, Outcome.SUCCESS: 2}
    assert list(outcomes.items()) == list(expected.items())
    assert found.to_json()["ranked"][0]["outcomes"] == {"branch": 1, "missed": 1, "no-member": 1, "success": 2}
    assert found.starts == 5
    assert not found.fell_out


def test_a_start_without_a_member_is_as_far_off_as_can_be(structure, number):
    found = ranked_types(structure, [row_of(number["watt"], 3, NO_MEMBER)])
    [one] = found.missed
    assert (one.miss, one.misses, one.sensitivity, one.travel, one.start) == (np.pi, (), np.inf, None, 3)
    assert one.faults == "no member at this start"
    assert found.fell_out == {DefectKind.NO_MEMBER: 1}
    assert "1 by no member that moves" in found.first_lines()[1]


def test_figures_of_a_row(structure, number):
    row = row_of(number["watt"], 2, misses=(1e-7, 3e-7), sensitivity=4.0, inputs=(0.5, -0.25, 0.1))
    [one] = ranked_types(structure, [row]).ranked
    assert (one.miss, one.misses, one.sensitivity, one.travel) == (3e-7, (1e-7, 3e-7), 4.0, 0.75)
    [weighed] = ranked_types(structure, [row], {1: 0.1}).ranked
    assert weighed.miss == pytest.approx(1e-7)
    [none_driven] = ranked_types(structure, [row_of(number["watt"], 2)]).ranked
    assert none_driven.travel is None


def test_types_are_ranked_by_links_sensitivity_and_miss_the_pareto_list_first(structure, number):
    """A type that another success beats in one figure, and equals in the others, is not on the Pareto list."""

    def names(**rows):
        found = ranked_types(structure, [row_of(number[name], 0, **figures) for name, figures in rows.items()])
        return [(found.name(one), one.pareto) for one in found.ranked]

    six = {"watt": {"sensitivity": 1.0}, "stephenson": {"sensitivity": 2.0}}
    assert names(**six) == [("watt", True), ("stephenson", False)]
    least = {"sensitivity": 2.0, "misses": (1e-8,)}
    assert names(watt={"sensitivity": 1.0, "misses": (1e-7,)}, stephenson=least) == [
        ("watt", True),
        ("stephenson", True),
    ]
    four_bar = {"sensitivity": 3.0}
    both = [("four-bar", True), ("watt", True), ("stephenson", False)]
    assert names(**{"four-bar": four_bar}, **six) == both
    beaten = {"four-bar": {"sensitivity": 0.5}, **six}
    assert names(**beaten) == [("four-bar", True), ("watt", False), ("stephenson", False)]
    equal = {"watt": {"sensitivity": 2.0}, "stephenson": {"sensitivity": 2.0000001}}
    first = min(equal, key=number.__getitem__)
    assert next(name for name, _ in names(**equal)) == first
    assert all(pareto for _, pareto in names(**equal))


def test_types_that_are_not_ranked_come_by_their_defects(structure, number):
    rows = [
        row_of(number["four-bar"], 0, apart("pose 3", "pose 4")),
        row_of(number["four-bar"], 1, apart("pose 3")),
        row_of(number["four-bar"], 2, misses=(0.1,)),
        row_of(number["watt"], 0, BRANCH),
        row_of(number["stephenson"], 0, FREEDOMS),
    ]
    found = ranked_types(structure, rows)
    assert [(found.name(one), one.start) for one in found.missed] == [("watt", 0), ("four-bar", 1), ("stephenson", 0)]
    answer = found.to_json()
    assert answer["missed"][1]["outcomes"] == {"circuit": 2, "missed": 1}
    assert answer["missed"][1]["defects"] == [{"kind": "circuit", "configurations": ["pose 3"], "reference": "pose"}]
    assert answer["left_out"] == {**found.structure.left_out, "branch": 1, "circuit": 1, "freedoms": 1}
    table = found.blocks()[-1]
    assert [row[-1] for row in table.rows] == [
        "branch: 1", "circuit: 2, misses above 1e-06: 1", "other degrees of freedom: 1",
    ]  # fmt: skip
    assert "pose 3" in report_page(found)


def without_sentences(answer):
    return {**answer, **{key: [{**one, "faults": ""} for one in answer[key]] for key in ("ranked", "missed")}}


WORDS = "loop-closure residual, turns back, pass through each other; on another circuit: a, b, c, degrees of freedom"


def test_reworded_sentences_rank_alike(data, monkeypatch):
    """Each kind says what all others say, with commas and semicolons: only what is printed of defects changes."""
    task = replace(read_task(data / "tasks" / "lid.json"), links=Limits(4, 4), distances=())
    before = synth.task(task, starts=4, rounds=1)
    assert {kind for one in before.outcomes.values() for kind in one} > {Outcome.SUCCESS, Outcome.MISSED}
    for kind in DefectKind:
        monkeypatch.setitem(SENTENCES, kind, lambda _: WORDS)
    after = synth.task(task, starts=4, rounds=1)
    assert without_sentences(after.to_json()) == without_sentences(before.to_json())


def test_reworded_sentences_change_nothing_but_themselves(structure, number, monkeypatch):
    """Rows whose records have every kind of defect."""
    every = [BRANCH, ORDER, FREEDOMS, NO_MEMBER, apart("pose 3"), apart("pose 2", "pose 3")]
    every += [Defect(kind, ("pose 2", "pose 3"), "pose", ("0", "1"), (1.0, 2.0), "so") for kind in DefectKind]
    rows = [
        row_of(number[name], start, one)
        for name in ("four-bar", "watt", "stephenson")
        for start, one in enumerate(every)
    ]
    rows = [row for row in rows if row["start"] % 3 != row["candidate"] % 3]
    before = ranked_types(structure, rows)
    told = [one.faults for one in before.missed]
    for kind in DefectKind:
        monkeypatch.setitem(SENTENCES, kind, lambda _: WORDS)
    after = ranked_types(structure, rows)
    assert [one.faults for one in after.missed] == [WORDS] * 3 != told
    assert without_sentences(after.to_json()) == without_sentences(before.to_json())
    assert [(one.candidate, one.start) for one in after.missed] == [(one.candidate, one.start) for one in before.missed]


def test_what_is_printed_of_ranked_designs(structure, number):
    rows = [
        row_of(number["watt"], 0, sensitivity=1.25, inputs=(0.0, np.pi / 6)),
        row_of(number["stephenson"], 0, misses=(3e-7,), sensitivity=2.5),
        row_of(number["four-bar"], 0, misses=(0.25,)),
    ]
    found = ranked_types(structure, rows)
    first, left_out, table, missed = found.blocks()
    assert first == "2 of 8 types can do it (3 starts)"
    assert left_out.endswith("1 by misses above 1e-06")
    links = {one.type_of().name: one.links for one in candidates_of(structure) if one.number in number.values()}
    roles = {name: "base {}, output {}".format(*pair) for name, pair in links.items()}
    assert table.rows == [
        ("1", "watt", "6", roles["watt"], "met", "1.25", "30.0°", "yes"),
        ("2", "stephenson", "6", roles["stephenson"], "3.0e-07", "2.5", "", ""),
    ]
    assert missed.rows == [("four-bar", "4", roles["four-bar"], "2.5e-01", "", "misses above 1e-06: 1")]
    answer = found.to_json()
    assert found.best is found.ranked[0]
    assert ranked_types(structure, []).best is None
    assert [one["travel_deg"] for one in answer["ranked"]] == [pytest.approx(30.0), None]
    assert len(ranked_types(structure, rows[:2]).blocks()) == 3


def test_what_is_printed_of_types_that_are_not_ranked(structure, number, monkeypatch):
    nearest = row_of(number["watt"], 0, misses=(0.125,))
    met = row_of(number["watt"], 0, BRANCH)
    said = [ranked_types(structure, rows).first_lines()[2:] for rows in ([nearest], [met], [])]
    name = ranked_types(structure, [met]).missed[0].candidate
    who = "nearest: watt (base {}, output {}), ".format(*name.links)
    sentence = "the driven joint turns back between pose 2 and pose 3"
    assert said == [[f"{who}largest miss 1.25e-01"], [f"{who}all wishes met; {sentence}"], []]
    [*_, table] = ranked_types(structure, [met]).blocks()
    assert table.rows[0][3:5] == ("met", sentence)
    assert len(ranked_types(replace(structure, left_out={}), []).blocks()) == 1
    assert Outcome.SUCCESS.title == "success"
    rows = [row_of(number[one], 0, BRANCH) for one in ("four-bar", "watt", "stephenson")]
    for most, last in ((2, "and 1 type farther off"), (3, None)):
        monkeypatch.setattr(ranking, "_MOST_MISSED", most)
        block = ranked_types(structure, rows).blocks()[-1]
        assert (block if isinstance(block, str) else None) == last
    assert len(block.rows) == 3
