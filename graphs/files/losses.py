"""What a format cannot hold of a mechanism, told by kind and number."""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable
from math import isclose

from graphs.convert.table import Mechanism, to_sc
from graphs.files.names_as_text import are_kept
from graphs.files.native.names import is_count
from graphs.joints.linkage import JointedLinkage
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import FLAT, HINGES, Sheet, with_all_edges
from graphs.mechanism.solids import HingedSolids
from graphs.mechanism.surfaces import SurfaceLinkage
from graphs.printing import plain

__all__ = [
    "lost_as_bare_graph",
    "lost_as_cp",
    "lost_as_dxf",
    "lost_as_fold",
    "lost_as_json",
    "lost_as_obj",
    "lost_as_svg",
    "lost_as_typed_graph",
]

Lost = tuple[str, ...]

_KEYS = 12
"""So many keys of a file are named."""


def lost_as_json(mechanism: Mechanism) -> Lost:
    """Return what a native file does not hold; for a sheet, all but its mechanism.

    >>> lost_as_json(Sheet(3, ((0, 1),), "B", ((0, 1, 2),), ((0, 0), (1, 0), (0, 1)), "Kite"))
    ('the title', 'coordinates of 3 vertices', 'the shape of 1 face')
    """
    if not isinstance(mechanism, Sheet):
        return ()
    return (*_of_its_file(mechanism), *_title(mechanism), *_shapes(mechanism), *_angles(mechanism))


def lost_as_fold(mechanism: Mechanism) -> Lost:
    """Return what a FOLD file does not hold; for a sheet read from one, its other frames and keys.

    >>> lost_as_fold(SCGraph(["A", "B"], [("A", "B")]))
    ('names of 2 links',)
    """
    return _of_its_file(mechanism) if isinstance(mechanism, Sheet) else _lost_as_sheet(mechanism)


def lost_as_cp(mechanism: Mechanism, sheet: Sheet) -> Lost:
    """Return what the ``.cp`` file of the sheet of a mechanism does not hold.

    >>> sheet = Sheet(3, ((0, 1), (1, 2)), "CU", ((0, 1, 2),), fold_angles=(None, 90.0))
    >>> lost_as_cp(sheet, sheet)
    ('1 cut: as borders', '1 unassigned crease: as valleys', '1 fold angle', 'which lines bound which of 1 face')
    """
    letters = with_all_edges(sheet).assignments
    told = [
        *_letters(letters, "C", "cut", "as borders"),
        *_letters(letters, "J", "join", "as auxiliary lines"),
        *_letters(letters, "U", "unassigned crease", "as valleys"),
        *_angles(sheet),
        *_title(sheet),
    ]
    return (*lost_as_fold(mechanism), *told, *_precision(sheet), _bounds(sheet))


def lost_as_dxf(mechanism: Mechanism, sheet: Sheet) -> Lost:
    """Return what the DXF file of the sheet of a mechanism does not hold.

    >>> sheet = Sheet(3, ((0, 1), (1, 2)), "JM", ((0, 1, 2),), fold_angles=(None, 90.0))
    >>> lost_as_dxf(sheet, sheet)
    ('1 fold angle', 'which lines bound which of 1 face')
    """
    return (*lost_as_fold(mechanism), *_angles(sheet), *_title(sheet), *_precision(sheet), _bounds(sheet))


def lost_as_svg(mechanism: Mechanism, sheet: Sheet) -> Lost:
    """Return what the SVG file of the sheet of a mechanism does not hold.

    Opacity holds fold angles up to 180 degrees, of mountains below zero and of valleys above it.

    >>> sheet = Sheet(3, ((0, 1), (1, 2)), "JM", ((0, 1, 2),), fold_angles=(None, 90.0))
    >>> lost_as_svg(sheet, sheet)
    ('1 join: as flat edges', '1 fold angle', 'which lines bound which of 1 face')
    """
    letters = with_all_edges(sheet).assignments
    wrong = sum(
        angle is not None and _is_told(letter, angle) and not _by_opacity(letter, angle)
        for letter, angle in zip(sheet.assignments, sheet.fold_angles or (), strict=False)
    )
    angles = (_number(wrong, "fold angle"),) if wrong else ()
    told = (*_letters(letters, "J", "join", "as flat edges"), *angles, *_precision(sheet))
    return (*lost_as_fold(mechanism), *told, _bounds(sheet))


