from hypothesis import given
from strategies import scd_graphs

from graphs.convert.duality import mechanism_of_sheet
from graphs.convert.panels import internal_rods, polyhedron_of, scd_from_panels, vertex_steps
from graphs.count.equations import mobility_of_model
from graphs.loops.loop import Loop
from graphs.mechanism.drawing import FaceKind
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import sheet_from_model


@given(scd_graphs)
def test_reconstruction_has_the_vertices_and_rods_that_were_counted(scd):
    model = polyhedron_of(scd)
    assert len(model) == scd.counts.vertices
    assert model.number_of_edges() == scd.counts.edges
    assert [centre.k for centre in model.centres] == [3] * scd.counts.implicit_centres
    assert mobility_of_model(model) == len(scd.joints) - 3 * len(scd.centred_loops) - 6 * scd.spatial_loops


@given(scd_graphs)
def test_every_vertex_is_told_once_with_the_links_that_have_it(scd):
    steps = list(vertex_steps(scd))
    assert [step.vertex for step in steps] == list(range(scd.counts.vertices))
    for step in steps:
        assert set(step.links) == {link for link, around in scd.vertices.items() if step.vertex in around}
        assert len(set(step.links)) == len(step.links)


@given(scd_graphs)
def test_links_of_the_model_share_rods_where_they_are_joined(scd):
    model = polyhedron_of(scd)
    for joint, (a, b) in scd.joints.items():
        ends = set(scd.drawing.ends_of_joint(joint))
        assert ends <= set(model.links[a]) & set(model.links[b])
        assert model.has_edge(*ends)


@given(scd_graphs)
def test_links_of_the_model_as_panels_give_the_graph_back(scd):
    """All but what panels cannot show: centres off the links, and joints in two pieces."""
    back = scd_from_panels(dict(polyhedron_of(scd).links))
    assert sorted(map(sorted, back.joints.values())) == sorted(map(sorted, scd.joints.values()))
    assert back.counts.external_edges == scd.counts.external_edges
    explicit = [kind for kind in map(scd.drawing.kind_of_face, range(len(scd.faces))) if kind is FaceKind.EXPLICIT]
    assert len(back.loops) == len(explicit)


def test_internal_rods_make_a_rigid_count():
    for n in range(3, 30):
        rods = {frozenset(rod) for rod in internal_rods(tuple(range(n)))}
        sides = {frozenset((i, (i + 1) % n)) for i in range(n)}
        assert len(rods) == 2 * n - 6
        assert not rods & sides


def test_a_remote_centre_keeps_the_rods_of_its_joints():
    joints = [(0, 1), (1, 2), (2, 3), (3, 0)]
    scd = SCDGraph(
        4,
        joints,
        [Loop((0, 1, 2, 3), name="S")],
        rotation={k: [k, None, (k - 1) % 4, None] for k in range(4)},
        outer=(0, "right"),
    )
    (centre,) = polyhedron_of(scd).centres
    assert centre.name == "S"
    assert {frozenset(rod) for rod in centre.rods} == {
        frozenset(scd.drawing.ends_of_joint(joint)) for joint in scd.joints
    }


@given(scd_graphs)
def test_the_sheet_of_a_model_has_its_joints(scd):
    sheet = sheet_from_model(polyhedron_of(scd))
    assert sheet.assignments.count("U") == len(scd.joints)
    assert len(mechanism_of_sheet(sheet).sc.joints) == len(scd.joints)
