"""A process that asks mutated files: each answer, or one line, within ten seconds and two gigabytes; nothing else.

The limits are those of docs/files.md. They are the system's, so that no handler of errors on the way can take
them for a fault of the file, and no loop in compiled code outlasts them; seconds are of the processor.
"""

from __future__ import annotations

import faulthandler
import random
import resource
import signal
import sys
import time
import warnings
from pathlib import Path

from mutated_files import mutated, seeds
from questions import count_only, front_door

SECONDS = 10
GIGABYTES = 2
_LONGEST_LINE = 1_000

QUESTIONS = {"count": count_only, "front": front_door}


def fuzz(suffix: str, number: int, seed: int, questions: str, folder: Path, data: Path) -> tuple[int, int]:
    """Ask so many mutated files of a format; return of how many the first question was answered and refused.

    The file that is asked is ``mutated`` in the folder, for whoever wants to know at which one a process ended.
    """
    rng = random.Random(f"{suffix} {seed}")
    files = seeds(data, folder)[suffix]
    path = folder / f"mutated{suffix}"
    refused = 0
    for _ in range(number):
        path.write_bytes(mutated(rng.choice(files), rng))
        lines = []
        signal.setitimer(signal.ITIMER_PROF, SECONDS)
        for line in QUESTIONS[questions](path, rng):
            signal.setitimer(signal.ITIMER_PROF, SECONDS)
            lines.append(line)
        signal.setitimer(signal.ITIMER_PROF, 0)
        for line in filter(None, lines):
            assert "\n" not in line and len(line) < _LONGEST_LINE, line  # noqa: PT018
        refused += lines[0] is not None
    return number - refused, refused


def main() -> None:
    """Run in a process of its own: questions, number, seed, folder to work in, data folder, suffixes."""
    questions, number, seed, folder, data, *suffixes = sys.argv[1:]
    warnings.simplefilter("error")
    faulthandler.register(signal.SIGPROF, chain=True)  # tell where it was, and end
    _, hard = resource.getrlimit(resource.RLIMIT_DATA)
    resource.setrlimit(resource.RLIMIT_DATA, (GIGABYTES * 2**30, hard))
    for suffix in suffixes:
        start = time.process_time()
        answered, refused = fuzz(suffix, int(number), int(seed), questions, Path(folder), Path(data))
        print(suffix, answered, refused, round(time.process_time() - start), flush=True)


if __name__ == "__main__":
    main()
