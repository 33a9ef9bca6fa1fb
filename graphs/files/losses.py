"""What a file cannot hold of a mechanism: by kind and number, and whether it is of another type when read back."""

from collections.abc import Callable, Collection, Hashable
from dataclasses import dataclass
from math import isclose, pi
from typing import Any

from graphs.convert.conversions import Mechanism, to_sc, to_sheet
from graphs.count.report import mobility_report
from graphs.errors import InvariantError, UnsolvableError, numbered
from graphs.files.bare import are_kept
from graphs.files.native import is_count
from graphs.files.outputs import Lost
from graphs.identity.chains import class_code
from graphs.joints.linkage import JointedLinkage, JointKind
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.precision import flattened
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import FLAT, HINGES, Sheet, with_all_edges
from graphs.mechanism.solids import HingedSolids
from graphs.mechanism.surfaces import SurfaceLinkage
from graphs.printing import plain

_KEYS = 12  # keys of a file that are named: programs write dozens of their own, and one line says what is lost


def lost_as_json(mechanism: Mechanism) -> Lost:
    """Return what a native file does not hold; for a sheet, all but its mechanism."""
    if not isinstance(mechanism, Sheet):
        return ()
    return (*_of_its_file(mechanism), *_title(mechanism), *_shapes(mechanism), *_angles(mechanism))


def lost_as_fold(mechanism: Mechanism) -> Lost:
    """Return what a FOLD file does not hold; for a sheet read from one, its other frames and keys."""
    return _of_its_file(mechanism) if isinstance(mechanism, Sheet) else _lost_as_sheet(mechanism)


def lost_as_cp(mechanism: Mechanism) -> Lost:
    """Return what the ``.cp`` file of a mechanism does not hold."""
    sheet = to_sheet(mechanism)
    letters = with_all_edges(sheet).assignments
    lost = [
        *_letters(letters, "C", "cut", "as borders"),
        *_letters(letters, "J", "join", "as auxiliary lines"),
        *_letters(letters, "U", "unassigned crease", "as valleys"),
        *_angles(sheet),
        *_title(sheet),
    ]
    return _lost_as_lines(mechanism, sheet, *lost)


def lost_as_dxf(mechanism: Mechanism) -> Lost:
    """Return what the DXF file of a mechanism does not hold."""
    sheet = to_sheet(mechanism)
    return _lost_as_lines(mechanism, sheet, *_angles(sheet), *_title(sheet))


def lost_as_svg(mechanism: Mechanism) -> Lost:
    """Return what the SVG file of a mechanism does not hold.

    Opacity holds fold angles up to 180 degrees, of mountains below zero and of valleys above it.
    """
    sheet = to_sheet(mechanism)
    letters = with_all_edges(sheet).assignments
    wrong = sum(
        angle is not None and _is_informative(letter, angle) and not _by_opacity(letter, angle)
        for letter, angle in zip(sheet.assignments, sheet.fold_angles or (), strict=False)
    )
    joins = _letters(letters, "J", "join", "as flat edges")
    return _lost_as_lines(mechanism, sheet, *joins, *_some(wrong, "fold angle"))


def _lost_as_lines(mechanism: Mechanism, sheet: Sheet, *lost: str) -> Lost:
    """Return what a drawing of lines does not hold; `lost` depends on its format."""
    flat = flattened(sheet)
    pose = (f"the pose in space: {flat.turned}",) if flat is not None and flat.turned else ()
    bounds = f"which lines bound which of {numbered(len(sheet.faces), 'face')}"
    return (*lost_as_fold(mechanism), *lost, *_precision(sheet), bounds, *pose)


def lost_as_obj(mechanism: Mechanism) -> Lost:
    """Return what the OBJ file of a mechanism does not hold."""
    sheet = to_sheet(mechanism)
    return (*lost_as_fold(mechanism), *_title(sheet), *_precision(sheet))


def lost_as_bare_graph(mechanism: Mechanism) -> Lost:
    """Return what a bare link-joint graph with names does not hold."""
    names = _listed(to_sc(mechanism), are_kept, "whether names of {} are text or integers")
    return (*_lost_as_graph(mechanism), *names)


def lost_as_nameless_graph(mechanism: Mechanism) -> Lost:
    """Return what a bare link-joint graph without names does not hold."""
    names = () if isinstance(mechanism, Sheet) else _names(to_sc(mechanism))
    return (*_lost_as_graph(mechanism), *names)


