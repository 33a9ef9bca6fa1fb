"""Wampler, Larson, Erdman 2007: a new mobility formula for spatial mechanisms."""

from __future__ import annotations

from paper_rows.row import Row

_EQ = "answer[0]['equations']['{}']['value']"
_VEM = "[answer[0]['counts']['vertices'], answer[0]['counts']['edges'], answer[0]['mobility']]"


def _model(
    place: str, what: str, name: str, printed: list[int] | None = None, right: list[int] | None = None, golden: str = ""
) -> Row:
    return Row(
        place, f"V, E, M of {what}", f"synth mobility data/wampler/{name}.json --json", _VEM,
        printed=printed, right=right, golden=f"004/{golden}",
    )  # fmt: skip


def _moves(place: str, what: str, name: str, options: str = "", slow: bool = False, remark: str = "") -> Row:
    return Row(
        place,
        f"degrees of freedom of {what}",
        f"synth mobility {name}.json --json",
        "answer[0]['verdict']['freedoms']",
        right=1,
        words="collapsible",
        first=(f"synth generate scissor-{name} {options}-o {name}.json --force",),
        slow=slow,
        remark=remark,
    )


ROWS = [
    Row(
        "Fig. 1, open",
        "mobility by Eq. 5",
        "synth mobility data/wampler/fig1.json --json",
        "answer[0]['mobility']",
        printed=1,
        golden="004/fig1/open",
    ),
    Row(
        "Fig. 1, open",
        "degrees of freedom",
        "synth mobility data/linkages/wampler-fig1-open.fold --json",
        "answer[0]['verdict']['freedoms']",
        printed=1,
        golden="004/fig1/open",
    ),
    Row(
        "Fig. 1, folded flat",
        "degrees of freedom",
        "synth mobility data/linkages/wampler-fig1-folded.fold --json",
        "answer[0]['verdict']['freedoms']",
        printed=2,
        golden="004/fig1/flat",
    ),
    Row(
        "Fig. 1, folded flat",
        "degrees of freedom to first order, all panels in one plane",
        "synth mobility data/linkages/wampler-fig1-coplanar.fold --json",
        "answer[0]['pose']['dof']",
        printed=2,
        right=3,
        misprint="004-2",
        golden="004/fig1",
        remark="two ways to move, of 2 and 1 degrees of freedom, meet there",
    ),
    *(
        Row(
            f"Fig. {v}",
            f"freedoms of a body of {v} vertices, E",
            f"synth mobility data/wampler/fig{v}.json --json",
            "[answer[0]['mobility'] + 6, answer[0]['counts']['edges']]",
            printed=[dof, e],
            words="5; one rod" if v == 2 else "6; E = 3 V - 6",
            golden="004/rigid_bodies",
            remark="the text points to Fig. 1 (004-3)" if v == 2 else "",
        )
        for v, dof, e in ((2, 5, 1), (3, 6, 3), (4, 6, 6), (5, 6, 9))
    ),
    Row(
        "Text before Eq. 3",
        "a four-bar of lengths 1, 0.7, 1.3, 3, stretched out: real dimension",
        "synth mobility data/joints/stretched-four-bar.json --json",
        "[answer[0]['verdict']['freedoms'], answer[0]['verdict']['certainty']]",
        printed=[0, "proved"],
        words="real dimension 0",
        golden="004/degenerate_fourbar",
        remark="proved; two freedoms to first order",
    ),
    Row(
        "Text before Eq. 3",
        "its complex dimension: M, which is the least dimension there; degrees of freedom to first order; "
        "complex lines of their second-order condition, and real ones",
        "synth mobility data/joints/stretched-four-bar.json --json",
        "(lambda lines: [answer[0]['mobility'], answer[0]['pose']['dof'], len({complex(x) for x in lines}), "
        "int(np.sum(lines.imag == 0))])(np.roots([1 + 1 / 1.3, 2 * 0.7 / 1.3, 0.7 + 0.49 / 1.3]))",
        words="1",
        right=[1, 2, 2, 0],
        golden="004/degenerate_fourbar",
        remark="the condition l1 x^2 + l2 y^2 + (l1 x + l2 y)^2 / l3 = 0 is not empty, so of 2 dimensions at most 1 is left, "
        "and 3 equations in 4 angles leave at least 1: complex dimension 1, in two branches; computed in the expression, not by a command",
    ),
    Row(
        "Eqs. 1, 2, text after Eq. 2",
        "two spherical four-bars with different centres: centres, M",
        "synth mobility data/wampler/two-centres.json --json",
        "[answer[0]['centres'], answer[0]['mobility']]",
        printed=[2, 1],
        words="1 by Eq. 2, with two centres",
        golden="004/eq2_two_centres",
    ),
    _model("Fig. 6", "two triangles with a vertex in common", "fig6", right=[5, 6, 3], golden="fig6"),
    _model("Fig. 7", "the model", "fig7", [6, 10, 2], golden="fig7"),
    _model("Fig. 8", "the model", "fig8", [5, 7, 2], golden="fig8"),
    _model("Fig. 9", "the model", "fig9", [5, 8, 1], golden="fig9"),
    Row(
        "Fig. 9, text",
        "mobility with one more edge",
        "synth mobility data/wampler/fig9-diagonal.json --json",
        "answer[0]['mobility']",
        printed=0,
        golden="004/fig9_diagonal/M",
    ),
    Row(
        "Fig. 10",
        "mobility by Eq. 5",
        "synth mobility data/wampler/fig10.json --json",
        "answer[0]['mobility']",
        printed=2,
        golden="004/fig10/M",
    ),
    Row(
        "Fig. 10",
        "Eq. 1: 8 links, 8 R, 1 S",
        "graphs.count.equations.traditional_cgk(8, [1] * 8 + [3], 6)",
        printed=-1,
        golden="004/fig10/M_eq1",
    ),
    Row(
        "Eq. 6",
        "constraints of a cylindrical, a planar and a prismatic joint",
        "(lambda m: [m(8, 12, 0, 0) - m(8, 12, 0, 2), m(8, 12, 0, 0) - m(8, 12, 3, 0), m(8, 12, 0, 0) - m(8, 12, 1, 2)])"
        "(graphs.count.equations.wampler_points)",
        printed=[4, 3, 5],
        words="2 L; 3 P; 2 L + P",
        golden="004/eq6_joint_costs",
    ),
    Row(
        "Fig. 12, Eq. 7",
        "what the last joint changes by rods alone and by Eq. 7",
        "synth mobility data/wampler/fig12.json --json",
        f"[{_EQ.format('wampler_eq5')} - 3, {_EQ.format('wampler_eq7')} - 3]",
        printed=[-5, -2],
        words="apparent change -5, true change -2, S+3",
        golden="004/fig12_remote",
        remark="by count; a rank of the rods of four coplanar points says otherwise (004-5)",
    ),
    Row(
        "Fig. 12, Eq. 7",
        "mobility of the chain of four before, and of the four-bar after",
        "[synth.mobility(synth.read('data/wampler/' + name)).mobility for name in ('fig12-open.json', 'fig12.json')]",
        right=[3, 1],
        golden="004/fig12_remote",
    ),
    *(
        Row(
            place,
            f"what a remote centre S+{k} adds",
            f"graphs.mechanism.polyhedron.PolyhedronModel(4, centres=[graphs.mechanism.polyhedron.RemoteCentre({k})])",
            "(lambda report: report.mobility - report.equations['wampler_eq6'].value)"
            "(graphs.count.report.mobility_report(answer))",
            printed=k,
            words=f"true change -2, apparent change -{2 + k}",
            golden=f"004/S{k}",
        )
        for place, k in (("Fig. 13, Eq. 8", 4), ("Fig. 15, Eq. 8", 1))
    ),
    Row(
        "Eq. 9",
        "freedoms of one scissor with four exposed vertices",
        "graphs.mechanism.polyhedron.PolyhedronModel(4, scissors=[(0, 1, 2, 3)])",
        "graphs.count.report.mobility_report(answer).mobility + 6",
        printed=7,
        golden="004/scissors_element/true_dof",
    ),
    Row(
        "Spherical scissors",
        "V, scissors, M of four in a loop",
        "synth mobility data/wampler/spherical-scissors.json --json",
        "[answer[0]['counts']['vertices'], answer[0]['counts']['scissors'], answer[0]['mobility']]",
        printed=[8, 4, 2],
        words="V 8, S+4 1, X 4: M 2",
        golden="004/scissors_spherical_loops",
        remark="the text lacks the number of a figure (004-4)",
    ),
    Row(
        "Spherical scissors",
        "mobility of the four-bar before",
        "graphs.count.equations.wampler_rods(5, 8)",
        printed=1,
        golden="004/scissors_spherical_loops",
    ),
    Row(
        "Spherical scissors, a = b",
        "mobility by rank",
        "synth mobility data/wampler/spherical-scissors.json --json",
        "answer[0]['exact']['mobility']",
        printed=2,
        words="as before",
        golden="004/scissors_planar",
        remark="of a general member; that equal arms have 2 too is in the golden values only",
    ),
    Row(
        "Fig. 16, Eq. 10",
        "M of three legs C-R-S that end in one point, V 10, E 15, L 6",
        "synth mobility data/wampler/crs-platform.json --json",
        "answer[0]['mobility']",
        printed=3,
        golden="004/crs3/",
    ),
    Row(
        "Fig. 16, Eq. 1",
        "M of the same legs as joints C, R and S: Eq. 1, Wampler's count, random member",
        "synth mobility data/joints/legs-crs.json --json",
        "[answer[0]['equations']['traditional_cgk']['value'], answer[0]['equations']['wampler_eq6']['value'], "
        "answer[0]['counts']['general_member']]",
        printed=[3, 3, 3],
        words="3",
        golden="004/crs3",
    ),
    Row(
        "Eq. 1",
        "M of three legs C-R-S with a platform: Eq. 1, Wampler's count, random member",
        "synth mobility data/joints/platform-crs.json --json",
        "[answer[0]['equations']['traditional_cgk']['value'], answer[0]['equations']['wampler_eq6']['value'], "
        "answer[0]['counts']['general_member']]",
        right=[6, 6, 6],
        remark="6 (8 - 1) - 3 (4 + 5 + 3)",
    ),
    Row(
        "Rigid bodies, S-S",
        "M of R-S-S-R by Eq. 1, by Wampler's count, and the spin of its rod",
        "synth mobility data/joints/rssr.json --json",
        "[answer[0]['equations']['traditional_cgk']['value'], answer[0]['equations']['wampler_eq5']['value'], "
        "answer[0]['counts']['passive']]",
        right=[2, 1, 1],
        words="the spin of a rod is not counted",
        golden="004/rigid_bodies",
    ),
    Row(
        "Fig. 16b",
        "degrees of freedom of Tsai's platform, three legs C-R-R",
        "synth mobility tsai.json --json",
        "answer[0]['verdict']['freedoms']",
        printed=3,
        words="three freedoms of translation; Eq. 1 fails",
        first=("synth generate 3-crr -o tsai.json --force",),
        golden="004/tsai_3crr",
    ),
    Row(
        "Fig. 16b",
        "its redundant equations, and for how many of them a reason is found",
        "synth explain tsai.json --json",
        "[answer['h'], sum(bool(one['reasons']) for one in answer['sets'])]",
        right=[3, 3],
        first=("synth generate 3-crr -o tsai.json --force",),
        golden="004/tsai_3crr",
        remark="axes parallel in each leg; in the joints of the file",
    ),
    Row(
        "Fig. 2, Eq. 5",
        "degrees of freedom of a rod by itself, by count, and with one link fixed",
        "synth.mobility('data/wampler/fig2.json')",
        "[answer.mobility, answer.verdict.freedoms]",
        right=[-1, 0],
        words="5 freedoms, not 6",
        golden="004/rigid_bodies",
        remark="never a negative number of degrees of freedom",
    ),
    Row(
        "Fig. 9",
        "links that the rods alone show: four triangles",
        "synth.read('data/wampler/fig9.json')",
        "[len(graphs.convert.models.scd_of_model(answer)), "
        "len(graphs.mechanism.bodies.rigid_sets(graphs.mechanism.polyhedron.PolyhedronModel(answer.nodes, answer.edges)))]",
        right=[4, 4],
    ),
    Row(
        "Fig. 12",
        "degrees of freedom of its rods alone, its links not named: first line, count, rank",
        "(lambda m: synth.mobility(graphs.mechanism.polyhedron.PolyhedronModel(m.nodes, m.edges, centres=m.centres)))"
        "(synth.read('data/wampler/fig12.json'))",
        "[answer.verdict.freedoms, answer.mobility, answer.exact.mobility]",
        right=[1, 1, 1],
        words="true change -2, so 1 is left",
        golden="004/fig12_remote",
        remark="tetrahedra of rods are bodies, whose four coplanar vertices have no freedom of their own (004-5)",
    ),
    Row(
        "Fig. 14b",
        "arms a, b and a', b' of two scissors that share two ends, from coordinates",
        "graphs.mechanism.polyhedron.PolyhedronModel(6, coordinates={0: (0, 2, 0), 1: (0, 0, 0), 2: (3, 2.5, 0), "
        "3: (3, -0.5, 0), 4: (6, 2, 0), 5: (6, 0, 0)}, scissors=[(0, 1, 2, 3), (2, 3, 4, 5)])",
        "(lambda pair: [bool(np.allclose(*pair.arms)), bool(np.allclose(*pair.ratios))])"
        "(graphs.answer.remote.scissors_pairs(answer)[0])",
        right=[True, True],
        words="identical, or asymmetric and mirrored: S+4",
        remark="the declared k is confirmed or refused with these numbers",
    ),
    Row(
        "Collapsible cube",
        "h by the motion, degrees of freedom and M",
        "synth mobility cube.json --json",
        "[answer[0]['verdict']['freedoms'] - answer[0]['mobility'], answer[0]['verdict']['freedoms'], answer[0]['mobility']]",
        right=[19, 1, -18],
        first=("synth generate scissor-cube -o cube.json --force",),
        remark="at every configuration 21 closure equations are redundant to first order",
    ),
    Row(
        "Fig. 16b",
        "Eq. 1 of it",
        "synth mobility tsai.json --json",
        "answer[0]['equations']['traditional_cgk']['value']",
        right=0,
        words="Eq. 1 fails",
        first=("synth generate 3-crr -o tsai.json --force",),
        golden="004/tsai_3crr",
    ),
    Row(
        "Collapsible cube, locked",
        "mobility, V 9, E 20",
        "synth mobility data/wampler/cube-locked.json --json",
        "answer[0]['mobility']",
        printed=1,
        golden="004/cube_locked/M",
    ),
    Row(
        "Collapsible cube, locked",
        "finite real freedoms",
        "synth mobility data/linkages/wampler-cube-locked.json --json",
        "[answer[0]['verdict']['freedoms'], answer[0]['verdict']['certainty']]",
        printed=[0, "proved"],
        words="0",
        golden="004/cube_locked",
    ),
    Row(
        "Collapsible cube, locked",
        "flexes to first order",
        "synth mobility data/linkages/wampler-cube-locked.json --json",
        "answer[0]['pose']['dof']",
        printed=1,
        words="an extra infinitesimal motion",
        right=2,
        misprint="004-1",
        golden="004/cube_locked",
    ),
    Row(
        "Fig. 18, Eq. 9",
        "mobility of the unlocked cube by count, five independent loops",
        "synth mobility data/wampler/cube-unlocked.json --json",
        "answer[0]['mobility']",
        right=2,
        misprint="004-6",
        words="S+4 per center",
        golden="004/cube_unlocked",
    ),
    Row(
        "Fig. 18",
        "degrees of freedom of the Hoberman cube, and to first order",
        "synth mobility cube.json --json",
        "[answer[0]['verdict']['freedoms'], answer[0]['pose']['dof']]",
        printed=[1, 2],
        words="one real freedom, an extra infinitesimal motion",
        right=[1, 3],
        misprint="004-1",
        first=("synth generate scissor-cube -o cube.json --force",),
        slow=True,
        golden="004/cube_unlocked",
    ),
    Row(
        "Collapsible tetrahedron, locked",
        "mobility",
        "synth mobility data/wampler/tetrahedron-locked.json --json",
        "answer[0]['mobility']",
        printed=-1,
        golden="004/tetra_locked/M",
    ),
    _moves("Collapsible tetrahedron", "the tetrahedron of scissors", "tetrahedron", slow=True),
    _moves("Collapsible polyhedra", "the octahedron of scissors", "octahedron", slow=True),
    _moves("Hoberman elements", "a ring of ten scissors", "ring", "--scissors 10 "),
    Row(
        "Assembly modes",
        "Roberts' seven-bar: degrees of freedom; rigid assemblies of the same links",
        "synth positions data/joints/roberts.json --no-circuits --json",
        "[sum(not one['regular'] for one in answer['positions']), sum(one['regular'] for one in answer['positions'])]",
        right=[1, 6],
        words="mobility belongs to an assembly mode",
        slow=True,
        remark="one assembly on the curve along which it moves, six rigid ones",
    ),
    *(
        Row(
            "Spherical scissors, Eq. 9",
            f"mobility of {n} scissors in a loop, by count and by rank",
            f"synth mobility data/wampler/spherical-scissors-{n}.json --json",
            "[answer[0]['mobility'], answer[0]['exact']['mobility']]",
            right=[n - 2, n - 2],
            golden="004/scissors_spherical_loops",
        )
        for n in (5, 6)
    ),
    Row(
        "Fig. 15",
        "scissors with their own dimensions",
        why="the dimensions are not at hand; S+1 is tried on a model above",
    ),
]
