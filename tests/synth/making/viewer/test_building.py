"""The script built by npm and esbuild, which stand-ins play here; the real ones: test_in_chromium."""

import os
import shutil
import stat

import pytest

from synth.making.viewer.building import build

NPM = """#!{sh}
echo npm "$@" >> {log}
{ending}
mkdir -p node_modules/.bin node_modules/three
echo "free for all" > node_modules/three/LICENSE
cat > node_modules/.bin/esbuild <<'END'
#!{sh}
mkdir built
cp src/page/main.js built/page.js
echo '{{"inputs": {{"src/page/main.js": {{}}, "node_modules/three/build/three.js": {{}}}}}}' > meta.json
END
chmod +x node_modules/.bin/esbuild
"""


@pytest.fixture
def web(tmp_path):
    folder = tmp_path / "web"
    (folder / "src" / "page").mkdir(parents=True)
    (folder / "src" / "page" / "main.js").write_text("first()")
    (folder / "node_modules").mkdir()
    (folder / "node_modules" / "large").write_text("not copied, not looked at")
    for name in ("package.json", "package-lock.json"):
        (folder / name).write_text("{}")
    return folder


@pytest.fixture
def npm(tmp_path, monkeypatch):
    """A stand-in for npm, alone on the path with what it needs; calls are logged."""
    if os.name == "nt":
        pytest.skip("the stand-in is a shell script")
    tools = tmp_path / "tools"
    tools.mkdir()
    for name in ("mkdir", "cat", "chmod", "cp"):
        (tools / name).symlink_to(shutil.which(name))
    sh = shutil.which("sh")
    monkeypatch.setenv("PATH", str(tools))
    monkeypatch.delenv("SYNTHEDRA_NO_PAGE", raising=False)

    def installed(ending=""):
        place = tools / "npm"
        place.write_text(NPM.format(sh=sh, log=tmp_path / "log", ending=ending))
        place.chmod(place.stat().st_mode | stat.S_IXUSR)
        return lambda: (tmp_path / "log").read_text().splitlines()

    return installed


def test_it_is_built_where_sources_differ_from_the_stamp(web, npm, tmp_path):
    calls, built = npm(), tmp_path / "built"
    assert build(web, built) == ""
    assert (built / "page.js").read_text() == "first()"
    assert "free for all" in (built / "LICENSES.txt").read_text()
    assert build(web, built) == ""
    (web / "node_modules" / "large").write_text("changed")
    assert build(web, built) == ""
    assert len(calls()) == 1
    assert "--ignore-scripts" in calls()[0]
    assert "--fetch-retries=0" in calls()[0]
    (web / "src" / "page" / "main.js").write_text("second()")
    assert build(web, built) == ""
    assert (built / "page.js").read_text() == "second()"
    (web / "package-lock.json").write_text("{ }")
    assert build(web, built) == ""
    assert len(calls()) == 3


def test_what_is_out_of_reach_is_told_and_what_was_built_is_kept(web, npm, tmp_path):
    built = tmp_path / "built"
    npm()
    assert build(web, built) == ""
    npm(ending="echo 'npm error code ENOTFOUND' >&2; exit 1")
    (web / "package-lock.json").write_text("{ }")
    assert build(web, built) == "npm failed: npm error code ENOTFOUND"
    assert (built / "page.js").read_text() == "first()"


def test_without_npm_or_if_it_is_not_wanted_nothing_is_built(web, npm, tmp_path, monkeypatch):
    assert build(web, tmp_path / "built") == "npm was not found"
    monkeypatch.setenv("SYNTHEDRA_NO_PAGE", "1")
    assert build(web, tmp_path / "built") == "SYNTHEDRA_NO_PAGE is set"
    assert not (tmp_path / "built").exists()