def _lost_as_graph(mechanism: Mechanism) -> Lost:
    sc = to_sc(mechanism)
    loops = (*sc.loops, *sc.closing)
    lost = list(_some(len(loops), "loop and its centre", "loops and their centres"))
    if sc.spatial_loops:
        lost.append(f"that {numbered(sc.spatial_loops, 'loop has', 'loops have')} no centre")
    if isinstance(mechanism, Sheet):
        lost += (*_of_its_file(mechanism), *_title(mechanism), *_shapes(mechanism), *_angles(mechanism))
    if isinstance(mechanism, SCDGraph):
        lost.append(f"the order of the sides of {numbered(len(sc), 'link')}")
    lost += _places_of_joints(mechanism)
    if isinstance(mechanism, JointedLinkage) and mechanism.places:
        lost.append("the places of its joints")
    if sc.ground is not None:
        lost.append("the ground link")
    return tuple(lost)


def lost_as_graphml(mechanism: Mechanism) -> Lost:
    """Return what a GraphML file does not hold: it has types of joints, where they are known."""
    if not isinstance(mechanism, JointedLinkage):
        return lost_as_bare_graph(mechanism)
    chain = mechanism.chain
    lost = list(_some(len(chain.loops) + len(chain.closing), "loop and its centre", "loops and their centres"))
    if mechanism.places:
        lost.append("the places of its joints")
    if chain.ground is not None:
        lost.append("the ground link")
    return (*lost, *_listed(chain, are_kept, "whether names of {} are text or integers"))


def _lost_as_sheet(mechanism: Mechanism) -> Lost:
    """Return the losses of a mechanism that becomes a sheet."""
    if isinstance(mechanism, PolyhedronModel):
        return _model_as_sheet(mechanism)
    sc = to_sc(mechanism)
    lost: list[str] = []
    if isinstance(mechanism, SCDGraph):
        lost += _some(mechanism.counts.implicit_centres, "implicit centre")
    loops: tuple[Loop, ...] = (*sc.loops, *sc.closing)
    infinite = sum(loop.centre is Centre.INFINITE for loop in loops)
    lost += _some(infinite, "centre at infinity", "centres at infinity")
    if sc.ground is not None:
        lost.append("the ground link")
    lost += _places_of_joints(mechanism)
    if isinstance(mechanism, JointedLinkage):
        lost.append("the kinds of its joints")
    lost += _some(sum(loop.at is not None for loop in loops), "named centre")
    lost += _some(sum(loop.name is not None for loop in loops), "name of a loop", "names of loops")
    return (*lost, *_names(sc))


def _places_of_joints(mechanism: Mechanism) -> Lost:
    if isinstance(mechanism, SurfaceLinkage):
        return (f"the places of joints on the {mechanism.kind}",)
    return ("the axes of its joints",) if isinstance(mechanism, HingedSolids) else ()


def _model_as_sheet(model: PolyhedronModel) -> Lost:
    return (
        *_some(len(model.centres), "remote centre"),
        *_some(len(model.on_line), "point on a line", "points on lines"),
        *_some(len(model.on_plane), "point on a plane", "points on planes"),
        *_some(len(model.scissors), "scissors", "scissors"),
        *([] if model.ground is None else ["the ground"]),
        *_some(0 if is_count(model.nodes) else len(model), "name of a vertex", "names of vertices"),
        *_some(0 if is_count(model.links) else len(model.links), "name of a link", "names of links"),
    )


def _names(sc: SCGraph) -> Lost:
    return _listed(sc, is_count, "names of {}")


def _listed(sc: SCGraph, are_held: Callable[[Collection[Hashable]], bool], line: str) -> Lost:
    """Return a line with the numbers of links and joints whose names are not held."""
    kinds: tuple[tuple[Collection[Hashable], str], ...] = ((sc.nodes, "link"), (sc.joints, "joint"))
    named = [numbered(len(ids), kind) for ids, kind in kinds if not are_held(ids)]
    return (line.format(" and ".join(named)),) if named else ()


def _of_its_file(sheet: Sheet) -> Lost:
    """Return what the file of a sheet holds beside the sheet."""
    if sheet.frames is None:
        return ()
    keys = sheet.frames.left_out
    named = ", ".join(map(plain, keys[:_KEYS])) + (f" and {len(keys) - _KEYS} more" if len(keys) > _KEYS else "")
    return (*_some(sheet.frames.others, "other frame"), *((f"the FOLD keys {named}",) if keys else ()))


def _title(sheet: Sheet) -> Lost:
    return ("the title",) if sheet.title else ()


def _precision(sheet: Sheet) -> Lost:
    """Return the precision of a pattern whose points were welded, which decides about centres and hinges."""
    return ("the distances of welded points",) if sheet.spread else ()


