"""A process that gives mutated files to the commands that work with coordinates, two of them for each file.

Whatever the file, a command ends with 0, 1 or 2 within twenty seconds of the processor and two gigabytes, with no
traceback, no warning, and no output left behind where it refused. What does not is printed as a line of JSON; a
command that hangs ends the process, and the file at which it was is in its folder.
"""

from __future__ import annotations

import faulthandler
import json
import os
import random
import resource
import signal
import sys
import warnings
from collections.abc import Sequence
from pathlib import Path

from click.testing import CliRunner
from mutated_files import mutated, seeds

from graphs.convert.conversions import CONVERSIONS, FORMS
from graphs.files.formats import WRITERS
from synth.cli.main import main as synth_command

SECONDS = 20
GIGABYTES = 2
ANSWERS = (0, 1, 2)
_MORE = {
    ".json": ["linkages/bennett", "linkages/kaleidocycle-6", "linkages/stewart"],
    ".fold": ["wiener/miura-4x4", "wiener/square-twist", "linkages/wampler-fig1-folded"],
}
"""Further files of the project's own, besides those that reading is tried with."""

_CHOICES: dict[str, list[str]] = {
    "fold": ["", "--all", "--branches --json", "--drive 0=30 --frames 3", "--branch 1 --frames 2", "--along 0=1 --frames 4",
             "--collisions --frames 5", "--frames 3 -o {out}.fold", "--frames 2 -o {out}.svg", "--frames 1 -o {out}.obj"],
    "draw": ["-o {out}.svg", "-o {out}.svg --as graph", "-o {out}.svg --as folded", "-o {out}.svg --as model",
             "-o {out}.pdf --colour branch", "-o {out}.svg --colour centres --graph", "-o {out}.png --colour verdict"],
    "view": ["-o {out}.html"],
    "template": ["-o {out}.pdf", "-o {out}.svg --size 100", "-o {out}.dxf --scale 3 --slots", "-o {out}.pdf --size 90 --as space",
                 "-o {out}.dxf --size 200 --hinges living --hinge-width 3", "-o {out}.svg --size 200 --hinges offset --hinge-width 2"],
    "advise": ["--freedoms 0", "--freedoms 1 --json", "--freedoms 2 --leave-out", "--freedoms 3 --size 2"],
    "explain": ["", "--json"],
    "states": ["--joint 0", "--joint 0 --link 1 --json", "--stiffness 0=1 --rest 0=40", "--stiffness 0=2 --drive 0=20 --frames 3",
               "--stiffness 0=1 --density 1 --ground 0", "--stiffness 1=1 --mass 1=2@0,1,0 --moment 0=1"],
    "convert": ["{out}.stl --size 100", "{out}.gltf --size 80 --gap 0", "{out}.obj --thickness 2 --size 90", "{out}{suffix} --lossy",
                "{out}{suffix} --to {kind} --lossy", "{out}{suffix} --form {form} --lossy", "{out}.csv --table axes"],
    "realise": ["-o {out}.fold", "-o {out}.fold --as space --tries 2", "--as cone --tries 2", "--flat-foldable --tries 1",
                "--symmetric --tries 2 --json", "-o {out}.svg --seed 5 --tries 1"],
}  # fmt: skip
"""The nine commands, and how they are asked."""


def questions(rng: random.Random) -> list[list[str]]:
    """Return two commands with their options, as templates in which the file is the second word."""
    fillings = {
        "suffix": rng.choice(sorted(WRITERS)),
        "kind": rng.choice(sorted(CONVERSIONS)),
        "form": rng.choice(sorted(FORMS)),
    }
    made = []
    for name in rng.sample(sorted(_CHOICES), 2):
        words = rng.choice(_CHOICES[name]).format(out="{out}", **fillings).split()
        made.append([name, "{file}", *words])
    return made


def fault_of(words: Sequence[str], file: Path) -> str | None:
    """Run a command on a file beside which it may write; return what is wrong with how it ended, or None."""
    out = file.parent / "written"
    asked = [word.format(file=file, out=out) for word in words]
    before = set(file.parent.iterdir())
    result = CliRunner().invoke(synth_command, asked)
    left = set(file.parent.iterdir()) - before
    for place in left:
        place.unlink()
    if result.exit_code not in ANSWERS:
        return f"exit status {result.exit_code}\n{result.stderr[-3000:]}"
    if result.exit_code == 2 and (left or not result.stderr.strip()):
        return f"refused, and left {sorted(one.name for one in left)} behind: {result.stderr}"
    if result.exit_code < 2 and "--json" in words:
        json.loads(result.stdout)
    return None


def limited(seconds: int = SECONDS) -> None:
    """End this process where it needs more time of the processor from now on; 0 takes the limit away."""
    signal.setitimer(signal.ITIMER_PROF, seconds)


def prepare() -> None:
    """Make warnings errors, tell where the process was when it ran out of time, and bound its memory."""
    warnings.simplefilter("error")
    os.environ["SYNTHEDRA_DEBUG"] = "1"
    faulthandler.register(signal.SIGPROF, chain=True)
    _, hard = resource.getrlimit(resource.RLIMIT_DATA)
    resource.setrlimit(resource.RLIMIT_DATA, (GIGABYTES * 2**30, hard))


def main() -> None:
    """Ask files from one number to another: folder to work in, data folder, seed, first, last.

    Of each that failed, and of the one that is asked, a line of JSON tells number, words and what was wrong.
    """
    folder, data, seed, first, last = sys.argv[1:]
    prepare()
    place = Path(folder)
    files = seeds(Path(data), place)
    for suffix, names in _MORE.items():
        files[suffix] += [(Path(data) / (name + suffix)).read_bytes() for name in names]
    for old in place.iterdir():
        old.unlink()
    suffixes = sorted(files)
    for number in range(int(first), int(last)):
        rng = random.Random(f"{seed} {number}")
        suffix = rng.choice([".fold", ".json", rng.choice(suffixes)])
        file = place / f"mutated{suffix}"
        file.write_bytes(mutated(rng.choice(files[suffix]), rng))
        for words in questions(rng):
            tell(number, words, "began")
            limited()
            wrong = fault_of(words, file)
            limited(0)
            tell(number, words, wrong or "ended")
        file.unlink()


def tell(number: int, words: Sequence[str], what: str) -> None:
    """Print a line of JSON."""
    print(json.dumps([number, list(words), what]), flush=True)


if __name__ == "__main__":
    main()
