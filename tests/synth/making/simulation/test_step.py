"""STEP: entities by a parser of a few lines, and solids by another kernel."""

import re

import numpy as np
import pytest
from simulated import planar_four_bar
from sizes import slow, slow_but

import synth
from graphs.errors import UnsolvableError
from graphs.mechanism.surfaces import SurfaceLinkage
from synth.linkages.conformed.linkage_behaviour import linkage_on_surfaces, loop_on_cones
from synth.making.simulation.assembly import assembly_of
from synth.making.simulation.bodies import Shell
from synth.making.simulation.step import step_bytes

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
    assert "PRODUCT('link_it''s_\\\\_\\X4\\000003B1\\X0\\'" in (tmp_path / "a.step").read_text()


SURFACES = {
    "cone": loop_on_cones(np.radians([120, 95, 45, 85]))[0],
    "cylinder": linkage_on_surfaces(SurfaceLinkage.loop([1.0, 1.5, 1.2, 1.4], "cylinder"))[0],
}


def shells(kind):
    """The bodies of a linkage on a surface, each a part of a shell."""
    assembly = assembly_of(SURFACES[kind])
    parts = [shape for body in assembly.bodies for shape in body.shapes]
    assert [type(part) for part in parts] == [Shell] * 4
    return assembly, parts


def test_shells_of_a_file(data, tmp_path):
    """A linkage on a cone by the name of its file, and as it is read: the same shells."""
    file = data / "surfaces" / "fig11-stephenson.json"
    for name, mechanism in (("a", file), ("b", synth.read(file))):
        synth.write_model(mechanism, tmp_path / f"{name}.step", "step")
    assert (tmp_path / "a.step").read_bytes() == (tmp_path / "b.step").read_bytes()
    assert len(of_type(entities((tmp_path / "a.step").read_bytes()), "CONICAL_SURFACE")) == 4 * 6


@pytest.mark.parametrize("kind", SURFACES)
def test_entities_of_shells(kind):
    assembly, parts = shells(kind)
    every = entities(step_bytes(assembly))
    counts = {name: len(of_type(every, name)) for name in ("ADVANCED_FACE", "EDGE_CURVE", "PLANE")}
    assert counts == {"ADVANCED_FACE": 24, "EDGE_CURVE": 48, "PLANE": 8 if kind == "cone" else 16}
    curved = of_type(every, "CONICAL_SURFACE" if kind == "cone" else "CYLINDRICAL_SURFACE")
    numbers = np.array([text[:-1].split(",")[2:] for text in curved.values()], dtype=float).reshape(4, -1)
    half = assembly.thickness / 2.0
    if kind == "cone":  # two sides with the half angle of the cone, two ends across them
        lam = SURFACES[kind].surface.angle
        angles = numbers.reshape(16, 2)[:, 1].reshape(4, 4)
        assert np.abs(angles - [np.pi / 2 - lam, lam, np.pi / 2 - lam, lam]).max() < 1e-12
    else:
        distances = np.array([np.linalg.norm(part.profile[[0, 2], :1], axis=1) for part in parts])
        assert np.abs(numbers - 1000.0 * distances).max() < 1e-9
        radius = SURFACES[kind].surface.radius
        assert np.abs(distances.min(axis=0) - [radius + half, radius - half]).max() < 1e-12  # the innermost layer


