"""Robots read: there and back, files as others write them, what is refused and what is told."""

import json
from functools import partial
from pathlib import Path

import networkx as nx
import numpy as np
import pytest
from commands import run
from simulated import mujoco_or_skip, planar_four_bar
from sizes import slow_but

import synth
from enumerate.chains.jobs import chains
from graphs.errors import FileError
from graphs.joints.linkage import JointedLinkage, JointKind
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.solids import HingedSolids
from synth.analysis.moving._configuration_of import configuration_of
from synth.catalogue.patterns.generators import GENERATORS
from synth.making.simulation.assembly import assembly_of
from synth.making.simulation.mjcf import mjcf_bytes
from synth.making.simulation.sdf import sdf_bytes
from synth.making.simulation.urdf import urdf_files

DATA = Path(__file__).parents[4] / "data"
FILES = sorted([*DATA.glob("linkages/*.*"), *DATA.glob("joints/*.json"), *DATA.glob("patterns/*.fold"),
                *DATA.glob("wiener/*.fold"), *DATA.glob("realised/*.fold")])  # fmt: skip
QUICK = ("miura", "goldberg", "stewart", "crash-lock")


def linkage_on_axes(graph, lines):
    """A chain with an axis, (point, direction), for each joint; its loops are closed there."""
    joints = {f"{a}-{b}": (a, b) for a, b in sorted(graph.edges)}
    return HingedSolids(SCGraph(sorted(graph), joints), dict(zip(joints, lines, strict=True)))


def random_linkage(kind, graph, seed):
    """A chain with random axes: parallel, through one point, or anywhere."""
    rng, count = np.random.default_rng(seed), graph.number_of_edges()
    points, directions = rng.uniform(-1.0, 1.0, (2, count, 3))
    if kind == "planar":
        directions[:] = rng.normal(size=3)
    elif kind == "spherical":
        points[:] = 0.0
    return linkage_on_axes(graph, list(zip(points.tolist(), directions.tolist(), strict=True)))


def random_linkages():
    """All chains of up to eight links and one degree of freedom, planar and spherical; loops of 7 to 12 in space."""
    for kind in ("planar", "spherical"):
        for links in (4, 6, 8):
            for number, graph in enumerate(chains(links, 1)):
                yield f"{kind} chain of {links}, {number}", partial(random_linkage, kind, graph, 100 * links + number)
    for links in range(7, 13):
        yield f"loop of {links} in space", partial(random_linkage, "spatial", nx.cycle_graph(links), links)


def with_loops(path):
    """Whether a file has coordinates, and loops: strings of panels have none, and joints of all kinds no places."""
    if path.parent.name == "joints":
        return path.stem in ("roberts", "slider-crank-placed", "stretched-four-bar")
    return not path.stem.startswith(("chain-", "ups-chain", "three-link-chain", "fig12-open"))


MANY = {
    **{name: partial(lambda name: synth.generate(name).mechanism, name) for name in GENERATORS},
    **{f"{path.parent.name}/{path.name}": partial(synth.read, path) for path in filter(with_loops, FILES)},
    **dict(random_linkages()),
}
"""Mechanisms with loops, by their names: generators, files, types that were given coordinates, chains at random."""


def written(assembly, folder):
    """Write an assembly in each format without its meshes; return the files."""
    (folder / "a.xml").write_bytes(mjcf_bytes(assembly))
    files = urdf_files(assembly)
    for ending in (".urdf", ".loops.json"):
        (folder / f"a{ending}").write_bytes(files[ending])
    (folder / "a.sdf").write_bytes(sdf_bytes(assembly))
    return folder / "a.xml", folder / "a.urdf", folder / "a.sdf"


def rank_at(configuration, angles):
    matrix = configuration.closure.dense(angles)
    return np.linalg.matrix_rank(matrix, tol=1e-6) if matrix.size else 0


