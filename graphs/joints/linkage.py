"""A linkage with joints of all kinds: a link-joint graph, the kind of each joint, and perhaps their places."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from math import hypot
from types import MappingProxyType
from typing import Any

from graphs.errors import InvariantError, numbered, shown
from graphs.input_limits import LEAST, MOST, check_extent, in_reach
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.sc import SCGraph
from graphs.types import Floats, JointId, LinkId


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
        """The degrees of freedom of one link against the other."""
        return {"R": 1, "P": 1, "U": 2, "C": 2, "S": 3, "E": 3}[self.value]

    @property
    def axes(self) -> int:
        """The number of directions that place the joint; 0 for a spherical one."""
        return {JointKind.UNIVERSAL: 2, JointKind.SPHERICAL: 0}.get(self, 1)

    @property
    def planar(self) -> bool:
        """Whether it can be in a planar loop: it turns about the normal, slides along the plane, or does both."""
        return self in (JointKind.REVOLUTE, JointKind.PRISMATIC, JointKind.PLANAR)

    @property
    def word(self) -> str:
        """The kind in a word."""
        return self.name.lower()


_OTHER_WORDS = {"hinge": "R", "slider": "P", "cardan": "U", "hooke": "U", "ball": "S"}


def kind_named(text: str) -> JointKind:
    """Return the kind of joint that a word or a letter means, in small or large letters.

    Parameters
    ----------
    text : str
        Such as ``U``, ``universal`` or ``cardan``; else InvariantError.

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


Vector = tuple[float, float, float]


def plain_vector(vector: Floats) -> Vector:
    """Return a vector as three plain numbers."""
    x, y, z = vector.tolist()
    return (x, y, z)


# Cosine: files have six digits; a universal joint whose axes are farther from a right angle is another joint.
_RIGHT = 1e-6


@dataclass(frozen=True, slots=True)
class JointPlace:
    """The place of a joint at a configuration.

    Attributes
    ----------
    point : tuple of 3 floats
        On its axes, any unit of length.
    axes : tuple of tuples of 3 floats
        For a revolute or cylindrical joint its axis, for a prismatic one the direction in which it slides, for a
        planar one the normal, for a universal one the axes that its first and its second link hold; none for a
        spherical one.

    Examples
    --------
    >>> JointPlace((0.0, 0.0, 0.0), ((0.0, 0.0, 1.0),)).axes
    ((0.0, 0.0, 1.0),)
    """

    point: Vector
    axes: tuple[Vector, ...] = ()


@dataclass(frozen=True, slots=True, repr=False)
class JointedLinkage:
    """Links joined by joints of any kind.

    Parameters
    ----------
    chain : SCGraph
        Links and joints. Loops with a finite centre have revolutes only; planar ones, whose centre is infinite,
        may have slides along their plane and planar joints.
    kinds : mapping of joint id to JointKind, or its letter or word
        Joints that are left out are revolutes.
    places : mapping of joint id to JointPlace, optional
        Of all joints, or of none: then it is a type, and stands for its generic realisations. InvariantError if a
        place does not suit the kind of its joint.
    notes : tuple of str, optional
        What a file had that was not read.

    Examples
    --------
    >>> leg = SCGraph(4, {"u": (0, 1), "p": (1, 2), "s": (2, 3)})
    >>> JointedLinkage(leg, {"u": JointKind.UNIVERSAL, "p": "P", "s": "spherical"})
    <JointedLinkage: 4 links, 3 joints: P S U, a type>
    """

    chain: SCGraph
    kinds: Mapping[JointId, JointKind]
    places: Mapping[JointId, JointPlace] = field(default_factory=dict)
    notes: tuple[str, ...] = field(default=(), compare=False)

    def __post_init__(self) -> None:
        for key in (*self.kinds, *self.places):
            if key not in self.chain.joints:
                raise InvariantError("joint", f"{shown(key)} is no joint", "a joint id", ("joints", key))
        kinds = {joint: self.kinds.get(joint, JointKind.REVOLUTE) for joint in self.chain.joints}
        whole = {joint: kind if isinstance(kind, JointKind) else kind_named(kind) for joint, kind in kinds.items()}
        for loop in (*self.chain.loops, *self.chain.closing):
            for joint in loop.joints:
                _check_in_loop(loop, joint, whole[joint])
        places = {joint: _checked(joint, whole[joint], self.places) for joint in whole} if self.places else {}
        check_extent([place.point for place in places.values()])
        object.__setattr__(self, "kinds", MappingProxyType(whole))
        object.__setattr__(self, "places", MappingProxyType(places))

    @property
    def mobility(self) -> int:
        """M by count: freedoms of the joints, less 3 for a loop with a centre and 6 for any other (Kutzbach)."""
        freedoms = sum(kind.freedoms for kind in self.kinds.values())
        return freedoms - 3 * len(self.chain.centred_loops) - 6 * self.chain.spatial_loops

    @property
    def kinds_in_words(self) -> str:
        """The numbers of joints of each kind, in words."""
        numbers = Counter(self.kinds.values())
        return ", ".join(f"{numbers[kind]} {kind.word}" for kind in JointKind if numbers[kind])

    def __reduce__(self) -> tuple[Any, ...]:
        return JointedLinkage, (self.chain, dict(self.kinds), dict(self.places), self.notes)

    def __repr__(self) -> str:
        letters = Counter(kind.value for kind in self.kinds.values())
        kinds = " ".join(letter if n == 1 else f"{n}{letter}" for letter, n in sorted(letters.items()))
        numbers = f"{numbered(len(self.chain), 'link')}, {numbered(len(self.kinds), 'joint')}"
        return f"<JointedLinkage: {numbers}: {kinds}, {'placed' if self.places else 'a type'}>"


