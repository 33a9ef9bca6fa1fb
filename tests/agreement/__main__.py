"""Ask all verbs about all mechanisms with coordinates in many guises: `python -m tests.agreement --help`.

Each disagreement is a line; at the end, or with Ctrl-C, there is a table of what was compared. Crease patterns by other people are
taken from the folder that SYNTHEDRA_FOLD names, or from ../shared/fold.
"""

from __future__ import annotations

import argparse
import sys
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.agreement.comparison import Table
from tests.agreement.running import comparisons
from tests.agreement.specimens import specimens
from tests.agreement.verbs import DOORS, VERBS
from tests.support.real_patterns import folder_of_patterns


def main() -> int:
    """Ask; return 1 where verbs disagree."""
    options = _options()
    verbs = [verb for verb in VERBS if verb.name in options.verbs]
    if not folder_of_patterns().is_dir():
        print(f"no crease patterns at {folder_of_patterns()}; name their folder in SYNTHEDRA_FOLD", file=sys.stderr)
    table = Table()
    with suppress(KeyboardInterrupt), TemporaryDirectory() as folder:  # what was compared so far is counted
        for one in comparisons(
            specimens(options.files),
            Path(folder),
            variants=options.variants,
            verbs=verbs,
            doors=DOORS[: 1 if options.python_only else None],
            seconds=options.seconds,
        ):
            table.add(one.variant, one.outcomes, one.disagreements)
            for disagreement in one.disagreements:
                print(f"{one.file} | {one.variant} | {disagreement}", flush=True)
    print(table)
    return bool(table.differ)


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m tests.agreement", description=__doc__)
    parser.add_argument("--files", default="", metavar="SUBSTRING", help="Only mechanisms whose names contain it.")
    parser.add_argument("--variants", default="", metavar="SUBSTRING", help="Only guises whose names contain it.")
    names = [verb.name for verb in VERBS]
    parser.add_argument("--verbs", nargs="+", default=names, choices=names, help="Only these verbs.")
    parser.add_argument("--python-only", action="store_true", help="Do not ask at the command line.")
    parser.add_argument("--seconds", type=float, default=60.0, help="Leave out what takes more processor time.")
    return parser.parse_args()


if __name__ == "__main__":
    sys.exit(main())
