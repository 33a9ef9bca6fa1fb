"""``import synth``: the same answers as the command line, from one call each."""

import json
import pickle
import re
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import networkx as nx
import numpy as np
import pytest
from commands import run
from sizes import slow

import synth
from graphs.errors import OpenError
from graphs.reduce.assur import reduce_assur
from synth.cli.output import shortened
from synth.linkages.guidance.orientations import read_orientations

ROOT = Path(__file__).resolve().parents[1]

FOUR_BAR = synth.SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [synth.Loop((0, 1, 2, 3))])


def told_by_command(files):
    return [
        {key: value for key, value in told.items() if key != "file"}
        for told in json.loads(run("mobility", "--json", *files).stdout)
    ]


@pytest.mark.parametrize("every", [4, slow(1)])
def test_the_answer_is_that_of_the_command(every, mechanisms, data):
    files = [*mechanisms, *sorted((data / "surfaces").glob("fig11-s*.json"))][::every]
    assert [shortened(synth.mobility(synth.read(file)).to_json()) for file in files] == told_by_command(files)


def crease_patterns(folder, most):
    """Patterns up to so many bytes with their answers; what cannot be read or is no sheet the command refuses too."""
    for file in sorted(folder.iterdir()):
        if file.suffix in (".fold", ".svg", ".cp", ".obj") and file.stat().st_size < most:
            try:
                yield file, shortened(synth.mobility(synth.read(file)).to_json())
            except (synth.FileError, synth.InvariantError):
                run("mobility", file, code=2)


@pytest.mark.parametrize("most", [1_000, slow(10**9)], ids=["small", "all"])
def test_the_answer_for_crease_patterns_is_that_of_the_command(most, fold_folder):
    patterns = list(crease_patterns(fold_folder, most))
    assert len(patterns) > 10
    assert [answer for _, answer in patterns] == told_by_command([file for file, _ in patterns])


def test_an_answer_prints_as_the_command_does(data):
    file = data / "wiener" / "watt.json"
    answer = synth.mobility(synth.read(file))
    printed = [line.rstrip() for line in run("mobility", file).stdout.rstrip().splitlines()]
    assert [str(file), *str(answer).splitlines()] == printed
    assert repr(answer) == "<JudgedMobility: 1 degree of freedom, proved>"
    html = answer._repr_html_()
    assert "<table>" in html
    assert "mobility M = 1" in html


def test_in_a_notebook_text_is_returned_and_not_displayed(data, monkeypatch):
    """rich displays what it prints where it finds a notebook; `str` and `print` must not."""
    monkeypatch.setattr("rich.console._is_jupyter", lambda: True)
    answer = synth.mobility(data / "patterns" / "four-bar-vertex.fold")
    assert str(answer).startswith(answer.verdict.text)


ANGLES, ORIENTED = "120,95,45,85", "data/orientations/tipparthi.json"
PRINTED = [
    (lambda: synth.map_to_cones(np.radians([120, 95, 45, 85])), "cone map --angles " + ANGLES),
    (lambda: synth.map_to_cones(np.radians([200, 100, 70, 60])), "cone map --angles 200,100,70,60"),
    (lambda: synth.map_to_cones(np.radians([120, 50, 120, 50])), "cone map --angles 120,50,120,50"),
    (lambda: synth.map_to_cylinders([4, 3, 5, 1]), "cylinder map --lengths 4,3,5,1"),
    (lambda: synth.map_to_cylinders([1, 2, 9, 7]), "cylinder map --lengths 1,2,9,7"),
    (lambda: synth.map_linkage(read("data/surfaces/fig11-stephenson.json")), "cone map data/surfaces/fig11-stephenson.json"),
    (lambda: synth.reduce(read("data/wiener/fortune-teller.json")), "reduce data/wiener/fortune-teller.json"),
    (lambda: synth.reduce(read("data/wiener/six-bar.json")), "reduce data/wiener/six-bar.json"),
    (lambda: reduce_assur(read("data/wiener/stephenson.json"), 0, [0]),
     "reduce data/wiener/stephenson.json --rule assur --ground 0 --input 0"),
    (lambda: synth.guiding_dyads(oriented()), f"dyads --orientations {ORIENTED}"),
    (lambda: synth.analyse_order(oriented(), (-0.349, -0.144, 0.926), "cw"),
     f"order --orientations {ORIENTED} --axis -0.349,-0.144,0.926 --direction cw"),
]  # fmt: skip