def there_and_back(mechanism, folder):
    """Each format keeps the id, the degrees of freedom at its configuration, and the axes; return the loops."""
    assembly = assembly_of(mechanism)
    lengths = np.where([hinge.slide for hinge in assembly.hinges], assembly.size, 1.0)
    angles = np.array([hinge.angle for hinge in assembly.hinges]) / lengths
    name = synth.identify(mechanism).chain or synth.identify(assembly.configuration.linkage.graph).chain  # of rods
    freedoms = len(angles) - rank_at(assembly.configuration, angles)
    for path in written(assembly, folder):
        back = synth.read(path)
        assert name is not None
        assert synth.identify(back).chain == name
        there = configuration_of(back, slides=True)
        assert len(there.joints) - rank_at(there, there.linkage.angles) == freedoms == assembly.freedoms
        for hinge in assembly.hinges:
            if isinstance(back, HingedSolids):
                point, axis = (np.array(part) for part in back.axes[hinge.name])
                assert np.linalg.norm(np.cross(axis, hinge.direction)) < 1e-12
                assert np.linalg.norm(np.cross(point - hinge.point, hinge.direction)) < 1e-12 * max(1, assembly.size)
    return len(assembly.cuts)


@pytest.mark.parametrize("name", slow_but(QUICK, MANY))
def test_there_and_back(name, tmp_path):
    assert there_and_back(MANY[name](), tmp_path) > 0


def test_how_many_go_there_and_back():
    assert len(MANY) >= 146


@pytest.mark.parametrize("suffix", [".xml", ".urdf", ".sdf"])
def test_verbs_answer_about_robots(suffix, tmp_path):
    """What is said of a mechanism is said of its robot: assembly modes, redundant equations, its name."""
    four_bar, bennett = planar_four_bar(), synth.generate("bennett").mechanism
    written(assembly_of(four_bar), tmp_path)
    answers = (
        synth.positions(four_bar, drive={"O": 0.7}),
        synth.positions(tmp_path / f"a{suffix}", drive={"joint_O": 0.7}),
    )
    modes = [sorted(mode["angles_deg"][name] for mode in answer.to_json()["positions"])
             for answer, name in zip(answers, ("B", "joint_B"), strict=True)]  # fmt: skip
    assert len(modes[0]) == 2
    assert np.allclose(*modes, atol=1e-8)
    written(assembly_of(bennett), tmp_path)
    of_robot, of_linkage = (synth.explain(each).to_json() for each in (tmp_path / f"a{suffix}", bennett))
    assert [of_robot[key] for key in ("freedoms", "count", "h")] == [
        of_linkage[key] for key in ("freedoms", "count", "h")
    ]
    assert of_robot["sets"][0]["reasons"] == of_linkage["sets"][0]["reasons"]
    assert "(Bennett)" in of_robot["sets"][0]["reasons"][0]


FOUR_BAR = """<mujoco><compiler angle="degree"/>
<default><joint axis="0 1 0"/><default class="other"><joint axis="0 0 1" pos="0.5 0 0"/></default></default>
<worldbody>
  <body name="base" pos="0 0 1" euler="90 0 0">
    <body name="crank"><joint name="a" axis="0 0 1"/>
      <frame pos="1 0 0" quat="2 0 0 0"><body name="coupler"><joint name="b" axis="0 0 3"/></body></frame>
    </body>
    <body name="rocker" pos="1.5 0 0" childclass="other"><joint name="d"/></body>
  </body>
</worldbody>
<equality>{}</equality></mujoco>"""
"""A crank of 1 and a base of 2, folded onto each other, as a person writes it: frames, classes, angles in degrees."""
BOTH = "".join(f'<connect body1="coupler" body2="rocker" anchor="2 0 {z}"/>' for z in (0, 1))
ONE = '<connect body1="coupler" body2="rocker" anchor="2 0 0"/>'