@pytest.mark.parametrize("kind", SURFACES)
def test_masses_of_shells(kind):
    """Against the sum over ever thinner wedges of its profile, and mass by Pappus: the way of the middle of the profile."""
    _, parts = shells(kind)
    for part in parts:
        x, y = part.profile.T
        area = (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2.0
        assert area > 0.0
        exact = part.properties(700.0)
        assert exact.mass == pytest.approx(700.0 * area * part.width * x.mean(), rel=1e-12)
        step = part.width / 2000.0
        corners = part.at(part.start + step * (np.arange(2000) + 0.5)).reshape(2000, 2, 2, 3)
        corners[:, 1] = corners[:, 1, ::-1]
        near = (1.0 - 1.0 / np.sqrt(3.0)) / 2.0
        weights = np.array([1.0 - near, near])
        points = np.einsum(
            "ia,jb,nabk->nijk", np.array([weights, weights[::-1]]), np.array([weights, weights[::-1]]), corners
        )
        distances = np.linalg.norm(np.cross(points - part.origin, part.axes[:, 1]), axis=-1)
        masses = 700.0 * area / 4.0 * step * distances
        centre = np.einsum("nij,nijk->k", masses, points) / masses.sum()
        arms = (points - centre).reshape(-1, 3)
        inertia = np.trace(second := np.einsum("n,na,nb->ab", masses.ravel(), arms, arms)) * np.eye(3) - second
        assert np.abs(centre - exact.centre).max() < 1e-6
        assert np.abs(inertia - exact.inertia).max() < 1e-6 * np.abs(exact.inertia).max()


@pytest.mark.parametrize("name", ["mjcf", "urdf", "sdf", "usd"])
def test_plates_in_place_of_shells(name, tmp_path):
    """Formats without curved shells have plates, a ten-degree part of the way each."""
    suffix = {"mjcf": "xml", "urdf": "urdf", "sdf": "sdf", "usd": "usda"}[name]
    synth.write_model(SURFACES["cone"], tmp_path / f"a.{suffix}", name)
    _, parts = shells("cone")
    plates = sum(len(part.plates()) for part in parts)
    assert plates == sum(int(np.ceil(np.degrees(part.width) / 10.0)) for part in parts)
    text = (tmp_path / f"a.{suffix}").read_text()
    counted = {"mjcf": "<mesh ", "urdf": "<mesh ", "sdf": "<polyline>", "usd": "def Mesh"}
    assert text.count(counted[name]) == {"urdf": 8, "sdf": 2 * plates}.get(name, plates)


@pytest.mark.parametrize("kind", [slow(kind) for kind in SURFACES])
def test_shells_by_another_kernel(kind, tmp_path):
    """Open CASCADE: volumes, centres, inertia, faces and edges; radii and half angles by points and normals of faces."""
    gmsh = pytest.importorskip("gmsh", reason="gmsh is not installed")
    assembly, parts = shells(kind)
    (tmp_path / "a.step").write_bytes(step_bytes(assembly))
    kinds, angles, radii = [], [], []
    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.model.occ.importShapes(str(tmp_path / "a.step"), highestDimOnly=False)
        gmsh.model.occ.synchronize()
        occ, solids = gmsh.model.occ, [tag for _, tag in gmsh.model.getEntities(3)]
        volumes = np.array([occ.getMass(3, tag) for tag in solids])
        centres = np.array([occ.getCenterOfMass(3, tag) for tag in solids])
        inertia = np.array([occ.getMatrixOfInertia(3, tag) for tag in solids]).reshape(-1, 3, 3)
        edges = len(gmsh.model.getEntities(1)) - len(assembly.hinges)
        for part, tag in zip(parts, solids, strict=True):
            for _, face in gmsh.model.getBoundary([(3, tag)], oriented=False):
                kinds.append(gmsh.model.getType(2, face))
                middle = np.mean(gmsh.model.getParametrizationBounds(2, face), axis=0)
                if kinds[-1] == "Plane":
                    continue
                normal, axis = gmsh.model.getNormal(face, middle), part.axes[:, 1]
                angles.append(np.arcsin(abs(normal @ axis)))
                point = gmsh.model.getValue(2, face, middle) / 1000.0 - part.origin
                radii.append((np.linalg.norm(np.cross(point, axis)), part))
    finally:
        gmsh.finalize()
    exact = [part.properties(1e9) for part in parts]
    assert np.abs(volumes / [each.mass for each in exact] - 1.0).max() < 1e-9
    assert np.abs(centres - [1000.0 * each.centre for each in exact]).max() < 1e-9 * 1000.0 * assembly.size
    for measured, each in zip(inertia / 1e6, exact, strict=True):
        assert np.abs(measured - each.inertia).max() < 1e-9 * np.abs(each.inertia).max()
    assert len(kinds) == 24
    assert edges == 48
    curved = "Cone" if kind == "cone" else "Cylinder"
    assert kinds.count(curved) == (16 if kind == "cone" else 8)
    surface = SURFACES[kind].surface
    if kind == "cone":
        near = np.minimum(
            np.abs(np.array(angles) - surface.angle), np.abs(np.array(angles) - (np.pi / 2 - surface.angle))
        )
        assert near.max() < 1e-12
        # midway along each side of the profile, by its two corners
        for distance, part in radii:
            halfway = (part.profile[:, 0] + np.roll(part.profile[:, 0], -1)) / 2.0
            assert np.abs(halfway - distance).min() < 1e-12
    else:
        assert max(angles) < 1e-12
        assert all(np.abs(part.profile[:, 0] - distance).min() < 1e-12 for distance, part in radii)


def test_links_thicker_than_the_surface(tmp_path):
    with pytest.raises(UnsolvableError, match="thicker than the surface is wide; try a smaller thickness"):
        synth.write_model(SURFACES["cylinder"], tmp_path / "a.step", "step", thickness=2000.0)
    assert not list(tmp_path.iterdir())


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


def assembly_by_xcaf(path):
    """What the reader of CAD programs such as FreeCAD finds: (name of the whole, its parts), by Open CASCADE.

    A part is (its name, that of its product, translation in millimetres, volume, centre of mass).
    """
    pytest.importorskip("OCP", reason="OCP is not installed; try make test-simulators")
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps
    from OCP.IFSelect import IFSelect_RetDone
    from OCP.STEPCAFControl import STEPCAFControl_Reader
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDataStd import TDataStd_Name
    from OCP.TDF import TDF_ChildIterator, TDF_Label
    from OCP.TDocStd import TDocStd_Document
    from OCP.XCAFDoc import XCAFDoc_DocumentTool, XCAFDoc_ShapeTool

    def name(label):
        attribute = TDataStd_Name()
        assert label.FindAttribute(TDataStd_Name.GetID_s(), attribute)
        return attribute.Get().ToExtString()

    def below(label):
        children = TDF_ChildIterator(label, False)
        while children.More():
            yield children.Value()
            children.Next()

    document, reader = TDocStd_Document(TCollection_ExtendedString("XmlXCAF")), STEPCAFControl_Reader()
    for mode in (reader.SetNameMode, reader.SetColorMode, reader.SetLayerMode):
        mode(True)
    assert reader.ReadFile(str(path)) == IFSelect_RetDone
    assert reader.Transfer(document)
    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main()).BaseLabel()
    (whole,) = [label for label in below(shapes) if XCAFDoc_ShapeTool.IsFree_s(label)]
    assert XCAFDoc_ShapeTool.IsAssembly_s(whole)
    parts = []
    for label in below(whole):
        product, properties = TDF_Label(), GProp_GProps()
        assert XCAFDoc_ShapeTool.IsComponent_s(label)
        assert XCAFDoc_ShapeTool.GetReferredShape_s(label, product)
        BRepGProp.VolumeProperties_s(XCAFDoc_ShapeTool.GetShape_s(label), properties)
        place = XCAFDoc_ShapeTool.GetLocation_s(label).Transformation().TranslationPart()
        centre = properties.CentreOfMass()
        at, middle = ([point.X(), point.Y(), point.Z()] for point in (place, centre))
        parts.append((name(label), name(product), at, properties.Mass(), middle))
    return name(whole), parts