def read(name):
    return synth.read(ROOT / name)


def oriented():
    return read_orientations(ROOT / ORIENTED)


@pytest.mark.parametrize(("asked", "words"), PRINTED, ids=[words for _, words in PRINTED])
def test_other_answers_print_as_commands_do(asked, words, monkeypatch):
    monkeypatch.chdir(ROOT)
    answer = asked()
    printed = [line.rstrip() for line in run(*words.split()).stdout.rstrip().splitlines()]
    assert str(answer).splitlines() == printed
    assert re.fullmatch(rf"<{type(answer).__name__}: .{{8,200}}>", repr(answer))
    assert "<p>" in answer._repr_html_()


@pytest.mark.parametrize(
    ("file", "edits", "words"),
    [
        ("data/patterns/bird-base.fold", {"lock": [3], "add_crease": [(5, 2)]}, "--lock 3 --add-crease 5:2"),
        slow("data/patterns/bird-base.fold", {"assign_branch": 1, "remove_crease": [8, 5]}, "--assign-branch 1 --remove-crease 8 --remove-crease 5"),
        ("data/realised/watt.fold", {"assign_branch": 1}, "--assign-branch 1"),
        ("data/patterns/bird-base.fold", {"remove_crease": [8, 5]}, "--remove-crease 8 --remove-crease 5"),
        ("data/patterns/bird-base.fold", {"add_crease": [(6, (0.5, 1.0))]}, "--add-crease 6:0.5,1"),
        ("data/patterns/bird-base.fold", {"add_ride_along": [(0, 1)], "lock": [12]}, "--add-ride-along 0,1 --lock 12"),
        ("data/wiener/six-bar.json", {"add_ride_along": [(0, 1)], "lock": [3]}, "--add-ride-along 0,1 --lock 3"),
        ("data/wiener/six-bar.json", {"add_spatial_loop": [(0, 2, 4, [1, 2])]}, "--add-spatial-loop 0,2,4:1,2"),
        ("m1:a-b.ac-.b-d.cd-", {"explicit": [0], "implicit": [0]}, "--explicit 0 --implicit 0"),
        ("m1:a-b.ac-.b-d.cd-", {"add_loop": [(0, 1, 3)]}, "--add-loop 0,1,3"),
        ("k1:Cr", {"add_crease": [(0, [1])]}, "--add-crease 0:1"),
    ],
)  # fmt: skip
def test_edits_in_one_call_are_those_of_the_command(file, edits, words, monkeypatch):
    monkeypatch.chdir(ROOT)
    edited = synth.edit(file, **edits)
    told = json.loads(run("edit", file, *words.split(), "--json").stdout)
    assert shortened(edited.to_json()) == {key: told[key] for key in ("edits", "notes")}
    printed = [line.rstrip() for line in run("edit", file, *words.split()).stdout.rstrip().splitlines()]
    assert str(edited).splitlines() == printed


@pytest.mark.parametrize(
    ("file", "options", "words"),
    [
        slow("data/patterns/bird-base.fold", {"size": 150}, "--size 150"),
        slow("data/patterns/bird-base.fold", {"scale": 90, "note": False}, "--scale 90 --no-note"),
        ("data/wiener/miura-2x2.fold", {"scale": 90, "note": False}, "--scale 90 --no-note"),
        ("m1:a-b.ac-.b-d.cd-", {"kind": "space"}, "--as space"),
        ("data/surfaces/fig11-stephenson.json", {"size": 120, "thickness": 0.5}, "--size 120 --thickness 0.5"),
    ],
)
def test_a_template_in_one_call_is_that_of_the_command(file, options, words, tmp_path, monkeypatch):
    monkeypatch.chdir(ROOT)
    template = synth.template(file, **options)
    told = json.loads(run("template", file, *words.split(), "-o", tmp_path / "command.svg", "--json").stdout)
    assert {"file": file, "output": told["output"], **shortened(template.to_json())} == told
    written = synth.write_template(template, tmp_path / "python.svg")
    assert len(written) == len(told["output"])
    for place, other in zip(written, told["output"], strict=True):
        assert place.read_text() == Path(other).read_text()


