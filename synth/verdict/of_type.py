"""The verdict on what has no coordinates, or was not followed: by rank at the pose, by rank of the type, by count.

Theory: docs/theory/verdict.md.
"""

from __future__ import annotations

from graphs.answer.report import MobilityAnswer
from synth.motion.branches import Certainty
from synth.verdict.verdict import Verdict
from synth.verdict.words import in_words

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
    A generic realisation has 1 degree of freedom (exact rank).
    """
    pose, exact = answer.pose, answer.exact
    if pose is not None and pose.dof is not None and pose.self_stresses == 0:
        return Verdict(pose.dof, "pose", "proved", _at_configuration(pose.dof))
    special = pose is not None and pose.self_stresses != 0  # what holds in general says nothing of this one
    end = f"; {left_out}" if left_out else ""
    if exact is not None:
        certainty: Certainty = "proved" if exact.mobility == answer.mobility else "numerical"
        how = "exact rank" if certainty == "proved" else "exact rank of random realisations, modulo two primes"
        freedoms = None if special else exact.mobility
        return Verdict(freedoms, "generic", certainty, _generic(exact.mobility, how, end))
    if (member := answer.counts.get("general_member")) is not None:  # of joints of all kinds
        return Verdict(member, "generic", "numerical", _generic(member, "rank of a random realisation", end))
    if answer.mobility is None:
        return Verdict(None, "count", "not known", f"Mobility unknown{end}.")
    freedoms = None if special else max(answer.mobility, 0)
    return Verdict(freedoms, "count", "not known", _generic(answer.mobility, "by count", end))


def _at_configuration(freedoms: int) -> str:
    return f"Mobile from this configuration: {in_words(freedoms)}." if freedoms else "Rigid."


def _generic(freedoms: int, how: str, end: str) -> str:
    if freedoms <= 0:
        count = f", M = {freedoms}" if freedoms < 0 else ""
        return f"A generic realisation is rigid ({how}{count}){end}."
    return f"A generic realisation has {in_words(freedoms)} ({how}){end}."