def with_names_of_any_kind():
    """A four-bar whose links have names with umlauts, quotes and backslashes, and letters from elsewhere."""
    four_bar = planar_four_bar()
    names = {"ground": "it's \\", "crank": "Kurbel äöü", "coupler": "漢字", "rocker": "#1;b"}
    joints = {joint: tuple(names[link] for link in ends) for joint, ends in four_bar.chain.joints.items()}
    return synth.HingedSolids(synth.SCGraph(names.values(), joints), four_bar.axes)


@pytest.mark.parametrize(
    "mechanism",
    [
        synth.generate("miura").mechanism,
        synth.generate("bennett").mechanism,
        with_names_of_any_kind(),
        *SURFACES.values(),
    ],
    ids=["panels", "bars", "names", *SURFACES],
)
def test_assembly_as_cad_programs_read_it(mechanism, tmp_path):
    """Names, placements, volumes and centres of the parts of the assembly; hinge axes are a part without volume."""
    assembly = assembly_of(mechanism)
    (tmp_path / "a.step").write_bytes(step_bytes(assembly))
    whole, parts = assembly_by_xcaf(tmp_path / "a.step")
    assert whole == "mechanism"
    expected = [body.name for body in assembly.bodies]
    assert [part[0] for part in parts] == [part[1] for part in parts] == [*expected, "hinge axes"]
    for number, (body, (_, _, at, volume, middle)) in enumerate(zip(assembly.bodies, parts, strict=False)):
        assert np.abs(np.array(at) - 1000.0 * assembly.origin(number)).max() < 1e-9 * 1000.0 * assembly.size
        properties = body.properties
        assert volume == pytest.approx(1e9 * properties.mass / assembly.options.density, rel=1e-9)
        assert np.abs(np.array(middle) - 1000.0 * properties.centre).max() < 1e-6 * 1000.0 * assembly.size
    assert parts[-1][3] == 0.0
