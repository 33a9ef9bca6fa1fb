"""glTF by the Khronos validator (npm `gltf-validator`), where node finds it; `make test-web` installs it."""

import json
import shutil
import subprocess

import pytest
from commands import run

CHECK = """
const validator = require('gltf-validator'), fs = require('fs');
validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[1])))
  .then((report) => console.log(JSON.stringify(report.issues)));
"""

pytestmark = pytest.mark.web


@pytest.fixture(scope="module")
def issues_of():
    node = shutil.which("node")
    found = [node or "node", "-e", "require('gltf-validator')"]
    if node is None or subprocess.run(found, check=False, capture_output=True).returncode:
        pytest.skip("node does not find gltf-validator (NODE_PATH)")

    def issues(path):
        told = subprocess.run([node, "-e", CHECK, str(path)], capture_output=True, text=True, check=True)
        return json.loads(told.stdout)

    return issues


def test_a_folding_and_a_linkage_on_a_cone_are_valid(issues_of, data, tmp_path):
    run("generate", "miura", "-o", tmp_path / "flat.fold")
    run("fold", tmp_path / "flat.fold", "--frames", 5, "-o", tmp_path / "frames.fold")
    run("convert", tmp_path / "frames.fold", tmp_path / "moving.gltf", "--size", 120)
    run("generate", "box-pop-up", "--fold", 60, "-o", tmp_path / "box.fold")
    run("convert", tmp_path / "box.fold", tmp_path / "still.gltf", "--size", 120)
    run("convert", data / "surfaces" / "fig11-stephenson.json", tmp_path / "cone.gltf", "--thickness", 0.5)
    for name in ("moving", "still", "cone"):
        found = issues_of(tmp_path / f"{name}.gltf")
        assert (found["numErrors"], found["numWarnings"]) == (0, 0), found["messages"]


def test_the_validator_sees_what_is_wrong(issues_of, tmp_path):
    (tmp_path / "a.gltf").write_text('{"asset": {"version": "2.0"}, "scene": 3}')
    assert issues_of(tmp_path / "a.gltf")["numErrors"] > 0
