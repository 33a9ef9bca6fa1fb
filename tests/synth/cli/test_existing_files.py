"""One rule for outputs: what is there is not replaced, unless by --force; links and devices never are."""

import json
import re
import shlex
import sqlite3

import click
import pytest
from commands import run

from graphs.files.formats import READERS, WRITERS
from synth.cli.main import main
from synth.exporters import EXPORTERS

COMMANDS = {
    "convert": ("convert {data}/wiener/watt.json", "a.edges"),
    "edit": ("edit {data}/wiener/watt.json --add-ride-along 0,1 -o", "a.json"),
    "reduce": ("reduce {data}/wiener/fortune-teller.json -o", "a.json"),
    "assur": ("reduce {data}/wiener/stephenson.json --rule assur --ground 0 --input 0 -o", "a.json"),
    "reconstruct": ("reconstruct {data}/wiener/six-bar.json -o", "a.json"),
    "rows as lines": ("enumerate chains --links 4 --dof 1 -o", "a.jsonl"),
    "rows as graphs": ("enumerate chains --links 4 --dof 1 -o", "a.g6"),
    "rows as a table": ("enumerate chains --links 4 --dof 1 -o", "a.parquet"),
    "rows in a store": ("enumerate chains --links 4 --dof 1 -o", "a.sqlite"),
    "strings": ("enumerate strings --max-dof 2 -o", "a.jsonl"),
    "cones": ("cone map --angles 120,95,45,85 -o", "a.svg"),
    "a linkage": ("cone map {data}/surfaces/fig11-stephenson.json -o", "a.svg"),
    "behaviour": ("cone behaviour --angles 120,95,45,85 -o", "a.svg"),
    "cylinders": ("cylinder map --lengths 4,3,5,1 -o", "a.svg"),
    "order": ("order --orientations {data}/orientations/tipparthi.json --axis=0,0,1 -o", "a.svg"),
    "dyads": ("dyads --orientations {data}/orientations/tipparthi.json -o", "a.svg"),
    "template": ("template {data}/patterns/bird-base.fold --size 100 --no-note -o", "a.svg"),
    "motion": ("fourbar --orientations {data}/orientations/crank-rocker.json --motion", "a.json"),
}
SLOW = ("cones", "dyads", "motion", "a linkage", "behaviour", "order")


def words_of(name, data, tmp_path):
    words, file = COMMANDS[name]
    return [*shlex.split(words.format(data=data)), tmp_path / file], tmp_path / file


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=pytest.mark.slow) if name in SLOW else name for name in COMMANDS]
)
def test_what_is_there_is_replaced_by_force_only(name, data, tmp_path):
    if name == "rows as a table":
        pytest.importorskip("pyarrow")
    words, path = words_of(name, data, tmp_path)
    path.write_text("old", encoding="utf-8")
    stderr = run(*words, code=2).stderr.splitlines()
    assert len(stderr) == 1
    assert "exists already" in stderr[0]
    assert "--force" in stderr[0]
    assert path.read_text(encoding="utf-8") == "old"
    run(*words, "--force", code=1 if name == "order" else 0)
    assert path.read_bytes() != b"old"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("name", [name for name in COMMANDS if "enumerate" not in COMMANDS[name][0]])
def test_what_is_there_is_refused_before_anything_is_read_or_computed(name, data, tmp_path):
    words, path = words_of(name, tmp_path / "nowhere", tmp_path)
    words = [
        "400" if "," in str(word) and words[i - 1] in ("--angles", "--lengths") else word
        for i, word in enumerate(words)
    ]
    assert "exists already" not in run(*words, code=2).stderr  # there is nothing to compute it from
    path.write_text("old", encoding="utf-8")
    assert "exists already" in run(*words, code=2).stderr


def test_a_folder_of_pictures_is_refused_before_anything_is_read(tmp_path):
    words = ["enumerate", "conical", "--chain", tmp_path / "nowhere.json", "--pictures", tmp_path]
    assert "exists already; expected a new folder" in run(*words, code=2).stderr


