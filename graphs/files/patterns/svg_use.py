"""How many shapes an SVG file draws, when each ``use`` draws what it names again."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

from graphs.errors import FileError, shown
from graphs.work_limits import how_to_raise, most

__all__ = ["check_uses"]

_LINKS = ("href", "{http://www.w3.org/1999/xlink}href")


def check_uses(text: str, path: Path) -> None:
    """Refuse a file whose shapes use shapes too often, or themselves; found without drawing any.

    Raises
    ------
    FileError
        If what is used is drawn again more often than the limit ``shapes``, or a shape uses itself.
    ElementTree.ParseError
        If it is not XML.
    """
    root = ElementTree.fromstring(text)
    named = {one.get("id"): one for one in root.iter() if one.get("id") is not None}
    drawn: dict[ElementTree.Element, int] = {}
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
            open_ones.discard(element)
            waiting.pop()
            continue
        open_ones.add(element)
        if around := [one for one in missing if one in open_ones]:
            raise FileError(path, "", f"the shape {shown(around[0].get('id'))} uses itself", "an end to it")
        waiting += missing
    more = drawn[root] - len(drawn)
    if more > most("shapes"):
        raise FileError(path, "", f"{more} shapes drawn by 'use'", how_to_raise("shapes", more))


def _used(element: ElementTree.Element, named: dict[str | None, ElementTree.Element]) -> list[ElementTree.Element]:
    if element.tag.rpartition("}")[2] != "use":
        return []
    targets = (element.get(key, "").removeprefix("#") for key in _LINKS)
    return [named[target] for target in targets if target in named][:1]
