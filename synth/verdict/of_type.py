"""The verdict on what has no coordinates, or was not followed: by rank at the pose, by rank of the type, by count.

Theory: docs/theory/verdict.md.
"""

from __future__ import annotations

from graphs.answer.report import MobilityAnswer
from synth.motion.branches import Certainty
from synth.verdict.verdict import Verdict

__all__ = ["verdict_of_type"]


def verdict_of_type(answer: MobilityAnswer, left_out: str = "") -> Verdict:
    """Say what counts and ranks tell about the motion of a mechanism.

    A pose at which all closure equations are independent is a regular one: its rates are motions. Where the exact
    rank of a type is as large as its number of equations it is proved, since no member has more.

    Parameters
    ----------
    answer : MobilityAnswer
    left_out : str, optional
        Why its motion was not looked for.

    Examples
    --------
    >>> import networkx as nx
    >>> from graphs.answer.mechanisms import mobility
    >>> print(verdict_of_type(mobility(nx.cycle_graph(4))))
    In general position it moves with 1 freedom (exact rank).
    """
    pose, exact = answer.pose, answer.exact
    if pose is not None and pose.dof is not None and pose.self_stresses == 0:
        return Verdict(pose.dof, "pose", "proved", _as_it_lies(pose.dof))
    end = f"; {left_out}" if left_out else ""
    if exact is not None:
        certainty: Certainty = "proved" if exact.mobility == answer.mobility else "numerical"
        how = "exact rank" if certainty == "proved" else "exact rank of random members, modulo two primes"
        return Verdict(exact.mobility, "generic", certainty, _in_general(exact.mobility, how, end))
    if answer.mobility is None:
        return Verdict(None, "count", "not known", f"Not known how it moves{end}.")
    return Verdict(max(answer.mobility, 0), "count", "not known", _in_general(answer.mobility, "by count", end))


def _as_it_lies(freedoms: int) -> str:
    if not freedoms:
        return "Rigid: nothing moves."
    return f"Moves with {_freedoms(freedoms)} from its pose."


def _in_general(freedoms: int, how: str, end: str) -> str:
    if freedoms <= 0:
        count = f", M = {freedoms}" if freedoms < 0 else ""
        return f"In general position it is rigid ({how}{count}){end}."
    return f"In general position it moves with {_freedoms(freedoms)} ({how}){end}."


def _freedoms(number: int) -> str:
    return f"{number} freedom" if number == 1 else f"{number} freedoms"