def _shapes(sheet: Sheet) -> Lost:
    """Return coordinates, faces and assignments, which a file of the mechanism alone does not hold."""
    vertices, faces = numbered(sheet.vertices, "vertex", "vertices"), len(sheet.faces)
    places = () if sheet.coordinates is None else (f"coordinates of {vertices}",)
    shape = "the shape of 1 face" if faces == 1 else f"the shapes of {faces} faces"
    folded = sum(letter in "MV" for letter in sheet.assignments)
    kinds = (f"mountain or valley of {numbered(folded, 'crease')}",) if folded else ()
    cuts = _some(sheet.assignments.count("C"), "cut")
    flat = _some(sum(letter in FLAT for letter in sheet.assignments), "flat edge")
    return (*places, shape, *kinds, *cuts, *flat)


def _angles(sheet: Sheet) -> Lost:
    pairs = zip(sheet.assignments, sheet.fold_angles or (), strict=False)
    number = sum(angle is not None and _is_informative(letter, angle) for letter, angle in pairs)
    return _some(number, "fold angle")


def _is_informative(letter: str, angle: float) -> bool:
    """Return whether a fold angle says more than that an edge without a hinge is not folded."""
    return letter in HINGES or angle != 0


def _by_opacity(letter: str, angle: float) -> bool:
    """Return whether the colour and the opacity of a line give its fold angle."""
    signed = {"M": -abs(angle), "V": abs(angle)}
    return letter in signed and abs(angle) <= pi and isclose(angle, signed[letter])


def _letters(assignments: str, letter: str, kind: str, becomes: str) -> Lost:
    number = assignments.count(letter)
    return (f"{numbered(number, kind)}: {becomes}",) if number else ()


def _some(number: int, one: str, more: str = "") -> Lost:
    return (numbered(number, one, more),) if number else ()


@dataclass(frozen=True)
class _Type:
    """The type of a mechanism, cheap parts first; without ``sc`` only the mobility by count is known."""

    mobility: int | None
    kind: str
    numbers: str
    sc: SCGraph | None

    @property
    def words(self) -> str:
        return f"M = {self.mobility} {self.kind}"

    @property
    def code(self) -> tuple[Any, ...] | None:
        """The canonical code of links, joints and centre classes, whichever link is fixed."""
        if self.sc is None:
            return None
        return class_code(SCGraph(self.sc.nodes, self.sc.joints, self.sc.loops, closing=self.sc.closing))


def change_of_type(before: Mechanism, after: Mechanism) -> str | None:
    """Return the change of the type of a mechanism in words; None if there is none, or `before` has no type.

    A sheet with an edge of three faces has none. Types are equal if links, joints and centre classes correspond.
    A polyhedron model that is more than its panels is compared by mobility alone, linkages with joints of all
    kinds by the names of these.
    """
    if isinstance(before, JointedLinkage) and isinstance(after, JointedLinkage):
        return None if _as_text(before) == _as_text(after) else "links, joints or their kinds differ"
    try:
        old = _type_of(before)
    except (InvariantError, UnsolvableError):
        return None
    try:
        new = _type_of(after)
    except (InvariantError, UnsolvableError) as error:
        return f"{old.words} would be no mechanism: {error}"
    if (old.mobility, old.kind) != (new.mobility, new.kind) and None not in (old.sc, new.sc):
        return f"{old.words} becomes {new.words}"
    if old.mobility != new.mobility:
        return f"M = {old.mobility} becomes M = {new.mobility}"
    if None in (old.sc, new.sc):
        return None
    if old.numbers != new.numbers:
        return f"{old.words}: {old.numbers} become {new.numbers}"
    if old.code != new.code:
        return f"{old.words}: the numbers stay, but other loops share a centre"
    return None


def _as_text(linkage: JointedLinkage) -> tuple[set[str], dict[str, tuple[set[str], JointKind]]]:
    """Return links, and joints with their ends and kinds, by their names: these files keep."""
    joints = {str(joint): ({*map(str, ends)}, linkage.kinds[joint]) for joint, ends in linkage.chain.joints.items()}
    return {*map(str, linkage.chain.nodes)}, joints


def _type_of(mechanism: Mechanism) -> _Type:
    try:
        sc = to_sc(mechanism)
    except UnsolvableError:
        if not isinstance(mechanism, PolyhedronModel):
            raise
        report = mobility_report(mechanism)
        return _Type(report.mobility, report.mechanism_class, "", None)
    report = mobility_report(sc)
    numbers = f"{report.links} links, {report.joints} joints, {report.centres} centres"
    return _Type(report.mobility, report.mechanism_class, numbers, sc)
