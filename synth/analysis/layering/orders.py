"""Whether a crease pattern folds flat, and in which layer orders. Theory: docs/theory/layer-orders.md."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import combinations, islice
from math import prod
from random import Random
from typing import Any

import numpy as np

from graphs.convert.duality import SheetMechanism, mechanism_of_sheet, opened
from graphs.errors import InvariantError, NumericalError, UnsolvableError, numbered
from graphs.geometry import signed_area
from graphs.input_limits import check_work
from graphs.mechanism.precision import Precision, extent_of, flat_places, keeping, precision_of_sheet, stated
from graphs.mechanism.sheet import Sheet, sides_of_face, with_all_edges
from graphs.printing import Block, Printed, TableBlock
from graphs.tolerances import Tolerances
from graphs.types import Floats, Ints
from synth.analysis.layering.checking import fault_of
from synth.analysis.layering.constraints import LayerConstraints, layer_constraints
from synth.analysis.layering.cores import LayerCore, core_lines, core_of
from synth.analysis.layering.counting.problem import Counter, LayerProblem, solutions
from synth.analysis.layering.counting.propagation import counted
from synth.analysis.layering.image import FoldedImage, folded, image_of
from synth.analysis.layering.local import FlatVertex, closing_points, flat_vertices
from synth.analysis.layering.needed_precision import COARSEST, NeededPrecision, needed_precision, rounded_up
from synth.analysis.layering.reduction import ReducedLayers, reduced

CONTRADICTION = "its layers contradict each other"
"""Why there is no layer order where the places of panels leave none."""
_FEW = 12
"""Wishes of which the largest number that can be met is looked for."""
_WIDER = 10.0
"""Where the least precision closes the sums and the image has no consistent layers, one so much coarser is tried."""
_LISTED = 12
"""Faults and components that are printed; data has all."""


@dataclass(frozen=True, eq=False, repr=False)
class LayerOrder(Printed):
    """One order of the layers.

    Attributes
    ----------
    image : FoldedImage
    stacks : tuple of tuple of int
        The panels over each cell, from the lowest to the highest.

    Examples
    --------
    >>> import synth
    >>> order = synth.layers("data/patterns/bird-base.fold").order()
    >>> order.stacks[0]
    (4, 6, 8, 10, 12, 14, 0, 2)
    """

    image: FoldedImage
    stacks: tuple[tuple[int, ...], ...]

    def above(self) -> dict[tuple[int, int], bool]:
        """Return for pairs of panels that overlap, the lower number first, whether the first is on top.

        Of pairs whose order is another over other cells, which only panels that are not convex can have, that over
        the first cell counts.
        """
        found: dict[tuple[int, int], bool] = {}
        for stack in self.stacks:
            for height, low in enumerate(stack):
                for high in stack[height + 1 :]:
                    found.setdefault((min(low, high), max(low, high)), high < low)
        return found

    def face_orders(self) -> list[tuple[int, int, int]]:
        """Return ``faceOrders`` of FOLD: faces f, g, and 1 if f lies on the side of g that its normal points to."""
        panels = self.image.panels
        places = panels.mechanism.panels
        return [
            (f, g, 1 if first_on_top == panels.faces_up[g] else -1)
            for (one, other), first_on_top in sorted(self.above().items())
            for f in places[one]
            for g in places[other]
        ]

    def to_json(self) -> dict[str, Any]:
        """Return the panels over each cell, from the lowest to the highest, and the corners of the cells."""
        corners = [[self.image.nodes[node].tolist() for node in cell] for cell in self.image.cells]
        return {
            "cells": [
                {"corners": places, "panels": list(stack)} for places, stack in zip(corners, self.stacks, strict=True)
            ]
        }

    def blocks(self) -> list[Block]:
        """Return the table of the cells."""
        rows = [(str(cell), " ".join(map(str, stack))) for cell, stack in enumerate(self.stacks) if stack]
        return [TableBlock(("cell", "panels from below"), rows, ("cell",))]

    def __repr__(self) -> str:
        return f"<LayerOrder: {numbered(len(self.stacks), 'cell')}, at most {self.image.depth} layers>"


@dataclass(frozen=True, eq=False, repr=False)
class LayerComponent:
    """Panels whose order does not depend on that of others.

    Attributes
    ----------
    panels : tuple of int
    problems : tuple of (LayerProblem, int array)
        The independent conditions on them, each with the classes of variables it is about.
    counts : tuple of int
        In how many ways each of these can be met.

    Examples
    --------
    >>> import synth
    >>> synth.layers("data/patterns/bird-base.fold").components
    (<LayerComponent: 16 panels, 2 orders>,)
    """

    panels: tuple[int, ...]
    problems: tuple[tuple[LayerProblem, Ints], ...]
    counts: tuple[int, ...]

    @property
    def orders(self) -> int:
        """In how many ways the panels can lie."""
        return prod(self.counts)

    def to_json(self) -> dict[str, Any]:
        """Return plain data; `factors` are the counts of parts that do not depend on each other."""
        return {"panels": list(self.panels), "orders": self.orders, "factors": list(self.counts)}

    def __repr__(self) -> str:
        return f"<LayerComponent: {numbered(len(self.panels), 'panel')}, {numbered(self.orders, 'order')}>"


@dataclass(frozen=True, eq=False, repr=False)
class FlatFolding(Printed):
    """Whether a crease pattern folds flat, and in which layer orders. It prints as ``synth layers`` does.

    Attributes
    ----------
    sheet : Sheet
        Opened along its cuts, its vertices moved within the precision.
    mechanism : SheetMechanism
    precision : Precision
    moved : float
        How far vertices were moved, in units of the extent.
    vertices : tuple of FlatVertex
        The vertices inside the sheet.
    image : FoldedImage, optional
        None where local conditions fail.
    misfit : float
        How far apart two panels put a vertex that they share, in units of the extent.
    parts : tuple of LayerComponent
        All panels whose order creases and transitivity leave open at first, fewest pairs first.
    orders : int
        The number of layer orders: 0 if there is none.
    fault : str
        Why there is none; empty if there is any.
    core : LayerCore, optional
        Conditions on layers that contradict each other, none of which can go; None if there is an order, if the image
        does not close, or without `explain`.
    needed : NeededPrecision, optional
        A precision with which a pattern would fold flat whose sums of sectors or image do not close.

    Examples
    --------
    >>> import synth
    >>> answer = synth.layers("data/patterns/bird-base.fold")
    >>> answer.orders, answer.image.depth
    (2, 16)
    """

    sheet: Sheet
    mechanism: SheetMechanism
    precision: Precision
    moved: float
    vertices: tuple[FlatVertex, ...]
    image: FoldedImage | None
    misfit: float
    parts: tuple[LayerComponent, ...]
    orders: int
    fault: str
    core: LayerCore | None = None
    needed: NeededPrecision | None = None
    _constraints: LayerConstraints | None = field(default=None)
    _reduced: ReducedLayers | None = field(default=None)

    @property
    def foldable(self) -> bool:
        """Whether there is any layer order."""
        return self.orders > 0

    @property
    def components(self) -> tuple[LayerComponent, ...]:
        """The panels whose order does not depend on that of others, where they have more than one."""
        return tuple(part for part in self.parts if part.orders > 1)

    @cached_property
    def valleys(self) -> dict[int, bool]:
        """Whether each assigned crease is a valley, by its joint."""
        return valleys_of(self.sheet, self.mechanism)

    @property
    def local_faults(self) -> tuple[FlatVertex, ...]:
        """Vertices whose surroundings do not fold flat."""
        return tuple(vertex for vertex in self.vertices if vertex.fault)

    def order(self, number: int = 0) -> LayerOrder:
        """Return one layer order by its number, from 0 on, in an order that is always the same.

        The last component changes first. Raises `InvariantError` for a number beyond the last; numbers far from 0 of
        a component with millions of orders take long to reach.
        """
        if not 0 <= number < self.orders:
            raise InvariantError("order", f"order {number}", f"a number from 0 to {self.orders - 1}")
        chosen: list[tuple[Ints, list[int]]] = []
        for (problem, classes), count in reversed(list(self._parts())):
            number, place = divmod(number, count)
            chosen.append((classes, next(islice(solutions(problem), place, None))))
        return self._with(chosen)

    def sample(self, seed: int = 0) -> LayerOrder:
        """Return a layer order drawn at random: each is as likely as any other."""
        self._check_any()
        draw = Random(seed)
        return self._with([(classes, _drawn(problem, draw)) for (problem, classes), _ in self._parts()])

    def orders_of(self, component: int) -> Iterator[LayerOrder]:
        """Yield an order for each way in which the panels of a component can lie; the others stay as in order 0."""
        self._check_any()
        mine = self.components[component].problems
        rest = [
            (classes, next(solutions(problem)))
            for (problem, classes), _ in self._parts()
            if not any(problem is other for other, _ in mine)
        ]

        def combined(left: Sequence[tuple[LayerProblem, Ints]]) -> Iterator[list[tuple[Ints, list[int]]]]:
            if not left:
                yield []
                return
            (problem, classes), *others = left
            for values in solutions(problem):
                for more in combined(others):
                    yield [(classes, values), *more]

        for chosen in combined(mine):
            yield self._with([*rest, *chosen])

    def nearest(self, wishes: Sequence[tuple[int, int]]) -> tuple[LayerOrder, tuple[tuple[int, int], ...]]:
        """Return a layer order that meets as many wishes as possible, and the wishes that it does not meet.

        A wish is a pair of panels, the first to be on top. Up to twelve wishes on one part are met in the largest
        number possible; of more, one after the other as far as that is possible. Raises `InvariantError` for panels
        that do not overlap.
        """
        self._check_any()
        assert self._constraints is not None
        assert self._reduced is not None
        table = self._constraints.table
        places: dict[tuple[int, int], set[int]] = {}
        for one, other, variable in np.unique(np.column_stack([table.panels, table.variable]), axis=0).tolist():
            places.setdefault((one, other), set()).add(variable)
        parts = [part for part, _ in self._parts()]
        part_of = {number: place for place, (_, classes) in enumerate(parts) for number in classes.tolist()}
        wanted: list[list[int]] = [[] for _ in parts]
        for upper, lower in wishes:
            pair = min(upper, lower), max(upper, lower)
            if pair not in places:
                raise InvariantError("wish", f"panels {upper} and {lower} do not overlap", "two panels that do")
            for variable in places[pair]:
                literal = int(self._reduced.literal[2 * variable + (upper > lower)])
                if literal >> 1 in part_of:
                    place = part_of[literal >> 1]
                    local = int(np.searchsorted(parts[place][1], literal >> 1))
                    wanted[place].append(2 * local + (literal & 1))
        order = self._with(
            [
                (classes, next(solutions(problem, _met(problem, list(dict.fromkeys(literals))))))
                for (problem, classes), literals in zip(parts, wanted, strict=True)
            ]
        )
        above = order.above()
        return order, tuple(
            (upper, lower) for upper, lower in wishes if above[min(upper, lower), max(upper, lower)] != (upper < lower)
        )

    @property
    def problems(self) -> tuple[tuple[LayerProblem, Ints], ...]:
        """The independent problems of all parts, each with the classes of variables it is about."""
        return tuple(part for part, _ in self._parts())

    def valley_literals(self, joints: Sequence[int]) -> dict[int, int]:
        """Return for creases the literal of a class that says that each is a valley; 0 is true, 1 false."""
        if self._constraints is None or self._reduced is None:
            return {}
        literals, turns = self._constraints.creases(dict.fromkeys(joints, True))
        of = self._constraints.turns.joint[turns]
        return dict(zip(of.tolist(), self._reduced.literal[literals].tolist(), strict=True))

    def _check_any(self) -> None:
        if not self.foldable:
            raise UnsolvableError(f"there is no layer order: {self.fault}")

    def _parts(self) -> Iterator[tuple[tuple[LayerProblem, Ints], int]]:
        for component in self.parts:
            yield from zip(component.problems, component.counts, strict=True)

    def _with(self, chosen: Sequence[tuple[Ints, list[int]]]) -> LayerOrder:
        """Return the layer order for values of the classes of all parts, and check it."""
        assert self.image is not None
        assert self._constraints is not None
        assert self._reduced is not None
        literal = self._reduced.literal[::2]
        value = np.ones(int(literal.max(initial=0)) // 2 + 1, dtype=np.int64)
        for classes, values in chosen:
            value[classes] = values
        table = self._constraints.table
        truth = (value[literal >> 1] ^ (literal & 1))[table.variable] if len(table) else np.empty(0, dtype=np.int64)
        stacks = []
        for cell, panels in enumerate(self.image.above):
            one, other = np.triu_indices(len(panels), 1)
            on_top = truth[table.first[cell] : table.first[cell + 1]]
            height = np.bincount(np.where(on_top == 1, one, other), minlength=len(panels))
            stacks.append(tuple(panels[np.argsort(height, kind="stable")].tolist()))
        order = LayerOrder(self.image, tuple(stacks))
        wrong = fault_of(self.image, stacks, self.valleys)
        if wrong:
            raise AssertionError(f"a layer order does not pass the checker: {wrong}")
        return order

    def to_json(self) -> dict[str, Any]:
        """Return the answer as plain data, with the keys that scripts rely on (docs/command-json.md)."""
        image = self.image
        return {
            "foldable": self.foldable,
            "orders": self.orders,
            "components": [component.to_json() for component in self.components],
            "fault": self.fault or None,
            "core": None if self.core is None else self.core.to_json(),
            "vertices": [vertex.to_json() for vertex in self.vertices],
            "needed_precision": None if self.needed is None else self.needed.to_json(),
            "misfit": self.misfit,
            "moved": self.moved,
            "precision": self.precision.size,
            "image": None
            if image is None
            else {
                "cells": len(image.cells),
                "segments": len(image.segments),
                "most_layers": image.depth,
                "pairs": 0 if self._constraints is None else self._constraints.variables,
            },
        }

    def blocks(self) -> list[Block]:
        """Return the lines and tables that are printed."""
        faults = self.local_faults
        if not self.foldable:
            told = "" if self.needed is None else f"; {self.needed}"
            blocks: list[Block] = [f"Does not fold flat: {self.fault}{told}."]
            if self.core is not None:
                blocks += core_lines(self.core, _LISTED)
            if faults:
                rows = [(str(v.vertex), f"{v.place[0]:.6g}, {v.place[1]:.6g}", v.fault) for v in faults[:_LISTED]]
                blocks.append(TableBlock(("vertex", "place", "fault"), rows, ("vertex",)))
                if len(faults) > _LISTED:
                    blocks.append(f"and {len(faults) - _LISTED} more")
            return blocks
        assert self.image is not None
        assert self._constraints is not None
        blocks = [f"Folds flat, in {numbered(self.orders, 'layer order')} (proved: every order is counted)."]
        blocks.append(
            f"{numbered(len(self.vertices), 'vertex', 'vertices')} inside the sheet, all locally flat-foldable; "
            f"largest mismatch of panels {self.misfit:.1g} of the extent"
        )
        blocks.append(
            f"folded image: {numbered(len(self.image.cells), 'cell')}, at most {numbered(self.image.depth, 'layer')}, "
            f"{numbered(self._constraints.variables, 'pair')} of panels that overlap"
        )
        if self.moved:
            blocks.append(f"vertices moved by up to {self.moved:.1g} of the extent so that the image closes")
        if self.components:
            several = self.components[:_LISTED]
            rows = [
                (str(number), str(component.orders), " ".join(map(str, component.panels)))
                for number, component in enumerate(several)
            ]
            blocks.append(TableBlock(("component", "orders", "panels"), rows, ("component", "orders")))
            if len(self.components) > _LISTED:
                blocks.append(f"and {len(self.components) - _LISTED} more components")
        return blocks

    def __repr__(self) -> str:
        return f"<FlatFolding: {numbered(self.orders, 'layer order')}>"


def _met(problem: LayerProblem, literals: Sequence[int]) -> list[int]:
    """Return as many of some literals as can be true together; of more than a few, those that go with the first."""

    def possible(some: Sequence[int]) -> bool:
        return next(solutions(problem, some), None) is not None

    if len(literals) <= _FEW:
        for number in range(len(literals), -1, -1):
            for some in combinations(literals, number):
                if possible(some):
                    return list(some)
    kept: list[int] = []
    for literal in literals if not possible(literals) else ():
        if possible([*kept, literal]):
            kept.append(literal)
    return kept or list(literals)


def _drawn(problem: LayerProblem, draw: Random) -> list[int]:
    """Return values that keep all conditions, each as likely as any other."""
    given: list[int] = []
    total = counted(problem)
    for variable in range(problem.variables):
        with_it = counted(problem, (*given, 2 * variable)) if total > 1 or not given else None
        if with_it is None:
            break
        if draw.randrange(total) < with_it:
            given.append(2 * variable)
            total = with_it
        else:
            given.append(2 * variable + 1)
            total -= with_it
    return next(solutions(problem, given))


def valleys_of(sheet: Sheet, mechanism: SheetMechanism) -> dict[int, bool]:
    """Return whether each assigned crease of a sheet is a valley, by its joint.

    The letters are those of faces that turn counter-clockwise, seen from the side that is up.
    """
    return {joint: letter == "V" for joint in mechanism.hinges if (letter := sheet.assignments[joint]) in "MV"}


def _check_unfolded(sheet: Sheet, points: Floats) -> None:
    """Refuse a sheet two faces of which lie on one side of the edge that they share: it is folded already."""
    seen: dict[frozenset[int], tuple[int, bool]] = {}
    for face, around in enumerate(sheet.faces):
        up = float(signed_area(points[list(around)])) > 0.0
        for a, b in sides_of_face(around):
            side = frozenset((a, b))
            ahead = (a < b) == up
            if side in seen and seen[side][1] == ahead:
                both = f"faces {seen[side][0]} and {face} lie on one side of the edge that they share"
                raise UnsolvableError(f"{both}: the pattern is folded already; expected it flat, or --frame N")
            seen[side] = (face, ahead)


def is_folded(sheet: Sheet) -> bool:
    """Return whether a sheet is at a configuration in which it is folded, and no crease pattern.

    Parameters
    ----------
    sheet : Sheet
        Without coordinates or faces it is not.

    Examples
    --------
    >>> is_folded(Sheet(4, (), "", ((0, 1, 3), (1, 2, 3)), ((0, 0), (1, 0), (0, 0), (0, 1))))
    True
    """
    if sheet.coordinates is None or not sheet.faces:
        return False
    try:
        _check_unfolded(sheet, np.array(flat_places(sheet, "a crease pattern")))
    except UnsolvableError:
        return True
    return False


@dataclass(frozen=True, eq=False)
class FlatPattern:
    """A crease pattern in its plane, opened along its cuts, with its vertices inside; what `layers` begins with."""

    sheet: Sheet
    mechanism: SheetMechanism
    precision: Precision
    points: Floats
    moved: float
    vertices: tuple[FlatVertex, ...]


def flat_pattern(sheet: Sheet) -> FlatPattern:
    """Return a crease pattern in its plane, its vertices moved to where the image closes if that is near enough.

    Raises `UnsolvableError` for a sheet without faces or in space.
    """
    if not sheet.faces:
        raise UnsolvableError("layers need panels, and the pattern has no faces")
    whole = with_all_edges(sheet)
    flat_places(whole, "a crease pattern that is folded flat")
    precision = precision_of_sheet(sheet)
    dual = mechanism_of_sheet(whole, geometry=False)
    apart = opened(whole, dual)
    mechanism = dual if apart is whole else mechanism_of_sheet(apart, geometry=False)
    points = np.array(flat_places(apart, "a crease pattern that is folded flat"))
    _check_unfolded(apart, points)
    vertices = flat_vertices(apart, mechanism, points, precision)
    moved = 0.0
    if all(vertex.kawasaki for vertex in vertices) and max((vertex.off for vertex in vertices), default=0.0) > 0.0:
        closed = closing_points(points, vertices)
        moved = float(np.linalg.norm(closed - points, axis=1).max()) / extent_of(points)
        if moved <= Tolerances.of(precision.size).same_point:
            points = closed
        else:
            moved = 0.0
    kept = keeping(apart, precision) if apart is not sheet else apart
    return FlatPattern(kept, mechanism, precision, points, moved, tuple(vertices))


def _check_pairs(pairs: int) -> None:
    """Refuse more pairs of panels over cells than the limit allows, before they take memory."""
    check_work("pairs", pairs, "pairs of panels over cells")


def flat_folding(
    sheet: Sheet,
    count: Counter,
    *,
    explain: bool = True,
    check: Callable[[int], None] = _check_pairs,
    search: bool = True,
) -> FlatFolding:
    """Return what `layers` does of a sheet, its problems counted by a function: a run that can be resumed, say.

    Parameters
    ----------
    sheet : Sheet
    count : callable
        Takes problems, and returns how many solutions each has.
    explain : bool, optional
        As for `layers`; so are the errors.
    check : callable, optional
        Takes the number of pairs of panels over cells, and raises an error if there are too many.
    search : bool, optional
        Where sums of sectors are off, look for a precision with which the pattern folds flat.

    Examples
    --------
    >>> import synth
    >>> from synth.analysis.layering.counting.propagation import counted
    >>> flat_folding(synth.read("data/patterns/bird-base.fold"), lambda problems: list(map(counted, problems))).orders
    2
    """
    pattern = flat_pattern(sheet)
    extent = extent_of(pattern.points)
    about = (pattern.sheet, pattern.mechanism, pattern.precision, pattern.moved, pattern.vertices)
    local = _local_fault(pattern.vertices)
    if not all(vertex.kawasaki for vertex in pattern.vertices):
        needed = _needed(sheet, pattern, count, check) if search else None
        return FlatFolding(*about, None, 0.0, (), 0, local, needed=needed)
    panels = folded(pattern.sheet, pattern.mechanism, pattern.points)
    tolerances = Tolerances.of(pattern.precision.size)
    misfit = panels.misfit / extent
    if misfit > tolerances.same_point * len(panels.flipped):
        place = ", ".join(f"{x:.6g}" for x in pattern.points[panels.vertex])
        wrong = f"the folded image does not close: panels part by {misfit:.2g} of the extent at ({place})"
        needed = _needed(sheet, pattern, count, check) if search else None
        return FlatFolding(*about, None, misfit, (), 0, wrong, needed=needed)
    if panels.unturned is not None:
        wrong = f"the folded image does not close: an odd number of creases round a hole, one of them {panels.unturned}"
        return FlatFolding(*about, None, misfit, (), 0, wrong)
    image = image_of(panels, max(tolerances.same_point * extent, 4.0 * panels.misfit))
    check(sum(len(there) * (len(there) - 1) // 2 for there in image.above))
    constraints = layer_constraints(image)
    known, _ = constraints.creases(valleys_of(pattern.sheet, pattern.mechanism))
    left = reduced(constraints, known)
    parts = () if left is None else components_of(constraints, left, count)
    orders = 0 if left is None else prod(part.orders for part in parts)
    if orders:
        return FlatFolding(*about, image, misfit, parts, orders, "", _constraints=constraints, _reduced=left)
    core = core_of(image, valleys_of(pattern.sheet, pattern.mechanism)) if explain else None
    return FlatFolding(*about, image, misfit, (), 0, local or CONTRADICTION, core, _constraints=constraints)


def _needed(sheet: Sheet, pattern: FlatPattern, count: Counter, check: Callable[[int], None]) -> NeededPrecision | None:
    """Return a precision with which a pattern folds flat whose sums of sectors or image do not close, if one does."""
    found = needed_precision(pattern.points, pattern.vertices)
    if found is None:
        return None
    size, moved = found
    # vertices are wrong by more than the least displacement, which panels that are to lie on each other may need
    for wider in (1.0, _WIDER):
        needed = max(size, pattern.precision.size) * wider
        if needed > COARSEST:
            break
        length = rounded_up(needed * extent_of(pattern.points))
        try:
            answer = flat_folding(stated(sheet, length), count, explain=False, check=check, search=False)
        except (NumericalError, UnsolvableError):
            continue
        if answer.foldable:
            return NeededPrecision(length, moved, answer.orders)
    return None


def _local_fault(vertices: Sequence[FlatVertex]) -> str:
    """Return what is wrong at the vertices, in words; empty if nothing is."""
    faults = [vertex for vertex in vertices if vertex.fault]
    if not faults:
        return ""
    first = faults[0]
    several = f"; faults at {numbered(len(faults) - 1, 'more vertex', 'more vertices')}" if len(faults) > 1 else ""
    return f"vertex {first.vertex} at ({first.place[0]:.6g}, {first.place[1]:.6g}): {first.fault}{several}"


def components_of(constraints: LayerConstraints, left: ReducedLayers, count: Counter) -> tuple[LayerComponent, ...]:
    """Count the orders of all components."""
    table = constraints.table
    class_of = left.literal[::2] >> 1
    panels_of: dict[int, set[int]] = {}
    open_rows = np.flatnonzero(class_of[table.variable] > 0) if len(table) else np.empty(0, dtype=np.int64)
    pairs = np.unique(np.column_stack([class_of[table.variable[open_rows]], table.panels[open_rows]]), axis=0)
    for number, one, other in pairs.tolist():
        panels_of.setdefault(number, set()).update((one, other))
    counts = count([problem for problem, _ in left.parts])
    found = []
    for places in left.components:
        problems = tuple(left.parts[place] for place in places)
        classes = np.concatenate([classes for _, classes in problems]).tolist()
        panels = tuple(sorted({panel for number in classes for panel in panels_of[number]}))
        found.append(LayerComponent(panels, problems, tuple(counts[place] for place in places)))
    return tuple(found)
