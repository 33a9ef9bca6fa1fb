"""The verbs, each asked in Python and at the command line, and what each says of the configuration it was asked about.

A verb is one row of `VERBS`: how it is asked, up to how many joints, and whether it takes any configuration or only
some. What it answers is an `Outcome`.
"""

from __future__ import annotations

import json
import weakref
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from html.parser import HTMLParser
from math import degrees, radians
from pathlib import Path
from signal import ITIMER_PROF, SIGPROF, setitimer, signal
from types import FrameType
from typing import Any

import numpy as np
from click.testing import CliRunner, Result

import synth
from graphs.errors import SynthedraError
from graphs.mechanism.sheet import Sheet
from graphs.types import JointId
from synth.analysis.compliance.joint_limits import limits
from synth.analysis.moving._configuration_of import sheet_of
from synth.cli.main import main
from synth.making.templates.template import panels_of_mechanism, template_of
from synth.making.viewer.page_data import Shown, shown_of
from tests.agreement.specimens import Placed

__all__ = ["DOORS", "VERBS", "Outcome", "Subject", "Verb", "asked"]

DOORS = ("python", "command")
_TURN = radians(2.0)
"""How far a joint is driven."""
_FRAMES = 2
_INDETERMINATE = "the rank of the closure equations at this configuration is unclear"


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of one question.

    Attributes
    ----------
    kind : {"told", "refused", "indeterminate", "missing", "left out", "fault"}
        An answer with a configuration, an error on purpose, a rank that the coordinates do not decide, an answer
        without a configuration, a question that was not asked, an error that nobody foresaw.
    configuration : dict or None
    why : str
        Of what is not told.
    """

    kind: str
    configuration: dict[str, Any] | None = None
    why: str = ""


class Subject:
    """A mechanism with its file, and what verbs are to be asked of it."""

    def __init__(self, thing: Placed, file: Path, folder: Path, frame: int | None = None) -> None:
        self.thing, self.file, self.folder, self.frame = thing, file, folder, frame

    @cached_property
    def shown(self) -> Shown:
        """What the page shows: its motion says which joints can be driven."""
        return shown_of(self.thing)

    @cached_property
    def placed(self) -> Placed:
        """The mechanism; of a sheet with frames the first that has coordinates."""
        thing = self.thing
        return thing.frames.first_placed() if isinstance(thing, Sheet) and thing.frames is not None else thing

    @property
    def joints(self) -> int:
        """How many joints it has, or creases."""
        thing = self.placed
        if isinstance(thing, Sheet):
            return len(thing.edges)
        return len(thing.edges) if not hasattr(thing, "chain") else len(thing.chain.joints)

    def driven(self, *, all_freedoms: bool = False) -> dict[JointId, float]:
        """Return angles, radians, a little further on the branch that is chosen: of one joint, or for each freedom."""
        moving = self.shown.moving
        if moving is None or moving.ways is None:
            return {}
        way = moving.ways.all[moving.ways.taken]
        names, angles = list(moving.linkage.graph.joints), moving.linkage.angles
        chosen = way.drivers if all_freedoms else way.drivers[:1]
        steps = _TURN * way.rates / np.abs(way.rates).max()
        if moving.limited and np.abs(angles + steps)[list(chosen)].max() > np.pi:
            steps = -steps
        return {names[place]: float(angles[place] + steps[place]) for place in chosen}

    def drive_words(self, *, all_freedoms: bool = False) -> list[str]:
        """Return the same as options."""
        return [
            word
            for joint, angle in self.driven(all_freedoms=all_freedoms).items()
            for word in ("--drive", f"{joint}={degrees(angle)!r}")
        ]


@dataclass(frozen=True, slots=True)
class Verb:
    """One verb.

    Attributes
    ----------
    name : str
    ask : callable
        Asks it in Python.
    words : callable
        Its words at the command line; none where it has no command for such a mechanism.
    takes_any : bool
        Whether it takes any configuration: then it may not refuse where others answer.
    most_joints : int
        It is left out of what has more: it would take too long.
    suits : callable
        Whether it is for such mechanisms at all.
    other_coordinates : bool
        Whether the answer is about the type with other coordinates, so that nothing but its numbers is the same.
    """

    name: str
    ask: Callable[[Subject], Any]
    words: Callable[[Subject], list[str]]
    takes_any: bool = False
    most_joints: int = 1000
    suits: Callable[[Subject], bool] = lambda _: True
    other_coordinates: bool = False


def _is_sheet(subject: Subject) -> bool:
    return sheet_of(subject.placed) is not None


def _can_be_driven(subject: Subject) -> bool:
    return bool(subject.driven())


VERBS = (
    Verb(
        "mobility",
        lambda s: synth.mobility(s.thing, exact=False, frame=s.frame),
        lambda s: ["mobility", str(s.file), "--no-exact", "--json"],
        takes_any=True,
    ),
    Verb(
        "fold",
        lambda s: synth.fold(sheet_of(s.thing), drive=s.driven(), frames=_FRAMES),
        lambda s: ["fold", str(s.file), *s.drive_words(), "--frames", str(_FRAMES), "--json"],
        takes_any=True,
        suits=_is_sheet,
    ),
    Verb(
        "move",
        lambda s: synth.move(s.thing, drive=s.driven(), frames=_FRAMES),
        lambda s: [] if _is_sheet(s) else ["fold", str(s.file), *s.drive_words(), "--frames", str(_FRAMES), "--json"],
        takes_any=True,
    ),
    Verb("explain", lambda s: synth.explain(s.thing), lambda s: ["explain", str(s.file), "--json"], takes_any=True),
    Verb(
        "states",
        lambda s: synth.states(s.thing, joints=list(s.driven())),
        lambda s: ["states", str(s.file), *(f"--joint={joint}" for joint in s.driven()), "--json"],
        takes_any=True,
        suits=_can_be_driven,
    ),
    Verb("limits", lambda s: limits(s.thing), lambda s: ["limits", str(s.file), "--json"]),
    Verb(
        "positions",
        lambda s: synth.positions(s.thing, drive=s.driven(all_freedoms=True), circuits=False),
        lambda s: ["positions", str(s.file), *s.drive_words(all_freedoms=True), "--no-circuits", "--json"],
        most_joints=12,
        suits=_can_be_driven,
    ),
    Verb(
        "advise",
        lambda s: synth.advise(s.thing, 0, limit=1),
        lambda s: ["advise", str(s.file), "--freedoms", "0", "--limit", "1", "--json"],
        most_joints=120,
    ),
    Verb(
        "view",
        lambda s: s.shown,
        lambda s: ["view", str(s.file), "-o", str(s.folder / "page.html"), "--force"],
        takes_any=True,
    ),
    Verb(
        "template",
        lambda s: template_of(panels_of_mechanism(s.thing)[0], size=150.0),
        lambda s: [
            "template", str(s.file), "--size", "150", "-o", str(s.folder / "template.dxf"), "--no-note", "--force",
            "--json",
        ],
        most_joints=200,
        suits=_is_sheet,
    ),
    Verb(
        "realise",
        lambda s: synth.realise(s.thing, tries=1),
        lambda s: ["realise", str(s.file), "--tries", "1", "--json"],
        most_joints=12,
        other_coordinates=True,
    ),
)  # fmt: skip


def asked(verb: Verb, door: str, subject: Subject, seconds: float | None = None) -> Outcome:
    """Ask one verb at one door.

    Parameters
    ----------
    verb : Verb
    door : {"python", "command"}
    subject : Subject
    seconds : float, optional
        What takes longer is left out.
    """
    if subject.joints > verb.most_joints:
        return Outcome("left out", why=f"more than {verb.most_joints} joints")
    try:
        with _at_most(seconds):
            if not verb.suits(subject):
                return Outcome("left out", why="not for such a mechanism")
            return _in_python(verb, subject) if door == "python" else _at_the_command_line(verb, subject)
    except _TimeIsUpError:
        return Outcome("left out", why=f"more than {seconds:g} seconds of processor time")
    except SynthedraError as error:  # what is no mechanism at all has no joints to be driven
        return _refusal(str(error))


def _in_python(verb: Verb, subject: Subject) -> Outcome:
    try:
        answer = verb.ask(subject)
    except SynthedraError as error:
        return _refusal(str(error))
    except (ArithmeticError, AssertionError, LookupError, TypeError, ValueError, np.linalg.LinAlgError) as error:
        return Outcome("fault", why=f"{type(error).__name__}: {error}")
    return _told(json.loads(json.dumps(answer.to_json())))


def _at_the_command_line(verb: Verb, subject: Subject) -> Outcome:
    words = verb.words(subject)
    if not words:
        return Outcome("left out", why="no command of its own")
    result = CliRunner().invoke(main, words)
    if result.exit_code == 2 and "No such option" in result.output:
        return Outcome("missing")
    if result.exit_code == 2 and "was not built" in result.output:
        return Outcome("left out", why="the page is not built here")
    if result.exit_code == 2:
        return _refusal(_last_line(result))
    if result.exit_code not in (0, 1):
        return Outcome("fault", why=_last_line(result))
    document = _json_of_page(subject.folder / "page.html") if verb.name == "view" else json.loads(result.stdout)
    return _told(document[0] if isinstance(document, list) else document)


def _refusal(why: str) -> Outcome:
    return Outcome("indeterminate" if _INDETERMINATE in why else "refused", why=why)


def _last_line(result: Result) -> str:
    return (result.output.strip().splitlines() or [repr(result.exception)])[-1]


def _told(document: dict[str, Any]) -> Outcome:
    told = document.get("configuration")
    return Outcome("missing") if told is None else Outcome("told", told)


class _Shown(HTMLParser):
    """The data of a page."""

    def __init__(self) -> None:
        super().__init__()
        self.inside, self.text = False, ""

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.inside = tag == "script" and dict(attrs).get("type") == "application/json"

    def handle_endtag(self, tag: str) -> None:
        self.inside = False

    def handle_data(self, data: str) -> None:
        self.text += data * self.inside


def _json_of_page(page: Path) -> dict[str, Any]:
    """Return what a page shows first."""
    parser = _Shown()
    parser.feed(page.read_text(encoding="utf-8"))
    first: dict[str, Any] = json.loads(parser.text)["shown"][0]
    return first


class _TimeIsUpError(BaseException):
    """A question takes too long."""


_AGAIN = 0.01
"""Seconds until a question is stopped again, if it could not be the first time."""


def _finalises(frame: FrameType | None) -> bool:
    """Tell whether an object is being finalised, where Python prints exceptions and goes on."""
    while frame is not None:
        if frame.f_code.co_name == "__del__" or frame.f_code.co_filename == weakref.__file__:
            return True
        frame = frame.f_back
    return False


@contextmanager
def _at_most(seconds: float | None) -> Iterator[None]:
    if seconds is None:
        yield
        return

    ended = False

    def end(_number: int, frame: FrameType | None) -> None:
        nonlocal ended
        if not ended and not _finalises(frame):
            ended = True
            raise _TimeIsUpError

    before = signal(SIGPROF, end)
    setitimer(ITIMER_PROF, seconds, _AGAIN)
    try:
        yield
    finally:
        setitimer(ITIMER_PROF, 0.0)
        signal(SIGPROF, before)
