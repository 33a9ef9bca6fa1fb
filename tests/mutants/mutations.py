"""One change in a file at a time: comparisons, connectives, signs and guards turned into others."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass

__all__ = ["Mutant", "mutants_of"]

_OTHER_COMPARISONS: dict[type[ast.cmpop], tuple[str, str]] = {
    ast.Lt: ("<", "<="),
    ast.LtE: ("<=", "<"),
    ast.Gt: (">", ">="),
    ast.GtE: (">=", ">"),
    ast.Eq: ("==", "!="),
    ast.NotEq: ("!=", "=="),
    ast.In: ("in", "not in"),
    ast.NotIn: ("not in", "in"),
    ast.Is: ("is", "is not"),
    ast.IsNot: ("is not", "is"),
}
_OTHER_OPERATORS: dict[type[ast.operator], tuple[str, str]] = {
    ast.Add: ("+", "-"),
    ast.Sub: ("-", "+"),
    ast.Mult: ("*", "/"),
    ast.FloorDiv: ("//", "*"),
}


@dataclass(frozen=True, slots=True)
class Mutant:
    """A file with one change.

    Attributes
    ----------
    line : int
    change : str
        What stands there, and what stands there instead.
    text : str
        The whole file with the change.
    """

    line: int
    change: str
    text: str

    def __str__(self) -> str:
        return f"line {self.line}: {self.change}"


@dataclass(frozen=True, slots=True)
class _Edit:
    """Offsets in a file between which its text is replaced."""

    begin: int
    end: int
    text: str


def mutants_of(text: str) -> Iterator[Mutant]:
    """Yield all mutants of the source of a module, in the order of their lines.

    Type annotations, docstrings and what is run for type checkers only have none. Each mutant parses.

    >>> [str(one) for one in mutants_of("if a < b and c:\\n    d = e + 1\\n")]
    ['line 1: a < b and c -> True', 'line 1: a < b and c -> False', 'line 1: and -> or', 'line 1: < -> <=', 'line 2: + -> -']
    """
    places = _Places(text)
    tree = ast.parse(text)
    skipped = {id(inner) for node in ast.walk(tree) for part in _not_run(node) for inner in ast.walk(part)}
    nodes = [node for node in ast.walk(tree) if id(node) not in skipped and isinstance(node, ast.expr | ast.stmt)]
    for node in sorted(nodes, key=lambda node: (node.lineno, node.col_offset)):
        for edit in _edits(node, text, places):
            changed = text[: edit.begin] + edit.text + text[edit.end :]
            try:
                ast.parse(changed)
            except SyntaxError:
                continue
            before = " ".join(text[edit.begin : edit.end].split())
            yield Mutant(text.count("\n", 0, edit.begin) + 1, f"{before} -> {edit.text}", changed)


def _not_run(node: ast.AST) -> Iterator[ast.AST]:
    """Yield the parts of a node that do nothing when the program runs."""
    if isinstance(node, ast.AnnAssign | ast.arg) and node.annotation is not None:
        yield node.annotation
    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and node.returns is not None:
        yield node.returns
    if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test):
        yield node


def _edits(node: ast.AST, text: str, places: _Places) -> Iterator[_Edit]:
    if isinstance(node, ast.If | ast.While | ast.IfExp):
        begin, end = places.span(node.test)
        yield _Edit(begin, end, "True")
        yield _Edit(begin, end, "False")
    elif isinstance(node, ast.Compare):
        operands = [node.left, *node.comparators]
        for operator, left, right in zip(node.ops, operands, operands[1:], strict=False):
            yield from _replaced(_OTHER_COMPARISONS.get(type(operator)), left, right, text, places)
    elif isinstance(node, ast.BoolOp):
        pair = ("and", "or") if isinstance(node.op, ast.And) else ("or", "and")
        for left, right in zip(node.values, node.values[1:], strict=False):
            yield from _replaced(pair, left, right, text, places)
    elif isinstance(node, ast.BinOp):
        yield from _replaced(_OTHER_OPERATORS.get(type(node.op)), node.left, node.right, text, places)
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not | ast.USub):
        begin, end = places.span(node)
        yield _Edit(begin, end, text[slice(*places.span(node.operand))])


def _replaced(
    pair: tuple[str, str] | None, left: ast.expr, right: ast.expr, text: str, places: _Places
) -> Iterator[_Edit]:
    """Yield the edit that replaces the operator between two operands; none where brackets hide it."""
    if pair is None:
        return
    begin, end = places.span(left)[1], places.span(right)[0]
    place = text.find(pair[0], begin, end)
    if place >= 0 and "#" not in text[begin:end]:
        yield _Edit(place, place + len(pair[0]), pair[1])


class _Places:
    """Where nodes of a source stand, in characters; their columns count bytes."""

    def __init__(self, text: str) -> None:
        self._lines = [line.encode() for line in text.splitlines(keepends=True)]
        self._starts = [0]
        for line in self._lines:
            self._starts.append(self._starts[-1] + len(line.decode()))

    def span(self, node: ast.expr) -> tuple[int, int]:
        """Return where a node begins and ends."""
        end_line, end_column = node.end_lineno, node.end_col_offset
        assert end_line is not None
        assert end_column is not None
        return self._offset(node.lineno, node.col_offset), self._offset(end_line, end_column)

    def _offset(self, line: int, column: int) -> int:
        return self._starts[line - 1] + len(self._lines[line - 1][:column].decode())