def lost_as_obj(mechanism: Mechanism, sheet: Sheet) -> Lost:
    """Return what the OBJ file of a sheet that was made of a mechanism does not hold."""
    return (*lost_as_fold(mechanism), *_title(sheet), *_precision(sheet))


def lost_as_bare_graph(mechanism: Mechanism, *, names: bool) -> Lost:
    """Return what a bare link-joint graph, with names or without, does not hold.

    >>> lost_as_bare_graph(SCGraph(4, [(0, 1), (1, 2), (2, 3), (3, 0)], [Loop(range(4))]), names=False)
    ('1 loop and its centre',)
    """
    sc = to_sc(mechanism)
    loops = (*sc.loops, *sc.closing)
    told = (
        []
        if not loops
        else ["1 loop and its centre" if len(loops) == 1 else f"{len(loops)} loops and their centres"]
    )
    if sc.spatial_loops:
        told.append(f"that {_number(sc.spatial_loops, 'loop has', 'loops have')} no centre")
    if isinstance(mechanism, Sheet):
        told += (*_of_its_file(mechanism), *_title(mechanism), *_shapes(mechanism), *_angles(mechanism))
    if isinstance(mechanism, SCDGraph):
        told.append(f"the order of the sides of {_number(len(sc), 'link')}")
    if isinstance(mechanism, SurfaceLinkage):
        told.append(f"where joints lie on the {mechanism.kind}")
    if isinstance(mechanism, HingedSolids):
        told.append("the axes of its joints")
    if isinstance(mechanism, JointedLinkage) and mechanism.places:
        told.append("the places of its joints")
    if sc.ground is not None:
        told.append("the ground link")
    if names:
        return (*told, *_listed(sc, are_kept, "whether names of {} are text or integers"))
    return (*told, *(() if isinstance(mechanism, Sheet) else _names(sc)))


def lost_as_typed_graph(linkage: JointedLinkage) -> Lost:
    """Return what a link-joint graph with the types of joints does not hold.

    >>> lost_as_typed_graph(JointedLinkage(SCGraph(2, [(0, 1)], ground=0), {}))
    ('the ground link',)
    """
    chain = linkage.chain
    told = list(_some(len(chain.loops) + len(chain.closing), "loop and its centre", "loops and their centres"))
    if linkage.places:
        told.append("the places of its joints")
    if chain.ground is not None:
        told.append("the ground link")
    return (*told, *_listed(chain, are_kept, "whether names of {} are text or integers"))


def _lost_as_sheet(mechanism: Mechanism) -> Lost:
    """Return what is lost where a mechanism that is no sheet becomes one."""
    if isinstance(mechanism, PolyhedronModel):
        return _model_as_sheet(mechanism)
    sc = to_sc(mechanism)
    told: list[str] = []
    if isinstance(mechanism, SCDGraph):
        told += _some(mechanism.counts.implicit_centres, "implicit centre")
    told += _some(_loops_of(sc, Centre.INFINITE), "centre at infinity", "centres at infinity")
    if sc.ground is not None:
        told.append("the ground link")
    if isinstance(mechanism, SurfaceLinkage):
        told.append(f"where joints lie on the {mechanism.kind}")
    if isinstance(mechanism, HingedSolids):
        told.append("the axes of its joints")
    if isinstance(mechanism, JointedLinkage):
        told.append("the kinds of its joints")
    loops: tuple[Loop, ...] = (*sc.loops, *sc.closing)
    told += _some(sum(loop.at is not None for loop in loops), "centre told by name", "centres told by name")
    told += _some(sum(loop.name is not None for loop in loops), "name of a loop", "names of loops")
    return (*told, *_names(sc))