@pytest.mark.parametrize("loops", [BOTH, ONE], ids=["two points", "one point in a plane"])
def test_a_four_bar_of_mujoco(loops, tmp_path):
    (tmp_path / "a.xml").write_text(FOUR_BAR.format(loops))
    solids = synth.read(tmp_path / "a.xml")
    assert isinstance(solids, HingedSolids)
    assert solids.chain.ground == "base"
    expected = {"a": (0, 0, 1), "b": (1, 0, 1), "d": (2, 0, 1), "coupler to rocker": (3, 0, 1)}
    for joint, (point, axis) in solids.axes.items():
        assert np.allclose(point, expected[joint], atol=1e-15)
        assert np.abs(np.abs(axis) - (0, 1, 0)).max() < 1e-15
    assert synth.mobility(solids).to_json()["mobility"] == 1


def test_other_joints_of_mujoco(tmp_path):
    (tmp_path / "a.xml").write_text(
        '<mujoco><worldbody><body name="a"><joint type="slide" axis="1 0 0"/><joint type="hinge" axis="1 0 0"/>'
        '<body name="b" pos="0 0 1"><joint type="ball"/></body></body><body name="c"><freejoint/></body></worldbody>'
        '<equality><joint joint1="x" polycoef="0 1 0 0 0"/></equality><tendon><fixed name="t"/></tendon></mujoco>'
    )
    linkage = synth.read(tmp_path / "a.xml")
    assert isinstance(linkage, JointedLinkage)
    assert sorted(kind.value for kind in linkage.kinds.values()) == ["P", "R", "S"]
    assert linkage.kinds["joint of b"] is JointKind.SPHERICAL
    notes = " ".join(linkage.notes)
    assert "1 equality <joint>" in notes
    assert "1 tendon section" in notes
    assert "1 body without a joint" in notes


@pytest.mark.parametrize("orientation", [
    'euler="30 20 10"', 'quat="0.9 0.1 -0.2 0.3"', 'axisangle="1 2 3 40"', 'xyaxes="1 1 0 -1 1 0.5"',
    'zaxis="1 -1 0.5"', 'zaxis="0 0 -1"',
])  # fmt: skip
@pytest.mark.parametrize("sequence", ["xyz", "ZXZ"])
def test_orientations_as_mujoco_reads_them(orientation, sequence, tmp_path):
    mujoco = mujoco_or_skip()
    text = (f'<mujoco><compiler eulerseq="{sequence}"/><worldbody><body pos="1 2 3" {orientation}>'
            '<joint name="j" axis="1 2 -1" pos="0.1 0.2 0.3"/><geom size="1"/></body></worldbody></mujoco>')  # fmt: skip
    (tmp_path / "a.xml").write_text(text)
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    point, axis = synth.read(tmp_path / "a.xml").axes["j"]
    assert np.allclose(point, data.xanchor[0], atol=1e-12)
    assert np.allclose(axis, data.xaxis[0], atol=1e-12)


def test_a_robot_of_ros(tmp_path):
    (tmp_path / "a.urdf").write_text(
        '<robot name="r"><link name="a"/><link name="b"/><link name="c"/><link name="d"/>'
        '<joint name="s" type="revolute"><parent link="a"/><child link="b"/><origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/></joint>'
        '<joint name="f" type="fixed"><parent link="b"/><child link="c"/><origin xyz="1 0 0" rpy="1.5707963267948966 0 0"/></joint>'
        '<joint name="t" type="continuous"><parent link="c"/><child link="d"/><axis xyz="0 0 1"/><mimic joint="s"/></joint></robot>'
    )
    solids = synth.read(tmp_path / "a.urdf")
    assert set(solids.chain.nodes) == {"a", "b", "d"}
    assert np.allclose(solids.axes["s"], [(1, 0, 0), (0, 1, 0)])
    assert np.allclose(solids.axes["t"], [(1, 1, 0), (1, 0, 0)])
    assert solids.notes == ("not read: 1 mimic joint",)
    assert "not read: 1 mimic joint" in str(synth.mobility(solids))


