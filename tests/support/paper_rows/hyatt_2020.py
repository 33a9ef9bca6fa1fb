"""Hyatt, Magleby, Howell 2020: developable mechanisms on right conical surfaces."""

from __future__ import annotations

from paper_rows.row import Row

_MOVED = (
    "synth cone move --steps 50,110,80 --lambda 20 --ground 4 --at 5 "
    "--point 1,0 --point 1,50 --point 3,160 --point 3,240 --axes 2,4 --json"
)
_AT = "answer['linkages'][0]['positions'][0]"

ROWS = [
    Row(
        "Eqs. 1 to 4",
        "T1 to T4 of the links 85, 120, 95, 45 (ground, input, coupler, output)",
        "synth cone map --angles 85,120,95,45 --json",
        "answer['T_deg']",
        right=[15.0, -85.0, -65.0, 15.0],
        golden="000/fig10a_T",
        remark="the class is printed, the values are not",
    ),
    Row(
        "Fig. 10a, section 5",
        "class, number of cones of 120, 95, 45, 85",
        "synth cone map --angles 120,95,45,85 --json",
        "[answer['grashof'], len(answer['cones'])]",
        printed=["Grashof", 2],
        words="Grashof, two cone angles",
        golden="000/fig10a_cones",
    ),
    Row(
        "Fig. 10b, section 5",
        "class, number of cones of 155, 50, 65, 80",
        "synth cone map --angles 155,50,65,80 --json",
        "[answer['grashof'], len(answer['cones'])]",
        printed=["non-Grashof", 1],
        words="non-Grashof, one cone angle",
        golden="000/fig10b_cones 000/fig10b_T",
    ),
    Row(
        "Fig. 10c, section 5",
        "class, cones, cones of angle zero of 100, 70, 90, 60",
        "synth cone map --angles 100,70,90,60 --json",
        "[answer['grashof'], len(answer['cones']), len(answer['flat'])]",
        printed=["folding", 1, 1],
        words="folding: up to one non-zero cone angle and one of zero",
        golden="000/fig10c_cones 000/fig10c_T",
    ),
    Row(
        "Fig. 10d, section 5",
        "whether 120, 50, 120, 50 lies on all cones of an interval",
        "synth cone map --angles 120,50,120,50 --json",
        "[family['lambda_deg'][0] < family['lambda_deg'][1] for family in answer['families']]",
        printed=[True, True],
        words="two sets of equal angles: infinitely many cone angles",
        golden="000/fig10d_T",
        remark="two families, each from 0 to 30 degrees",
    ),
    Row(
        "Eq. 5",
        "link angle of a step of 40 degrees, lambda = 20 degrees",
        "synth cone map --steps 40,50,50 --lambda 20 --json",
        "answer['cones'][0]['link_angles_deg'][0][2]",
        right=37.4944745021,
        golden="000/eq5",
        second="np.degrees(np.arccos(np.sin(np.radians(20)) ** 2 + np.cos(np.radians(20)) ** 2 * np.cos(np.radians(40))))",
        remark="`-o` writes the linkage to a file",
    ),
    Row(
        "Eq. 7",
        "largest cone angle of links 120, 155, 100 degrees",
        "np.degrees(synth.linkages.surfaces.loop_maps.largest_cone_angle(np.radians([120, 155, 100])))",
        misprint="000-10",
        words="any lambda from 0 to 90 degrees",
        right=[30.0, 12.5, 40.0],
        golden="000/eq7_domain",
    ),
    Row(
        "Eqs. 8 to 11, 17",
        "joint axis O, lambda = 20 degrees",
        "synth.linkages.conformed.joint_axes([0.0], np.radians(20))[0]",
        right=[0.0, -0.342020143326, 0.939692620786],
        misprint="000-9",
        words="garbled at hand",
        golden="000/eq17",
    ),
    Row(
        "Table 1",
        "circuits of steps 100, -50, 100; 90, 80, 100; 50, 40, 30; 170, 170, 170: one of each row",
        "[str(synth.linkages.surfaces.circuits(np.radians(steps)).names()) for steps in "
        "([100, -50, 100, -150], [90, 80, 100, 90], [50, 40, 30, -120], [170, 170, 170, -150])]",
        printed=["open", "crossed", "crossed", "open"],
        right=["crossed", "open", "open", "crossed"],
        misprint="000-1",
        golden="000/table1",
    ),
    Row(
        "Table 2, Eqs. 13, 14",
        "sign of the dihedral angle between links with steps 40 and 60; 40 and -20; -40 and 60",
        "[int(np.sign(synth.linkages.conformed.dihedral_angles(np.radians([a, b, -a - b]), np.radians(20))[1])) "
        "for a, b in ((40, 60), (40, -20), (-40, 60))]",
        printed=[-1, 1, 1],
        right=[1, -1, -1],
        misprint="000-3, 000-4",
        golden="000/table2_eq13_14",
    ),
    Row(
        "Section 2.3",
        "other linkages on the joint lines of 85, 120, 95, 45",
        "synth cone map --angles 85,120,95,45 --supplementary --json",
        "len(answer['linkages']) - 1",
        printed=15,
        slow=True,
        remark="7 have other link angles (000-7)",
    ),
    Row(
        "Section 2.4, Fig. 3",
        "instant axis of the coupler against the fixed link, input turned by 5 degrees, steps 50, 110, 80, lambda = 20 degrees",
        _MOVED,
        f"(lambda p: [round(float(x), 9) for x in p * np.sign(p[2])])(np.array({_AT}['instant_axes'][0]['direction']))",
        second=f"(lambda o, a, b, c: (lambda p: p / np.linalg.norm(p) * np.sign(p[2]))(np.cross(np.cross(o, a), "
        f"np.cross(c, b))))(*[point['place'] for point in {_AT}['points']])",
        remark="by the line in which the planes of input and output meet",
    ),
    Row(
        "Section 3, T4 < 0",
        "cones of the link angles that steps 150, -130, 140, -160 make at lambda = 20 degrees",
        "synth cone map --steps 150,-130,140,-160 --lambda 20 --by-angles --json",
        "len(answer['cones'])",
        printed=0,
        words="cannot be mapped to a right cone",
        right=1,
        misprint="000-6",
        golden="000/counterexample_T4neg_crossed",
        remark="T4 = -146.6, non-Grashof; the cone of 20 degrees, crossed. The section ends with a cylinder where a cone is meant (000-11)",
    ),
    Row(
        "Sections 3, 5, T4 > 0",
        "numbers of cones of Grashof and of non-Grashof linkages with T4 > 0, of 5 000 random linkages that lie on a cone",
        "(lambda random: synth.linkages.surfaces.link_angles((lambda at: np.roll(at, -1, axis=1) - at)"
        "(random.uniform(-np.pi, np.pi, (5000, 4))), random.uniform(0.05, 1.4, (5000, 1))))(np.random.default_rng(1))",
        "(lambda t, cones: [np.unique(np.sum(np.isfinite(cones), axis=0)[(t[:, 3] > 0) & (sign * t.prod(axis=1) > 0)]) "
        "for sign in (1, -1)])(synth.linkages.fourbar.closing.spherical_differences(answer), "
        "(lambda found: [found.open, found.crossed])(synth.linkages.surfaces.cone_angles(answer)))",
        printed=[[2], [1]],
        words="Grashof two cones, non-Grashof one",
        golden="000/cone_count_claim",
    ),
    Row(
        "Section 4, Fig. 9",
        "direction of the coupler's ICRL on the circle, and of its instant axis seen along the cone",
        "synth cone behaviour --steps 50,110,80 --lambda 20 --ground 4 --json",
        "next(link['icrl_deg'] for link in answer['linkages'][0]['links'] if link['link'] == 2) % 180",
        second="(lambda o, a, b, c: (lambda p: np.degrees(np.arctan2(p[0], p[2])) % 180)(np.cross(np.cross(o, a), "
        "np.cross(c, b))))(*synth.linkages.conformed.joint_axes(np.radians([0, 50, 160, 240]), np.radians(20)))",
        words="the projection of the pole axis goes through the circle's centre and the planar instant centre",
        golden="000/icrl_projection",
    ),
    Row(
        "Section 6, Eq. 19",
        "joint A there",
        _MOVED,
        f"{_AT}['points'][1]['place']",
        right=[0.727113066918, -0.282654488077, 0.625630105003],
        golden="000/pos_open_sample",
    ),
    Row(
        "Section 6, Eqs. 21, 23",
        "joint B there",
        _MOVED,
        f"{_AT}['points'][2]['place']",
        right=[0.329179397983, -0.395976860063, -0.857229986782],
        misprint="000-2",
        words="Eq. 21 and Eq. 23 give the same B",
        golden="000/pos_open_sample 000/pos_monte_carlo",
        remark="with the printed signs of gamma_0 and beta_0 they differ by about a radius",
    ),
    Row(
        "Section 6",
        "angle of the output there, less that at the conformed position",
        _MOVED,
        f"abs({_AT}['joint_angles_deg']['4'])",
        right=3.5896533261,
        misprint="000-5",
        words="psi = 180 - theta between gamma and beta",
        golden="000/pos_open_sample",
        remark="between beta and gamma, in loop order",
    ),
    Row(
        "Fig. 11",
        "projected angles of a Stephenson linkage, O to F",
        "synth cone map data/surfaces/fig11-stephenson.json --json",
        "(lambda at: [at[b] - at[a] for a, b in zip('OABCDE', 'ABCDEF')])(answer['cones'][0]['azimuths_deg'])",
        printed=[-40.0, -20.0, -45.0, -68.0, 28.0, 30.0],
        golden="000/fig11_stephenson2/projected",
        remark="an open chain through the seven axes, which closes with 115 (000-8)",
    ),
    Row(
        "Fig. 11",
        "degrees of freedom",
        "synth mobility data/hyatt/fig11-stephenson.json --json",
        "answer[0]['mobility']",
        right=1,
        golden="000/fig11_stephenson2",
        remark="which axes form the four-bar and which the five-bar is in the figure only: 15 ways fit",
    ),
    Row(
        "Fig. 10",
        "curves of the loop sums, with their legends",
        why="the legends are in the figure only; `synth cone map --angles 120,95,45,85 -o sums.svg` draws ours",
    ),
]
