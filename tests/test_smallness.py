"""What is zero is decided in one place: no decompositions elsewhere, and no constants beside the table.

Ranks and null spaces are those of `graphs.rank`, planes and rotations those of `graphs.geometry`. Lengths, angles, rates
and singular values are compared with fields of `graphs.tolerances.Tolerances`. The trees of all modules are walked.
"""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
SOURCES = {
    path.relative_to(ROOT).as_posix(): path
    for package in ("graphs", "enumerate", "synth")
    for path in sorted((ROOT / package).rglob("*.py"))
}

DECOMPOSITIONS = {"svd", "svdvals", "null_space", "matrix_rank", "orth"}
DECOMPOSING = ("graphs/rank/", "graphs/geometry.py")
"""Where matrices may be taken apart."""
DECIDING = ("graphs/tolerances.py", "graphs/geometry.py", "graphs/rank/singular_values.py")
"""Where constants may say what is zero."""
UNITS = {"LEAST", "EPSILON", "EPS", "eps"}
"""Names that make a small constant of what they are multiplied with."""
SMALL = 1e-3
"""Literals up to a thousandth are small, and powers of ten written as such."""
MAYBE_SMALL = re.compile(r"e-|\.0|" + "|".join(UNITS), re.IGNORECASE)
"""A file without any of these has no small constant: its tree is not walked."""