def test_a_model_of_gazebo(tmp_path):
    (tmp_path / "a.sdf").write_text(
        '<sdf version="1.9"><world name="w"><model name="m"><frame name="f"><pose>0 0 1 0 0 0</pose></frame>'
        '<link name="a"><pose relative_to="f">1 0 0 0 0 1.5707963267948966</pose></link>'
        '<link name="b"><pose relative_to="a">1 0 0 0 0 0</pose></link><link name="c"/>'
        '<joint name="u" type="universal"><parent>a</parent><child>b</child><axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2></joint>'
        '<joint name="p" type="prismatic"><parent>b</parent><child>c</child><axis><xyz expressed_in="a">1 0 0</xyz></axis></joint>'
        '<joint name="w" type="fixed"><parent>world</parent><child>a</child></joint></model></world></sdf>'
    )
    linkage = synth.read(tmp_path / "a.sdf")
    assert linkage.chain.ground == "a"
    assert np.allclose(linkage.places["u"].point, (1, 1, 1))
    assert np.allclose(linkage.places["u"].axes, [(0, 1, 0), (-1, 0, 0)])
    assert np.allclose(linkage.places["p"].axes, [(0, 1, 0)])


def body(inside, more=""):
    return f'<mujoco><worldbody><body name="a">{inside}</body></worldbody>{more}</mujoco>'


URDF = '<robot name="r"><link name="a"/><link name="b"/>{}</robot>'
BAD = {
    "entities": ("a.xml", '<!DOCTYPE a [<!ENTITY b "c">]><mujoco/>', "a document type"),
    "no XML": ("a.urdf", "<robot", "not XML; expected <robot>"),
    "other root": ("a.sdf", "<html/>", "the element 'html'; expected <sdf>"),
    "nothing": ("a.xml", "<mujoco/>", "no joints"),
    "include": ("a.xml", '<mujoco><include file="/etc/passwd"/></mujoco>', "bodies in another file"),
    "global": ("a.xml", '<mujoco><compiler coordinate="global"/></mujoco>', "global coordinates"),
    "axis": ("a.xml", body('<joint axis="0 0 0"/>'), "the axis has no direction"),
    "words": ("a.xml", body('<joint axis="0 x 0"/>'), "expected 3 numbers"),
    "infinite": ("a.xml", body('<joint pos="0 1e999 0"/>'), "expected 3 numbers"),
    "type": ("a.xml", body('<joint type="screw"/>'), "the type 'screw'"),
    "twice": ("a.xml", body('<body name="a"/>'), "the name occurs twice"),
    "no body": ("a.xml", body("<joint/>", '<equality><connect body1="a" body2="z" anchor="0 0 0"/></equality>'), "no body 'z'"),
    "welded": ("a.xml", body("<joint/>", '<equality><weld body1="a"/></equality>'), "both bodies are one link"),
    "no link": ("a.urdf", URDF.format('<joint name="j" type="fixed"><parent link="a"/></joint>'), "no <child>"),
    "no tree": ("a.urdf", URDF.format(
        '<joint name="j" type="revolute"><parent link="a"/><child link="b"/></joint>'
        '<joint name="k" type="revolute"><parent link="b"/><child link="a"/></joint>'), "a loop of joints"),
    "kind": ("a.urdf", URDF.format('<joint name="j" type="ball"><parent link="a"/><child link="b"/></joint>'), "the type 'ball'"),
    "models": ("a.sdf", "<sdf/>", "0 models; expected 1"),
    "own frame": ("a.sdf", '<sdf><model name="m"><link name="a"><pose relative_to="a">0 0 0 0 0 0</pose></link><link name="b"/>'
                  '<joint name="j" type="revolute"><parent>b</parent><child>a</child></joint></model></sdf>', "relative to itself"),
    "no kind": ("a.urdf", URDF.format('<joint name="j"><parent link="a"/><child link="b"/></joint>'), "the type ''; expected one of"),
    "spherical": ("a.urdf", URDF.format('<joint name="j" type="spherical"><parent link="a"/><child link="b"/></joint>'), "the type 'spherical'"),
    "universal": ("a.xml", body('<joint type="universal"/>'), "the type 'universal'; expected hinge, slide, ball or free"),
    "default": ("a.xml", body('<joint/>', '<default><joint type="cylindrical"/></default>'), "the type 'cylindrical'"),
    "gearbox": ("a.sdf", '<sdf><model name="m"><link name="a"/><joint name="j" type="gearbox"><parent>world</parent>'
                '<child>a</child></joint></model></sdf>', "the type 'gearbox'"),
    "revolute2": ("a.sdf", '<sdf><model name="m"><link name="a"/><joint name="j" type="revolute2"><parent>world</parent>'
                  '<child>a</child></joint></model></sdf>', "the type 'revolute2'"),
    "screw": ("a.sdf", '<sdf><model name="m"><link name="a"/><joint name="j" type="screw"><parent>world</parent>'
              '<child>a</child></joint></model></sdf>', "the type 'screw'"),
}  # fmt: skip


