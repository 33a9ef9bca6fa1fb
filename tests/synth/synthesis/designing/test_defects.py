"""Defects of designs: kinds and what they concern, there and back as JSON; sentences, made last."""

import pytest

from synth.synthesis.designing.defects import SENTENCES, Defect, DefectKind, first_kind, kinds_of, sentence_of

SAID = [
    (Defect(DefectKind.CIRCUIT, ("3", "4"), reference="pose"), "on another circuit than pose: 3, 4"),
    (Defect(DefectKind.BRANCH, ("2", "3")), "the driven joint turns back between 2 and 3"),
    (Defect(DefectKind.ORDER, ("2", "3")), "the driven joint passes the configurations out of order"),
    (Defect(DefectKind.INPUTS, ("2", "3")), "the inputs of 2 do not lead straight to 3"),
    (Defect(DefectKind.COLLISION, ("2",), parts=("0", "5")), "panels 0 and 5 pass through each other at 2"),
    (
        Defect(DefectKind.COLLISION, ("2", "3"), parts=("0", "5")),
        "panels 0 and 5 pass through each other between 2 and 3",
    ),
    (Defect(DefectKind.ASSIGNMENT, parts=("4",)), "1 crease folds against the assignment: 4"),
    (
        Defect(DefectKind.ASSIGNMENT, parts=tuple(map(str, range(8)))),
        "8 creases fold against the assignment: 0, 1, 2, 3, 4, 5",
    ),
    (Defect(DefectKind.FREEDOMS, values=(2, 1)), "2 degrees of freedom at the pose; expected 1"),
    (Defect(DefectKind.FREEDOMS, values=(1, 2)), "1 degree of freedom at the pose; expected 2"),
    (Defect(DefectKind.OPEN, values=(0.00123,)), "loop-closure residual 1.2e-03"),
    (Defect(DefectKind.UNTRACED), "the configurations could not be traced"),
    (Defect(DefectKind.IMMOBILE, reason="Rigid."), "Rigid."),
    (Defect(DefectKind.NO_MEMBER, reason="no member at this start"), "no member at this start"),
]


@pytest.mark.parametrize(("defect", "sentence"), SAID)
def test_a_defect_is_said_in_one_sentence_and_kept_as_data(defect, sentence):
    assert sentence_of(defect) == sentence
    assert Defect.of_json(defect.to_json()) == defect
    assert all(defect.to_json().values())


def test_every_kind_has_a_sentence_and_a_title_of_its_own():
    assert set(SENTENCES) == set(DefectKind) == {defect.kind for defect, _ in SAID}
    assert len({kind.title for kind in DefectKind}) == len(DefectKind)


def test_of_several_defects_that_of_the_motion_is_counted():
    several = [Defect(DefectKind.OPEN, values=(1.0,)), Defect(DefectKind.ORDER), Defect(DefectKind.BRANCH, ("a", "b"))]
    assert first_kind(several) is DefectKind.BRANCH
    assert first_kind(several[:1]) is DefectKind.OPEN
    assert first_kind([]) is None
    assert kinds_of(several) == "open order branch"
    assert [kind for kind in DefectKind if kind.of_motion] == list(DefectKind)[:3]
