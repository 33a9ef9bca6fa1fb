"""Mutated files: each is read and reported, or refused with one line; nothing else."""

from __future__ import annotations

import random
import re
import resource
import signal
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from oripa import opx_text

from graphs.convert.duality import mechanism_of_sheet
from graphs.convert.table import to_sc
from graphs.count.report import mobility_report
from graphs.errors import SynthedraError
from graphs.files.formats import READERS, read_all, write
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sheet import Sheet

SECONDS = 5
GIGABYTE = 2**30
EXTREMES = [b"0", b"-1", b"1e308", b"-1e309", b"NaN", b"null", b"99999999999999999999", b"1e-320", b"2000001", b"true", b'""',
            b"[]", b"{}", b"\xff", b"<", b"&", b"\x00", b"0.1", b"3"]  # fmt: skip


def seeds(data: Path, folder: Path) -> dict[str, list[bytes]]:
    """Return small files of every format, made from the project's own."""
    sheet_file, scd_file = data / "patterns" / "bird-base.fold", data / "wiener" / "table3-row3.json"
    made: dict[str, list[bytes]] = {suffix: [] for suffix in READERS}
    for file in (sheet_file, data / "patterns" / "four-bar-vertex.fold"):
        made[".fold"].append(file.read_bytes())
    for name in ("table3-row3", "watt", "concentric-loops"):
        made[".json"].append((data / "wiener" / f"{name}.json").read_bytes())
    for name in ("fig12", "crs-platform"):
        made[".json"].append((data / "wampler" / f"{name}.json").read_bytes())
    (sheet,), (scd,) = read_all(sheet_file), read_all(scd_file)
    for suffix in (".svg", ".cp", ".obj"):
        write(sheet.mechanism, folder / f"seed{suffix}")
        made[suffix].append((folder / f"seed{suffix}").read_bytes())
    for suffix in (".g6", ".s6", ".graphml", ".edges", ".txt"):
        write(scd.mechanism, folder / f"seed{suffix}")
        made[suffix].append((folder / f"seed{suffix}").read_bytes())
    made[".svg"].append(
        b'<svg xmlns="http://www.w3.org/2000/svg"><g transform="rotate(30) scale(2 1)" style="stroke:#f00">'
        b'<rect width="9" height="8" stroke="black"/><path d="M0 4h9m-4-4c1 3 3 1 0 8A2 3 4 0 1 9 9z"/>'
        b'<polyline points="1,2 3,4 5,1" stroke="rgb(0,0,255)"/><circle r="3" stroke="blue"/></g></svg>'
    )
    lines = ((1, 0, 0, 9, 0), (1, 9, 0, 9, 8), (1, 9, 8, 0, 8), (1, 0, 8, 0, 0), (2, 0, 0, 9, 8), (3, 9, 0, 0, 8))
    made[".opx"].append(opx_text(lines).encode())
    made[".edges"].append(b"0 1 {'weight': 3}\n1 2 {}\n2 3 {}\n3 0 {}\n")
    made[".csv"].append(b',source,target,weight\n0,0,1,1.0\n1,1,2,1.0\n2,"2",3,1.0\n3,3,0,1.0\n')
    return made


def mutated(seed: bytes, rng: random.Random) -> bytes:
    """Change a few bytes, numbers or stretches of a file."""
    raw = bytearray(seed)
    for _ in range(rng.choice([1, 1, 1, 2, 3, 8])):
        if not raw:
            break
        at, kind = rng.randrange(len(raw)), rng.randrange(8)
        length = rng.choice([1, 2, 8, 40])
        if kind == 0:
            raw[at] = rng.randrange(256)
        elif kind == 1:
            del raw[at : at + length]
        elif kind == 2:
            raw[at:at] = raw[max(0, at - length) : at + length]
        elif kind == 3:
            del raw[at:]
        elif kind == 4:
            raw[at:at] = rng.choice(EXTREMES)
        else:  # most of all, numbers and words become others
            words = list(re.finditer(rb"[-\w.]+", bytes(raw)))
            if words:
                word = rng.choice(words)
                other = rng.choice(words).group() if rng.random() < 0.5 else rng.choice(EXTREMES)
                raw[word.start() : word.end()] = other
    return bytes(raw)


def answer(path: Path) -> str | None:
    """Read and report a file; return the error line, None if there is an answer."""
    try:
        for entry in read_all(path):
            thing = entry.mechanism
            if isinstance(thing, Sheet):
                mobility_report(mechanism_of_sheet(thing).sc).to_json()
            else:
                mobility_report(thing if isinstance(thing, PolyhedronModel) else to_sc(thing)).to_json()
    except SynthedraError as error:
        return str(error)
    return None


@contextmanager
def told_on_failure(words: str) -> Iterator[None]:
    """Stop the clock, and say on stderr what was tried unless it came to its end."""
    done = False
    try:
        yield
        done = True
    finally:
        signal.alarm(0)
        if not done:
            sys.stderr.write(words + "\n")


def fuzz(suffix: str, number: int, seed: int, data: Path) -> tuple[int, int]:
    """Try so many mutated files of a format; return how many were answered and refused.

    Anything but an answer or one line within five seconds and a gigabyte raises.
    """
    rng = random.Random(f"{suffix} {seed}")
    answered = refused = 0

    def late(*_: object) -> None:
        raise TimeoutError(f"more than {SECONDS} s")

    signal.signal(signal.SIGALRM, late)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        files = seeds(data, folder)[suffix]
        path = folder / f"mutated{suffix}"
        for i in range(number):
            raw = mutated(rng.choice(files), rng)
            path.write_bytes(raw)
            with told_on_failure(f"file {i} of {suffix}, seed {seed}: {raw[:2000]!r}"):
                signal.alarm(SECONDS)
                line = answer(path)
            answered += line is None
            refused += line is not None
            assert line is None or ("\n" not in line and len(line) < 1000), line
    return answered, refused


def main() -> None:
    """Run from the command line in a process of its own: suffix, number, seed, data folder."""
    suffix, number, seed, data = sys.argv[1:]
    fuzz(suffix, 20, 0, Path(data))  # load what is loaded lazily before the limit is set
    _, hard = resource.getrlimit(resource.RLIMIT_DATA)
    used = int(Path("/proc/self/statm").read_text().split()[5]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_DATA, (used + GIGABYTE, hard))
    print(*fuzz(suffix, int(number), int(seed), Path(data)))


if __name__ == "__main__":
    main()
