"""A task: roles of bodies, what a type must be like, and wishes in which bodies have the names of their roles."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import combinations
from pathlib import Path
from typing import Any, Literal, get_args

from enumerate.runner.job import ANY_NUMBER, ONE_OR_MORE, Limits
from graphs.errors import InvariantError, shown
from graphs.joints.linkage import JointKind

System = Literal["any", "spherical", "planar", "hybrid", "spatial"]
Form = Literal["space", "cone", "sheet"]
Source = Literal["sc", "chains", "scd", "generators"]

ROLES = ("base", "input", "output")
SYSTEMS, FORMS, SOURCES = get_args(System), get_args(Form), get_args(Source)
DEFAULT_SOURCES: Mapping[str, tuple[str, ...]] = {
    "space": ("sc", "chains", "generators"),
    "cone": ("chains",),
    "sheet": ("scd", "generators"),
}
"""Where types come from, for each form, if a task does not say."""
OF_FORM: Mapping[str, tuple[str, ...]] = {
    "space": ("sc", "chains", "generators"),
    "cone": ("sc", "chains"),
    "sheet": ("scd", "generators"),
}
"""Where types of a form can come from."""
LINKS = Limits(4, 6)
"""Numbers of links, if a task does not say."""
_NUMBERS = ("links", "loops", "centres", "symmetry", "open_edges", "explicit_centres", "implicit_centres")
_MOST_LINKS, _MOST_OF_GENERATORS = 12, 100
"""Links of types that are enumerated, and of what generators make."""
_OF_LINKS, _OF_JOINTS = ("link",), ("joint", "joints", "near", "far", "driver", "arcs", "inputs")
"""Keys of wishes under which links and joints are named."""


@dataclass(frozen=True, slots=True)
class RolePair:
    """A requirement about two roles: of their relative mobility, or of the number of joints between them.

    Attributes
    ----------
    roles : (str, str)
    limits : Limits

    Examples
    --------
    >>> print(RolePair(("output", "base"), Limits(1, 1)))
    base and output: 1
    """

    roles: tuple[str, str]
    limits: Limits

    def __post_init__(self) -> None:
        if len(set(self.roles)) != 2:
            raise InvariantError("roles", f"the pair {' and '.join(self.roles)}", "two different roles")
        object.__setattr__(self, "roles", tuple(sorted(self.roles)))

    def __str__(self) -> str:
        return f"{' and '.join(self.roles)}: {limits_text(self.limits)}"


def limits_text(limits: Limits) -> str:
    """Return limits in words.

    >>> limits_text(Limits(2, 2)), limits_text(Limits(1)), limits_text(Limits(0, 3))
    ('2', 'at least 1', 'at most 3')
    """
    if limits.most is None:
        return f"at least {limits.least}"
    if limits.least == limits.most:
        return str(limits.least)
    return f"{limits.least} to {limits.most}" if limits.least else f"at most {limits.most}"


def centres_text(limits: Limits, kind: str) -> str:
    """Return limits of the number of centres of a kind in words.

    >>> centres_text(Limits(1, 1), "explicit"), centres_text(Limits(0, 0), "implicit")
    ('1 explicit centre', '0 implicit centres')
    """
    return f"{limits_text(limits)} {kind} centre{'' if limits.most == 1 else 's'}"


@dataclass(frozen=True)
class Task:
    """What a mechanism is to do, of whatever type.

    Attributes
    ----------
    roles : tuple of str
        Bodies: ``base``, ``input``, ``output``. A task without roles is about the whole mechanism.
    freedoms : int
        Degrees of freedom.
    links, loops, centres, symmetry : Limits
        Numbers of links, of independent loops, of classes of loops with one centre, of symmetries.
    system : {"any", "spherical", "planar", "hybrid", "spatial"}
        One centre, one at infinity, several, or a loop without any.
    form : {"space", "cone", "sheet"}
        Where the mechanism lies.
    sources : tuple of {"sc", "chains", "scd", "generators"}
        Where types come from; empty: those that suit the form.
    generators : mapping of str to mapping of str to float, optional
        Generators, with values of parameters (counts too); None: all, with their default values.
    joints : tuple of str
        Kinds of joints, by their letters; enumerated types have revolutes.
    spatial, infinite : int, bool
        Loops without a centre of SC graphs, and whether centres may be at infinity.
    open_edges : Limits
        Of SCD graphs.
    explicit_centres, implicit_centres : Limits
        Of sheets: numbers of bounded faces whose centre is a vertex of the links, and of those whose centre the links
        leave open (remote centres). A sheet without implicit centres and spatial loops has no holes.
    mobilities, distances : tuple of RolePair
        Relative mobility of two roles, and the number of joints between them.
    wishes : mapping, optional
        As in a file of wishes (docs/native-json.md), where a link is a role, and a joint two roles with a hyphen
        between them: ``base-input``. Without wishes types are listed, and not designed.
    title : str
    place : Path
        The file, for messages and for the files that wishes name.

    Raises
    ------
    InvariantError
        If it contradicts itself, or its roles cannot be told apart.

    Examples
    --------
    >>> task = Task(links=Limits(4, 6), mobilities=(RolePair(("base", "output"), Limits(1)),))
    >>> task.roles, task.sources
    (('base', 'output'), ('sc', 'chains', 'generators'))
    """

    roles: tuple[str, ...] = ("base", "output")
    freedoms: int = 1
    links: Limits = LINKS
    loops: Limits = ANY_NUMBER
    centres: Limits = ANY_NUMBER
    symmetry: Limits = ONE_OR_MORE
    system: System = "any"
    form: Form = "space"
    sources: tuple[str, ...] = ()
    generators: Mapping[str, Mapping[str, float]] | None = None
    joints: tuple[str, ...] = ("R",)
    spatial: int = 0
    infinite: bool = False
    open_edges: Limits = ANY_NUMBER
    explicit_centres: Limits = ANY_NUMBER
    implicit_centres: Limits = ANY_NUMBER
    mobilities: tuple[RolePair, ...] = ()
    distances: tuple[RolePair, ...] = ()
    wishes: Mapping[str, Any] | None = None
    title: str = ""
    place: Path = field(default=Path("task"), compare=False)

    def __post_init__(self) -> None:
        if not self.sources:
            object.__setattr__(self, "sources", DEFAULT_SOURCES[self.form])
        self._check_structure()
        self._check_roles()

    def _check_structure(self) -> None:
        most = _MOST_OF_GENERATORS if set(self.sources) == {"generators"} else _MOST_LINKS
        if self.links.most is None or self.links.most > most:
            raise InvariantError("links", f"{limits_text(self.links)} links", f"at most {most}", ("links", 0))
        if self.freedoms < 1:
            raise InvariantError("degrees of freedom", str(self.freedoms), "1 or more", ("degrees_of_freedom", 0))
        if self.form == "cone" and self.system not in ("any", "spherical"):
            wrong = f"form cone and system {self.system} exclude each other"
            raise InvariantError(
                "system", wrong, "system spherical: the axes of a cone meet at its apex", ("system", 0)
            )
        for kind in ("explicit", "implicit"):
            name = f"{kind}_centres"
            if self.form != "sheet" and getattr(self, name) != ANY_NUMBER:
                words = centres_text(getattr(self, name), kind)
                expected = "form sheet: whether a centre is a vertex of the links is known of sheets"
                raise InvariantError("form", f"form {self.form} and {words} exclude each other", expected, (name, 0))
        for source in self.sources:
            if source not in OF_FORM[self.form]:
                wrong = f"form {self.form} and types from {source} exclude each other"
                raise InvariantError("types", wrong, "types from " + ", ".join(OF_FORM[self.form]), ("types", 0))
        if not self.joints or not set(self.joints) <= {kind.value for kind in JointKind}:
            letters = ", ".join(kind.value for kind in JointKind)
            raise InvariantError("joints", f"the joints {shown(', '.join(self.joints))}", letters, ("joints", 0))

    def _check_roles(self) -> None:
        for role in self.roles:
            if role not in ROLES or self.roles.count(role) > 1:
                raise InvariantError(
                    "roles", f"the role {shown(role)}", f"each of {', '.join(ROLES)} once", ("roles", 0)
                )
        if self.roles and "base" not in self.roles:
            raise InvariantError("roles", "there is no base", "the role base: bodies move against it", ("roles", 0))
        for pairs, place in ((self.mobilities, "relative_mobility"), (self.distances, "distance")):
            self._check_pairs(pairs, place)
        for number, pair in enumerate(self.mobilities):
            if pair.limits.least > self.freedoms:
                wrong = f"a relative mobility ({pair}) and degrees of freedom: {self.freedoms} exclude each other"
                raise InvariantError("roles", wrong, "no more than the mechanism has", ("relative_mobility", number))
        moving = [role for role in self.roles if role != "base" and role not in self.named_roles]
        for one, other in combinations(moving, 2):
            expected = "a wish, a relative mobility or a distance that names one of them"
            raise InvariantError("roles", f"the task does not distinguish {one} from {other}", expected, ("roles", 0))

    def _check_pairs(self, pairs: tuple[RolePair, ...], place: str) -> None:
        """Refuse pairs of roles that are not there, and two limits for the same pair that exclude each other."""
        for number, pair in enumerate(pairs):
            strange = [role for role in pair.roles if role not in self.roles]
            if strange:
                what = f"the role {shown(strange[0])} is not among the roles"
                raise InvariantError("roles", what, ", ".join(self.roles) or "no roles", (place, number))
            for other in pairs[:number]:
                if other.roles == pair.roles and not _overlap(other.limits, pair.limits):
                    wrong = f"{other} and {pair} exclude each other"
                    raise InvariantError("roles", wrong, "limits that overlap", (place, number))

    @property
    def named_roles(self) -> frozenset[str]:
        """The roles that wishes, relative mobilities and distances name."""
        pairs = {role for pair in (*self.mobilities, *self.distances) for role in pair.roles}
        links = {name for _, kind, name in names_in(self.wishes) if kind == "link"}
        joints = {role for pair in self.joint_roles for role in pair}
        return frozenset(pairs | links | joints)

    @property
    def joint_roles(self) -> tuple[tuple[str, str], ...]:
        """The pairs of roles between which wishes need a joint."""
        found = {tuple(sorted(name.split("-"))) for _, kind, name in names_in(self.wishes) if kind == "joint"}
        return tuple((pair[0], pair[-1]) for pair in sorted(found))

    @property
    def key(self) -> dict[str, Any]:
        """The task in JSON values: what a store is for."""
        return {
            "roles": list(self.roles),
            "freedoms": self.freedoms,
            **{name: _listed(getattr(self, name)) for name in _NUMBERS},
            **{name: getattr(self, name) for name in ("system", "form", "spatial", "infinite")},
            **{name: list(getattr(self, name)) for name in ("sources", "joints")},
            "generators": None if self.generators is None else {k: dict(v) for k, v in self.generators.items()},
            **{
                name: [[*pair.roles, *_listed(pair.limits)] for pair in getattr(self, name)]
                for name in ("mobilities", "distances")
            },
            "wishes": self.wishes,
        }  # fmt: skip


def _listed(limits: Limits) -> list[int | None]:
    return [limits.least, limits.most]


def _overlap(one: Limits, other: Limits) -> bool:
    tops = [limits.most for limits in (one, other) if limits.most is not None]
    return not tops or max(one.least, other.least) <= min(tops)


def names_in(value: Any, place: str = "wishes", key: str = "") -> Iterator[tuple[str, str, str]]:
    """Yield where wishes name links and joints: the place, "link" or "joint", and the name.

    >>> list(names_in({"configurations": [{"inputs": {"base-input": 40}}]}))
    [('wishes.configurations[0].inputs', 'joint', 'base-input')]
    """
    if isinstance(value, Mapping):
        if key == "inputs":
            yield from ((place, "joint", str(name)) for name in value)
            return
        for below, item in value.items():
            yield from names_in(item, f"{place}.{below}", below)
    elif isinstance(value, list | tuple):
        for number, item in enumerate(value):
            yield from names_in(item, f"{place}[{number}]", key)
    elif key in _OF_LINKS:
        yield place, "link", str(value)
    elif key in _OF_JOINTS and value is not None:
        yield place, "joint", str(value)


def renamed(value: Any, links: Mapping[str, str], joints: Mapping[str, str], key: str = "") -> Any:
    """Return wishes with the names of the links and joints of a mechanism in the place of roles.

    >>> renamed({"kind": "angle", "joint": "base-input"}, {}, {"base-input": "3"})
    {'kind': 'angle', 'joint': '3'}
    """
    if isinstance(value, Mapping):
        if key == "inputs":
            return {joints[str(name)]: item for name, item in value.items()}
        return {below: renamed(item, links, joints, below) for below, item in value.items()}
    if isinstance(value, list | tuple):
        return [renamed(item, links, joints, key) for item in value]
    if key in _OF_LINKS:
        return links[str(value)]
    return joints[str(value)] if key in _OF_JOINTS and value is not None else value
