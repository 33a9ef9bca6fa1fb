"""Write what the commands of the documentation print into it, anew: ``make examples``.

Only outputs that do not agree with what is written are replaced, and lines of dots are kept where they are written
last: look at the changes before they are kept.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from tests.support.examples import agree, commands_of, fences_of, printed_by  # noqa: E402


def main() -> None:
    """Look through the documents named, or through all."""
    places = [Path(name).resolve() for name in sys.argv[1:]]
    places = places or [ROOT / "README.md", *(ROOT / "docs").glob("*.md"), *(ROOT / "docs" / "guides").glob("*.md")]
    for place in places:
        with TemporaryDirectory() as folder:
            (Path(folder) / "data").symlink_to(ROOT / "data")
            os.chdir(folder)
            text = place.read_text(encoding="utf-8")
            made = renewed(text)
            os.chdir(ROOT)
        if made != text:
            place.write_text(made, encoding="utf-8")
            print(place.relative_to(ROOT))


def renewed(document: str) -> str:
    """Return a document whose blocks say what their commands print."""
    made, end = "", 0
    for fence in fences_of(document):
        if fence.place is not None:
            Path(fence.place).write_text(fence.text, encoding="utf-8")
        if fence.language == "console":
            made += document[end : fence.start] + _block(fence.text)
            end = fence.end
    return made + document[end:]


def _block(text: str) -> str:
    heads = ["$ " + part.partition("\n")[0] for part in ("\n" + text).split("\n$ ")[1:]]
    lines: list[str] = []
    for head, command in zip(heads, commands_of(text), strict=True):
        printed = printed_by(command.words)
        lines += [head, *(command.output if agree(command.output, printed) else printed)]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    main()
