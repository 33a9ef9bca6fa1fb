"""Compare the verdicts on crease patterns in many guises: `python -m tests.invariance --help`.

Each difference is a line; at the end, or with Ctrl-C, there is a table. Crease patterns by other people are taken
from the folders that SYNTHEDRA_FOLD and SYNTHEDRA_LAYERS name, or from ../shared.
"""

from __future__ import annotations

import argparse
import sys
from contextlib import suppress

from tests.invariance.comparing import Table, comparisons
from tests.invariance.guises import GUISES
from tests.invariance.patterns import folder_of_layers, patterns
from tests.support.real_patterns import folder_of_patterns


def main() -> int:
    """Compare; return 1 where verdicts differ."""
    parser = argparse.ArgumentParser(prog="python -m tests.invariance", description=__doc__)
    parser.add_argument("--files", default="", metavar="SUBSTRING", help="Only patterns whose names contain it.")
    parser.add_argument("--guises", nargs="+", choices=list(GUISES), help="Only these guises.")
    parser.add_argument("--seconds", type=float, default=12.0, help="Leave out what takes longer.")
    options = parser.parse_args()
    for folder in (folder_of_patterns(), folder_of_layers()):
        if not folder.is_dir():
            print(f"no crease patterns at {folder}", file=sys.stderr)
    table = Table()
    with suppress(KeyboardInterrupt):  # what was compared so far is counted
        for one in comparisons(patterns(options.files), options.guises, options.seconds):
            table.add(one)
            if one.differ:
                print(one, flush=True)
    print(table)
    return bool(table.differ.total())


if __name__ == "__main__":
    sys.exit(main())
