"""The gallery: forty things, each with its commands and its picture; on the site also a page that moves, a template.

``make pictures`` runs all commands, keeps the pictures in ``docs/pictures/gallery`` and writes ``docs/gallery.md``;
``python docs/gallery.py NAME...`` does it for those things. `conf.py` adds pages and templates to the site.
"""

from __future__ import annotations

import os
import shlex
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from click.testing import CliRunner

from synth.cli.main import main as synth_main

if TYPE_CHECKING:
    from sphinx.application import Sphinx

HERE = Path(__file__).resolve().parent
PICTURES, DOCUMENT = HERE / "pictures", HERE / "gallery.md"
SHOWN_ELSEWHERE = {
    "bird-base-branch", "bird-base-centres", "eight-bar", "fortune-teller", "kaleidocycle", "loop-sums", "order-map",
    "stephenson-cone",
}  # fmt: skip
"""Things whose pictures other documents show: they lie one folder higher."""


@dataclass(frozen=True)
class Thing:
    """One thing of the gallery.

    Attributes
    ----------
    name, title : str
        The stem of its picture; its heading.
    shown : str
        A sentence on what the picture shows, also its alternative text.
    commands : tuple of str
        Commands after ``synth``; the last writes the picture ``NAME.svg``.
    page, template : str
        Names of the files, or files of ``data``, of which the site has a page that moves and a template; or "".
    """

    name: str
    title: str
    shown: str
    commands: tuple[str, ...]
    page: str = ""
    template: str = ""

    @property
    def place(self) -> str:
        """Where its picture lies, from the folder of pictures."""
        return f"{self.name}.svg" if self.name in SHOWN_ELSEWHERE else f"gallery/{self.name}.svg"

    @property
    def text(self) -> str:
        """Its part of the document."""
        typed = "\n".join(f"synth {command}" for command in self.commands)
        picture = f"![{self.shown}](pictures/{self.place})"
        return f"### {self.title}\n\n{picture}\n\n{self.shown}\n\n```sh\n{typed}\n```\n"


def sheet(name: str, title: str, shown: str, *options: str, draw: str = "", file: str = "") -> Thing:
    """Return a crease pattern of a generator, or of a file, with its picture; the site has page and template."""
    commands = () if file else (" ".join(["generate", name, *options, "-o", f"{name}.fold"]),)
    source = file or f"{name}.fold"
    return Thing(name, title, shown, (*commands, f"draw {source} {draw}-o {name}.svg"), page=source, template=source)


def solid(name: str, title: str, shown: str, *options: str) -> Thing:
    """Return a linkage of a generator with its picture; the site has a page of it."""
    made = " ".join(["generate", name, *options, "-o", f"{name}.json"])
    return Thing(name, title, shown, (made, f"draw {name}.json -o {name}.svg"), page=f"{name}.json")


BIRD, TELLER = "data/patterns/bird-base.fold", "data/wiener/fortune-teller.json"
STEPHENSON = "data/surfaces/fig11-stephenson.json"

