"""What a question loads and calls: nothing of kinds of mechanism that it is not about."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
ANSWER = """
import inspect, json, sys
from pathlib import Path

root, often, files = Path(sys.argv[1]), {}, set()
rooms = tuple(str(root / room) for room in ("graphs", "enumerate", "synth"))

def note(frame, event, arg):
    code = frame.f_code
    if event == "call" and code.co_flags & inspect.CO_OPTIMIZED and code.co_filename.startswith(rooms):
        often[code.co_name] = often.get(code.co_name, 0) + 1
        above = frame.f_back
        while above is not None and not (above.f_code.co_name == "<module>" and above.f_code.co_filename.startswith(rooms)):
            above = above.f_back
        if above is None:  # not on behalf of a module that is being imported
            files.add(str(Path(code.co_filename).relative_to(root)))

sys.setprofile(note)
from synth.cli.main import main
try:
    main(sys.argv[2:])
except SystemExit as end:
    assert not end.code
finally:
    sys.setprofile(None)
sys.stdout.write("\\n" + json.dumps([sorted(sys.modules), sorted(files), often]))
"""
NOT_ASKED = ("synth.linkages", "synth.catalogue", "synth.synthesis", "synth.making", "enumerate", "graphs.files.robots")


def loaded_by(*command):
    done = subprocess.run(
        [sys.executable, "-c", ANSWER, str(ROOT), *map(str, command)],
        capture_output=True, text=True, check=True, cwd=ROOT,
    )  # fmt: skip
    return json.loads(done.stdout.splitlines()[-1])


@pytest.fixture(scope="module")
def bird_base():
    return loaded_by("mobility", "data/patterns/bird-base.fold")


def test_a_question_about_a_sheet_loads_no_other_kinds(bird_base):
    modules, _, _ = bird_base
    assert [name for name in modules if name.startswith(NOT_ASKED)] == []


def test_a_question_about_a_sheet_is_answered_by_few_files(bird_base):
    _, files, often = bird_base
    assert len(files) <= 95
    assert [name for name in files if name.startswith(tuple(room.replace(".", "/") for room in NOT_ASKED))] == []
    assert (often["linkage_of_sheet"], often["precision_as_written"]) == (1, 1)


def test_one_vertex_waits_for_no_search_of_near_points():
    modules, _, _ = loaded_by("mobility", "data/patterns/four-bar-vertex.fold")
    assert not {"scipy.spatial", "scipy.optimize", "shapely.plotting"} & set(modules)


def test_linkages_on_surfaces_are_placed_all_the_same():
    modules, _, often = loaded_by("mobility", "tests/support/seeds/watt-on-cone.json")
    assert "synth.linkages.conformed.linkage_behaviour" in modules
    assert often["placed_chain"] == 1