EXEMPT = {
    ("synth/analysis/layering/needed_precision.py", "COARSEST"): "coarsest precision that a refusal proposes",
    ("graphs/convert/hinges.py", "_SHORTEST"): "least divisor",
    ("graphs/convert/faces.py", "_OVERLAP"): "part of an area that is covered twice",
    ("graphs/convert/tracing.py", "TOLERANCES"): "welding distances that are tried in turn",
    ("graphs/convert/tracing.py", "_SAME"): "grid that parts points found twice, in welding distances",
    ("graphs/input_limits.py", "LEAST"): "least extent of coordinates",
    ("graphs/input_limits.py", "_THIN"): "what rounding leaves of a line",
    ("graphs/files/solids/gltf.py", "_METRES"): "units of length",
    ("graphs/joints/linkage.py", "_RIGHT"): "angle at which a file is refused",
    ("graphs/joints/revolutes.py", "_FLAT"): "how clear a spherical joint must be",
    ("graphs/mechanism/sheet.py", "COLLINEAR"): "snapping distance of drawings, the finest that is tried",
    ("graphs/rank/dissection.py", "_CHECKED"): "range in which a second count is made",
    ("graphs/rank/infinitesimal.py", "_SPREAD"): "how far off a plane is nearly flat",
    ("synth/analysis/assembly/ends.py", "_LEVENBERG"): "regularisation of steps",
    ("synth/synthesis/atlas/signatures.py", "_SHORTEST"): "motion that is too short for a signature",
    ("synth/synthesis/atlas/axis_fit.py", "_FITTING"): "step of differences, end of an iteration",
    ("synth/synthesis/atlas/in_order.py", "_REFINING"): "step of differences",
    ("synth/linkages/guidance/sixbars.py", "_OPEN"): "room at a transmission angle of 1.8 degrees",
    ("synth/linkages/guidance/sixbars.py", "_SMALLEST"): "size of a random change",
    ("synth/analysis/members/circuits.py", "_FIRST"): "length of a step that finds rates",
    ("synth/analysis/members/circuits.py", "_SHORTEST"): "length of a step at which a circuit is given up",
    ("synth/analysis/assembly/ends.py", "_NEAR_END"): "distance in which a singular configuration is looked for",
    ("synth/analysis/assembly/general.py", "_LINEAR"): "second difference of a trace that is linear",
    ("synth/analysis/assembly/kernel.py", "_LEAST"): "least step along a path",
    ("synth/analysis/assembly/precise.py", "_LEAST"): "least step along a path",
    ("synth/analysis/assembly/precise.py", "_NUDGE"): "step of differences",
    ("synth/analysis/assembly/redundant.py", "_BENT"): "part of a step by which an elbow bends",
    ("synth/analysis/assembly/kernel.py", "_NUDGE"): "step of differences",
    ("synth/analysis/compliance/springs.py", "_BALANCED"): "end of an iteration",
    ("synth/analysis/compliance/springs.py", "_DOWN"): "length of a step",
    ("synth/analysis/compliance/springs.py", "_SOFT"): "length of a step",
    ("synth/analysis/compliance/springs.py", "_NUDGE"): "step of differences",
    ("synth/synthesis/designing/designs.py", "_MET"): "what is told as met",
    ("synth/synthesis/designing/search.py", "SEARCH"): "regularisation of steps, end of an iteration",
    ("synth/synthesis/designing/search.py", "_ANGLES"): "end of an iteration",
    ("synth/synthesis/designing/search.py", "_CLOSED"): "regularisation of steps, end of an iteration",
    ("synth/synthesis/designing/targets.py", "_COMPLEX"): "step of differences",
    ("synth/synthesis/designing/quadrilaterals.py", "IMAGINARY"): "imaginary step of exact derivatives",
    ("synth/synthesis/designing/targets.py", "_STEP"): "step of differences",
    ("synth/synthesis/designing/tracing.py", "_SAME"): "how well two methods agree",
    ("synth/making/drawing/sphere.py", "_ROUND"): "simplified outlines of a drawing",
    (
        "synth/analysis/folding/mending/fitting.py",
        "_CLOSING",
    ): "regularisation of a step, weight of a held joint, end of an iteration",
    ("synth/analysis/motion/branches.py", "_SAME"): "how well points of multiplicity are known",
    ("synth/analysis/motion/singular/certificate.py", "_NEARLY_REAL"): "which points are tried as real ones first",
    ("synth/analysis/motion/singular/certificate.py", "_LEAST_WIDTH"): "width of a box, as that of rounding",
    ("synth/analysis/motion/singular/elimination.py", "_NEARLY_REAL"): "which eigenvalues are tried as real",
    ("synth/analysis/motion/singular/elimination.py", "_SAME"): "how well points of multiplicity are known",
    ("synth/analysis/motion/singular/homotopy.py", "_ALIKE"): "end of an iteration",
    ("synth/analysis/motion/singular/homotopy.py", "_LEAST"): "length of a step at which a path is given up",
    ("synth/analysis/motion/singular/homotopy.py", "_NEAR"): "error of a step",
    ("synth/analysis/motion/singular/homotopy.py", "_ROUNDED"): "end of an iteration",
    (
        "synth/analysis/motion/singular/mode_count.py",
        "_AGREE",
    ): "how well proportions agree that are known to 1e-9 each",
    ("synth/analysis/motion/singular/monodromy.py", "_SAME"): "how well two points of a plane agree",
    ("synth/analysis/motion/singular/immobile.py", "_FIGURES"): "which shares make a candidate, which is proved then",
    ("synth/analysis/folding/mending/near_mechanisms.py", "_FARTHER"): "errors of a coordinate that are tried in turn",
    ("synth/linkages/guidance/synthesis.py", "NEARLY_REAL"): "where a search begins",
    ("synth/linkages/guidance/synthesis.py", "SOLVED"): "end of an iteration",
    ("synth/linkages/guidance/dyads.py", "_UNIT"): "which roots are tried",
    ("synth/linkages/guidance/order.py", "_FITS"): "misfit that a note tells of, by digits as printed",
    ("synth/linkages/guidance/orientations.py", "_NORM_TOLERANCE"): "digits as printed: more is refused",
    ("synth/analysis/members/member_kernel.py", "LEAST"): "least step of a driven joint",
    ("synth/analysis/motion/derivatives.py", "_ALIKE"): "how well two methods agree",
    ("synth/analysis/motion/derivatives.py", "_COMPLEX"): "step of differences",
    ("synth/analysis/motion/derivatives.py", "_NUDGE"): "step of differences",
    ("synth/analysis/motion/tangent.py", "REGULAR"): "regularisation of a step",
    ("synth/analysis/motion/tangent.py", "_LEFT"): "end of an iteration",
    ("synth/analysis/motion/tangent.py", "_SETTLED"): "end of an iteration",
    ("synth/analysis/motion/tangent.py", "_UNSETTLED"): "end of an iteration",
    ("synth/analysis/motion/singular/second_order.py", "_GAINS"): "end of an iteration",
    ("synth/analysis/motion/singular/second_order.py", "_NEAR"): "end of an iteration",
    ("synth/analysis/motion/singular/sampling.py", "_NUDGE"): "step of differences",
    ("synth/analysis/motion/singular/sampling.py", "_ROUNDED"): "end of an iteration",
    ("synth/analysis/motion/walk/events.py", "_FLAT"): "angles that are tried, and taken if loops close",
    ("synth/analysis/motion/walk/events.py", "_NUDGE"): "step of differences",
    ("synth/analysis/motion/walk/step.py", "_EXACT"): "end of an iteration",
    ("synth/analysis/motion/walk/step.py", "_ROUGH"): "end of an iteration",
    ("synth/analysis/motion/walk/walking.py", "_FLOOR"): "fold angle that is left where others want a crease unfolded",
    ("synth/analysis/motion/walk/step.py", "_AT_END"): "part of a step",
    ("synth/analysis/motion/walk/step.py", "_NEAR"): "end of an iteration",
    ("synth/analysis/motion/walk/walking.py", "_LEAST"): "least step along a curve",
    ("synth/analysis/overconstraint/redundancy.py", "_NUDGE"): "step of differences",
    ("synth/catalogue/patterns/hinged_rings.py", "_APART"): "bound of a generator",
    ("synth/catalogue/patterns/hinged_rings.py", "_NUDGE"): "step of differences",
    ("synth/catalogue/realisation/drawing.py", "_APART"): "how far apart centres of a drawing are to be",
    (
        "synth/catalogue/realisation/drawing.py",
        "_SHAPING",
    ): "regularisation of steps, what they leave out, end of an iteration",
    ("synth/catalogue/realisation/_realise.py", "_LARGEST"): "bound of a size",
    ("synth/catalogue/realisation/_realise.py", "_SMALLEST"): "bound of a size",
    ("synth/catalogue/realisation/space.py", "_WIDER"): "part of an area",
    ("synth/catalogue/realisation/special/families.py", "_CONDITIONS"): "regularisation of steps, end of an iteration",
    ("synth/making/simulation/mjcf.py", "STEP"): "time of a step",
    ("synth/making/simulation/mjcf.py", "_LIGHTEST"): "bound of a simulator",
    ("synth/making/simulation/step.py", "_ACCURACY"): "accuracy that a file states",
    ("synth/making/simulation/mjcf.py", "_SOLVER"): "end of an iteration of a simulator",
    ("synth/making/simulation/mjcf.py", "_STIFF"): "stiffness of a simulator",
    ("synth/linkages/surfaces/loop_sums.py", "_MOST_SENSITIVE"): "greatest growth of rounding, a large number",
    ("synth/linkages/surfaces/mapping.py", "_VAGUE"): "digits below which a caution is told",
    ("synth/synthesis/tasks/ranking.py", "WITHIN"): "what is told as met",
    ("synth/making/templates/pieces.py", "_NEAR"): "millimetres of a drawing",
    ("synth/making/templates/pieces.py", "_GRID"): "grid of overlays",
    ("synth/making/templates/pieces.py", "_OVERLAP"): "part of an area that is covered twice",
    ("synth/making/templates/pieces.py", "_SLIT"): "millimetres of a drawing",
    ("synth/making/templates/hinges.py", "_SPECK"): "square millimetres of a drawing",
    ("synth/making/templates/hinges.py", "_STRAIGHT"): "millimetres of a drawing",
    ("synth/making/templates/hinges.py", "_THIN"): "millimetres of a drawing",
    ("synth/making/templates/nets.py", "_SAME"): "millimetres of a drawing",
    ("synth/making/templates/pieces.py", "GRID"): "grid of overlays, millimetres",
    ("synth/making/templates/pieces.py", "_INSIDE"): "millimetres of a drawing",
    ("synth/making/templates/template.py", "_UNITS"): "units of length",
    ("synth/making/templates/solids.py", "_RIGID"): "how far a panel may be out of shape",
    ("synth/making/templates/solids.py", "_STRAIGHT"): "millimetres of a drawing",
    ("synth/making/templates/pages.py", "_TINY"): "part of a page",
    ("synth/making/templates/laser.py", "_CLOSED"): "millimetres of a drawing",
    ("synth/making/templates/laser.py", "_NEAR"): "millimetres of a drawing",
}
"""Module constants that are small and decide nothing that is zero, with their reasons."""


