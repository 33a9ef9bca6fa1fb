"""XML written line by line: elements, their attributes and their children; numbers to the last digit."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import TypeAlias
from xml.sax.saxutils import escape, quoteattr

import numpy as np

Value: TypeAlias = str | float | int | bool | Iterable[float]


@dataclass
class Element:
    """An element with attributes, a line of comment before it, and either text or children; or a comment alone."""

    tag: str
    attributes: dict[str, Value] = field(default_factory=dict)
    children: list[Element] = field(default_factory=list)
    text: str = ""
    comment: str = ""

    def add(self, tag: str, text: Value = "", *, comment: str = "", **attributes: Value) -> Element:
        """Add a child with attributes, whose names may end in ``_`` where they are words of Python."""
        named = {name.rstrip("_"): value for name, value in attributes.items()}
        self.children.append(Element(tag, named, [], as_text(text), comment))
        return self.children[-1]

    def inside(self) -> Iterator[Element]:
        """Yield the elements inside it, in the order of the file."""
        for child in self.children:
            yield child
            yield from child.inside()

    def lines(self, depth: int = 0) -> Iterator[str]:
        """Yield the lines of an element."""
        indent = "  " * depth
        if self.comment:
            yield f"{indent}<!-- {_in_comment(self.comment)} -->"
        if not self.tag:
            return
        named = "".join(f" {name}={quoteattr(as_text(value))}" for name, value in self.attributes.items())
        if self.children:
            yield f"{indent}<{self.tag}{named}>"
            for child in self.children:
                yield from child.lines(depth + 1)
            yield f"{indent}</{self.tag}>"
        elif self.text:
            yield f"{indent}<{self.tag}{named}>{escape(self.text)}</{self.tag}>"
        else:
            yield f"{indent}<{self.tag}{named}/>"


def document(root: Element, comments: Iterable[str] = ()) -> bytes:
    """Return an XML file with lines of comment at its head."""
    head = [f"<!-- {_in_comment(comment)} -->" for comment in comments]
    return "\n".join(['<?xml version="1.0" encoding="utf-8"?>', *head, *root.lines(), ""]).encode()


def as_text(value: Value) -> str:
    """Return a value as attributes hold it; numbers are read back as the same numbers."""
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    return " ".join(
        f"{number + 0.0:.17g}" if number % 1 else f"{number + 0.0:.0f}"
        for number in np.ravel(np.asarray(value)).tolist()
    )


def _in_comment(text: str) -> str:
    """Return text that may stand in a comment: two dashes end it."""
    return text.replace("--", "- -").rstrip("-")