def test_options_of_another_mechanism_are_refused(data):
    with pytest.raises(synth.InvariantError, match="radius for another mechanism; expected a linkage on a cone"):
        synth.template(data / "patterns" / "bird-base.fold", radius=3)
    with pytest.raises(synth.InvariantError, match="tabs, precision for another mechanism; expected a mechanism with"):
        synth.template(data / "surfaces" / "fig11-stephenson.json", tabs=3, precision=1e-3)


def test_lists_in_one_call_are_those_of_the_command():
    rows = json.loads(run("enumerate", "conical", "--chain", "k1:Cr", "--ground", "all", "--slots", 5, "--json").stdout)
    assert json.loads(json.dumps(list(synth.conical_candidates("k1:Cr", grounds="all", slots=5)))) == rows
    assert synth.count_conical_candidates("k1:Cr", grounds="all", slots=5) == len(rows)
    few = [synth.Filter("layers", most=2)]
    assert len(list(synth.conical_candidates("k1:Cr", filters=few))) == synth.count_conical_candidates(
        "k1:Cr", filters=few
    )
    rows = json.loads(run("enumerate", "addenda", "--of", "k1:Cr", "--json").stdout)
    assert [addendum.kind for addendum in synth.addenda("k1:Cr")] == [row["kind"] for row in rows]
    assert synth.count_strings(4) == len(list(synth.strings(4)))


def test_a_page_in_one_call_is_that_of_the_command(data, tmp_path, monkeypatch):
    from synth.making.viewer import pages

    for name in ("page.js", "page.css"):
        (tmp_path / name).write_text("")
    file = data / "patterns" / "four-bar-vertex.fold"
    monkeypatch.setattr(pages, "BUILT", tmp_path)
    monkeypatch.setattr(pages.page, "__kwdefaults__", {**pages.page.__kwdefaults__, "built": tmp_path})
    page = synth.view(file, "k1:Cr")
    page.save(tmp_path / "python.html")
    monkeypatch.setattr(pages, "check_built", lambda: None)
    run("view", file, "k1:Cr", "-o", tmp_path / "command.html")
    assert (tmp_path / "python.html").read_text() == (tmp_path / "command.html").read_text()
    assert re.fullmatch(r"<ViewPage: .{5,100}>", repr(page))
    with pytest.raises(synth.FileError, match=r"the extension is not known; expected \.html"):
        page.save(tmp_path / "page.pdf")


def test_html_escapes_names():
    scd = synth.SCDGraph(["<b>", "c"], [("<b>", "c")], rotation={"<b>": (0, None, None), "c": (0, None, None)})
    assert "<b>" not in synth.reconstruct(scd)._repr_html_()
    assert "&lt;b&gt;" in synth.reconstruct(scd)._repr_html_()


def test_exact_and_pose_are_objects(data):
    answer = synth.mobility(synth.read(data / "patterns" / "bird-base.fold"))
    assert answer.exact.mobility == answer.mobility == 5
    assert (answer.infinitesimal.dof, answer.overconstraint) == (10, 5)
    assert synth.mobility(FOUR_BAR, exact=False).exact is None


def test_any_mechanism_has_an_answer(data):
    assert synth.mobility(nx.cycle_graph(5)).mobility == 2
    assert synth.mobility(nx.cycle_graph(5)).warnings[0].startswith("a link-joint graph without centres")
    conical = synth.mobility(synth.read(data / "surfaces" / "fig11-stephenson.json"))
    assert (conical.mobility, conical.infinitesimal.dof, conical.infinitesimal.flat) == (1, 1, False)
    with_angles = synth.read(data / "hyatt" / "spherical-four-bar.json")
    assert synth.mobility(with_angles).mobility == 1


