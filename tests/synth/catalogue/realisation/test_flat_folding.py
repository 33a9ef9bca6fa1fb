"""Flat-foldable sheets: reflected in creases one after the other round a vertex or a hole, the sheet closes."""

import numpy as np
import pytest

from enumerate.scd.jobs import scd_graphs
from graphs.convert.conversions import to_scd
from graphs.errors import InvariantError, UnsolvableError
from graphs.files.formats import read, write
from graphs.identity.drawings import map_id, mechanism_from_map_id
from graphs.mechanism.sheet import sides_of_face
from synth.catalogue.realisation._realise import realise
from synth.catalogue.realisation.conditions import flat_folding
from synth.catalogue.realisation.drawing import barycentric_start, first_unknowns
from synth.catalogue.realisation.measures import crossings
from synth.catalogue.realisation.pattern import pattern_of

EXPLICIT = "m1:a---b.ac-.bde.cef--.d-g.fg-"
IMPLICIT = "m1:a-b-.a-c-.b-d-.c-d-"


def _folded_flat(sheet) -> dict[int, np.ndarray]:
    """Where the vertices come to lie if panels are reflected in creases, one by one from the first panel on."""
    points = np.array(sheet.coordinates) @ [1.0, 1.0j]
    panel_at = {side: number for number, face in enumerate(sheet.faces) for side in sides_of_face(face)}
    motion = {0: (1.0 + 0.0j, 0.0j, False)}
    work = [0]
    for panel in work:
        turn, shift, over = motion[panel]
        for a, b in sides_of_face(sheet.faces[panel]):
            other = panel_at.get((b, a))
            if other is None or other in motion:
                continue
            p, q = ((turn * (points[v].conjugate() if over else points[v]) + shift) for v in (a, b))
            mirror = (q - p) / (q - p).conjugate()
            motion[other] = (mirror * turn.conjugate(), p + mirror * (shift - p).conjugate(), not over)
            work.append(other)
    lands: dict[int, list[complex]] = {}
    for panel, face in enumerate(sheet.faces):
        turn, shift, over = motion[panel]
        for v in face:
            lands.setdefault(v, []).append(turn * (points[v].conjugate() if over else points[v]) + shift)
    return {v: np.array(places) for v, places in lands.items()}


def _alternate_sums(sheet) -> list[float]:
    """Of each vertex off the border, every other sector summed, less 180 degrees."""
    points = np.array(sheet.coordinates)
    border = {v for edge, letter in zip(sheet.edges, sheet.assignments, strict=True) if letter == "B" for v in edge}
    off = []
    for vertex in set(range(sheet.vertices)) - border:
        ends = [b if a == vertex else a for a, b in sheet.edges if vertex in (a, b)]
        rays = np.sort([np.arctan2(*(points[end] - points[vertex])[::-1]) for end in ends])
        off.append(np.diff(rays)[::2].sum() - np.pi)
    return off


@pytest.mark.parametrize("code", [EXPLICIT, IMPLICIT])
def test_alternate_sectors_sum_to_180_degrees_and_the_sheet_folds_flat(code, tmp_path):
    pattern = pattern_of(mechanism_from_map_id(code))
    found = realise(mechanism_from_map_id(code), flat_foldable=True)
    write(found.sheet, tmp_path / "flat.fold")
    sheet = read(tmp_path / "flat.fold")
    assert map_id(to_scd(sheet)) == code
    assert np.abs(_alternate_sums(sheet)).max(initial=0.0) < 1e-12
    assert max(np.abs(places - places[0]).max() for places in _folded_flat(sheet).values()) < 1e-12
    assert found.condition_errors.off_flat < 1e-12
    assert found.folds
    assert found.figures.greatest_angle < np.pi
    assert crossings(pattern, np.array(sheet.coordinates)) == 0


def test_without_it_they_do_not():
    sheet = realise(mechanism_from_map_id(EXPLICIT)).sheet
    assert np.abs(_alternate_sums(sheet)).max() > 1e-2


def test_derivatives_are_those_of_the_condition():
    pattern = pattern_of(mechanism_from_map_id(IMPLICIT))
    unknowns = first_unknowns(pattern, *barycentric_start(pattern, np.random.default_rng(1)))
    condition = flat_folding(pattern)
    _, by = condition(unknowns)
    for column in range(unknowns.size):
        step = 1e-6 * np.eye(unknowns.size)[column].reshape(unknowns.shape)
        change = (condition(unknowns + step)[0] - condition(unknowns - step)[0]) / 2e-6
        assert by[:, column] == pytest.approx(change, abs=1e-7)


def test_an_odd_number_of_creases_about_a_centre_is_the_reason(data):
    with pytest.raises(UnsolvableError, match="5 creases, an odd number, about a vertex"):
        realise(read(data / "wiener" / "creased-four-bar.json"), flat_foldable=True)
    with pytest.raises(UnsolvableError, match="5 creases, an odd number, about a hole"):
        realise(read(data / "wiener" / "remote-5-bar.json"), flat_foldable=True)


def test_poses_in_space_are_not_asked():
    with pytest.raises(InvariantError, match="a sheet"):
        realise(mechanism_from_map_id(EXPLICIT), kind="space", flat_foldable=True)


def _all_even(scd) -> bool:
    try:
        flat_folding(pattern_of(scd))
    except UnsolvableError:
        return False
    return True


@pytest.mark.slow
def test_every_type_of_even_explicit_centres_is_found():
    """Six links of at most five sides, all centres explicit, one freedom."""
    types = [scd for scd in scd_graphs(6, 1, 5) if len(pattern_of(scd).holes) == 0 and _all_even(scd)]
    assert len(types) > 30
    for scd in types:
        assert realise(scd, flat_foldable=True).condition_errors.off_flat < 1e-12
