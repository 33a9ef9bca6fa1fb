"""How much work an SVG file is: shapes that ``use`` draws again, and groups in groups."""

from __future__ import annotations

import re
from pathlib import Path
from xml.etree import ElementTree

from graphs.errors import FileError, shown
from graphs.limits import how_to_raise, most

__all__ = ["check_work_of_svg"]

_LINKS = ("href", "{http://www.w3.org/1999/xlink}href")

_LONG_NUMBER = re.compile(r"[0-9]{101}")


def check_work_of_svg(text: str, path: Path) -> None:
    """Refuse shapes that use shapes too often, or themselves, or nest too deeply; found without drawing any.

    Raise FileError if shapes are drawn by use more often than the limit ``shapes``, elements (used ones included)
    are nested more deeply than the limit ``levels``, a shape uses itself, or a number, transform or style sheet is
    too long; ElementTree.ParseError if the text is not XML.
    """
    root = ElementTree.fromstring(text)
    named = {one.get("id"): one for one in root.iter() if one.get("id") is not None}
    drawn: dict[ElementTree.Element, int] = {}
    levels: dict[ElementTree.Element, int] = {}
    waiting, open_ones = [root], set[ElementTree.Element]()
    while waiting:  # depth first, without recursion: files nest as deep as they like
        element = waiting[-1]
        if element in drawn:
            waiting.pop()
            continue
        inner = [*element, *_used(element, named)]
        missing = [one for one in inner if one not in drawn]
        if not missing:
            drawn[element] = 1 + sum(drawn[one] for one in inner)
            levels[element] = 1 + max((levels[one] for one in inner), default=0)
            open_ones.discard(element)
            waiting.pop()
            continue
        open_ones.add(element)
        if around := [one for one in missing if one in open_ones]:
            raise FileError(path, "", f"the shape {shown(around[0].get('id'))} uses itself", "an end to it")
        waiting += missing
    for element in drawn:
        _check_text(element, path)
    _check(path, "shapes", drawn[root] - len(drawn), "shapes drawn by 'use'")
    _check(path, "levels", levels[root], "levels of elements in elements")


def _check_text(element: ElementTree.Element, path: Path) -> None:
    """Refuse text that the patterns by which svgelements reads it would look through again and again."""
    name = element.tag.rpartition("}")[2]
    for key, value in element.items():
        if key not in (*_LINKS, "id") and _LONG_NUMBER.search(value):
            raise FileError(path, f"{name}: {key}", "a number of more than 100 digits", "coordinates")
        if key == "transform":
            _check(path, "letters", len(value), "letters in a transform")
    if name == "style":
        text = element.text or ""
        _check(path, "letters", len(text), "letters in a style sheet")
        if "{" in text.rpartition("}")[2]:
            raise FileError(path, "style", "a rule that does not end", "'}' after the last rule")


def _check(path: Path, limit: str, needed: int, what: str) -> None:
    if needed > most(limit):
        raise FileError(path, "", f"{needed} {what}", how_to_raise(limit, needed))


def _used(element: ElementTree.Element, named: dict[str | None, ElementTree.Element]) -> list[ElementTree.Element]:
    if element.tag.rpartition("}")[2] != "use":
        return []
    targets = (element.get(key, "").removeprefix("#") for key in _LINKS)
    return [named[target] for target in targets if target in named][:1]