def test_an_id_is_read_as_a_file_is(data):
    six_bar = synth.read(data / "wiener" / "six-bar.json")
    ids = synth.identify(six_bar)
    again = synth.read(ids.drawing)
    assert synth.identify(again) == ids
    assert isinstance(again, synth.SCDGraph)
    chain = synth.read(ids.chain)
    assert synth.identify(chain).chain == ids.chain
    assert synth.identify(chain).drawing is None
    assert synth.mobility(chain).warnings[0].startswith("a link-joint graph without centres")
    for bad in ("k1:", "k1:~~", "m1:x", "m1:"):
        with pytest.raises(synth.FileError):
            synth.read(bad)


@pytest.mark.parametrize(
    "words",
    [
        ["mobility", "{}"],
        ["id", "{}"],
        ["reduce", "{}"],
        ["edit", "{}", "--lock", "0"],
        ["convert", "{}", "OUT.json"],
        ["enumerate", "addenda", "--of", "{}", "--count"],
        ["enumerate", "scd", "--of", "{}", "--max-degree", "3", "--count"],
        ["enumerate", "conical", "--chain", "{}", "--count"],
    ],
    ids=lambda words: words[0] + words[1].strip("{}"),
)
@pytest.mark.parametrize("code", ["k1:E`hW", "m1:ab.ac.bde.cfg.dg.ef"])
def test_every_command_takes_an_id(words, code, tmp_path):
    run(*(word.replace("{}", code).replace("OUT", str(tmp_path / "out")) for word in words))


def test_a_file_named_as_an_id_is_written_with_its_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert "extension" in run("id", "./k1:Cr", code=2).stderr + "extension" * (not (tmp_path / "k1:Cr").exists())
    (tmp_path / "k1:Cr.edges").write_text("a b\nb c\nc d\nd a\n")
    assert run("id", "./k1:Cr.edges").stdout.startswith("chain    k1:Cr\n")


def test_id_of_what_has_none(data):
    told = json.loads(run("id", "--json", data / "wampler" / "scissors.json").stdout)
    assert told == {"chain": None, "drawing": None}
    assert "has more than panels" in run("id", data / "wampler" / "scissors.json").stdout


def test_errors_are_of_the_families_that_python_has():
    with pytest.raises(OSError, match="no such file"):
        synth.read("there is none.json")
    with pytest.raises(ValueError, match="one of"):
        synth.convert(FOUR_BAR, "nothing")
    assert issubclass(OpenError, synth.FileError)
    assert issubclass(synth.InvariantError, ValueError)


def test_short_descriptions(data):
    assert repr(FOUR_BAR) == "<SCGraph: 4 links, 4 joints, 1 centre>"
    assert repr(synth.SCGraph(1)) == "<SCGraph: 1 link, 0 joints, 0 centres>"
    assert repr(synth.read(data / "wiener" / "six-bar.json")) == (
        "<SCDGraph: 6 links, 7 joints, 2 centres, 7 vertices>"
    )
    assert repr(synth.read(data / "patterns" / "bird-base.fold")) == (
        "<Sheet: 16 faces, 20 creases, 13 vertices, flat>"
    )
    assert repr(synth.convert(FOUR_BAR, "vertex-edge")) == "<VertexEdgeGraph: 1 vertex, 4 creases>"
    assert repr(synth.read(data / "wampler" / "fig9.json")) == "<PolyhedronModel: 5 vertices, 8 rods>"
    assert repr(synth.read(data / "linkages" / "bennett.json")) == "<HingedSolids: 4 links, 4 joints>"
    assert repr(synth.read(data / "joints" / "rssr.json")) == "<JointedLinkage: 4 links, 4 joints: 2R 2S, a type>"
    assert repr(synth.read(data / "surfaces" / "fig10-four-bar.json")) == (
        "<SurfaceLinkage: 4 links, 4 joints, on a cylinder, by steps>"
    )
    turns = synth.Orientations.from_axis_angles([(0, 0, 1)] * 3, [0, 1, 2])
    assert repr(turns) == "<Orientations: 3 orientations>"


