"""In a notebook mechanisms, pictures and answers show themselves."""

from collections import namedtuple
from pathlib import Path
from xml.etree import ElementTree

import pytest

import synth
from enumerate.strings.panel_strings import ChainString
from graphs.files.formats import read
from synth.notebook import load_ipython_extension

DATA = Path(__file__).resolve().parents[1] / "data"
THINGS = {
    "graph": read("k1:Cr"),
    "sheet": read(DATA / "patterns" / "bird-base.fold"),
    "drawn": read(DATA / "wiener" / "fortune-teller.json"),
    "solids": read(DATA / "linkages" / "bennett.json"),
    "round a cone": read(DATA / "surfaces" / "fig11-stephenson.json"),
    "model": read(DATA / "wampler" / "cube-unlocked.json"),
    "string": ChainString((2, 1)),
    "picture": synth.draw(read("k1:Cr")),
}


class Formatter:
    """What IPython has for SVG: functions by the names of classes, and of those that they inherit from."""

    def __init__(self):
        self.of = {}

    def for_type_by_name(self, module, name, function):
        self.of[module, name] = function

    def __call__(self, thing):
        functions = (self.of.get((one.__module__, one.__name__)) for one in type(thing).__mro__)
        return next(function for function in functions if function is not None)(thing)


@pytest.fixture
def shown():
    formatter = Formatter()
    kind = namedtuple("kind", "display_formatter formatters", defaults=(None, None))
    load_ipython_extension(kind(display_formatter=kind(formatters={"image/svg+xml": formatter})))
    return formatter


@pytest.mark.parametrize("name", THINGS)
def test_mechanisms_are_shown_as_pictures(name, shown):
    assert ElementTree.fromstring(shown(THINGS[name])).tag.endswith("svg")


def test_what_cannot_be_drawn_is_described(shown):
    fan = synth.Sheet(5, (), "", ((0, 1, 2), (0, 1, 3), (0, 1, 4), (1, 0, 2)), tuple((i, i * i) for i in range(5)))
    assert shown(fan) is None


@pytest.mark.web
def test_a_notebook_that_is_run_shows_them():
    nbclient, nbformat = pytest.importorskip("nbclient"), pytest.importorskip("nbformat")
    pytest.importorskip("ipykernel")
    cells = [
        "import synth",
        "synth.read('k1:Cr')",
        f"synth.read({str(DATA / 'patterns' / 'bird-base.fold')!r})",
        "synth.draw(synth.read('k1:Cr'), 'graph')",
        "synth.mobility(synth.read('k1:Cr'))",
        "synth.move(synth.read(" + repr(str(DATA / "linkages" / "bennett.json")) + "), frames=2)",
    ]
    book = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    nbclient.NotebookClient(book, timeout=120, kernel_name="python3").execute()
    kinds = [set(cell.outputs[0].data) if cell.outputs else set() for cell in book.cells]
    assert all("image/svg+xml" in kind for kind in kinds[1:4])
    assert all("text/html" in kind for kind in kinds[4:])