SECTIONS: dict[str, tuple[Thing, ...]] = {
    "Sheets that fold": (
        sheet(
            "miura",
            "Miura sheet",
            "A Miura sheet of 3 x 4 panels, folded to 50°.",
            "--rows 3",
            "--columns 4",
            "--fold 50",
        ),
        sheet(
            "miura-tube",
            "Tube of two Miura strips",
            "A tube of two Miura strips: it folds flat with one degree of freedom.",
        ),
        sheet("waterbomb", "Waterbomb tessellation", "A waterbomb tessellation, folded to 60°.", "--fold 60"),
        sheet("yoshimura", "Yoshimura's pattern", "Yoshimura's pattern, folded to 50°.", "--fold 50"),
        sheet(
            "resch", "Resch's triangles", "Resch's triangles, folded to 70°.", "--rows 2", "--columns 2", "--fold 70"
        ),
        sheet(
            "square-twist",
            "Square twist",
            "The square twist folded flat, from the front, the back and against the light.",
            draw="--as flat-folded ",
        ),
        sheet("huffman-grid", "Huffman's grid", "Huffman's grid of equal quadrilaterals, folded to 60°.", "--fold 60"),
        sheet(
            "kresling",
            "Storey of Kresling's pattern",
            "A storey of Kresling's pattern, which is rigid with rigid panels.",
        ),
        sheet("deployable-cylinder", "Deployable cylinder", "A cylinder whose pleated walls deploy it radially."),
        sheet("chickenwire", "Chicken wire", "The chicken wire pattern, folded to 50°.", "--fold 50"),
        sheet("preliminary-base", "Preliminary base", "The crease pattern of the preliminary base."),
        sheet("hexagon-twist", "Hexagon twist", "The hexagon twist, folded to 40°.", "--fold 40"),
        sheet("map", "Map", "The crease pattern of a map of 3 x 3 panels."),
    ),
    "One pattern, many questions": (
        Thing(
            "bird-base-folding",
            "How it folds",
            "The bird base folded by its first branch.",
            (f"fold {BIRD} --drive 0=100 --frames 6 -o bird-base-folding.svg",),
            page=BIRD,
            template=BIRD,
        ),
        Thing(
            "bird-base-verdict",
            "What moves",
            "Creases of the bird base that move are orange.",
            (f"draw {BIRD} --colour verdict -o bird-base-verdict.svg",),
        ),
        Thing(
            "bird-base-branch",
            "How a branch begins",
            "Branch 1 of the bird base: creases that begin as mountains and valleys.",
            (f"draw {BIRD} --colour branch --branch 1 -o bird-base-branch.svg",),
        ),
        Thing(
            "bird-base-centres",
            "Where axes meet",
            "The bird base with its SC graph: signs and colours of its centres.",
            (f"draw {BIRD} --graph --colour centres -o bird-base-centres.svg",),
        ),
        Thing(
            "bird-base-flat",
            "How it lies folded",
            "The bird base folded flat, in its first layer order.",
            (f"draw {BIRD} --as flat-folded -o bird-base-flat.svg",),
        ),
        Thing(
            "bird-base-template",
            "How it is made",
            "A template of the bird base to print, cut and fold.",
            (f"template {BIRD} --size 150 --no-note -o bird-base-template.svg",),
        ),
    ),
    "Pop-ups and cartons": (
        sheet("box-pop-up", "Box in a card", "A box cut out of a card, folded to 80°.", "--fold 80"),
        sheet("beaked-box", "Box with a beak", "A box whose ridge ends in a beak, folded to 70°.", "--fold 70"),
        sheet("slit-array", "Row of boxes", "A card with a row of boxes, folded to 80°.", "--fold 80"),
        sheet("webbed-tray", "Webbed tray", "A tray with webbed corners, folded to 50°.", "--fold 50"),
        sheet("crash-lock", "Crash-lock bottom", "A carton with a crash-lock bottom."),
        Thing(
            "laser",
            "Living hinges for a laser",
            "The box of a card with living hinges, in layers to cut, score and engrave.",
            (
                "generate box-pop-up -o card.fold",
                "template card.fold --size 240 --hinges living --hinge-width 6 --laser -o laser.svg",
            ),
        ),
    ),
    "Linkages in space": (
        sheet("sarrus", "Linkage of Sarrus", "The linkage of Sarrus, which moves along a straight line."),
        solid(
            "bennett", "Bennett's linkage", "Bennett's linkage: four hinges, overconstrained, one degree of freedom."
        ),
        solid("myard", "Myard's linkage", "Myard's linkage of five hinges."),
        solid("bricard-trihedral", "Bricard's trihedral linkage", "Bricard's trihedral linkage of six hinges."),
        Thing(
            "kaleidocycle",
            "Kaleidocycle",
            "A kaleidocycle of eight solids.",
            ("draw data/linkages/kaleidocycle-8.json -o kaleidocycle.svg",),
            page="data/linkages/kaleidocycle-8.json",
        ),
    ),
    "Linkages on cones": (
        Thing(
            "stephenson-cone",
            "Six-bar on a cone",
            "A Stephenson six-bar on a cone: which links move inward or outward.",
            (f"cone behaviour {STEPHENSON} -o stephenson-cone.svg",),
            page=STEPHENSON,
            template=STEPHENSON,
        ),
        Thing(
            "four-bar-cone",
            "From angles to a cone",
            "A four-bar given by the angles of its links, on the first of its cones.",
            (
                "cone map --angles 120,95,45,85 --cone 1 -o four-bar.json",
                "cone behaviour four-bar.json -o four-bar-cone.svg",
            ),
            page="four-bar.json",
            template="four-bar.json",
        ),
        Thing(
            "outside",
            "From a wish",
            "A four-bar found for a wish: outside a cone of half angle 25° for a turn of 60°.",
            (
                "cone design --half-angle 25 --outside 60deg --tries 12 -o outside.json",
                "cone behaviour outside.json -o outside.svg",
            ),
            page="outside.json",
            template="outside.json",
        ),
    ),
    "Types": (
        Thing(
            "chains-of-eight",
            "All chains of eight links",
            "The sixteen kinematic chains of eight links and one degree of freedom.",
            ("enumerate chains --links 8 --dof 1 -o chains.jsonl", "draw chains.jsonl -o chains-of-eight.svg"),
        ),
        Thing(
            "vertices",
            "Types of sheets",
            "SCD graphs of four links, each with its realised sheet beside it.",
            ("enumerate scd --links 4 --dof 1 --max-degree 4 -o vertices.jsonl", "draw vertices.jsonl -o vertices.svg"),
        ),
        Thing(
            "eight-bar",
            "A chain",
            "A chain of eight links, without crossings, with its symmetry as a mirror.",
            ("draw data/wiener/eight-bar.json --as chain -o eight-bar.svg",),
        ),
        Thing(
            "fortune-teller",
            "An SCD graph",
            "The SCD graph of the fortune teller: signs of centres, open edges, ride-alongs.",
            (f"draw {TELLER} -o fortune-teller.svg",),
        ),
        Thing(
            "realised",
            "From a type to a sheet",
            "A sheet of a six-link type.",
            ("realise m1:a-b.ac-.bde.cef.d-g.fg- -o realised.fold", "draw realised.fold -o realised.svg"),
            page="realised.fold",
            template="realised.fold",
        ),
    ),
    "Orientations, loops": (
        Thing(
            "order-map",
            "Orientations in order",
            "The sphere by the order in which a crank about an axis takes six orientations.",
            ("draw data/orientations/tipparthi.json -o order-map.svg",),
        ),
        Thing(
            "loop-sums",
            "Where a loop closes",
            "Loop sums of a five-bar over the angle of the cone: zeros are cones on which it lies.",
            ("cone map --angles 60,70,80,50,90 -o loop-sums.svg",),
        ),
    ),
}
THINGS = {thing.name: thing for things in SECTIONS.values() for thing in things}
HEAD = """# Gallery

Forty things, each with the commands that make it. `make pictures` runs them all, so each picture is what the commands
write; on the site, pages that move and templates stand beside them. Commands run in a clone of the repository.
"""


