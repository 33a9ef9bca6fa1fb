"""A spherical six-bar through the five orientations of Tipparthi and Larochelle: checked by all assembly modes."""

import numpy as np
import pytest
from sizes import slow
from spherical import STEPHENSON, is_among, spherical

import synth
from synth.analysis.motion.linkage import link_motions
from synth.analysis.moving._configuration_of import configuration_of
from synth.linkages.guidance.orientations import read_orientations
from synth.synthesis.designing import DesignSearch, LinkOrientation, WishedConfiguration, Wishes
from synth.synthesis.designing.defects import DefectKind

LINK = 4


def six_bar(data, seed):
    """A design of a random Stephenson linkage, link 4 through all orientations, the first where it is at the pose."""
    turns = read_orientations(data / "orientations" / "tipparthi.json").to_rotation()
    turns = turns * turns[0].inv()
    names = ["pose", "2", "3", "4", "5"]
    quaternions = turns.as_quat(scalar_first=True).tolist()
    wishes = tuple(
        LinkOrientation(at=name, link=str(LINK), quaternion=tuple(one))
        for name, one in zip(names, quaternions, strict=True)
    )
    problem = Wishes(wishes, tuple(map(WishedConfiguration, names[1:])))
    return DesignSearch(spherical(STEPHENSON, np.random.default_rng(seed)), problem).design(0), turns.as_matrix()


@pytest.mark.parametrize("seed", [0, *(slow(seed) for seed in range(1, 10))])
def test_a_six_bar_takes_five_orientations_and_its_defects_are_told(seed, data):
    one, matrices = six_bar(data, seed)
    assert max(figure.part for figure in one.figures) < 1e-10
    assert one.error < 1e-12
    linkage = configuration_of(one.mechanism).linkage
    for angles, matrix in zip(one.angles.values(), matrices[1:], strict=True):
        row = np.array(list(angles.values()))
        assert np.abs(link_motions(linkage, row[None])[LINK][0][0] - matrix).max() < 1e-10
        if one.freedoms == 1:
            modes = synth.positions(one.mechanism, drive={0: row[0]})
            assert is_among(row, modes.positions)
    assert one.success == (not one.defects)
    assert one.freedoms == 1 or {defect.kind for defect in one.defects} <= {DefectKind.FREEDOMS, DefectKind.IMMOBILE}
