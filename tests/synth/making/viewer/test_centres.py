"""Centres as pages show them: of what kind, where, and carried by a link that keeps them."""

import numpy as np
import pytest

from graphs.files.formats import read
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.folding.motion import fold
from synth.analysis.motion.linkage import link_motions
from synth.analysis.moving._configuration_of import configuration_of
from synth.catalogue.patterns.creases import miura
from synth.making.viewer.linkage import centres_of


@pytest.mark.parametrize(
    ("name", "kinds"),
    [
        ("realised/remote-5-bar.fold", ["implicit"]),
        ("realised/watt-planar.fold", ["infinite"]),
        ("patterns/four-bar-vertex.fold", ["explicit"]),
    ],
)
def test_kinds_of_patterns(data, name, kinds):
    centres = centres_of(configuration_of_sheet(read(data / name)))
    assert [centre.kind for centre in centres] == kinds


def test_links_without_shape_have_finite_ones(data):
    linkage = configuration_of(read(data / "surfaces" / "fig11-stephenson.json"))
    (centre,) = centres_of(linkage)
    assert centre.kind == "finite"
    assert centre.loops == 2
    assert sorted(centre.joints) == list(range(7))


def test_axes_meet_there_and_all_its_links_keep_it_as_they_fold():
    folding = fold(miura(3, 3, np.radians(60.0)), frames=2)
    pattern = configuration_of_sheet(folding.configuration.sheet)
    linkage = pattern.linkage
    pairs, links = list(linkage.graph.joints.values()), list(linkage.graph.nodes)
    motions = link_motions(linkage, folding.path.angles[-1:])
    centres = centres_of(pattern)
    assert len(centres) == 4
    for centre in centres:
        joints = list(centre.joints)
        assert np.abs(np.cross(centre.place - linkage.points[joints], linkage.directions[joints])).max() < 1e-12
        around = [link for link in links if sum(link in pairs[joint] for joint in joints) == 2]
        assert links[centre.link] in around
        places = [(motions[link][0] @ centre.place + motions[link][1]).ravel() for link in around]
        assert np.abs(np.array(places) - places[0]).max() < 1e-12
