"""Files of C beside those of Python: built by the installation, with whatever compiler is there, and loaded.

Such a file does what a Python function beside it does too, faster: it takes arrays and knows nothing of Python, so it
is called without the interpreter's lock. Where there is no compiler, or a library is not of this version of its
source, the Python function does the work, and `synth --version` says so.

This file stands alone, since it runs before anything is installed: as part of the installation, and from the
command line (``python -m graphs.c_libraries``), which builds what is not there yet.
"""

import ctypes
import os
import shutil
import subprocess
import sys
import sysconfig
from functools import cache
from hashlib import sha256
from pathlib import Path

__all__ = ["build", "library", "place_of", "sources"]

_ROOT = Path(__file__).resolve().parent.parent
_PACKAGES = ("graphs", "enumerate", "synth")
_FLAGS = ("-O3", "-std=c99", "-fPIC", "-shared", "-ffp-contract=off", "-fvisibility=hidden", "-pthread")
"""No products and sums are contracted: processors would round them differently."""
_OFF = "SYNTHEDRA_COMPILED"
_SECONDS = 120  # a compiler takes some, also under emulation; one that hangs must not hang the installation


def sources(root: Path = _ROOT) -> list[Path]:
    """Return all files of C of the packages."""
    return sorted(path for package in _PACKAGES for path in (root / package).rglob("*.c"))


def place_of(source: Path) -> Path:
    """Return where the library of a source is kept: its name says of which version it and the headers beside it are."""
    read = [source.read_bytes(), *(header.read_bytes() for header in sorted(source.parent.glob("*.h")))]
    digest = sha256(b"".join([repr(_FLAGS).encode(), *read])).hexdigest()[:12]
    return source.parent / "built" / f"{source.stem}-{digest}{'.dll' if os.name == 'nt' else '.so'}"


def build(source: Path) -> str:
    """Build the library of a source unless it is there; return why not, empty if it is there."""
    target = place_of(source)
    if target.exists():
        return ""
    compiler = _compiler()
    if not compiler:
        return "no C compiler was found"
    target.parent.mkdir(parents=True, exist_ok=True)
    beside = target.with_name(f".{target.name}.{os.getpid()}")
    try:
        run = subprocess.run(
            [*compiler, *_FLAGS, str(source), "-o", str(beside), "-lm"],
            capture_output=True,
            text=True,
            timeout=_SECONDS,
            check=False,
            stdin=subprocess.DEVNULL,
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        return f"{compiler[0]} could not be run: {type(error).__name__}"
    if run.returncode:
        beside.unlink(missing_ok=True)
        errors = [line.strip() for line in run.stderr.splitlines() if "error" in line.lower()]
        return f"{compiler[0]} failed: {errors[0] if errors else f'status {run.returncode}'}"
    for old in target.parent.glob(f"{source.stem}-*"):
        old.unlink(missing_ok=True)
    beside.replace(target)
    return ""


def _compiler() -> list[str]:
    """Return the command of a compiler: the one that CC names, else a usual one."""
    named = os.environ.get("CC") or sysconfig.get_config_var("CC") or ""
    for words in ([*named.split()], ["cc"], ["gcc"], ["clang"]):
        if words and shutil.which(words[0]):
            return words[:1]
    return []


@cache
def library(source: Path) -> ctypes.CDLL | None:
    """Return the library of a source; None where it was not built, or SYNTHEDRA_COMPILED is "never"."""
    place = place_of(source) if source.exists() else None
    if os.environ.get(_OFF) == "never" or place is None or not place.exists():
        return None
    try:
        return ctypes.CDLL(str(place))
    except OSError:  # of another kind of machine: a folder that two machines share
        return None


def main() -> int:
    """Build all libraries, and say which could not be: an installation without them works all the same."""
    for source in sources():
        why = build(source)
        if why:
            print(f"{source.relative_to(_ROOT)} was not built, Python does its work: {why}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
