"""STEP: entities by a parser of a few lines, and solids by another kernel."""

import re

import numpy as np
import pytest
from simulated import planar_four_bar
from sizes import slow_but

import synth
from synth.simulation.assembly import assembly_of
from synth.simulation.step import step_bytes

LINE = re.compile(r"(#\d+)=(.+);")


def entities(data):
    """Return the entities of a file: name to text."""
    text = data.decode("ascii")
    assert text.startswith("ISO-10303-21;")
    assert text.endswith("ENDSEC;\nEND-ISO-10303-21;\n")
    inside = text.split("DATA;\n")[1].split("ENDSEC;")[0]
    return dict(LINE.fullmatch(line).groups() for line in inside.splitlines())


def of_type(every, kind):
    return {name: text for name, text in every.items() if text.startswith(f"{kind}(")}


@pytest.mark.parametrize("name", ["miura", "bennett", "resch"])
def test_entities(name):
    assembly = assembly_of(synth.generate(name).mechanism)
    every = entities(step_bytes(assembly))
    names = {name for text in every.values() for name in re.findall(r"#\d+", text)}
    assert names <= set(every)
    shapes = [shape for body in assembly.bodies for shape in body.shapes]
    corners = [len(shape.plane.flat) if hasattr(shape, "plane") else 0 for shape in shapes]
    assert len(of_type(every, "MANIFOLD_SOLID_BREP")) == len(shapes)
    assert len(of_type(every, "ADVANCED_FACE")) == sum(count + 2 if count else 3 for count in corners)
    assert len(of_type(every, "EDGE_CURVE")) == sum(3 * count or 3 for count in corners)
    assert len(of_type(every, "CYLINDRICAL_SURFACE")) == corners.count(0)
    assert len(of_type(every, "TRIMMED_CURVE")) == len(assembly.hinges)
    assert len(of_type(every, "NEXT_ASSEMBLY_USAGE_OCCURRENCE")) == len(assembly.bodies) + 1
    edges = dict.fromkeys(of_type(every, "EDGE_CURVE"), 0)
    for text in of_type(every, "ORIENTED_EDGE").values():
        edge, along = re.fullmatch(r"ORIENTED_EDGE\('',\*,\*,(#\d+),\.([TF])\.\)", text).groups()
        edges[edge] += 1 if along == "T" else -1
    assert set(edges.values()) == {0}  # each edge is passed in both directions: shells are closed


def test_names_of_any_kind(tmp_path):
    four_bar = planar_four_bar()
    names = {"crank": "it's \\ α", "ground": "a;b", "coupler": "\n", "rocker": "#1"}
    graph = synth.SCGraph([names[link] for link in four_bar.chain.nodes],
                          {joint: tuple(names[link] for link in ends) for joint, ends in four_bar.chain.joints.items()})  # fmt: skip
    synth.write_model(synth.HingedSolids(graph, four_bar.axes), tmp_path / "a.step", "step")
    assert "PRODUCT('link_it''s \\\\ \\X4\\000003B1\\X0\\'" in (tmp_path / "a.step").read_text()


@pytest.mark.parametrize(
    "name", slow_but(("miura", "bennett"), ["miura", "bennett", "resch", "crash-lock", "scissor-ring"])
)
def test_solids_by_another_kernel(name, tmp_path):
    """Open CASCADE, in gmsh: volumes, centres, numbers of faces, radii by areas, and where the placements are."""
    gmsh = pytest.importorskip("gmsh", reason="gmsh is not installed")
    assembly = assembly_of(synth.generate(name).mechanism)
    (tmp_path / "a.step").write_bytes(step_bytes(assembly))
    shapes = [shape for body in assembly.bodies for shape in body.shapes]
    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.model.occ.importShapes(str(tmp_path / "a.step"), highestDimOnly=False)
        gmsh.model.occ.synchronize()
        solids = [tag for _, tag in gmsh.model.getEntities(3)]
        volumes = np.array([gmsh.model.occ.getMass(3, tag) for tag in solids])
        centres = np.array([gmsh.model.occ.getCenterOfMass(3, tag) for tag in solids])
        faces = len(gmsh.model.getEntities(2))
    finally:
        gmsh.finalize()
    parts = [shape.properties(1e9) for shape in shapes]
    assert np.abs(volumes / [part.mass for part in parts] - 1.0).max() < 1e-9
    assert np.abs(centres - [1000.0 * part.centre for part in parts]).max() < 1e-6 * 1000.0 * assembly.size
    corners = [len(shape.plane.flat) if hasattr(shape, "plane") else 1 for shape in shapes]
    assert faces == sum(count + 2 for count in corners)
