"""Wiener 2016, master's thesis: spherical system linkages."""

from __future__ import annotations

from paper_rows.row import Row

_M = "answer[0]['mobility']"
_KEYS = {"N": "['links']", "J": "['joints']", "V": "['counts']['vertices']", "C": "['counts']['implicit_centres']",
         "E_ext": "['counts']['external_edges']", "E_int": "['counts']['internal_edges']", "M": "['mobility']",
         "lam": ""}  # fmt: skip


def _counted(place: str, name: str, figures: str, golden: str, what: str = "", **more: str) -> Row:
    """Return a row that counts a file; figures read ``"N 6 J 7 M 1"``."""
    words = figures.split()
    keys, numbers = words[::2], [int(word) for word in words[1::2]]
    return Row(
        place,
        f"{', '.join(keys)}{' of ' if what else ''}{what}",
        f"synth mobility data/wiener/{name}.json --json",
        f"[{', '.join(f'answer[0]{_KEYS[key]}' for key in keys)}]",
        printed=numbers,
        golden=f"003/{golden}",
        **more,
    )


def _arranged(name: str, as_printed: str) -> Row:
    return Row(
        "Tables 4, 5",
        f"Bowen's class of data/wiener/{name}",
        f"synth mobility data/wiener/{name} --json",
        "answer[0]['arrangement']",
        right=as_printed,
        remark="the tables have pictures of classes, and no figures",
    )