def test_a_kind_of_picture_is_refused_before_anything_is_computed(tmp_path):
    words = ["cone", "map", tmp_path / "nowhere.json", "-o", tmp_path / "a.bmp"]
    assert "are not known; expected one of .png .svg .pdf" in run(*words, code=2).stderr


def test_every_option_that_names_an_output_comes_with_force():
    def commands(group, path=()):
        with click.Context(group) as context:
            for name in group.list_commands(context):
                command = group.get_command(context, name)
                if isinstance(command, click.Group):
                    yield from commands(command, (*path, name))
                else:
                    yield " ".join((*path, name)), command

    outputs = {"output", "picture", "motion", "target"}
    writing = {}
    for name, command in commands(main):
        parameters = {parameter.name for parameter in command.params}
        if parameters & outputs:
            writing[name] = "force" in parameters
    assert len(writing) > 10
    assert all(writing.values()), writing


@pytest.mark.parametrize("file", ["a.jsonl", "a.sqlite"])
def test_rows_are_not_written_through_links_or_to_pipes(file, tmp_path):
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / file).symlink_to(tmp_path / "elsewhere" / file)
    words = ["enumerate", "chains", "--links", "4", "--dof", "1", "-o", tmp_path / file]
    for more in ([], ["--force"]):
        assert "a symbolic link; expected the name of the file itself" in run(*words, *more, code=2).stderr
    assert not list((tmp_path / "elsewhere").iterdir())


def test_a_store_begins_anew_by_force(tmp_path):
    path = tmp_path / "a.sqlite"
    run("enumerate", "chains", "--links", 4, "--dof", 1, "-o", path)
    run("enumerate", "chains", "--links", 6, "--dof", 1, "-o", path, "--force")
    store = sqlite3.connect(path)
    assert store.execute("SELECT count(*) FROM type").fetchone() == (2,)
    store.close()
    assert (
        "--resume and --force exclude each other"
        in run("enumerate", "chains", "--links", 4, "--dof", 1, "-o", path, "--force", "--resume", code=2).stderr
    )


def test_folders_are_not_replaced(tmp_path):
    (tmp_path / "folder").mkdir()
    words = ["enumerate", "chains", "--links", 4, "--dof", 1, "-o", tmp_path / "folder", "--force"]
    assert "exists already; expected a new folder: folders are not replaced" in run(*words, code=2).stderr


def test_a_pattern_of_another_type_is_refused_unless_lossy(tmp_path):
    run("enumerate", "scd", "--links", 4, "--dof", 1, "--max-degree", 4, "-o", tmp_path / "all")
    files, kept, told = sorted((tmp_path / "all").iterdir()), 0, []
    for file in files:
        words = ["convert", file, tmp_path / "a.fold", "--force"]
        if json.loads(run("convert", *words[1:], "--lossy", "--json").stdout)["lost"]:
            told += run(*words, code=2).stderr.splitlines()
            assert "not stored: 1 implicit centre" in run(*words, "--lossy").stdout
            run("convert", file, tmp_path / "b.json", "--to", "sheet", "--force", code=2)
        else:
            kept += 1
            assert "not stored" not in run(*words).stdout
    assert kept == 6
    assert told == [
        f"{files[0]}: a .fold file would be read back as another type: M = 1 spherical becomes M = -2 spatial; it cannot "
        "hold 1 implicit centre; try --lossy (in Python lossy=True)"
    ]


@pytest.mark.parametrize(
    ("command", "table"),
    [
        ("convert", READERS),
        ("convert", WRITERS),
        ("convert", EXPORTERS["solids"]),
        ("draw", EXPORTERS["pictures"]),
        ("order", EXPORTERS["pictures"]),
        ("dyads", EXPORTERS["pictures"]),
        ("cone map", EXPORTERS["pictures"]),
        ("template", EXPORTERS["templates"]),
        ("fold", EXPORTERS["motions"]),
        ("atlas query", EXPORTERS["pictures"]),
        ("atlas query", EXPORTERS["tables"]),
    ],
)
def test_the_help_of_a_command_lists_all_formats(command, table):
    words = set(re.findall(r"\.\w+", run(*command.split(), "--help").stdout))
    assert set(table) <= words
