"""A package with two compiled functions, one calling the other, and processes that call them."""

import json
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent

_FILES = {
    "__init__.py": '"""A toy."""\n',
    "inner.py": "from enumerate.kernel._compiled import compiled\n\n\n@compiled\ndef inner(x):\n    return x + 1\n",
    "outer.py": "from enumerate.kernel._compiled import compiled\nfrom toy.inner import inner\n\n\n"
    "@compiled\ndef outer(x):\n    return 10 * inner(x)\n",
}


def make_toy(folder: Path) -> Path:
    """Write the package into a folder."""
    package = folder / "toy"
    package.mkdir()
    for name, text in _FILES.items():
        (package / name).write_text(text)
    return package


def edit(file: Path, before: str, after: str) -> None:
    """Change a file, to a text of the same length if the two are."""
    text = file.read_text()
    assert before in text
    file.write_text(text.replace(before, after))


def run(code: str, folder: Path, cache: Path, machine_code: str = "always"):
    """Run Python with the toy package in reach; return what it printed as JSON, and standard error."""
    path = os.pathsep.join([str(folder), str(ROOT)])
    environment = {**os.environ, "PYTHONPATH": path, "SYNTHEDRA_CACHE": str(cache), "PYTHONDONTWRITEBYTECODE": "1"}
    environment["SYNTHEDRA_MACHINE_CODE"] = machine_code
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout), done.stderr
