"""Links and joints by the names that people type: an id, a number, a pair of links; near names for a wrong one."""

from collections.abc import Hashable, Iterable
from difflib import get_close_matches

from graphs.errors import InvariantError, shown
from graphs.mechanism.sc import SCGraph
from graphs.types import JointId, LinkId

_MOST = 12  # names listed in a message: enough to see how they look, and a line or two


def known(names: Iterable[Hashable], unknown: str) -> str:
    """List the known names for a message about an unknown one, and the nearest unless that is a number."""
    every = list(names)
    if not every:
        return "there is none"
    listed = ", ".join(map(shown, every[:_MOST])) + (f", ... ({len(every)})" if len(every) > _MOST else "")
    near = [] if unknown.isdigit() else get_close_matches(unknown[:100], map(str, every), 1)
    nearest = next((shown(name) for name in every if near and str(name) == near[0]), None)
    return f"one of {listed}" + (f"; the nearest is {nearest}" if nearest is not None else "")


def link_named(sc: SCGraph, name: str) -> LinkId:
    """Return the link whose name has this text.

    Parameters
    ----------
    sc : SCGraph
    name : str
        InvariantError if no link has it.

    Examples
    --------
    >>> link_named(SCGraph(["A", 7], {"j": ("A", 7)}), "7")
    7
    """
    return _named(list(sc.nodes), name, "link")


def joint_named(sc: SCGraph, name: str) -> JointId:
    """Return the joint whose id has this text; else by its number in the list, else the one between two links.

    Parameters
    ----------
    sc : SCGraph
    name : str
        Such as ``3``, ``hinge``, or ``A,B``. A number in the list is one only if ids are not numbers themselves.
        InvariantError if there is no such joint, or there are several between the links.

    Examples
    --------
    >>> chain = SCGraph(["A", "B", "C"], {"j": ("A", "B"), "k": ("B", "C")})
    >>> joint_named(chain, "k"), joint_named(chain, "0"), joint_named(chain, "B,C")
    ('k', 'j', 'k')
    """
    for joint in sc.joints:
        if str(joint) == name:
            return joint
    numbered = any(isinstance(joint, int) for joint in sc.joints)
    if not numbered and name.isascii() and name.isdigit() and len(name) < 10 and int(name) < len(sc.joints):
        return list(sc.joints)[int(name)]
    first, comma, second = (word.strip() for word in name.partition(","))
    if not comma:
        return _named(sc.joints, name, "joint")
    a, b = link_named(sc, first), link_named(sc, second)
    between: list[Hashable] = list(sc[a][b]) if sc.has_edge(a, b) else []
    if len(between) == 1:
        return next(iter(between))
    pair = f"{shown(a)} and {shown(b)}"
    if between:
        joints = ", ".join(map(shown, between))
        raise InvariantError("joint", f"{len(between)} joints join {pair}", f"one of {joints}")
    here = ", ".join(shown(other) for other in list(sc[a])[:_MOST])
    raise InvariantError("joint", f"no joint joins {pair}", f"a link beside {shown(a)}: {here or 'it has none'}")


def _named(names: Iterable[Hashable], name: str, kind: str) -> Hashable:
    every = list(names)
    if name not in map(str, every):
        raise InvariantError(kind, f"{shown(name)} is no {kind}", known(every, name))
    return next(candidate for candidate in every if str(candidate) == name)
