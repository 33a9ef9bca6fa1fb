"""Tipparthi and Larochelle 2011: orientation order analysis of spherical four-bar mechanisms."""

from __future__ import annotations

from paper_rows.row import Row

_PRINTED = "data/orientations/tipparthi-as-printed.json"
_RIGHT = "data/orientations/tipparthi.json"
_CASE_1 = "--axis 0.054261,-0.996977,0.055603 --direction ccw --json"
_CASE_2 = "--axis -0.349442,-0.144163,0.925801 --direction cw --json"
_ANGLES = "{'S%d%d' % tuple(one['pair']): one['angle_deg'] for one in answer['crossings']}"
_OF_3 = "{'S%d%d' % tuple(one['pair']): one['angle_deg'] for one in answer['crossings'] if 3 in one['pair']}"
_DYADS = f"synth dyads --orientations {_RIGHT} --json"


def _nearest(axis: str) -> str:
    """Return the expression of the fixed axis nearest to one, with its sign."""
    return (
        f"(lambda g: (lambda n: [float(np.sign(np.dot(n, g)) * x) for x in n])("
        f"max((one['G'] for one in answer['dyads']), key=lambda n: abs(np.dot(n, g)))))({axis})"
    )


ROWS = [
    Row(
        "Figs. 1, 2",
        "mobility of two RR dyads with a coupler, a spherical 4R",
        "synth mobility data/tipparthi/spherical-4r.json --json",
        "answer[0]['mobility']",
        right=1,
        golden="002/hoop_case1",
    ),
    Row(
        "Table 1",
        "x1 of orientation M3",
        f"synth.linkages.guidance.orientations.read_orientations('{_RIGHT}').quaternions[2][1]",
        printed=0.041131,
        right=-0.041131,
        within=0.0000005,
        misprint="002-1",
        golden="002/table1",
        remark="with this sign both printed fixed axes are those of dyads; the columns are x0 to x3 (002-4)",
    ),
    Row(
        "Case study 1",
        "hoop angles, orientations as printed",
        f"synth order --orientations {_PRINTED} {_CASE_1}",
        _ANGLES,
        printed={
            "S23": 25.9,
            "S45": 45.4,
            "S25": 74.1,
            "S13": 80.2,
            "S24": 96.1,
            "S15": 129.4,
            "S14": 151.3,
            "S35": 154.1,
            "S34": 175.7,
        },
        within=0.05,
        golden="002/hoop_case1/",
        remark="scalar first, S_ij that of M_j M_i^-1 (002-3)",
    ),
    Row(
        "Case study 1",
        "whether there is an order defect",
        f"synth order --orientations {_PRINTED} {_CASE_1}",
        "not answer['in_order']",
        printed=True,
        words="order defect",
        golden="002/hoop_case1_sequence/order_defect",
    ),
    Row(
        "Case study 1",
        "hoop angles of M3, with its sign mended",
        f"synth order --orientations {_RIGHT} {_CASE_1}",
        _OF_3,
        printed={"S13": 80.2, "S23": 25.9, "S34": 175.7, "S35": 154.1},
        right={"S13": 75.445, "S23": 20.220, "S34": 171.510, "S35": 149.591},
        within=0.0005,
        misprint="002-2",
        golden="002/hoop_case1_corrected_M3",
        remark="still an order defect",
    ),
    Row(
        "Case study 2",
        "hoop angles, orientations as printed",
        f"synth order --orientations {_PRINTED} {_CASE_2}",
        _ANGLES,
        printed={
            "S35": 1.3,
            "S13": 14.4,
            "S45": 51.4,
            "S14": 68.9,
            "S23": 83.5,
            "S15": 97.0,
            "S24": 134.4,
            "S34": 152.5,
            "S25": 162.5,
        },
        within=0.05,
        golden="002/hoop_case2/",
    ),
    Row(
        "Case study 2",
        "whether there is an order defect",
        f"synth order --orientations {_PRINTED} {_CASE_2}",
        "not answer['in_order']",
        printed=False,
        words="no order defect",
        golden="002/hoop_case2_sequence/order_defect",
    ),
    Row(
        "Case study 2",
        "hoop angles of M3, with its sign mended",
        f"synth order --orientations {_RIGHT} {_CASE_2}",
        _OF_3,
        printed={"S13": 14.4, "S23": 83.5, "S34": 152.5, "S35": 1.3},
        right={"S13": 16.824, "S23": 82.336, "S34": 151.224, "S35": 179.339},
        within=0.0005,
        misprint="002-2",
        golden="002/hoop_case2",
        remark="still no order defect",
    ),
    Row(
        "Case study 1",
        "fixed axis, of the six dyads the nearest",
        _DYADS,
        _nearest("[0.054261, -0.996977, 0.055603]"),
        printed=[0.054261, -0.996977, 0.055603],
        within=0.00001,
        golden="002/burmester_corrected/G1",
        remark="found from the orientations alone",
    ),
    Row(
        "Case study 2",
        "fixed axis, of the six dyads the nearest",
        _DYADS,
        _nearest("[-0.349442, -0.144163, 0.925801]"),
        printed=[-0.349442, -0.144163, 0.925801],
        within=0.00001,
        golden="002/burmester_corrected/G2",
        remark="the only one of the six without an order defect",
    ),
    Row(
        "Theorem 1, Eqs. 1, 2",
        "verdicts by the hoop, by inequalities and by crank angles",
        f"synth order --orientations {_RIGHT} {_CASE_2}",
        "[answer['checks']['hoop'], answer['checks']['inequalities'], answer['checks']['crank_angles']]",
        printed=["cw", "cw", "cw"],
        words="the hoop order holds if and only if the crank angles grow",
        golden="002/hoop_theorem_mc",
        remark="Eq. 2 has n rows, ours n - 2: [equivalent](theory/order.md)",
    ),
    Row(
        "Theorem 1",
        "another order than that of the file, about the axis of case study 2: from the second orientation on",
        f"synth order --orientations {_RIGHT} {_CASE_2} --desired 2,3,4,5,1",
        "[answer['required'], answer['in_order']]",
        right=[[[2, 4], [2, 5], [1, 2], [1, 3]], True],
        words="any order",
        remark="a crank that takes 1 to 5 in order, turning all round, takes 2, 3, 4, 5, 1 too",
    ),
    Row(
        "Planar propeller, from which the hoop is made",
        "order of three positions on a crank at 0, 90, 240 degrees about a pivot: where the propeller passes P13, P23",
        "synth order --position 2,0,0 --position 0,2,20 --position -1,-1.7320508,70 --pivot 0,0 --json",
        "[one['angle_deg'] for one in answer['crossings']] + [answer['in_order']]",
        right=[75.0, 120.0, True],
        within=1e-4,
        words="the planar theorem",
        remark="half sums of crank angles, less that of P12: (240 - 90) / 2, 240 / 2; [why](theory/order.md)",
    ),
    Row(
        "Filemon, as quoted",
        "dyads of the six without an order defect, each looked at without the other of its four-bar",
        _DYADS,
        "[one['in_order'] for one in answer['dyads']].count(True)",
        right=1,
        golden="002/burmester_corrected",
        remark="order depends on the driving dyad alone ([order](theory/order.md))",
    ),
    Row(
        "Figs. 3 to 6",
        "link angles of the dyads of case studies 1 and 2, fixed to moving axis",
        _DYADS,
        "[(lambda d: min(d['link_angle_deg'], 180 - d['link_angle_deg']))(max(answer['dyads'], "
        "key=lambda d: abs(np.dot(d['G'], g)))) for g in ([0.054261, -0.996977, 0.055603], [-0.349442, -0.144163, 0.925801])]",
        second="[(lambda d: (lambda x: float(np.degrees(np.arccos(min(1, abs(x))))))(np.dot(d['G'], d['W'])))(max(answer['dyads'], "
        "key=lambda d: abs(np.dot(d['G'], g)))) for g in ([0.054261, -0.996977, 0.055603], [-0.349442, -0.144163, 0.925801])]",
        remark="not printed; axes reversed are the same axes, so angles up to 90 degrees",
    ),
]