@pytest.fixture(scope="module")
def results(data):
    """What the functions of the face return."""
    pattern, ring = data / "patterns" / "four-bar-vertex.fold", synth.generate("four-bar").mechanism
    orientations = oriented()
    dyads = synth.guiding_dyads(orientations)
    return [
        *(synth.mobility(pattern), synth.identify(pattern), synth.reconstruct(pattern), synth.reduce(FOUR_BAR)),
        *(
            synth.edit(FOUR_BAR, lock=[0]),
            synth.explain(ring),
            synth.advise(pattern, 0),
            synth.layers(data / "patterns" / "bird-base.fold"),
            synth.fold(pattern, frames=2),
        ),
        *(synth.positions(ring, drive={0: 0.1}), synth.states(ring, joints=[0]), synth.generate("miura")),
        *(next(synth.addenda(FOUR_BAR)), next(synth.strings(4)), synth.template(pattern, size=100)),
        *(synth.realise("m1:a-b.ac-.b-d.cd-"), synth.realise_on_cone(FOUR_BAR), dyads),
        *(synth.map_to_cones([2.1, 1.7, 0.8, 1.5]), synth.map_to_cylinders([4, 3, 5, 1])),
        *(synth.cones_of_loops(np.ones((3, 4))), synth.sweep(ring, {"arcs": np.ones((2, 4))}, drive={0: [0.1]})),
        *(synth.four_bars(orientations, dyads.dyads[:4])[0], synth.analyse_order(orientations, (0, 0, 1))),
        *(synth.move(data / "surfaces" / "fig10-four-bar.json", frames=2), synth.look(pattern)),
        synth.read(data / "joints" / "rssr.json"),
    ]


def test_results_have_short_descriptions(results):
    for result in results:
        assert len(repr(result)) <= 130, result
        assert "\n" not in repr(result)


def test_results_go_from_process_to_process(results):
    """As `ProcessPoolExecutor` sends them: each is pickled, and prints alike afterwards."""
    for result in results:
        again = pickle.loads(pickle.dumps(result))
        assert (type(again), str(again)) == (type(result), str(result))


def test_two_processes_fold_by_one_argument(data):
    files = [data / "patterns" / f"{name}.fold" for name in ("four-bar-vertex", "bird-base")]
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        motions = list(pool.map(synth.fold, files))
    for file, motion in zip(files, motions, strict=True):
        here = synth.fold(file)
        assert str(motion) == str(here)
        assert np.array_equal(motion.path.angles, here.path.angles)
        assert motion.configuration.closure.at(motion.path.angles[-1])[0] == pytest.approx(0, abs=1e-12)


def test_importing_costs_next_to_nothing():
    code = (
        "import synth, sys; heavy = {'networkx', 'numpy', 'rich', 'numba', 'scipy', 'click'} & set(sys.modules);"
        "assert not heavy, heavy; assert 'Where to begin' in synth.__doc__; synth.SCGraph; print(len(synth.__all__))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.stderr == ""
    assert 50 <= int(done.stdout) <= 90


def test_motions_do_without_what_other_jobs_need(tmp_path):
    """Folding, moving, generating, drawing and templates load no numba, matplotlib or flint, and go without them."""
    code = f"""
import sys
sys.modules.update(dict.fromkeys(("flint", "matplotlib", "numba")))
import synth
miura = synth.generate("miura", rows=2, columns=3).mechanism
motion = synth.fold(miura, frames=3)
assert motion.closure < 1e-12
assert synth.move(synth.generate("bennett").mechanism, frames=3).closure < 1e-12
synth.write(motion.frames()[-1], {str(tmp_path / "folded.fold")!r})
synth.draw(miura).save({str(tmp_path / "miura.svg")!r})
synth.write_template(synth.template(miura, size=100), {str(tmp_path / "cut.svg")!r})
print(synth.mobility("k1:Cr"))
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.stderr == ""
    assert "note: no exact rank: exact ranks require python-flint; try pip install python-flint\n" in done.stdout
    assert {path.name for path in tmp_path.iterdir()} >= {"folded.fold", "miura.svg", "cut.svg"}
