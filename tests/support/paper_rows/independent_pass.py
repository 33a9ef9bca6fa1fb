"""What an independent pass through the five papers found: answers that differed from them, or could not be had."""

from __future__ import annotations

from paper_rows import hyatt_2021, tipparthi_2011, wampler_2007, wiener_2016
from paper_rows.row import Row

_RING = (
    "(lambda k, declared: graphs.mechanism.polyhedron.PolyhedronModel(16, scissors=[(2 * i, 2 * i + 1, (2 * i + 2) % 16, "
    "(2 * i + 3) % 16) for i in range(8)], centres=[graphs.mechanism.polyhedron.RemoteCentre(k)] * declared, "
    "coordinates={2 * i + j: (r * np.cos(i * np.pi / 4), r * np.sin(i * np.pi / 4), 0) "
    "for i in range(8) for j, r in enumerate((2, 3))}))"
)
"""A ring of eight equal scissors about a centre, declared so many times as S+k."""


def _shown(rows: list[Row], paper: str, place: str, what: str) -> Row:
    """Return a row that points to the one of a paper that shows the item: the only one at a place whose text has these words."""
    (shown,) = (row for row in rows if row.place == place and what in row.what)
    return Row(f"{paper}, {place}", shown.what, same=shown)


ROWS = [
    _shown(wampler_2007.ROWS, "Wampler 2007", "Fig. 12", "rods alone"),
    Row(
        "Wiener 2016, Section 4.2.3",
        "rods alone of the n-bars with a remote centre, 5 to 8 links: degrees of freedom of the first line",
        "[synth.convert(synth.read(f'{folder}/remote-{n}-bar.json'), 'polyhedron') for folder in ('data/wiener',) for n in range(5, 9)]",
        "[synth.mobility(graphs.mechanism.polyhedron.PolyhedronModel(m.nodes, m.edges, centres=m.centres)).verdict.freedoms "
        "for m in answer]",
        words="n - 3",
        right=[2, 3, 4, 5],
    ),
    _shown(wampler_2007.ROWS, "Wampler 2007", "Fig. 2, Eq. 5", "rod by itself"),
    _shown(wiener_2016.ROWS, "Wiener 2016", "Table 6", "all of whose axes pass through the apex"),
    _shown(wiener_2016.ROWS, "Wiener 2016", "Table 6", "Eq. 2 with the sum of f"),
    Row(
        "Wampler 2007, Fig. 16b",
        "M and h of Tsai's platform by `mobility` and by `explain`",
        "(lambda m: [synth.mobility(m), synth.explain(m)])(synth.generate('3-crr').mechanism)",
        "[answer[0].mobility, answer[0].overconstraint, answer[1].count, answer[1].overconstraint]",
        words="Eq. 1 fails",
        right=[0, 3, 0, 3],
    ),
    Row(
        "Wiener 2016, Table 1",
        "M and h of a placed slider-crank, Eq. 1 with lambda = 3, by `mobility` and by `explain`",
        "(lambda m: [synth.mobility(m), synth.explain(m)])(synth.read('data/joints/slider-crank-placed.json'))",
        "[answer[0].mobility, answer[0].overconstraint, answer[1].count, answer[1].overconstraint]",
        words="lambda = 3 in a plane",
        right=[1, 0, 1, 0],
    ),
    _shown(wampler_2007.ROWS, "Wampler 2007", "Collapsible cube", "h by the motion"),
    _shown(wiener_2016.ROWS, "Wiener 2016", "Section 4.2.5.6", "as an SCD graph"),
    _shown(wiener_2016.ROWS, "Wiener 2016", "Section 3.4.4", "implicit centre"),
    _shown(wampler_2007.ROWS, "Wampler 2007", "Fig. 9", "links that the rods alone show"),
    _shown(wiener_2016.ROWS, "Wiener 2016", "Sections 3.4, 4.1.4.4", "SCD graph of links"),
    _shown(wampler_2007.ROWS, "Wampler 2007", "Fig. 14b", "arms a, b"),
    Row(
        "Wampler 2007, Eq. 9",
        "a ring of eight equal scissors with coordinates: S+4 declared, S+3 declared, none declared",
        f"[{_RING}(*one) for one in ((4, 1), (3, 1), (4, 0))]",
        "[next(word for note in graphs.answer.remote.notes_on_centres(one) for word in ('confirmed', 'refused', 'found') "
        "if word in note) for one in answer]",
        words="S+4 for a loop of identical scissors",
        right=["confirmed", "refused", "found"],
    ),
    _shown(wiener_2016.ROWS, "Wiener 2016", "Section 6.1", "classes"),
    _shown(hyatt_2021.ROWS, "Hyatt 2021", "Eqs. 1 to 3", "T1, T2, T3"),
    _shown(hyatt_2021.ROWS, "Hyatt 2021", "Fig. 5", "parallelogram"),
    _shown(hyatt_2021.ROWS, "Hyatt 2021", "Fig. 6", "kite"),
    Row(
        "Hyatt 2021, Section 3.2",
        "a spherical parallelogram of 120, 50, 120, 50 on the chosen cone of lambda = 20 degrees: its link angles there",
        "synth cone map --angles 120,50,120,50 --lambda 20 --json",
        "np.degrees(synth.linkages.surfaces.link_angles(np.radians(answer['cones'][0]['steps_deg']), np.radians(20)))",
        words="infinitely many cone angles",
        right=[120.0, 50.0, 120.0, 50.0],
    ),
    Row(
        "Hyatt 2021, Fig. 10",
        "row 2 of a table of 2 rows, written: radius of 4, 3, 5, 1, crossed",
        "synth cylinder map crossed.json --json",
        "[one['radius'] for one in answer['cylinders']]",
        printed=[2.59],
        within=0.005,
        first=("synth cylinder map --lengths 4,3,5,1 --cylinder 2 -o crossed.json --force",),
    ),
    Row(
        "Hyatt 2021, Section 5",
        "Fig. 10, crossed, in motion: where link 4, which turns about its own end, changes its direction",
        "synth cylinder move crossed.json",
        "['-180°' in answer, '180°, then outward' in answer, '179.99' in answer]",
        words="half a turn",
        right=[True, True, False],
        first=("synth cylinder map --lengths 4,3,5,1 --cylinder 2 -o crossed.json --force",),
    ),
    Row(
        "Hyatt 2020, Eqs. 1 to 4",
        "a link of 200 degrees, which is one of 160: what is said",
        "synth cone map --angles 200,50,60,70",
        "'link 1: 200 degrees is read as 160' in answer",
        words="link angles up to 180 degrees",
        right=True,
    ),
    _shown(tipparthi_2011.ROWS, "Tipparthi 2011", "Theorem 1", "another order"),
    _shown(tipparthi_2011.ROWS, "Tipparthi 2011", "Planar propeller, from which the hoop is made", "three positions"),
]