@dataclass(frozen=True, slots=True)
class Leg:
    """Joints in a row, binary links between them and a link at either end; of a ring the first is the last."""

    joints: tuple[JointId, ...]
    links: tuple[LinkId, ...]


def legs(chain: SCGraph) -> list[Leg]:
    """Return the rows of joints that binary links make: each joint is in one; the ground ends rows."""
    at: dict[LinkId, list[JointId]] = {link: [] for link in chain.nodes}
    for joint, ends in chain.joints.items():
        for link in ends:
            at[link].append(joint)
    inside = {link for link, joints in at.items() if len(joints) == 2 and link != chain.ground}
    passed: set[JointId] = set()
    rows = []
    for link in sorted(at, key=inside.__contains__):  # rings of binary links come last
        for joint in at[link]:
            if joint in passed or (link in inside and set(at[link]) & passed):
                continue
            rows.append(_walked(chain, at, inside, (link, joint)))
            passed.update(rows[-1].joints)
    return rows


def _walked(
    chain: SCGraph, at: Mapping[LinkId, Sequence[JointId]], inside: set[LinkId], start: tuple[LinkId, JointId]
) -> Leg:
    link, joint = start
    joints, links = [joint], [link]
    while True:
        a, b = chain.joints[joint]
        link = b if a == link else a
        links.append(link)
        if link not in inside or link == links[0]:
            return Leg(tuple(joints), tuple(links))
        first, second = at[link]
        joint = second if first == joint else first
        joints.append(joint)


def _check_in_loop(loop: Loop, joint: JointId, kind: JointKind) -> None:
    """Raise InvariantError for a joint that loops with such a centre cannot have."""
    if loop.centre is Centre.INFINITE:
        suits, where, expected = kind.planar, "is planar", "a revolute, a slide or a planar joint"
    else:
        suits, where, expected = kind is JointKind.REVOLUTE, "has a finite centre", "a revolute"
    if loop.has_centre and not suits:
        wrong = f"joint {shown(joint)} of {loop.label}, which {where}, is {kind.word}"
        raise InvariantError("kinds", wrong, expected, ("joints", joint))


def _checked(joint: JointId, kind: JointKind, places: Mapping[JointId, JointPlace]) -> JointPlace:
    part = ("joints", joint)
    if joint not in places:
        wrong = f"joint {shown(joint)} has no place"
        raise InvariantError("place", wrong, "one for each joint, or for none", part)
    place = places[joint]
    if len(place.axes) != kind.axes:
        wrong = f"{kind.word} joint {shown(joint)} has {numbered(len(place.axes), 'axis', 'axes')}"
        raise InvariantError("place", wrong, str(kind.axes), part)
    vectors = tuple(_vector(joint, vector) for vector in (place.point, *place.axes))
    for axis in vectors[1:]:
        if not LEAST <= hypot(*axis) <= MOST:
            wrong = f"an axis of joint {shown(joint)} is {shown(list(axis))}"
            raise InvariantError("place", wrong, "a vector that is not zero", part)
    if kind is JointKind.UNIVERSAL:
        one, other = vectors[1:]
        cosine = sum(x * y for x, y in zip(one, other, strict=True)) / hypot(*one) / hypot(*other)
        if abs(cosine) > _RIGHT:
            wrong = f"the axes of universal joint {shown(joint)} have a cosine of {cosine:.1e}"
            raise InvariantError("place", wrong, "a right angle", part)
    return JointPlace(vectors[0], vectors[1:])


def _vector(joint: JointId, numbers: Sequence[float]) -> Vector:
    if len(numbers) != 3 or not in_reach(numbers):
        wrong = f"the place of joint {shown(joint)} has {shown(list(numbers))}"
        raise InvariantError("place", wrong, f"three numbers, none beyond {MOST:g}", ("joints", joint))
    x, y, z = map(float, numbers)
    return x, y, z
