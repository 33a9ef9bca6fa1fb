"""The library of C against numpy and scipy: equations, derivatives, factors, and whole motions; threads."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import scipy.sparse

from graphs.c_libraries import build, library, place_of
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from synth.analysis.folding.configuration import configuration_of_sheet
from synth.analysis.motion import closure as closing, closure_kernel as of_library
from synth.analysis.motion.closure import ClosureEquations, corrected
from synth.analysis.motion.closure_kernel import SOURCE, KernelFactor, kernel
from synth.analysis.motion.linkage import linkage_of_axes
from synth.analysis.motion.path import circuit_through, driven_path
from synth.analysis.motion.tangent import SparseFactor
from synth.analysis.motion.walk.events import TurningPoint
from synth.analysis.motion.walk.walking import Ahead
from synth.catalogue.patterns import generate

needs_library = pytest.mark.skipif(kernel() is None, reason="there is no library: no compiler was at hand")


def two_ways(linkage, monkeypatch):
    """The equations with the library, and without."""
    fast = ClosureEquations(linkage)
    monkeypatch.setattr(closing, "kernel", lambda: None)
    slow = ClosureEquations(linkage)
    monkeypatch.undo()
    assert fast._kernel is not None
    assert slow._kernel is None
    return fast, slow


def linkage_of_rings(rng, sliding=True):
    """Rings, each on a joint of those before: axes about a point of it, parallel to it, or anyhow; some joints slide."""
    joints, loops, slides = [(0, 1)], [], []
    axes = {0: (rng.normal(size=3), rng.normal(size=3))}
    links = 2
    for centre in rng.permutation(["finite", "infinite", "none", "finite", "none"]):
        k, shared = int(rng.integers(3, 7)), int(rng.integers(len(joints)))
        point, along = axes[shared]
        round_it = [joints[shared][1], *range(links, links + k - 1), joints[shared][0]]
        links += k - 1
        numbers = range(len(joints), len(joints) + k)
        joints += list(zip(round_it, round_it[1:], strict=False))
        for number in numbers:
            directions, points = rng.normal(size=3), rng.normal(size=3)
            if centre == "finite":
                points = point + directions * rng.normal()
            axes[number] = (points, along * rng.choice([-2.0, 1.0]) if centre == "infinite" else directions)
        loops.append(Loop([shared, *numbers], centre))
        slides += numbers[:1] if sliding and centre == "none" else []
    return linkage_of_axes(SCGraph(links, joints, loops), axes, slides=slides)


@needs_library
@pytest.mark.parametrize("seed", range(6))
def test_equations_and_derivatives_are_those_of_numpy(seed, monkeypatch):
    rng = np.random.default_rng(seed)
    fast, slow = two_ways(linkage_of_rings(rng), monkeypatch)
    for _ in range(4):
        angles = rng.normal(size=fast.joints)
        for one, other in zip(fast.evaluated(angles), slow.evaluated(angles), strict=True):
            np.testing.assert_allclose(one, other, rtol=0, atol=1e-13 * max(1.0, np.abs(other).max()))
    fast, slow = fast.locked([1, 4]), slow.locked([1, 4])
    np.testing.assert_allclose(fast.evaluated(angles)[1], slow.evaluated(angles)[1], atol=1e-12)
    assert not fast.at(angles)[1].toarray()[:, [1, 4]].any()


@needs_library
@pytest.mark.parametrize("name", ["miura", "waterbomb", "kaleidocycle", "bird-base"])
def test_factors_are_those_of_scipy(name, monkeypatch):
    from synth.analysis.moving._configuration_of import configuration_of

    linkage = configuration_of(generate(name).mechanism).linkage
    fast, slow = two_ways(linkage, monkeypatch)
    rng = np.random.default_rng(3)
    entries = fast.evaluated(linkage.angles + 0.2 * rng.normal(size=fast.joints))[1]
    matrix = slow.matrix(entries)
    one, other = KernelFactor(fast._kernel, entries, 1e-9), SparseFactor(matrix, 1e-9)
    assert one.shape == other.shape == matrix.shape
    rates, off = rng.normal(size=fast.joints), rng.normal(size=fast.rows)
    for method, given in (("image", rates), ("sum_of_rows", off), ("least_exactly", off), ("projected", rates)):
        np.testing.assert_allclose(getattr(one, method)(given), getattr(other, method)(given), rtol=1e-7, atol=1e-8)
    normal = matrix.T @ matrix
    whole = normal + 1e-9 * max(normal.diagonal().max(), 1.0) * scipy.sparse.identity(fast.joints)
    np.testing.assert_allclose(whole @ one.solved(rates), rates, atol=1e-5)


@needs_library
@pytest.mark.parametrize("seed", range(12))
def test_any_pattern_is_factorised(seed, monkeypatch):
    """Cliques in any arrangement: the factor solves the normal equations to all digits where they are regular."""
    rng = np.random.default_rng(seed)
    fast, slow = two_ways(linkage_of_rings(rng, sliding=False), monkeypatch)
    entries = rng.normal(size=len(fast.evaluated(np.zeros(fast.joints))[1]))
    matrix, added = slow.matrix(entries), 0.5
    normal = (matrix.T @ matrix).toarray()
    normal += added * max(normal.diagonal().max(), 1.0) * np.eye(fast.joints)
    right = rng.normal(size=fast.joints)
    factor = KernelFactor(fast._kernel, entries, added)
    np.testing.assert_allclose(factor.solved(right), np.linalg.solve(normal, right), rtol=1e-10, atol=1e-12)


@needs_library
@pytest.mark.parametrize(("rows", "columns"), [(2, 30), (12, 12), (24, 20), (60, 70)])
def test_blocks_of_a_sheet_are_factorised(rows, columns, monkeypatch):
    """Sheets have factors with wide blocks of columns; each solves its normal equations, also where few entries
    are, and where two halves of it are factorised at once."""
    linkage = configuration_of_sheet(generate("miura", rows=rows, columns=columns, fold=0.7).mechanism).linkage
    fast, slow = two_ways(linkage, monkeypatch)
    rng = np.random.default_rng(rows)
    entries = fast.evaluated(linkage.angles + 0.1 * rng.normal(size=fast.joints))[1]
    matrix, right = slow.matrix(entries), rng.normal(size=fast.joints)
    normal = matrix.T @ matrix
    normal += 0.1 * max(normal.diagonal().max(), 1.0) * scipy.sparse.identity(fast.joints)
    np.testing.assert_allclose(normal @ KernelFactor(fast._kernel, entries, 0.1).solved(right), right, atol=1e-13)


@needs_library
def test_copies_for_wide_registers_change_no_digit(tmp_path, monkeypatch):
    """The same source without these copies answers with the same bytes: factors, solutions, and Newton's method."""
    narrow = tmp_path / SOURCE.name
    narrow.write_text(f"#define WIDE\n{SOURCE.read_text()}")
    (tmp_path / "factor.h").write_text(SOURCE.with_name("factor.h").read_text())
    if build(narrow):
        pytest.skip(build(narrow))
    linkage = configuration_of_sheet(generate("miura", rows=36, columns=44, fold=0.7).mechanism).linkage
    rng = np.random.default_rng(0)
    start, right = linkage.angles + 0.01 * rng.normal(size=len(linkage.angles)), rng.normal(size=len(linkage.angles))
    answers = []
    for source in (SOURCE, narrow):
        monkeypatch.setattr(of_library, "SOURCE", source)
        equations = ClosureEquations(linkage)
        entries = equations.evaluated(start)[1]
        answers.append(
            [KernelFactor(equations._kernel, entries, 0.1).solved(right), corrected(equations, start).angles]
        )
    for one, other in zip(*answers, strict=True):
        assert one.tobytes() == other.tobytes()


