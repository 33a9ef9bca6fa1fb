"""Hyatt et al. 2021: methods for mapping mechanisms to developable surfaces."""

from __future__ import annotations

from paper_rows.row import Row

_TABLE_2 = "synth cone map --angles 70,80,120,40 --json"
_FIG_10 = "synth cylinder map --lengths 4,3,5,1 --json"

_PLACES = {1: (0, 40, 90, 140), 2: (0, 70, 200, 260)}
_LOOPS = {
    ("open", "A"): (1, 4, 3, 2), ("open", "B"): (2, 1, 4, 3), ("crossed 1", "A"): (1, 3, 4, 2),
    ("crossed 1", "B"): (1, 2, 4, 3), ("crossed 2", "A"): (2, 4, 1, 3), ("crossed 2", "B"): (1, 4, 2, 3),
}  # fmt: skip
"""Configuration and column to points O, A, B, C; ground is C O, coupler A B."""

_PRINTED = {
    (1, "open", "A"): "Y*, Y", (1, "open", "B"): "N, N", (1, "crossed 1", "A"): "Y, Y",
    (1, "crossed 1", "B"): "N, N", (1, "crossed 2", "A"): "N, N", (1, "crossed 2", "B"): "Y*, Y",
    (2, "open", "A"): "N, N", (2, "open", "B"): "N, N", (2, "crossed 1", "A"): "Y*, Y",
    (2, "crossed 1", "B"): "N, N", (2, "crossed 2", "A"): "N, N*", (2, "crossed 2", "B"): "N, N",
}  # fmt: skip
"""Intra- and extramobility as printed; a star where a chord that is a diameter makes it the other."""


def _table_4(case: int, configuration: str, column: str) -> Row:
    loop = [_PLACES[case][point - 1] for point in _LOOPS[configuration, column]]
    steps = [(b - a + 180) % 360 - 180 for a, b in zip(loop, loop[1:], strict=False)]
    words = _PRINTED[case, configuration, column]
    printed = words.startswith("Y")
    return Row(
        "Table 4",
        f"case {case}, {configuration}, {column}: intramobile, extramobile",
        f"synth cylinder behaviour --steps {','.join(map(str, steps))} --radius 1 --ground 4 --json",
        "[answer['linkages'][0]['table4'][key] for key in ('case', 'configuration', 'column')] "
        "+ [answer['linkages'][0][key] for key in ('intramobile', 'extramobile')]",
        printed=[case, configuration, column, printed, printed],
        words=words,
        golden="001/table4",
    )