ROWS = [
    *(
        Row(
            "Table 1, Eq. 1",
            f"mobility of a {kind} six-bar loop",
            f"synth mobility data/wiener/six-bar-loop-{kind}.json --json",
            "[answer[0]['mobility'], answer[0]['equations']['traditional_cgk']['value']]",
            printed=[m, m],
            words=str(m),
            golden="003/table1",
        )
        for kind, m in (("planar", 3), ("spherical", 3), ("spatial", 0))
    ),
    Row(
        "Text below Eq. 1",
        "mobility of the spherical and of the spatial loop of Table 1",
        "[synth.mobility(synth.read(name)).mobility for name in "
        "('data/wiener/six-bar-loop-spherical.json', 'data/wiener/six-bar-loop-spatial.json')]",
        printed=[0, 3],
        right=[3, 0],
        misprint="003-1",
        golden="003/table1",
    ),
    Row(
        "Eq. 1",
        "slider-crank in a plane: Eq. 1 (lambda = 3), random member",
        "synth mobility data/joints/slider-crank.json --json",
        "[answer[0]['equations']['traditional_cgk']['value'], answer[0]['counts']['general_member']]",
        right=[1, 1],
        remark="3 (4 - 1) - 4 (3 - 1)",
    ),
    Row(
        "Eq. 1",
        "the same joints in space: Eq. 1 (lambda = 6)",
        "synth mobility data/joints/slider-crank-in-space.json --json",
        "answer[0]['equations']['traditional_cgk']['value']",
        right=-2,
        remark="6 (4 - 1) - 4 (6 - 1)",
    ),
    Row(
        "Eq. 1",
        "slider-crank with arms 1.41421 and 2.23607, its crank turned by 20 degrees: slides from where it was",
        "synth positions data/joints/slider-crank-placed.json --drive 0=20 --no-circuits --json",
        "sorted(-one['lengths']['3'] for one in answer['positions'])",
        second="(lambda x, y: [x - 3 - (5 - y * y) ** 0.5, x - 3 + (5 - y * y) ** 0.5])"
        "(2 ** 0.5 * np.cos(np.radians(65)), 2 ** 0.5 * np.sin(np.radians(65)))",
        remark="by the circle of the rod",
        slow=True,
    ),
    Row(
        "Table 1, planar loops",
        "coupler point of a planar four-bar in motion: distances to the coupler's joints before and after",
        "synth cylinder move --lengths 4,3,5,1 --at 0,10 --point 3,250 --point 2,176.6291739194 --point 4,-22.7406449519 --json",
        "[float(np.linalg.norm(np.subtract(at['points'][0]['place'], at['points'][k]['place']))) "
        "for at in answer['linkages'][0]['positions'] for k in (1, 2)]",
        second="[2 * answer['linkages'][0]['radius'] * np.sin(np.radians(arc / 2)) "
        "for arc in (250 - 176.6291739194, 360 - 22.7406449519 - 250)] * 2",
        remark="by the circle that it was on",
        slow=True,
    ),
    Row(
        "Section 2.3.3",
        "external and internal edges of a link with six sides",
        "graphs.convert.panels.scd_from_panels({'link': tuple('ABCDEF')}).counts",
        "[answer.external_edges, answer.internal_edges]",
        printed=[6, 6],
        golden="003/polyhedron_link",
    ),
    *(
        _counted("Table 2, Section 3.3.5", name, "N 6 J 7 M 1", golden, what)
        for name, golden, what in (
            ("watt-planar", "table2", "Watt, planar"),
            ("stephenson-planar", "table2", "Stephenson, planar"),
            ("watt", "watt_stephenson", "Watt with two centres"),
            ("stephenson", "watt_stephenson", "Stephenson, concurrent"),
        )
    ),
    Row(
        "Section 3.3.6",
        "concentric loops: whether Eqs. 1 to 3 apply, mobility by rank",
        "synth mobility data/wiener/concentric-loops.json --json",
        "[any(answer[0]['equations'][key]['applies'] for key in ('traditional_cgk', 'modified_cgk', 'spherical_system')), "
        "answer[0]['exact']['mobility']]",
        right=[False, 0],
        words="the formula fails",
        golden="003/concentric",
        remark="N 16, J 24: Eq. 3 would give -3",
    ),
    _counted("Table 3, row 1", "table3-row1", "V 6 C 0 E_ext 11 E_int 0", "table3_row1"),
    _counted("Table 3, row 2", "table3-row2", "V 7 C 0 E_ext 12 E_int 2", "table3_row2"),
    _counted("Table 3, row 3", "table3-row3", "V 9 C 1 E_ext 15 E_int 8", "table3_row3"),
    _counted("Table 3, row 4", "table3-row4", "V 9 C 1 E_ext 15 E_int 8", "table3_row4"),
    _counted(
        "Section 4.1.4.1", "six-bar", "N 6 J 7 V 7 C 0 E_ext 12 E_int 2 M 1", "ex_4_1_4_1", "the two-loop six-bar"
    ),
    _counted(
        "Section 4.1.4.2",
        "eight-bar",
        "N 8 J 10 V 8 C 0 E_ext 15 E_int 2 M 1",
        "ex_4_1_4_2",
        "the three-loop eight-bar",
        remark="the topology is in the figure only; ours fits all counts",
    ),
    _counted(
        "Section 4.1.4.3, Fig. 15",
        "three-link-chain",
        "N 3 J 2 V 7 C 0 E_ext 9 E_int 4 M 2",
        "ex_4_1_4_3",
        "the three-link chain",
    ),
    _counted(
        "Section 4.1.4.4",
        "fortune-teller",
        "N 16 J 20 V 13 C 0 E_ext 28 E_int 0 M 5",
        "ex_4_1_4_4",
        "the fortune teller",
        remark="its title says eight-bar (003-4)",
    ),
    _counted(
        "Section 4.1.4.5", "nine-bar-mesh", "N 9 J 12 V 16 C 0 E_ext 24 E_int 18 M 0", "ex_4_1_4_5", "the nine-bar mesh"
    ),
    _counted(
        "Section 4.1.4.6",
        "hybrid-ten-bar",
        "N 10 J 11 V 13 C 0 E_ext 23 E_int 8 M 2",
        "ex_4_1_4_6_links_0_2",
        "the hybrid ten-bar",
    ),
    Row(
        "Section 4.2.2",
        "what a crease changes",
        "synth edit data/hyatt/spherical-four-bar.json --add-crease 1 --json",
        "answer['edits'][0]['counted']",
        printed=1,
        golden="003/crease/dM",
    ),
    *(
        Row(
            "Section 4.2.3",
            f"mobility of the {n}-bar with an implicit centre",
            f"synth mobility data/wiener/remote-{n}-bar.json --json",
            _M,
            printed=n - 3,
            words="n - 3",
            golden="003/implicit_centre",
        )
        for n in (5, 6, 7, 8)
    ),
    Row(
        "Section 4.2.4.3",
        "what a ride-along of links with 4 and 4 sides changes",
        "graphs.count.equations.relative_polyhedron(4 + 4 - 5, 0, 3 * 4 + 3 * 4 - 15)",
        printed=-6,
        words="3 (n + m - 5) - 3 n + 3 m - 15, which is -6, = 0",
        right=0,
        misprint="003-3",
        golden="003/ride_along_vertex_edge",
        remark="brackets are missing",
    ),
    Row(
        "Section 4.2.5.1",
        "a spherical chain of 3 links onto the six-bar: dM, M",
        "synth edit data/wiener/six-bar-loop-spherical.json --add-loop 0,1,3 --json",
        "[answer['edits'][0]['predicted'], answer['edits'][0]['mobility']]",
        printed=[1, 4],
        golden="003/ex_4_2_5_1",
    ),
    Row(
        "Section 4.2.5.2",
        "a spatial chain of 4 links between links that are not adjacent: dM, M",
        "synth edit data/wiener/six-bar-loop-spherical.json --add-spatial-loop 0,2,4:0,1 --json",
        "[answer['edits'][0]['predicted'], answer['edits'][0]['mobility']]",
        printed=[-1, 2],
        golden="003/ex_4_2_5_2",
    ),
    Row(
        "Section 4.2.5.2",
        "dM of dV = 6, dE = 19",
        "graphs.count.equations.relative_polyhedron(6, 0, 19)",
        printed=-20,
        words="dM = 3 dV - 2 dE, which is -20, = -1",
        right=-1,
        misprint="003-2",
        golden="003/ex_4_2_5_2",
    ),
    *(
        Row(
            f"Section {place}",
            f"N, J, M of {what}, reduced",
            f"synth reduce data/wiener/{name}.json --json",
            "[answer['after'][key] for key in ('links', 'joints', 'mobility')]",
            printed=[n, n, m],
            golden=f"003/{golden}",
        )
        for place, name, what, n, m, golden in (
            ("4.2.5.3", "ride-along", "a ride-along", 4, 1, "ex_4_2_5_3"),
            ("4.2.5.4", "adjunct-chain", "an adjunct chain", 4, 1, "ex_4_2_5_4"),
            ("4.2.5.5", "double-strip", "a double strip", 4, 1, "ex_4_2_5_5"),
            ("4.2.5.6", "fortune-teller", "the fortune teller", 8, 5, "ex_4_2_5_6"),
        )
    ),
    _arranged("six-bar-loop-spherical.json", "single"),
    _arranged("six-bar.json", "coupled"),
    _arranged("eight-bar.json", "linear"),
    _arranged("fortune-teller.json", "tree"),
    _arranged("nine-bar-mesh.json", "loop"),
    _arranged("miura-3x4.fold", "periodic"),
    _arranged("miura-5x5.fold", "doubly periodic"),
    *(
        Row(
            "Table 6",
            f"which of Eqs. 1 to 4 apply to a {kind} linkage",
            f"synth mobility data/{name}.json --json",
            "[answer[0]['equations'][key]['applies'] for key in "
            "('traditional_cgk', 'modified_cgk', 'spherical_system', 'polyhedron')]",
            printed=applies,
            golden="003/table6",
        )
        for kind, name, applies in (
            ("spherical", "wampler/fig12-scd", [True, True, True, True]),
            ("spherical system", "wiener/six-bar", [False, True, True, True]),
            ("hybrid", "wiener/hybrid-ten-bar", [False, False, False, True]),
            ("spatial", "wiener/three-link-chain", [True, True, False, True]),
        )
    ),
    Row(
        "Table 6",
        "whether Eq. 4, without the sides of the links, and Eq. 2 of R-S-S-R apply; Eq. 2 with the sum of f",
        "[synth.mobility(synth.read('data/wiener/hybrid-ten-bar.json').sc_graph()), synth.mobility('data/joints/rssr.json')]",
        "[answer[0].equations['polyhedron'].applies, answer[1].equations['modified_cgk'].applies, "
        "answer[1].equations['modified_cgk'].value]",
        right=[False, True, 2],
        words="Eq. 2 overrides Eq. 1 in space",
        golden="003/table6",
    ),
    Row(
        "Table 6",
        "class, centres, M by Eq. 1 of Watt's six-bar on a cone, all of whose axes pass through the apex",
        "synth.mobility(graphs.mechanism.surfaces.SurfaceLinkage.placed(synth.read('data/wiener/watt.json'), "
        "np.radians([0, 40, 110, 200, 250, 300, 340])))",
        "[answer.mechanism_class, answer.centres, answer.equations['traditional_cgk'].applies, "
        "answer.equations['traditional_cgk'].value]",
        right=["spherical", 1, True, 1],
        words="one centre: Eq. 1 applies",
    ),
    Row(
        "Section 3.4.4",
        "polyhedron models of Table 3, rows 3 and 4, with an implicit centre, as SCD graphs again",
        "[synth.read(name) for name in ('data/wiener/table3-row3.json', 'data/wiener/table3-row4.json')]",
        "[str(synth.identify(synth.convert(synth.convert(one, 'polyhedron'), 'scd'))) == str(synth.identify(one)) "
        "for one in answer]",
        right=[True, True],
        words="the model has the vertices of the SCD graph",
    ),
    Row(
        "Sections 3.4, 4.1.4.4",
        "whether the fortune teller's SC graph has one SCD graph of links with up to 3 sides, and that is the thesis's",
        "synth.read('data/wiener/fortune-teller.json')",
        "str(synth.identify(synth.convert(answer.sc_graph(), 'scd', max_degree=3))) == str(synth.identify(answer))",
        right=True,
        remark="up to 4 sides there are 10 702",
    ),
    Row(
        "Section 4.2.5.6",
        "the fortune teller reduced as an SCD graph: links, open edges, centres",
        "synth.reduce('data/wiener/fortune-teller.json').graph",
        "[len(answer), answer.counts.open_edges, len(answer.centre_classes())]",
        right=[8, 8, 1],
        words="the eight-bar",
        golden="003/ex_4_2_5_6",
    ),
    Row(
        "Section 6.1",
        "Hervé's classes of Sarrus' linkage and of a Miura sheet",
        "[synth.mobility(one).herve for one in ('data/linkages/sarrus.json', 'data/wiener/miura-3x3.fold')]",
        "[one.kind for one in answer]",
        right=["exceptional", "paradoxical"],
        words="special geometry: directions of axes, or lengths and angles",
    ),
    Row(
        "Section 5.2.4",
        "mobility of the UPS chain between bodies of 3 and 3 vertices, of 4 and 5, of 6 and 3",
        "[synth.mobility(synth.read(name)).mobility for name in ('data/wiener/ups-chain-3-3.json', "
        "'data/wiener/ups-chain-4-5.json', 'data/wiener/ups-chain-6-3.json')]",
        printed=[6, 6, 6],
        words="6",
        golden="003/ups_chain",
    ),
    Row(
        "Table 7",
        "modes of R-RR-RRR, R-RRR-RR, RR-R-RRR, RR-RR-RR",
        "synth enumerate strings --dof 6 --json",
        "[next(one['modes'] for one in answer if one['string'] == text) "
        "for text in ('R-RR-RRR', 'R-RRR-RR', 'RR-R-RRR', 'RR-RR-RR')]",
        printed=[2, 2, 2, 3],
        golden="003/table7",
    ),
    Row(
        "Table 8, Appendix B",
        "numbers of strings with 1 to 6 creases",
        "synth enumerate strings --max-dof 6 --json",
        "[sum(one['creases'] == n for one in answer) for n in range(1, 7)] + [len(answer)]",
        printed=[1, 2, 3, 4, 5, 5, 20],
        golden="003/table8",
    ),
    Row(
        "Table 8",
        "strings with 4 creases, joints they stand for, distance of the bodies",
        "synth enumerate strings --dof 4 --json",
        "[[one['string'], one['joints'], one['distance']] for one in answer]",
        printed=[
            ["R-RRR", "RS", "fixed"],
            ["RR-RR", "UU", "fixed"],
            ["R-R-RR", "RPU", "variable"],
            ["R-RR-R", "RUR", "variable"],
        ],
        golden="003/table8",
        remark="all 20 in the printed order, in the tests",
    ),
    Row(
        "Table 8, notes",
        "strings with all axes parallel; freedoms of RRR-RRR",
        "synth enumerate strings --max-dof 6 --json",
        "[[one['string'] for one in answer if one['comment'] == 'all axes parallel'], "
        "next(one['dof'] for one in answer if one['string'] == 'RRR-RRR')]",
        right=[["R-R", "R-R-R"], 5],
        words="all axes parallel",
        golden="003/table8",
    ),
    Row(
        "Section 6.1.1.2",
        "mobility of a 4 x 4 mesh with four creases in inner panels",
        "synth mobility data/wiener/mesh-4x4-inner-creases.json --json",
        "answer[0]['exact']['mobility']",
        printed=1,
        golden="003/crease_claim",
    ),
    Row(
        "Section 6.1.1.2",
        "mobility with the four creases in one edge row, by rank",
        "synth mobility data/wiener/mesh-4x4-edge-creases.json --json",
        "answer[0]['exact']['mobility']",
        printed=1,
        right=2,
        misprint="003-5",
        golden="003/crease_claim",
    ),
    *(
        Row(
            "Section 6.1.2, Eq. 8",
            f"h and degrees of freedom of the {i} x {j} Miura sheet",
            f"synth mobility data/wiener/miura-{i}x{j}.fold --json",
            "[answer[0]['pose']['h'], answer[0]['verdict']['freedoms']]",
            printed=[(i - 2) * (j - 2), 1],
            words="h = (i - 2) (j - 2); 1",
            golden="003/miura_h",
        )
        for i, j in ((3, 3), (4, 4), (5, 5))
    ),
    Row(
        "Section 6.1.3",
        "degrees of freedom of the square twist",
        "synth mobility data/wiener/square-twist.fold --json",
        "answer[0]['verdict']['freedoms']",
        printed=1,
    ),
    Row(
        "Section 6.1.3",
        "ways to fold of the square twist",
        "synth mobility data/wiener/square-twist.fold --json",
        "len(answer[0]['verdict']['branches'])",
        words="1 freedom by radial symmetry",
        right=6,
        misprint="003-6",
        remark="one for each choice of two of the four vertices; none is symmetric under quarter turns",
    ),
    Row(
        "Section 6.1.4",
        "degrees of freedom of Sarrus' linkage",
        "synth mobility data/linkages/sarrus.json --json",
        "answer[0]['verdict']['freedoms']",
        printed=1,
        golden="003/sarrus",
    ),
    Row(
        "Section 6.1.4, Eq. 4",
        "mobility of Sarrus' type by Eqs. 1 and 4",
        "synth mobility data/wiener/sarrus.json --json",
        "[answer[0]['equations'][key]['value'] for key in ('traditional_cgk', 'polyhedron')]",
        right=[0, 0],
        misprint="003-8",
        words="Eq. 4 covers all cases",
        golden="003/sarrus",
        remark="of the general member",
    ),
    Row(
        "Section 6.1.4",
        "special geometry asked of a type: a spatial loop of six revolutes has M = 0, and a member of it moves",
        "synth.realise(graphs.mechanism.sc.SCGraph(6, [(0, 1), (1, 2), (2, 3), (3, 4), (4, 5), (5, 0)]), freedoms=1)",
        "answer.members[0].freedoms",
        right=1,
        words="geometry decides, as in Sarrus' linkage",
        second="synth.mobility(answer.members[0].mechanism, exact=False).verdict.freedoms",
        remark="`synth realise TYPE --freedoms 1`; what was found in thirty types is in theory/realisation.md",
    ),
    Row(
        "Section 6.3.2",
        "what locking a joint changes",
        "synth edit data/wiener/ride-along.json --lock 3 --json",
        "[answer['edits'][0]['predicted'], answer['edits'][0]['counted']]",
        printed=[-1, -1],
        words="-1",
        golden="003/lock",
    ),
    Row(
        "Appendix A",
        "alpha of B over A and A', theta = 65, phi = 25: half the diagonal of a rhombus of links theta, opened by 2 phi",
        "synth.linkages.fourbar.position.output_spherical(np.radians([65] * 4), "
        "2 * np.arcsin(np.sin(np.radians(25)) / np.sin(np.radians(65))), -1)",
        "np.degrees(np.arcsin(np.sin(np.radians(65)) * np.cos(answer / 2)))",
        second="np.degrees(np.arccos(np.cos(np.radians(65)) / np.cos(np.radians(25))))",
        words="alpha = arccos(cos theta / cos phi)",
        golden="003/appendixA",
        remark="for theta above 90 degrees, phi <= 180 - theta (003-7)",
    ),
    Row(
        "Fig. 36, element 1",
        "pop-up of a planar and a spherical loop, a six-bar: links, mobility",
        "synth.mobility(synth.generate('beaked-box').mechanism)",
        "[answer.links, answer.mobility]",
        right=[6, 1],
        words="one planar and one spherical loop",
        second="[len(answer.configuration.linkage.graph), answer.verdict.freedoms]",
        remark="`synth generate beaked-box`; the dimensions of the figure are not at hand",
    ),
    Row("Fig. 28", "the mechanism with its own dimensions", why="the dimensions are in the figure only"),
    Row("Figs. 23, 32, 33, 35", "their mechanisms", why="they are in the figures only, which are not at hand"),
    Row("Fig. 62", "the crease assignment of the square twist", why="it is in the figure only"),
]
