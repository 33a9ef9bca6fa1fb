"""Lines and words as DXF R12 (AC1009), the form of DXF that every program takes.

A file is pairs of lines, a group code and a value: *DXF Reference*, Autodesk. Line types are CONTINUOUS: machines
cut along dashes dash by dash. R12 says no unit; what the unit is, is for the remark.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from graphs.printing import plain

__all__ = ["DxfLayer", "DxfLine", "DxfWord", "dxf_of"]

_LONGEST = 250


@dataclass(frozen=True, slots=True)
class DxfLayer:
    """A layer: its name, and the number of its colour (1 red, 2 yellow, 3 green, 5 blue, 6 magenta, 7 black)."""

    name: str
    colour: int


@dataclass(frozen=True, slots=True)
class DxfLine:
    """A line on a layer."""

    layer: str
    start: tuple[float, float]
    end: tuple[float, float]


@dataclass(frozen=True, slots=True)
class DxfWord:
    """A word on a layer: where its left end or its middle is, at half its height."""

    layer: str
    at: tuple[float, float]
    words: str
    size: float
    middle: bool


def dxf_of(
    layers: Sequence[DxfLayer], lines: Sequence[DxfLine], words: Iterable[DxfWord] = (), *, remark: str = ""
) -> str:
    """Return the DXF text of lines and words on given layers; the remark is the first line of the file.

    Coordinates are written so that they are read back to the last digit.

    >>> text = dxf_of([DxfLayer("CUT", 7)], [DxfLine("CUT", (0.0, 0.0), (30.5, 0.0))])
    >>> text.split("ENTITIES")[1].split()[:10]
    ['0', 'LINE', '8', 'CUT', '10', '0.0', '20', '0.0', '30', '0.0']
    """
    pairs: list[tuple[int, object]] = [(999, plain(remark, _LONGEST))] if remark else []
    pairs += [(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1009"), *_extent(lines), (0, "ENDSEC")]
    pairs += [(0, "SECTION"), (2, "TABLES"), *_line_types(), *_layers(layers), *_styles(), (0, "ENDSEC")]
    pairs += [(0, "SECTION"), (2, "BLOCKS"), (0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES")]
    for line in lines:
        pairs += [(0, "LINE"), (8, line.layer), *_point(10, line.start), *_point(11, line.end)]
    for word in words:
        align = 1 if word.middle else 0
        pairs += [(0, "TEXT"), (8, word.layer), *_point(10, word.at), (40, float(word.size))]
        pairs += [(1, plain(word.words, _LONGEST)), (72, align), *_point(11, word.at), (73, 2)]
    pairs += [(0, "ENDSEC"), (0, "EOF")]
    return "".join(f"{code}\n{value}\n" for code, value in pairs)


def _point(code: int, at: tuple[float, float]) -> list[tuple[int, object]]:
    return [(code, float(at[0])), (code + 10, float(at[1])), (code + 20, 0.0)]


def _extent(lines: Sequence[DxfLine]) -> list[tuple[int, object]]:
    ends = [end for line in lines for end in (line.start, line.end)] or [(0.0, 0.0)]
    low, high = ((pick(x for x, _ in ends), pick(y for _, y in ends)) for pick in (min, max))
    return [(9, "$EXTMIN"), *_point(10, low), (9, "$EXTMAX"), *_point(10, high)]


def _line_types() -> list[tuple[int, object]]:
    solid: list[tuple[int, object]] = [
        (0, "LTYPE"),
        (2, "CONTINUOUS"),
        (70, 0),
        (3, "Solid line"),
        (72, 65),
        (73, 0),
    ]
    return [(0, "TABLE"), (2, "LTYPE"), (70, 1), *solid, (40, 0.0), (0, "ENDTAB")]


def _layers(layers: Sequence[DxfLayer]) -> list[tuple[int, object]]:
    rows: list[tuple[int, object]] = [(0, "TABLE"), (2, "LAYER"), (70, len(layers) + 1)]
    for layer in (DxfLayer("0", 7), *layers):
        rows += [(0, "LAYER"), (2, layer.name), (70, 0), (62, layer.colour), (6, "CONTINUOUS")]
    return [*rows, (0, "ENDTAB")]


def _styles() -> list[tuple[int, object]]:
    style: list[tuple[int, object]] = [(0, "STYLE"), (2, "STANDARD"), (70, 0), (40, 0.0), (41, 1.0), (50, 0.0)]
    style += [(71, 0), (42, 2.5), (3, "txt"), (4, "")]
    return [(0, "TABLE"), (2, "STYLE"), (70, 1), *style, (0, "ENDTAB")]
