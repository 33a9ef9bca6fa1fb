"""Kinds of joints: what two links that are joined may still do. Theory: docs/theory/joints.md."""

from __future__ import annotations

from enum import Enum

from graphs.errors import InvariantError, shown

__all__ = ["JointKind", "kind_named"]


class JointKind(Enum):
    """A kind of joint, by the letter that names of legs use (UPS, RUS).

    Attributes
    ----------
    REVOLUTE
        Turns about an axis: a crease.
    PRISMATIC
        Slides along a direction.
    UNIVERSAL
        Turns about two axes that cross at a right angle, one held by each link.
    SPHERICAL
        Turns about a point.
    CYLINDRICAL
        Turns about an axis and slides along it.
    PLANAR
        Slides in a plane and turns about its normal.

    Examples
    --------
    >>> JointKind("U").word, JointKind.UNIVERSAL.freedoms, JointKind.UNIVERSAL.axes
    ('universal', 2, 2)
    """

    REVOLUTE = "R"
    PRISMATIC = "P"
    UNIVERSAL = "U"
    SPHERICAL = "S"
    CYLINDRICAL = "C"
    PLANAR = "E"

    @property
    def freedoms(self) -> int:
        """Of one link against the other."""
        return _FREEDOMS[self]

    @property
    def axes(self) -> int:
        """How many directions a pose has to give: of a spherical joint none."""
        return {JointKind.UNIVERSAL: 2, JointKind.SPHERICAL: 0}.get(self, 1)

    @property
    def planar(self) -> bool:
        """Whether it can be in a planar loop: it turns about the normal, slides along the plane, or does both."""
        return self in (JointKind.REVOLUTE, JointKind.PRISMATIC, JointKind.PLANAR)

    @property
    def word(self) -> str:
        """The kind in a word."""
        return self.name.lower()


_FREEDOMS = {
    JointKind.REVOLUTE: 1,
    JointKind.PRISMATIC: 1,
    JointKind.UNIVERSAL: 2,
    JointKind.CYLINDRICAL: 2,
    JointKind.SPHERICAL: 3,
    JointKind.PLANAR: 3,
}
_OTHER_WORDS = {"hinge": "R", "slider": "P", "cardan": "U", "hooke": "U", "ball": "S"}


def kind_named(text: str) -> JointKind:
    """Return the kind of joint that a word or a letter means, in small or large letters.

    Parameters
    ----------
    text : str
        Such as ``U``, ``universal`` or ``cardan``.

    Raises
    ------
    InvariantError
        If it is no kind of joint.

    Examples
    --------
    >>> kind_named("universal"), kind_named("s").freedoms
    (<JointKind.UNIVERSAL: 'U'>, 3)
    """
    word = text.strip().lower()
    for kind in JointKind:
        if word in (kind.value.lower(), kind.word) or _OTHER_WORDS.get(word) == kind.value:
            return kind
    known = ", ".join(f"{kind.value} ({kind.word})" for kind in JointKind)
    raise InvariantError("joint type", f"the joint type {shown(text)}", f"one of {known}")
