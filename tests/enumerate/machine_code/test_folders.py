"""Folders of machine code: whose they are, and which go."""

import os
import shutil
import tempfile
import time
from pathlib import Path

import pytest

from enumerate.machine_code.folders import (
    bases,
    holds_code,
    make_folder,
    prune,
    safe,
    touch,
    usable_bases,
    writable_base,
)

unix = pytest.mark.skipif(os.name == "nt", reason="folders have no modes")
as_root = pytest.mark.skipif(getattr(os, "geteuid", lambda: 1)() != 0, reason="only root can give folders away")
NUMBER = "0" * 32
DAY = 86_400


@pytest.fixture
def places(tmp_path, monkeypatch):
    """Where machine code may go, below a temporary folder."""
    (tmp_path / "home").mkdir()
    (tmp_path / "temporary").mkdir()
    monkeypatch.setenv("SYNTHEDRA_CACHE", str(tmp_path / "named"))
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setenv("USERPROFILE", str(tmp_path / "home"))
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "temporary"))
    return tmp_path


def test_kept_code_is_seen_where_it_would_be_read_and_nothing_is_made(places):
    home = places / "home" / ".cache" / "synthedra"
    assert not holds_code()
    assert not (places / "named").exists()
    assert not home.exists()
    make_folder(home, f"enumerate.toy-{NUMBER}")
    assert not holds_code()  # the named base can be made: the one at home is not looked into
    make_folder(places / "named", f"synth.toy-{NUMBER}")
    make_folder(places / "named", "enumerate.toy")
    assert not holds_code()
    make_folder(places / "named", f"enumerate.toy-{NUMBER}")
    assert holds_code()
    shutil.rmtree(places / "named")
    (places / "named").write_text("a file is in the way")
    assert holds_code()  # at home


def test_the_best_folder_that_can_be_made_is_used(places):
    found = list(bases())
    assert found[:2] == [places / "named", places / "home" / ".cache" / "synthedra"]
    assert found[2].parent == places / "temporary"
    assert writable_base() == found[0]
    found[0].rmdir()
    found[0].write_text("a file is in the way")
    (places / "home" / ".cache").write_text("here too")
    assert writable_base() == found[2]
    assert os.name == "nt" or found[2].stat().st_mode & 0o777 == 0o700
    found[2].rmdir()
    found[2].write_text("and here")
    assert writable_base() is None


def test_no_folder_is_looked_into_beyond_the_one_that_is_written(places):
    assert list(usable_bases()) == [places / "named"]
    assert not (places / "home" / ".cache").exists()


@unix
@pytest.mark.parametrize("which", ["base", "inner"])
@pytest.mark.parametrize("mode", [0o777, 0o770, 0o702, 0o1777])
def test_a_folder_that_others_may_write_is_refused(places, which, mode):
    base = places / "named"
    folder = make_folder(base, "inner")
    assert folder == safe(base, "inner") == base / "inner"
    {"base": base, "inner": folder}[which].chmod(mode)
    assert safe(base, "inner") is None
    assert make_folder(base, "inner") is None


@unix
@as_root
@pytest.mark.parametrize("which", ["base", "inner"])
def test_a_folder_of_another_user_is_refused(places, which):
    base = places / "named"
    folder = make_folder(base, "inner")
    os.chown({"base": base, "inner": folder}[which], 12345, -1)
    assert safe(base, "inner") is None
    assert writable_base() == (base if which == "inner" else places / "home" / ".cache" / "synthedra")


@unix
@as_root
def test_a_link_of_another_user_is_refused(places):
    (places / "mine").mkdir(mode=0o700)
    (places / "named").symlink_to(places / "mine")
    assert make_folder(places / "named") == places / "named"
    os.lchown(places / "named", 12345, -1)
    assert make_folder(places / "named") is None


@unix
@as_root
def test_nothing_is_made_in_the_home_of_another_user(places):
    os.chown(places / "home", 12345, -1)
    assert places / "home" / ".cache" / "synthedra" not in list(bases())


def aged(folder: Path, days: float) -> Path:
    folder.mkdir(parents=True)
    (folder / "f.nbc").write_bytes(b"code")
    os.utime(folder, (time.time() - days * DAY,) * 2)
    return folder


def test_old_folders_go_and_what_is_no_such_folder_stays(tmp_path):
    old, new = aged(tmp_path / f"a.b-{NUMBER}", 31), aged(tmp_path / f"a.c-{NUMBER}", 29)
    others = [aged(tmp_path / name, 99) for name in ("thesis", f"-{NUMBER}", f"x y-{NUMBER}", "a.b-0")]
    file = tmp_path / f"file-{NUMBER}"
    file.write_text("a file")
    prune(tmp_path)
    prune(tmp_path / "nowhere")
    assert not old.exists()
    assert all(path.exists() for path in [new, file, *others])


def test_the_newest_folders_of_a_module_stay(tmp_path):
    folders = [aged(tmp_path / f"a.b-{number:032x}", number) for number in range(12)]
    other = aged(tmp_path / f"a.c-{NUMBER}", 20)
    prune(tmp_path)
    assert [folder.exists() for folder in folders] == [True] * 8 + [False] * 4
    assert other.exists()


def test_a_folder_that_is_used_stays_young(tmp_path):
    folder, today = aged(tmp_path / f"a.b-{NUMBER}", 29), aged(tmp_path / f"a.c-{NUMBER}", 0.5)
    before = today.stat().st_mtime
    touch(folder)
    touch(today)
    touch(tmp_path / "nowhere")
    assert time.time() - folder.stat().st_mtime < DAY
    assert today.stat().st_mtime == before


def test_nowhere_to_write_is_no_error(tmp_path, monkeypatch):
    """No folder named, no home that is this user's, no temporary folder: code is compiled, and kept nowhere."""
    closed = tmp_path / "a file, no folder"
    closed.write_text("")
    monkeypatch.setenv("SYNTHEDRA_CACHE", str(closed / "cache"))
    monkeypatch.setenv("HOME", str(closed / "home"))
    monkeypatch.setattr(tempfile, "tempdir", str(closed / "tmp"))
    assert list(usable_bases()) == []
    assert writable_base() is None


def test_caches_of_the_user_may_be_elsewhere(places, monkeypatch):
    usual, elsewhere = places / "home" / ".cache" / "synthedra", places / "caches" / "synthedra"
    monkeypatch.setenv("XDG_CACHE_HOME", str(places / "caches"))
    assert elsewhere in bases()
    assert usual not in bases()
    monkeypatch.setenv("SYNTHEDRA_CACHE", "")
    assert writable_base() == elsewhere
    monkeypatch.setenv("XDG_CACHE_HOME", "caches")  # the specification has relative paths ignored
    assert usual in bases()


@pytest.mark.skipif(not hasattr(os, "geteuid"), reason="users have no numbers")
def test_caches_of_another_user_are_not_used(places, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(places / "home"))
    monkeypatch.setattr(os, "geteuid", lambda: 12_345_678)
    assert places / "home" / "synthedra" not in list(bases())