@needs_library
@pytest.mark.parametrize("rows", [3, 7])
def test_motions_are_those_of_numpy(rows, monkeypatch):
    linkage = configuration_of_sheet(generate("miura", rows=rows, columns=rows, fold=0.7).mechanism).linkage
    paths = [
        driven_path(equations, linkage.angles, [0], np.linspace(0.0, 0.4, 5)[1:, None] + linkage.angles[0])
        for equations in two_ways(linkage, monkeypatch)
    ]
    assert [path.stopped for path in paths] == ["", ""]
    np.testing.assert_allclose(paths[0].angles, paths[1].angles, atol=1e-11)


@needs_library
def test_threads_share_one_linkage():
    linkage = configuration_of_sheet(generate("miura", rows=6, columns=6, fold=0.7).mechanism).linkage
    equations = ClosureEquations(linkage)
    starts = [linkage.angles + 1e-3 * np.random.default_rng(k).normal(size=equations.joints) for k in range(24)]
    alone = [corrected(ClosureEquations(linkage), start).angles for start in starts]
    with ThreadPoolExecutor(8) as threads:
        together = list(threads.map(lambda start: corrected(equations, start).angles, starts))
    for one, other in zip(alone, together, strict=True):
        assert one.tolist() == other.tolist()


def test_a_linkage_without_loops_has_no_equations():
    hinge = linkage_of_axes(SCGraph(2, [(0, 1)]), {0: ((0, 0, 0), (0, 0, 1))})
    equations = ClosureEquations(hinge)
    place = corrected(equations, np.array([0.5]))
    assert (equations.rows, place.error, place.space.projected(np.ones(1)).tolist()) == (0, 0.0, [1.0])