def decompositions(source):
    """Lines in which a matrix is taken apart by numpy or scipy, called or only named."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Attribute) and node.attr in DECOMPOSITIONS:
            yield node.lineno
        elif isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] in ("numpy", "scipy"):
            yield from (node.lineno for alias in node.names if alias.name in DECOMPOSITIONS)


def is_small(node, source):
    """Whether an expression holds a small literal, or a product with a small unit."""
    for inner in ast.walk(node):
        if isinstance(inner, ast.Constant) and isinstance(inner.value, float):
            if 0.0 < inner.value <= SMALL:
                return True
            text = ast.get_source_segment(source, inner) if inner.value <= 1.0 else None
            if text is not None and text.lower().startswith(("1e-", "1.0e-")):
                return True
        elif isinstance(inner, ast.BinOp):
            sides = {getattr(side, "id", getattr(side, "attr", "")) for side in (inner.left, inner.right)}
            if isinstance(inner.op, (ast.Mult, ast.Div, ast.Pow)) and sides & UNITS:
                return True
    return False


def small_constants(source):
    """Names of the module constants that are small, one by one where several are set at once."""
    for node in ast.parse(source).body:
        if isinstance(node, ast.Assign):
            targets, value = node.targets, node.value
        elif isinstance(node, ast.AnnAssign) and node.value is not None:
            targets, value = [node.target], node.value
        else:
            continue
        for target in targets:
            if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple):
                pairs = zip(target.elts, value.elts, strict=True)
            else:
                pairs = [(target, value)]
            yield from (ast.unparse(name) for name, one in pairs if is_small(one, source))


def test_matrices_are_taken_apart_in_one_place():
    found = {
        name: lines
        for name, path in SOURCES.items()
        if not name.startswith(DECOMPOSING)
        and any(word in (text := path.read_text(encoding="utf-8")) for word in DECOMPOSITIONS)
        and (lines := list(decompositions(text)))
    }
    assert found == {}


def test_no_constant_beside_the_table_says_what_is_zero():
    found = {
        (name, constant)
        for name, path in SOURCES.items()
        if not name.startswith(DECIDING)
        if MAYBE_SMALL.search(text := path.read_text(encoding="utf-8"))
        for constant in small_constants(text)
    }
    assert sorted(found - set(EXEMPT)) == []
    assert sorted(set(EXEMPT) - found) == [], "exempt, and no longer there"


@pytest.mark.parametrize(
    ("source", "names"),
    [
        ("_ZERO = 1e-9", ["_ZERO"]),
        ("_FIRST, _LEAST = 0.1, 1e-6", ["_LEAST"]),
        ("_ALL: tuple[float, ...] = (1.0, 1e-2)", ["_ALL"]),
        ("from x import EPSILON\n_NOISE = 8 * EPSILON", ["_NOISE"]),
        ("_ANGLE = radians(1e-4)", ["_ANGLE"]),
        ("_PLAIN = 0.0001", ["_PLAIN"]),
        ("_HALF, _MOST = 0.5, 1e3", []),
        ("def f(x):\n    step = 1e-6\n    return x", []),
    ],
)
def test_small_constants_are_seen(source, names):
    assert list(small_constants(source)) == names


@pytest.mark.parametrize(
    ("source", "seen"),
    [
        ("np.linalg.svd(a)", True),
        ("take_apart = scipy.linalg.null_space", True),
        ("from numpy.linalg import matrix_rank", True),
        ("from graphs.rank.singular_values import null_space\nnull_space(a)", False),
    ],
)
def test_decompositions_are_seen(source, seen):
    assert bool(list(decompositions(source))) == seen