@pytest.mark.parametrize("case", BAD)
def test_what_is_refused(case, tmp_path):
    name, text, message = BAD[case]
    (tmp_path / name).write_text(text)
    with pytest.raises(FileError) as error:
        synth.read(tmp_path / name)
    assert message in str(error.value)
    assert "\n" not in str(error.value)
    for words in (("mobility", tmp_path / name), ("convert", tmp_path / name, tmp_path / "b.xml", "--as", "mjcf")):
        result = run(*words, code=2)
        assert (result.stdout, result.stderr) == ("", f"{error.value}\n")


UNREAD = {
    "a.xml": (body("<joint/><screw/><composite/>"), ["1 <composite>", "1 <screw>"]),
    "a.urdf": (URDF.format('<joint name="j" type="revolute"><parent link="a"/><child link="b"/></joint><loop_joint/>'), ["1 <loop_joint>"]),
    "a.sdf": ('<sdf><model name="m"><static>true</static><gripper/><link name="a"/><joint name="j" type="revolute">'
              "<parent>world</parent><child>a</child></joint></model></sdf>", ["1 <gripper> in the model", "1 static model"]),
}  # fmt: skip


@pytest.mark.parametrize("name", UNREAD)
def test_elements_that_are_not_read(name, tmp_path):
    """Joints of other programs that are no joints to us: a note of `mobility` and of `convert`."""
    text, parts = UNREAD[name]
    (tmp_path / name).write_text(text)
    notes = [f"not read: {part}" for part in parts]
    assert sorted(synth.read(tmp_path / name).notes) == notes
    assert all(f"note: {note}" in run("mobility", tmp_path / name).output for note in notes)
    told = json.loads(run("convert", tmp_path / name, tmp_path / "b.json", "--json").output)
    assert sorted(told["notes"]) == notes


@pytest.mark.parametrize("loops", [{}, {"loops": 3}, {"loops": [3]}, {"loops": [{"links": ["a", "z"], "joint": "l",
                         "points": [[0, 0, 0]], "axis": [0, 0, 1]}]}])  # fmt: skip
def test_bad_loops_beside_a_tree(loops, tmp_path):
    (tmp_path / "a.urdf").write_text(
        URDF.format('<joint name="j" type="revolute"><parent link="a"/><child link="b"/></joint>')
    )
    (tmp_path / "a.loops.json").write_text(json.dumps({"format": "synthedra/loops", "version": 1} | loops))
    with pytest.raises(FileError, match=r"a\.loops\.json"):
        synth.read(tmp_path / "a.urdf")


def test_deep_bodies(tmp_path):
    """A chain of 2000 bodies inside each other is no matter of recursion."""
    deep = "".join('<body><joint axis="0 0 1"/>' for _ in range(2000)) + "</body>" * 2000
    (tmp_path / "a.xml").write_text(f"<mujoco><worldbody>{deep}</worldbody></mujoco>")
    assert len(synth.read(tmp_path / "a.xml").chain.joints) == 2000
