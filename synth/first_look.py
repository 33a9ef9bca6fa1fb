"""A first answer: what a mechanism is, how it moves, what is wrong with its drawing, and what to ask next."""

from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from shlex import quote
from typing import Any, TypeAlias

from enumerate.chains.names import name_of
from graphs.answer.mobility import sheet_in_frame
from graphs.convert.conversions import Mechanism, kind_in_words, to_sc
from graphs.errors import numbered
from graphs.files.mechanism_like import MechanismLike, mechanism_for
from graphs.identity.chains import chain_id
from graphs.joints.linkage import JointedLinkage
from graphs.loops.loop import Centre
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.precision import lies_flat
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.mechanism.surfaces import SurfaceLinkage
from graphs.printing import Block, Printed
from synth.analysis.verdict._mobility import JudgedMobility, mobility

_LETTERS = {"M": "mountain", "V": "valley", "U": "unassigned", "F": "flat", "C": "cut"}
_MOST_NAMED = 12
"""Links of a mechanism whose chain is looked up by name."""
Question: TypeAlias = tuple[str, str]
"""A command with FILE for the file, and what it answers or writes."""


@dataclass(frozen=True, repr=False)
class FirstLook(Printed):
    """What a mechanism is, how it moves, what is wrong with its drawing, and what to ask next.

    Attributes
    ----------
    kind : str
        What it is: its kind, parts and where it lies.
    motion : str
        The verdict, and whether a flat pattern folds flat.
    drawing : str
        Repairs, creases whose assignment disagrees with the motion, and what was left out, with places; or that
        nothing had to be repaired.
    next : tuple of (str, str)
        Commands with what each of them answers; FILE stands for the file.
    mobility : JudgedMobility
        The whole answer.
    file : str
        How the mechanism was named, or FILE.

    Examples
    --------
    >>> look("k1:Cr").commands[0]
    ('synth realise k1:Cr -o realised.fold', 'a sheet or panels of this type')
    """

    kind: str
    motion: str
    drawing: str
    next: tuple[Question, ...]
    mobility: JudgedMobility
    file: str = "FILE"

    @property
    def commands(self) -> list[Question]:
        """The commands as they are typed, with what each of them answers."""
        return [(command.replace("FILE", quote(self.file)), answer) for command, answer in self.next]

    def blocks(self) -> list[Block]:
        """Return the lines that are printed."""
        widest = max(len(command) for command, _ in self.commands)
        rows = [f"  {command:{widest}}  {answer}" for command, answer in self.commands]
        return [self.kind, self.motion, self.drawing, "Next:", *rows]

    def to_json(self) -> dict[str, Any]:
        """Return the sentences and the commands as plain data (docs/command-json.md)."""
        commands = [{"command": command, "answers": answer} for command, answer in self.commands]
        return {"kind": self.kind, "motion": self.motion, "drawing": self.drawing, "next": commands}

    def __repr__(self) -> str:
        return f"<FirstLook: {self.kind}>"


def look(mechanism: MechanismLike, *, precision: float | None = None) -> FirstLook:
    """Say what a mechanism is, whether and how it moves, what is wrong with its drawing, and what to ask next.

    Parameters
    ----------
    mechanism : Mechanism, str or Path
        What `synth.read` returns, a file, or an id.
    precision : float, optional
        The error that a coordinate may have, in their unit; by default as `synth.mobility` takes it.

    Raises
    ------
    FileError, InvariantError
        If the file cannot be read, or is no mechanism.

    Examples
    --------
    >>> print(look("k1:Cr"))
    A kinematic chain, a type without coordinates and centres: 4 links, 4 joints; its chain is named four-bar.
    A generic realisation has 1 degree of freedom (exact rank).
    Nothing had to be repaired.
    Next:
      synth realise k1:Cr -o realised.fold  a sheet or panels of this type
      synth draw k1:Cr -o picture.svg       a picture of the graph
      synth id k1:Cr                        ids, with which lists and atlases are searched
    """
    file = str(mechanism) if isinstance(mechanism, str | Path) else "FILE"
    read: Mechanism = mechanism_for("look", mechanism, Mechanism)
    answer = mobility(read, precision=precision)
    questions = tuple(_questions(read, answer))
    return FirstLook(_kind(read, answer), _motion(answer), _drawing(answer), questions, answer, file)


