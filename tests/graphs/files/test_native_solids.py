"""Files of solids hinged at edges: there and back, and what is refused."""

import json
from pathlib import Path

import pytest

from graphs.answer.mobility import counts_and_ranks
from graphs.errors import FileError, InvariantError
from graphs.files.formats import read, write
from graphs.files.native import dumps, from_document
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids

WHERE = Path("some.json")
AXES = [{"joint": "a", "point": [0, 0, 0], "direction": [0, 0, 1]}]
DOOR = {
    "format": "synthedra/solids", "version": 1, "links": ["wall", "door"],
    "joints": [{"id": "a", "links": ["wall", "door"]}], "loops": [], "ground": "wall", "axes": AXES,
}  # fmt: skip


def test_there_and_back(tmp_path, data):
    ring = SCGraph(4, {name: (i, (i + 1) % 4) for i, name in enumerate("OABC")}, [Loop("OABC")], ground=0)
    solids = HingedSolids(ring, {name: ((0.1, i, 1 / 3), (i, 1, -2.5e-7)) for i, name in enumerate("OABC")})
    assert write(solids, tmp_path / "a.json") == ()
    back = read(tmp_path / "a.json")
    assert isinstance(back, HingedSolids)
    assert back.chain.is_identical(ring)
    assert dict(back.axes) == dict(solids.axes)
    made = read(data / "linkages" / "bennett.json")
    assert dumps(made) == (data / "linkages" / "bennett.json").read_text()


def test_axes_lost_in_other_formats_are_told(tmp_path, data):
    solids = read(data / "linkages" / "sarrus.json")
    assert "the axes of its joints" in write(solids, tmp_path / "a.edges", lossy=True)


def test_freedoms_at_the_pose(data):
    answer = counts_and_ranks(read(data / "linkages" / "bricard-trihedral.json"))
    assert (answer.mobility, answer.exact.mobility, answer.infinitesimal.dof) == (0, 0, 1)
    assert answer.to_json()["pose"]["h"] == 1


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"axes": []}, "axes: joint 'a' has no axis; expected one for each joint"),
        ({"axes": [*AXES, *AXES]}, r"axes\[1\]: joint 'a' again"),
        ({"axes": [AXES[0] | {"joint": "b"}]}, r"axes\[0\].joint: 'b' is no joint"),
        ({"axes": [AXES[0] | {"direction": [0, 0, 0]}]}, r"axes\[0\]: .* the direction \[0.0, 0.0, 0.0\]"),
        ({"axes": [AXES[0] | {"direction": [0, 1e-200, 0]}]}, r"expected a vector that is not zero"),
        ({"axes": [AXES[0] | {"point": [0, 1e200, 0]}]}, r"expected three numbers, none beyond 1e\+50"),
        ({"axes": [AXES[0] | {"point": [0, 1]}]}, r"axes\[0\].point: .*expected three numbers"),
        ({"axes": [AXES[0] | {"point": [0, "x", 1]}]}, r"axes\[0\].point\[1\]"),
        ({"axes": {"a": 1}}, "axes: .*expected a list of axes"),
        ({"closing": []}, "closing"),
    ],
)
def test_what_is_no_linkage_is_refused(changes, told):
    with pytest.raises(FileError, match=told):
        from_document(json.loads(json.dumps(DOOR | changes)), WHERE)


def test_axes_of_other_joints_are_refused():
    with pytest.raises(InvariantError, match="7 is no joint"):
        HingedSolids(SCGraph(2, [(0, 1)]), {0: ((0, 0, 0), (0, 0, 1)), 7: ((0, 0, 0), (0, 0, 1))})
