"""Whether a file read back is of the type of the mechanism that was written."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from graphs.convert.table import Mechanism, to_sc
from graphs.count.report import mobility_report
from graphs.errors import InvariantError, UnsolvableError
from graphs.identity.chains import class_code
from graphs.joints.kinds import JointKind
from graphs.joints.linkage import JointedLinkage
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.sc import SCGraph

__all__ = ["change_of_type"]


@dataclass(frozen=True)
class _Type:
    """What is compared, the cheap first; without an SC graph (``sc``), only the mobility by count is known."""

    mobility: int | None
    kind: str
    numbers: str
    sc: SCGraph | None

    @property
    def told(self) -> str:
        return f"M = {self.mobility} {self.kind}"

    @property
    def code(self) -> tuple[Any, ...] | None:
        """The canonical code of links, joints and centre classes, whichever link is fixed."""
        if self.sc is None:
            return None
        return class_code(SCGraph(self.sc.nodes, self.sc.joints, self.sc.loops, closing=self.sc.closing))


def change_of_type(before: Mechanism, after: Mechanism) -> str | None:
    """Say how the type of a mechanism changed; None if it did not, or `before` has no type.

    A sheet with an edge of three faces has none. Two types are one if links, joints and centre classes correspond.
    A polyhedron model that is more than its panels is compared by mobility alone, linkages with joints of all
    kinds by the names of these.
    """
    if isinstance(before, JointedLinkage) and isinstance(after, JointedLinkage):
        return None if _as_text(before) == _as_text(after) else "links, joints or their kinds are others"
    try:
        old = _type_of(before)
    except (InvariantError, UnsolvableError):
        return None
    try:
        new = _type_of(after)
    except (InvariantError, UnsolvableError) as error:
        return f"{old.told} becomes nothing that moves: {error}"
    if (old.mobility, old.kind) != (new.mobility, new.kind) and None not in (old.sc, new.sc):
        return f"{old.told} becomes {new.told}"
    if old.mobility != new.mobility:
        return f"M = {old.mobility} becomes M = {new.mobility}"
    if None in (old.sc, new.sc):
        return None
    if old.numbers != new.numbers:
        return f"{old.told}: {old.numbers} become {new.numbers}"
    if old.code != new.code:
        return f"{old.told}: the numbers stay, but other loops share a centre"
    return None


def _as_text(linkage: JointedLinkage) -> tuple[set[str], dict[str, tuple[set[str], JointKind]]]:
    """Return links, and joints with their ends and kinds, by their names: these files keep."""
    joints = {
        str(joint): ({*map(str, ends)}, linkage.kinds[joint]) for joint, ends in linkage.chain.joints.items()
    }
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