def _kind(mechanism: Mechanism, answer: JudgedMobility) -> str:
    """Return the sentence that says what it is."""
    if isinstance(mechanism, Sheet):
        others = mechanism.frames.others if mechanism.frames is not None else 0
        return _kind_of_sheet(sheet_in_frame(mechanism, None), others)
    if isinstance(mechanism, SurfaceLinkage):
        axes = "all axes meet at its apex" if mechanism.kind == "cone" else "all axes are parallel"
        return f"A linkage on a {mechanism.kind}: {_parts(answer, centres=False)}; {axes}{_named(mechanism, answer)}."
    if isinstance(mechanism, HingedSolids):
        return f"Rigid bodies in space, hinged along axes: {_parts(answer)}."
    if isinstance(mechanism, JointedLinkage):
        where = "with the places of its joints" if mechanism.places else "a type without coordinates"
        return f"A linkage of several kinds of joints, {where}: {_parts(answer)}."
    if getattr(mechanism, "centres_assumed", False):
        parts = f"{numbered(answer.links or 0, 'link')}, {numbered(answer.joints or 0, 'joint')}"
        return f"A kinematic chain, a type without coordinates and centres: {parts}{_named(mechanism, answer)}."
    placed = isinstance(mechanism, PolyhedronModel) and bool(mechanism.coordinates)
    where = "with coordinates" if placed else "a type without coordinates"
    kind = kind_in_words(mechanism)
    article = "An" if kind.startswith(("SC", "a", "e", "i", "o")) else "A"
    planar = ", at infinity: the linkage is planar" if _is_planar(mechanism) else ""
    return f"{article} {kind}, {where}: {_parts(answer)}{planar}{_named(mechanism, answer)}."


def _is_planar(mechanism: Mechanism) -> bool:
    """Check whether an SC or SCD graph has one centre class, and that is at infinity."""
    if not isinstance(mechanism, SCGraph) or mechanism.spatial_loops:
        return False
    return [centre.centre for centre in mechanism.centre_classes()] == [Centre.INFINITE]


def _kind_of_sheet(sheet: Sheet, others: int) -> str:
    """Return the sentence on a crease pattern: panels, creases by assignment, state, extent, other frames."""
    letters = Counter(sheet.assignments)
    creases = [f"{letters[letter]} {word}" for letter, word in _LETTERS.items() if letters[letter]]
    lines = ", ".join(creases) or "no creases listed"
    if sheet.coordinates is None:
        return f"A crease pattern without coordinates: {numbered(len(sheet.faces), 'panel')}; lines: {lines}."
    flat = lies_flat(sheet)
    spans = [max(values) - min(values) for values in zip(*sheet.coordinates, strict=True)]
    unit = sheet.frames.unit if sheet.frames is not None else None
    extent = " x ".join(f"{span:.4g}" for span in (spans[:2] if flat else spans)) + (f" {unit}" if unit else "")
    state = "A flat crease pattern" if flat else "A crease pattern folded in space"
    more = f"; {numbered(others, 'more frame')} in the file (--at FRAME)" if others else ""
    return f"{state}: {numbered(len(sheet.faces), 'panel')}; lines: {lines}; extent {extent}{more}."


def _parts(answer: JudgedMobility, *, centres: bool = True) -> str:
    """Return the numbers of links, joints, vertices, and if asked for of centres."""
    vertices = answer.counts.get("vertices") if answer.links is None else None
    numbers = (("link", answer.links), ("joint", answer.joints), ("vertex", vertices), ("centre", answer.centres))
    return ", ".join(
        numbered(number, noun, "vertices" if noun == "vertex" else "")
        for noun, number in numbers
        if number is not None and (noun != "centre" or (number and centres))
    )


def _named(mechanism: Mechanism, answer: JudgedMobility) -> str:
    """Return what the chain is called, where it has a name."""
    if isinstance(mechanism, PolyhedronModel) or answer.links is None or answer.links > _MOST_NAMED:
        return ""
    name = name_of(chain_id(to_sc(mechanism)))
    return f"; its chain is named {name}" if name else ""


def _motion(answer: JudgedMobility) -> str:
    """Return the verdict, and for a flat pattern whether it folds flat."""
    sentences = [answer.verdict.text]
    if answer.flat_folding is not None:
        sentences.append(f"{str(answer.flat_folding).capitalize()}.")
    return " ".join(sentences)


