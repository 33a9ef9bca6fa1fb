"""Write docs/papers.md from its rows, with what comes out of each: ``make examples``. It takes about a minute."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "tests" / "support")]

from paper_rows.page import numbered, page  # noqa: E402
from paper_rows.row import value_of  # noqa: E402


def main() -> None:
    """Ask all, and write the page."""
    with TemporaryDirectory() as folder:
        (Path(folder) / "data").symlink_to(ROOT / "data")
        os.chdir(folder)
        figures = {number: value_of(row)[0] for number, _, row in numbered() if not (row.why or row.same)}
        os.chdir(ROOT)
    (ROOT / "docs" / "papers.md").write_text(page(figures), encoding="utf-8")


if __name__ == "__main__":
    main()
