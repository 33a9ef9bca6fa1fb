"""Linkages on cones as solids: closed, the right way round, as thick as was asked for, apart."""

from itertools import combinations

import numpy as np
import pytest
from commands import run
from conical import STEPHENSON
from measured import is_watertight, volume_of_mesh

from graphs.errors import UnsolvableError
from graphs.mechanism.surfaces import Cone, Cylinder
from synth.linkages.conformed.linkage_behaviour import OnSurface, loop_of_steps
from synth.making.templates.on_surface import LayeredLinkage, TemplateSizes, solids_on_surface
from synth.synthesis.candidates.job import CandidateJob

LAMBDA = np.radians(28)
SIZES = TemplateSizes(size=90, thickness=1.0)


@pytest.fixture(scope="module")
def linkages():
    job = CandidateJob(STEPHENSON)
    rows = job.rows()[::34]
    return [
        LayeredLinkage(OnSurface(STEPHENSON, job.places(row).tolist(), LAMBDA), Cone(LAMBDA), SIZES) for row in rows
    ]


def volume_of(linkage, link, gap):
    """Of a shell between two offset cones, by its area at the middle height and its thickness; slots taken off."""
    inner, outer = SIZES.ends
    height = linkage.height(link.layer) * np.tan(LAMBDA)
    off = gap / 2 / (inner * np.cos(LAMBDA))
    area = np.cos(LAMBDA) * (link.width - 2 * off) * ((outer + height) ** 2 - (inner + height) ** 2) / 2
    low, high = SIZES.slot_ends
    hole = np.cos(LAMBDA) * 2 * linkage.slot * ((high + height) ** 2 - (low + height) ** 2) / 2
    return (area - len(link.slots) * hole) * SIZES.thickness


def test_shells_are_closed_the_right_way_round_and_have_the_volume_of_what_was_asked_for(linkages):
    assert any(link.slots for linkage in linkages for link in linkage.links)
    for linkage in linkages:
        surface, *meshes = solids_on_surface(linkage, 2.0)
        assert is_watertight(surface)
        assert volume_of_mesh(surface) > 0
        for link, mesh in zip(linkage.links, meshes, strict=True):
            assert is_watertight(mesh)
            assert volume_of_mesh(mesh) == pytest.approx(volume_of(linkage, link, 2.0), rel=2e-3)


def test_layers_are_apart_and_so_are_neighbours_in_a_layer(linkages):
    for linkage in linkages:
        surface, *meshes = solids_on_surface(linkage, 2.0)
        spans = {}
        for layer, mesh in [(-1, surface), *((link.layer, m) for link, m in zip(linkage.links, meshes, strict=True))]:
            across = np.hypot(mesh.corners[:, 0], mesh.corners[:, 2])
            off = across * np.sin(LAMBDA) + mesh.corners[:, 1] * np.cos(LAMBDA)  # along the normal of the cone
            spans.setdefault(layer, []).append((off.min(), off.max()))
        for layer, found in spans.items():
            np.testing.assert_allclose(found, [(3 * layer - 0.5, 3 * layer + 0.5)] * len(found), atol=1e-9)
        for (a, one), (b, other) in combinations(zip(linkage.links, meshes, strict=True), 2):
            if a.layer == b.layer:
                apart = np.linalg.norm(one.corners[:, None] - other.corners[None], axis=-1).min()
                assert apart > 1.9


def test_a_cylinder_is_closed_and_what_has_no_room_for_the_gap_is_refused():
    made = LayeredLinkage(loop_of_steps(np.radians([40, 50, 50])), Cylinder(30.0), SIZES)
    for mesh in solids_on_surface(made, 2.0):
        assert is_watertight(mesh)
        assert volume_of_mesh(mesh) > 0
    with pytest.raises(UnsolvableError, match="narrower than the gap"):
        solids_on_surface(made, 25.0)


def test_solids_of_a_linkage_are_written(tmp_path, data):
    stephenson = data / "surfaces" / "fig11-stephenson.json"
    for suffix in ("stl", "3mf", "gltf", "obj"):
        words = ("convert", stephenson, tmp_path / f"a.{suffix}", "--size", 80, "--thickness", 1)
        assert "hinges" in run(*words).output
        assert (tmp_path / f"a.{suffix}").stat().st_size > 1000
    assert "for panels" in run("convert", stephenson, tmp_path / "b.stl", "--scale", 3, code=2).output
