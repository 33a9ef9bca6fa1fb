"""The library of C against the kernels that numba compiles; positions that are kept between runs."""

import numpy as np
import pytest
from spherical import FOUR_BAR, STEPHENSON, spherical

from enumerate.machine_code import folders
from graphs.joints.linkage import JointedLinkage, JointPlace
from synth.analysis.assembly import general as module, tracking
from synth.analysis.assembly.family import Family, family_of
from synth.analysis.assembly.general import general_positions
from synth.analysis.moving._configuration_of import configuration_of

needs_library = pytest.mark.skipif(tracking._library() is None, reason="there is no library: no compiler was at hand")


def families():
    """Spherical ones, and a planar one with a slide."""
    linkages = [
        (spherical(FOUR_BAR, np.random.default_rng(1)), 0),
        (spherical(STEPHENSON, np.random.default_rng(2)), 5),
    ]
    places = {joint: JointPlace((joint, joint % 2, 0.0), ((0.0, 0.0, 1.0),)) for joint in range(3)}
    slide = JointPlace((2.0, 0.0, 0.0), ((1.0, 0.3, 0.0),))
    slider = configuration_of(JointedLinkage(FOUR_BAR, {3: "P"}, {**places, 3: slide}), slides=True).linkage
    return [(family_of(linkage, [joint])[0], k) for k, (linkage, joint) in enumerate([*linkages, (slider, 0)])]


def by_both(monkeypatch, call):
    fast = call()
    monkeypatch.setattr(tracking, "_library", lambda: None)
    slow = call()
    monkeypatch.undo()
    return fast, slow


@needs_library
@pytest.mark.parametrize(("family", "seed"), families())
def test_equations_and_paths_are_those_of_the_kernels(family: Family, seed, monkeypatch):
    random = np.random.default_rng(seed)
    count = 2 * len(family.axes) + family.driven + 4 * len(family.loops)

    def complexes(*shape):
        return random.normal(size=shape) + 1j * random.normal(size=shape)

    member, unknowns = complexes(count), complexes(family.unknowns)
    for one, other in zip(*by_both(monkeypatch, lambda: family.at(member, unknowns)), strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-13, atol=1e-13)
    general = general_positions(family)
    near = np.resize(general.values, (40, family.unknowns))
    starts, members = near + 0.1 * complexes(40, family.unknowns), np.tile(general.parameters, (40, 1))
    fast, slow = by_both(monkeypatch, lambda: family.corrected(members, starts, 25))
    closed = (fast[1] <= 1e-10) & (slow[1] <= 1e-10)
    assert closed.any()
    np.testing.assert_allclose(fast[0][closed], slow[0][closed], atol=1e-9)
    # paths from the positions of a general member to another member
    curves = tuple(np.tile(each, (len(general.values), 1)) for each in (general.parameters, member, complexes(count)))
    fast, slow = by_both(monkeypatch, lambda: family.followed(curves, general.values))
    assert fast.arrived.tolist() == slow.arrived.tolist()
    assert fast.arrived.any()
    np.testing.assert_allclose(fast.values[fast.arrived], slow.values[fast.arrived], atol=1e-8)
    # and from hyperplane to hyperplane, on a line of members
    section = module._Section(family, general.parameters, random)
    points = section.points_of(general.values)
    fast, slow = by_both(monkeypatch, lambda: section.moved(section.member, section.first, points, bent=False))
    assert len(fast) > 0
    np.testing.assert_allclose(fast, slow, atol=1e-8)


def test_general_positions_are_kept(tmp_path, monkeypatch):
    """They are found once; a damaged file is no answer; another seed is another member."""
    monkeypatch.setenv("SYNTHEDRA_CACHE", str(tmp_path))
    monkeypatch.setattr(module, "_remembered", {})
    family, _ = family_of(spherical(FOUR_BAR, np.random.default_rng(3)), [1])
    wanted = general_positions(family)
    found = []
    monkeypatch.setattr(module, "general_positions", lambda *given: found.append(given) or general_positions(*given))

    def agrees(times):
        module._remembered.clear()  # as another process begins
        general = module.kept_positions(family)
        np.testing.assert_array_equal(general.values, wanted.values)
        np.testing.assert_array_equal(general.parameters, wanted.parameters)
        assert (general.curves, len(found)) == (wanted.curves, times)

    agrees(1)
    agrees(1)
    (file,) = tmp_path.glob("*/*.npz")
    assert folders.read_whole(file)
    file.write_bytes(file.read_bytes()[:-1])
    agrees(2)
    assert len(module.kept_positions(family, 5).values) == len(wanted.values)
    assert len(found) == 3