def test_a_library_is_of_its_source(tmp_path):
    """Another source has another library, which is built once; what is no C is refused in a line."""
    source = tmp_path / "one.c"
    source.write_text("int one(void) { return 1; }\n")
    if build(source):
        pytest.skip(build(source))
    assert library(source) is not None
    first = place_of(source)
    source.write_text("int one(void) { return 2; }\n")
    assert place_of(source) != first
    assert not place_of(source).exists()
    assert build(source) == ""
    assert not first.exists()
    first = place_of(source)
    (tmp_path / "part.h").write_text("int part(void);\n")
    assert place_of(source) != first
    source.write_text("this is no C\n")
    assert "failed: " in build(source)
    assert library(SOURCE) is kernel()


@needs_library
@pytest.mark.parametrize("name", ["bennett", "four-bar", "kaleidocycle", "bricard-trihedral"])
def test_walks_take_the_steps_that_python_takes(name, monkeypatch):
    """Steps taken ahead, with the watch over the rank, are those taken one by one; events end them as they do those."""
    from synth.analysis.moving._configuration_of import configuration_of

    at = configuration_of(generate(name).mechanism)
    start = driven_path(at.closure, at.linkage.angles, [0], at.linkage.angles[0] + [[0.3]]).angles[-1]
    several = circuit_through(at.closure, start, events=[TurningPoint(0)])
    monkeypatch.setattr(Ahead, "next", lambda ahead, walk: None)
    one_by_one = circuit_through(at.closure, start, events=[TurningPoint(0)])
    np.testing.assert_allclose(several.angles, one_by_one.angles, rtol=0, atol=1e-12)
    assert several.stopped == one_by_one.stopped
    assert [(event.kind, event.frame) for event in several.events] == [
        (event.kind, event.frame) for event in one_by_one.events
    ]


@needs_library
def test_newtons_method_is_that_of_python(monkeypatch):
    linkage = configuration_of_sheet(generate("miura", rows=5, columns=5, fold=0.7).mechanism).linkage
    for chance in range(4):
        start = linkage.angles + 10.0 ** -(chance + 1) * np.random.default_rng(chance).normal(size=len(linkage.angles))
        fast = corrected(ClosureEquations(linkage), start)
        monkeypatch.setattr(ClosureEquations, "corrected", lambda *_: None)
        slow = corrected(ClosureEquations(linkage), start)
        monkeypatch.undo()
        assert (fast.steps, fast.closed) == (slow.steps, slow.closed)
        np.testing.assert_allclose(fast.angles, slow.angles, rtol=0, atol=1e-12)
        np.testing.assert_allclose(fast.entries, slow.entries, rtol=0, atol=1e-11)
