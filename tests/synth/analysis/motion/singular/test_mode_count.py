"""Branches of sheets of degree-4 vertices counted without a list: against the list, and against known numbers."""

import json
from collections import Counter
from itertools import product

import numpy as np
import pytest
from commands import run

from graphs.files.formats import write
from graphs.mechanism.sheet import with_all_edges
from synth.analysis.motion.branches import Search, branches_of, search_for
from synth.analysis.motion.linkage import linkage_of_sheet
from synth.analysis.motion.singular.mode_count import count_of_modes, modes_of
from synth.analysis.verdict._mobility import mobility
from synth.catalogue.patterns import generate
from synth.catalogue.patterns.creases import fan, map_sheet, miura
from synth.catalogue.patterns.panels import sheet_of_panels


def linkage(sheet):
    return linkage_of_sheet(with_all_edges(sheet))


def zigzags(rows, columns, rng):
    """Return a Miura sheet whose zigzags have each an angle of its own, and whose strips have each a width."""
    shifts, heights = rng.uniform(0.1, 0.3, columns + 1), np.cumsum([0.0, *rng.uniform(0.8, 1.2, rows)])

    def corner(i, j):
        return (i + (shifts[i] if j % 2 else -shifts[i]) * 0.5, heights[j])

    tops = [[(i, j) for i in range(columns + 1)] for j in range(rows + 1)]
    level = [[corner(*at) for at in row] for row in tops]
    for j in range(1, rows + 1):  # one angle of each zigzag in all strips: shifts are in proportion to widths
        width = heights[j] - heights[j - 1]
        level[j] = [
            (x + (1 if j % 2 else -1) * s * width, heights[j]) for (x, _), s in zip(level[j - 1], shifts, strict=True)
        ]
    return sheet_of_panels(
        [
            [level[j][i], level[j][i + 1], level[j + 1][i + 1], level[j + 1][i]]
            for j in range(rows)
            for i in range(columns)
        ]
    )


@pytest.mark.parametrize(("rows", "columns"), [(2, 2), (2, 4), (3, 3), (4, 2), (4, 4)])
def test_the_count_is_that_of_the_list(rows, columns, rng):
    for sheet in (miura(rows, columns, 1.1), zigzags(columns, rows, rng)):
        start = linkage(sheet)
        counted, listed = count_of_modes(start), branches_of(start)
        assert listed.exhaustive
        assert (counted.kinds, counted.all) == (listed.kinds, True)
        assert counted.kinds == Counter({1: 2 ** (rows - 1) - 1}) + Counter({columns - 1: 1})


def test_maps_have_two_branches():
    for rows, columns in [(2, 2), (3, 4), (5, 2)]:
        counted = count_of_modes(linkage(map_sheet(rows, columns)))
        assert counted.kinds == Counter([rows - 1, columns - 1])


def test_every_choice_of_modes_by_brute_force():
    """A null space for each choice: with every vertex moving, as the transfer counts."""
    for sheet in (generate("square-twist").mechanism, miura(3, 3, 0.9), map_sheet(3, 3)):
        start = linkage(sheet)
        modes, expected = modes_of(start), Counter()
        for choice in product(*modes):
            rows = []
            for number, (loop, mode) in enumerate(zip(start.loops, choice, strict=True)):
                for joint, part in zip(loop.joints, mode, strict=True):
                    row = np.zeros(len(start.angles) + len(modes))
                    row[joint], row[len(start.angles) + number] = 1.0, -part
                    rows.append(row)
            _, values, right = np.linalg.svd(np.array(rows))
            rank = int((values > 1e-9).sum())
            amounts = right[rank:, len(start.angles) :]
            if len(amounts) and np.abs(amounts).max(axis=0).min() > 1e-6:
                expected[len(amounts)] += 1
        assert count_of_modes(start).kinds == expected


def test_other_vertices_have_no_such_modes():
    assert count_of_modes(linkage(fan(np.radians((0, 60, 120, 180, 240, 300))))) is None


def test_a_sheet_of_more_branches_than_are_listed_has_its_number(tmp_path):
    start = linkage(miura(10, 6, 1.0))
    branches = branches_of(start, search=search_for(len(start.angles), None))
    assert (branches.count, branches.at_least, branches.complete) == (2**9, False, False)
    assert len(branches.branches) < 2**9
    few = branches_of(linkage(miura(5, 3, 1.0)), search=Search(most=3))
    assert (few.count, few.at_least, few.kinds) == (16, False, Counter({1: 15, 2: 1}))
    file = tmp_path / "miura.fold"
    write(miura(10, 6, 1.0), file)
    [said] = json.loads(run("mobility", "--json", file).stdout)
    verdict = said["verdict"]
    assert (verdict["count"], verdict["at_least"], verdict["proved"]) == (512, False, False)
    assert "512 folding branches: 1 with 5 DOF, 511 with 1 DOF." in verdict["text"]


@pytest.mark.slow
def test_a_sheet_of_40_x_40_panels_has_its_number():
    sheet = miura(40, 40, 1.0)
    verdict = mobility(sheet, exact=False).verdict
    assert (verdict.count.count, verdict.count.at_least) == (2**39, False)
    assert verdict.count.kinds == Counter({1: 2**39 - 1, 39: 1})