def _model_as_sheet(model: PolyhedronModel) -> Lost:
    told = [
        *_some(len(model.centres), "remote centre"),
        *_some(len(model.on_line), "point on a line", "points on lines"),
        *_some(len(model.on_plane), "point on a plane", "points on planes"),
        *_some(len(model.scissors), "scissors", "scissors"),
        *([] if model.ground is None else ["the ground"]),
        *_some(0 if is_count(model.nodes) else len(model), "name of a vertex", "names of vertices"),
        *_some(0 if is_count(model.links) else len(model.links), "name of a link", "names of links"),
    ]
    return tuple(told)


def _loops_of(sc: SCGraph, centre: Centre) -> int:
    return sum(loop.centre is centre for loop in (*sc.loops, *sc.closing))


def _names(sc: SCGraph) -> Lost:
    return _listed(sc, is_count, "names of {}")


def _listed(sc: SCGraph, are_held: Callable[[Collection[Hashable]], bool], line: str) -> Lost:
    """Put into a line how many links and joints there are, of those whose names are not held."""
    kinds: tuple[tuple[Collection[Hashable], str], ...] = ((sc.nodes, "link"), (sc.joints, "joint"))
    named = [_number(len(ids), kind) for ids, kind in kinds if not are_held(ids)]
    return (line.format(" and ".join(named)),) if named else ()


def _of_its_file(sheet: Sheet) -> Lost:
    """Tell what the file that a sheet was read from holds beside it."""
    if sheet.frames is None:
        return ()
    keys = sheet.frames.left_out
    named = ", ".join(map(plain, keys[:_KEYS])) + (f" and {len(keys) - _KEYS} more" if len(keys) > _KEYS else "")
    return (*_some(sheet.frames.others, "other frame"), *((f"the FOLD keys {named}",) if keys else ()))


def _title(sheet: Sheet) -> Lost:
    return ("the title",) if sheet.title else ()


def _precision(sheet: Sheet) -> Lost:
    """Tell of the precision of a pattern whose points were welded, which decides about centres and hinges."""
    return ("how far points were apart that were welded",) if sheet.spread else ()


def _shapes(sheet: Sheet) -> Lost:
    """Tell of coordinates, faces and assignments, where only the mechanism is kept."""
    places = (
        () if sheet.coordinates is None else (f"coordinates of {_number(sheet.vertices, 'vertex', 'vertices')}",)
    )
    folded = sum(letter in "MV" for letter in sheet.assignments)
    faces = len(sheet.faces)
    cuts = _letters(sheet.assignments, "C", "cut", "")
    flat = _some(sum(letter in FLAT for letter in sheet.assignments), "flat edge")
    kinds = (f"mountain or valley of {_number(folded, 'crease')}",) if folded else ()
    shape = "the shape of 1 face" if faces == 1 else f"the shapes of {faces} faces"
    return (*places, shape, *kinds, *cuts, *flat)


def _angles(sheet: Sheet) -> Lost:
    pairs = zip(sheet.assignments, sheet.fold_angles or (), strict=False)
    return _some(sum(angle is not None and _is_told(letter, angle) for letter, angle in pairs), "fold angle")


def _is_told(letter: str, angle: float) -> bool:
    """Tell whether a fold angle says more than that an edge that hinges nothing is not folded."""
    return letter in HINGES or angle != 0


def _by_opacity(letter: str, angle: float) -> bool:
    """Tell whether the colour and the opacity of a line tell its fold angle."""
    signed = {"M": -abs(angle), "V": abs(angle)}
    return letter in signed and abs(angle) <= 180 and isclose(angle, signed[letter])


def _letters(assignments: str, letter: str, kind: str, becomes: str) -> Lost:
    number = assignments.count(letter)
    if not number:
        return ()
    return (_number(number, kind) + (f": {becomes}" if becomes else ""),)


def _bounds(sheet: Sheet) -> str:
    return f"which lines bound which of {_number(len(sheet.faces), 'face')}"


def _some(number: int, one: str, more: str | None = None) -> Lost:
    return (_number(number, one, more),) if number else ()


def _number(number: int, one: str, more: str | None = None) -> str:
    return f"{number} {one if number == 1 else more or one + 's'}"