ROWS = [
    Row(
        "Table 1, Eqs. 1 to 3",
        "whether T1 T2 T3 >= 0, and whether s + l <= p + q, of 4, 3, 5, 1",
        _FIG_10,
        "[bool(np.prod(answer['T']) >= 0), 1 + 5 <= 3 + 4, answer['grashof']]",
        printed=[True, True, "Grashof"],
        words="T1 T2 T3 >= 0 if and only if s + l <= p + q",
        golden="001/table1_eq1_3",
    ),
    Row(
        "Eq. 4, Fig. 10",
        "radius of 4, 3, 5, 1, open",
        _FIG_10,
        "answer['cylinders'][0]['radius']",
        printed=2.54,
        within=0.005,
        golden="001/fig10 001/eq4",
    ),
    Row(
        "Eq. 12, Fig. 10",
        "radius of 4, 3, 5, 1, crossed",
        _FIG_10,
        "answer['cylinders'][1]['radius']",
        printed=2.59,
        within=0.005,
        golden="001/fig10 001/eq12_mu_minus",
    ),
    Row(
        "Eq. 5",
        "R squared of 4, 3, 5, 1, crossed",
        _FIG_10,
        "answer['cylinders'][1]['radius'] ** 2",
        printed=-6.71282051282,
        words="(ad - bc), which makes it -6.7128",
        right=6.71282051282,
        misprint="001-1",
        golden="001/eq5",
    ),
    Row(
        "Eqs. 6 to 8",
        "lengths between the joints on the cylinder of Fig. 10",
        _FIG_10,
        "[float(np.hypot(*np.subtract(a, b))) for a, b in "
        "(lambda at: zip(at, at[1:] + at[:1]))(answer['cylinders'][0]['coordinates'])]",
        right=[4.0, 3.0, 5.0, 1.0],
        misprint="001-3",
        words="unknowns x1, y1, x2, y2, x3, y2",
        golden="001/eq6_8_fig10",
        remark="the system is right; the last unknown is y3",
    ),
    Row(
        "Eq. 11",
        "area of 4, 3, 5, 1, crossed",
        _FIG_10,
        "synth.surfaces.loop_sums.crossed_area(np.array([4.0, 3, 5, 1]))",
        second="abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in (lambda at: zip(at, at[1:] + at[:1]))"
        "(answer['cylinders'][1]['coordinates']))) / 2",
        words="K = sqrt(P1 P2 P3 P4) / 4",
        golden="001/eq11",
    ),
    Row(
        "Eq. 12, mu = -1",
        "crossed cylinders of 9, 5, 4, 3, non-Grashof",
        "synth cylinder map --lengths 9,5,4,3 --json",
        "[answer['grashof'], [one['circuit'] for one in answer['cylinders']]]",
        printed=["non-Grashof", ["open"]],
        words="not valid",
        remark="the formula has a real value, 1.4832, of no quadrilateral (001-2)",
    ),
    Row(
        "Section 3.1.1",
        "radii of 5, 1, 3, 4",
        "synth cylinder map --lengths 5,1,3,4 --json",
        "[one['radius'] for one in answer['cylinders']]",
        printed=[2.54, 2.59],
        words="the order of the links does not affect the radius: 2.54, 2.59",
        within=0.005,
        golden="001/eq12_permutation",
    ),
    Row(
        "Section 3.1.3",
        "least radius of 5, 3, 5, 3, crossed",
        "synth cylinder map --lengths 5,3,5,3 --json",
        "[one['radius'][0] for one in answer['families']]",
        printed=[2.5, 2.5],
        words="l / 2 <= R < infinity",
        golden="001/parallelogram_range",
        remark="no upper end",
    ),
    Row(
        "Table 2",
        "legs of 70, 80, 120, 40",
        _TABLE_2,
        "answer['chords']",
        printed=[1.147, 1.286, 1.732, 0.684],
        within=0.0005,
        golden="001/table2/legs",
    ),
    Row(
        "Table 2",
        "R, open",
        _TABLE_2,
        "answer['cones'][0]['R']",
        printed=0.90476,
        within=0.000005,
        golden="001/table2/R_open",
    ),
    Row(
        "Table 2",
        "R, crossed",
        "synth.surfaces.circumradii(2 * np.sin(np.radians([70, 80, 120, 40]) / 2)).crossed",
        printed=2.3064,
        within=0.00005,
        golden="001/table2/R_crossed",
        remark="larger than 1: no cone, so `synth cone map` does not list it",
    ),
    Row(
        "Table 2",
        "class of the spherical linkage",
        _TABLE_2,
        "answer['grashof']",
        printed="non-Grashof",
        golden="001/table2",
    ),
    Row(
        "Table 2",
        "class of the planar linkage",
        "synth cylinder map --lengths 1.147,1.286,1.732,0.684 --json",
        "answer['grashof']",
        printed="Grashof",
        golden="001/table2/planar",
    ),
    Row(
        "Fig. 3b",
        "cone angle of 70, 80, 120, 40",
        _TABLE_2,
        "[one['lambda_deg'] for one in answer['cones']]",
        printed=[25.21],
        within=0.005,
        golden="001/fig3",
    ),
    Row(
        "Eqs. 9, 10",
        "projected angle of the first link there",
        _TABLE_2,
        "answer['cones'][0]['steps_deg'][0]",
        second="(lambda phi, lam: np.degrees(np.arccos((np.cos(phi) - np.sin(lam) ** 2) / np.cos(lam) ** 2)))"
        "(np.radians(70), np.radians(answer['cones'][0]['lambda_deg']))",
        misprint="001-4",
        words="cos alpha",
        golden="001/eq9",
        remark="cos phi",
    ),
    Row(
        "Eqs. 13, 14, 17, 18",
        "cone angle by the radius of the chords, arccos R",
        _TABLE_2,
        "np.degrees(np.arccos(answer['cones'][0]['R']))",
        printed=25.21,
        within=0.005,
        golden="001/eq13_14 001/eq17_18",
    ),
    Row(
        "Eqs. 15, 16",
        "least R and largest lambda with a link of 120 degrees",
        "synth cone map --angles 120,50,120,50 --json",
        "[float(np.cos(np.radians(answer['families'][0]['lambda_deg'][1]))), answer['families'][0]['lambda_deg'][1]]",
        right=[0.866025403784, 30.0],
        golden="001/eq15_16",
    ),
    Row(
        "Section 3.2.3",
        "R and cone angle of 100, 70, 90, 60, crossed",
        "synth cone map --angles 100,70,90,60 --json",
        "[answer['flat'][0]['R'], answer['flat'][0]['lambda_deg'], answer['flat'][0]['circuit']]",
        printed=[1.0, 0.0, "crossed"],
        words="R = 1, cone angle 0",
        golden="001/folding_R1 001/folding_R1_mc",
    ),
    Row(
        "Sections 3.1.2, 6",
        "class of 3.1, 2.3, 3.9, 0.8, crossed on a cylinder",
        "synth cylinder map --lengths 3.1,2.3,3.9,0.8 --json",
        "[answer['grashof'], answer['cylinders'][1]['circuit']]",
        printed=["Grashof", "crossed"],
        words="a crossed developable mechanism is always Grashof",
        golden="001/grashof_claim_planar",
        remark="holds for 20 000 random ones, in the tests",
    ),
    Row(
        "Sections 3.2.3, 6",
        "class of a crossed linkage on a cone",
        "synth cone map --angles 130.371566191,116.783338835,124.018218564,135.462511009 --json",
        "[answer['grashof'], answer['cones'][0]['circuit']]",
        printed=["Grashof", "crossed"],
        words="a crossed developable mechanism is always Grashof",
        right=["non-Grashof", "crossed"],
        misprint="001-6",
        golden="000/counterexample_T4neg_crossed",
    ),
    Row(
        "Eqs. 19, 20",
        "sum of the central angles of Fig. 10, open",
        _FIG_10,
        "sum(answer['cylinders'][0]['steps_deg'])",
        right=360.0,
        misprint="001-5",
        words="psi_a twice, psi_g left out",
        golden="001/eq20",
    ),
    Row(
        "Fig. 10, Eq. 20",
        "signs and sum of an open loop without the centre, 9, 5, 4, 3",
        "synth cylinder map --lengths 9,5,4,3 --json",
        "[answer['cylinders'][0]['circuit'], answer['cylinders'][0]['signs'], answer['cylinders'][0]['k']]",
        right=["open", [1, -1, -1, -1], 0],
        misprint="001-7",
        words="++++ = 360",
    ),
    *(_table_4(*key) for key in _PRINTED),
    Row(
        "Section 5.2, Table 4 *",
        "case 1, open, A, with a chord that is a diameter: what each arc of the half turn allows",
        "synth cylinder behaviour --steps 40,50,90 --radius 1 --json",
        "[[one['intramobile'], one['extramobile']] for one in answer['linkages'][0]['choices']]",
        printed=[[False, True], [False, False]],
        words="a link that spans half a turn may curve either way, one at a time; intramobility is lost",
        golden="001/table4_finite_motion",
    ),
    Row(
        "Table 3",
        "cases of four-bars on a cone or cylinder",
        "synth enumerate conical --chain four-bar --ground 0 --opposites --json",
        "len(answer)",
        right=16,
        slow=True,
        remark="12 up to an exchange of ground and coupler, which Tables 3 and 4 do not tell apart; both are listed. "
        "Which picture is A or B, crossed 1 or 2, is in the figure only",
        golden="001/table4",
    ),
    Row(
        "Figs. 1a, 4",
        "a linkage on its cylinder, written and moved: radius of Fig. 10",
        "synth cylinder move fig-10.json --json",
        "answer['linkages'][0]['radius']",
        printed=2.54,
        within=0.005,
        first=("synth cylinder map --lengths 4,3,5,1 --cylinder 1 -o fig-10.json --force",),
        slow=True,
        golden="001/fig10",
        remark="the lengths of Figs. 1a and 4 are not at hand; those of Fig. 10 are",
    ),
    Row(
        "Figs. 1, 4 to 9",
        "their linkages with their own dimensions",
        why="the dimensions are in the figures only, which are not at hand",
    ),
    Row(
        "Scope",
        "tangent developables, cones and cylinders that are not circular",
        why="not asked for: joints of such linkages lie on no circle ([mapping](theory/mapping.md))",
    ),
]