def main() -> None:
    """Make the pictures of the things named, or of all, and the document."""
    (PICTURES / "gallery").mkdir(exist_ok=True)
    for name in sys.argv[1:] or THINGS:
        with beside_data() as folder:
            make(THINGS[name])
            (PICTURES / THINGS[name].place).write_bytes((folder / f"{name}.svg").read_bytes())
    DOCUMENT.write_text(document(), encoding="utf-8")


def document() -> str:
    """Return the text of ``docs/gallery.md``."""
    parts = [HEAD]
    for section, things in SECTIONS.items():
        parts += [f"## {section}\n", *(thing.text for thing in things)]
    return "\n".join(parts)


@contextmanager
def beside_data() -> Iterator[Path]:
    """Work in an empty folder, in which ``data`` is that of the project."""
    here = Path.cwd()
    with TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "data").symlink_to(HERE.parent / "data")
        os.chdir(folder)
        try:
            yield folder
        finally:
            os.chdir(here)


def make(thing: Thing) -> None:
    """Run the commands of a thing in this folder."""
    for command in thing.commands:
        run(shlex.split(command))


def run(words: list[str]) -> None:
    """Run a command; the program ends with its message where it fails."""
    result = CliRunner().invoke(synth_main, words)
    if result.exit_code:
        sys.exit(f"synth {shlex.join(words)}: {result.output}")


def add_links(app: Sphinx, name: str, source: list[str]) -> None:
    """Have the document of the site lead to pages and templates, which `add_pages` writes."""
    del app
    if name == "gallery":
        for thing in THINGS.values():
            links = [f'<a href="gallery/{file}">{said}</a>' for file, said, _ in files_of(thing)]
            head = f"{thing.shown}\n\n```sh"
            source[0] = source[0].replace(
                head, "\n\n".join([thing.shown, *(["  ".join(links)] if links else []), "```sh"])
            )


def add_pages(app: Sphinx, exception: Exception | None) -> None:
    """Write pages and templates beside the site that was built."""
    if exception is None and app.builder.format == "html":
        to = Path(app.outdir) / "gallery"
        to.mkdir(exist_ok=True)
        for thing in THINGS.values():
            with beside_data() as folder:
                if files := files_of(thing):
                    make(thing)
                for file, _, words in files:
                    run(words)
                    (to / file).write_bytes((folder / file).read_bytes())


def files_of(thing: Thing) -> list[tuple[str, str, list[str]]]:
    """Return file, name and command of the page and the template of a thing; no page where its script is not built."""
    from graphs.errors import SynthedraError
    from synth.making.viewer.pages import check_built

    files = []
    try:
        check_built()
        if thing.page:
            files.append((f"{thing.name}.html", "Page that moves", ["view", thing.page, "-o", f"{thing.name}.html"]))
    except SynthedraError:
        pass
    if thing.template:
        pdf = f"{thing.name}.pdf"
        files.append((pdf, "Template to print", ["template", thing.template, "-o", pdf]))
    return files


if __name__ == "__main__":
    main()