def _drawing(answer: JudgedMobility) -> str:
    """Return the sentences on repairs, assignments that disagree, and what was left out."""
    reading = answer.reading
    sentences = [str(line).rstrip(".") for line in answer.report.unread()]
    for note in answer.repairs:
        if reading is None or note != reading.left_out:
            sentences.append(f"repaired: {note if reading is None else reading.with_places(note)}")
    sentences += [f"repaired: {note}" for note in answer.mended]
    at = answer.configuration
    if at is not None and at.disagreeing:
        sentences.append(at.disagreeing.rstrip("."))
    if not sentences:
        return "Nothing had to be repaired."
    return " ".join(f"{sentence[:1].upper()}{sentence[1:]}." for sentence in sentences)


def _questions(mechanism: Mechanism, answer: JudgedMobility) -> list[Question]:
    """Return the commands that suit the mechanism and its verdict, the likeliest first."""
    if isinstance(mechanism, SurfaceLinkage):
        return _of_surface(mechanism)
    if isinstance(mechanism, PolyhedronModel):
        return [("synth mobility FILE --verbose", "the evidence: ranks, and every equation of mobility")]
    if answer.configuration is None and answer.infinitesimal is None:
        realised = "realised.fold"
        return [
            (f"synth realise FILE -o {realised}", "a sheet or panels of this type"),
            ("synth draw FILE -o picture.svg", "a picture of the graph"),
            ("synth id FILE", "ids, with which lists and atlases are searched"),
        ]
    freedoms = answer.verdict.freedoms
    questions = _of_sheet(answer, freedoms) if isinstance(mechanism, Sheet) else []
    if freedoms and isinstance(mechanism, HingedSolids):
        questions.append(("synth fold FILE", "its motion: how far it goes, and why it ends"))
        scale = " --scale 1" if mechanism.shapes else ""  # shapes of `synth thicken` are in millimetres
        questions.append(
            (f"synth convert FILE model.xml --as mjcf{scale}", "a model for simulators, other formats too")
        )
    if freedoms and answer.mobility is not None and answer.mobility < freedoms:
        questions.append(("synth explain FILE", "why it moves although counts say that it is rigid"))
    if freedoms is not None and freedoms > 1:
        questions.append(("synth advise FILE --freedoms 1", "which joints to lock for one degree of freedom"))
    if freedoms:
        questions.append(("synth view FILE -o page.html", "a page on which it moves, for any browser"))
    return [*questions, ("synth mobility FILE", "the evidence: ranks, counts and equations")]


def _of_sheet(answer: JudgedMobility, freedoms: int | None) -> list[Question]:
    """Return what is asked of a crease pattern with coordinates."""
    questions = []
    at = answer.configuration
    if answer.reading is not None and answer.reading.repairs:
        questions.append(("synth draw FILE --as repairs -o repairs.svg", "the places that were repaired"))
    if at is not None and at.disagreeing:
        questions.append(("synth draw FILE --as marks -o marks.svg", "the creases whose assignment disagrees"))
        branch = at.disagreement
        number = 0 if branch is None else branch.number
        questions.append((f"synth edit FILE --assign-branch {number} -o assigned.fold", "the pattern assigned anew"))
    if freedoms:
        questions.append(("synth fold FILE -o folded.fold", "its motion, as frames"))
        questions.append(("synth template FILE -o template.pdf", "a template to print, cut and fold"))
    if at is not None and at.flat:
        questions.append(("synth layers FILE", "whether it folds flat, and in how many layer orders"))
    if freedoms == 0:
        questions.append(("synth advise FILE --freedoms 1", "which panels to crease so that it moves"))
    return questions


def _of_surface(linkage: SurfaceLinkage) -> list[Question]:
    return [
        (f"synth {linkage.kind} behaviour FILE -o picture.svg", "which links leave the surface, in a picture"),
        (f"synth {linkage.kind} move FILE", "how far its links move inward and outward"),
        ("synth template FILE -o template.pdf", "a template to cut and roll up"),
        ("synth view FILE -o page.html", "a page on which it moves, for any browser"),
        ("synth mobility FILE", "the evidence: ranks, counts and equations"),
    ]
