"""The two senses in which a driving joint turns from the conformed position: limits, sides of links, their lines."""

from dataclasses import dataclass
from math import degrees
from typing import Any

from graphs.types import LinkId
from synth.linkages.conformed.behaviours import Way

BACK, ROUND = "turns back", "turns all round"
"""Why a driving joint goes no further."""


@dataclass(frozen=True, slots=True)
class Stretch:
    """The side of the surface that a link keeps to, up to a turn of the driving joint from the start, radians."""

    way: Way
    end: float


@dataclass(frozen=True, slots=True)
class Sense:
    """One sense of the driving joint from the conformed position: its limit, and where links lie on the way.

    The limit is in radians, negative where the joint turns backward; `ends` says why there: ``turns back``,
    ``turns all round`` (the conformed position again), or why the curve could not be followed. `ways` has the
    stretches of each link.
    """

    limit: float
    ends: str
    ways: dict[LinkId, tuple[Stretch, ...]]

    @property
    def one_way(self) -> tuple[Way, float] | None:
        """The side of the surface that all moving links keep to from the beginning, and up to which turn."""
        moving = [each for each in self.ways.values() if each[0].way != Way.STILL]
        begin = {each[0].way for each in moving}
        if len(begin) != 1 or not begin <= {Way.INWARD, Way.OUTWARD}:
            return None
        return begin.pop(), min((each[0].end for each in moving), key=abs)


def sense_json(sense: Sense) -> dict[str, Any]:
    """Return a sense as plain data."""
    keeps = sense.one_way
    return {
        "limit_deg": degrees(sense.limit),
        "ends": sense.ends,
        "one_way": None if keeps is None else {"way": keeps[0].name.lower(), "to_deg": degrees(keeps[1])},
        "links": {
            str(link): [{"way": each.way.name.lower(), "to_deg": degrees(each.end)} for each in stretches]
            for link, stretches in sense.ways.items()
        },
    }


def range_line(backward: Sense, forward: Sense) -> str:
    """Return the limits of the driving joint, why they are, and the side to which all links keep at first."""
    ends = f"backward {backward.ends}, forward {forward.ends}"
    if backward.ends == forward.ends:
        ends = forward.ends if forward.ends == ROUND else f"{forward.ends} at both ends"
    line = f"range {_angle(backward.limit)} to {_angle(forward.limit)}; {ends}"
    for name, sense in (("backward", backward), ("forward", forward)):
        if sense.one_way is not None:
            way, end = sense.one_way
            whole = _angle(end) == _angle(sense.limit)
            line += f"; {name} all links {_WORDS[way]}" + ("" if whole else f" to {_angle(end)}")
    return line


def _angle(angle: float) -> str:
    return f"{round(degrees(angle), 2) + 0.0:g}°"


_WORDS = {way: "inward and outward" if way is Way.BOTH else way.name.lower() for way in Way}


def stretches_text(stretches: tuple[Stretch, ...]) -> str:
    """Return the ways of a link in turn; the last stretch ends where the joint does, which stands above."""
    *before, last = stretches
    return "".join(f"{_WORDS[each.way]} to {_angle(each.end)}, then " for each in before) + _WORDS[last.way]
