"""The SCD graph of an SC graph where there is only one whose links have so few sides."""

from enumerate.runner._run import total_of
from enumerate.scd.jobs import mechanism_of, scd_count_job, scd_graphs_of
from graphs.errors import UnsolvableError
from graphs.identity.chains import isomorphism
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph


def only_scd_graph(mechanism: SCGraph, max_degree: int) -> SCDGraph:
    """Return the only SCD graph of an SC graph whose links have no more than so many sides, under its own names.

    Parameters
    ----------
    mechanism : SCGraph
    max_degree : int
        The most sides of a link.

    Raises
    ------
    UnsolvableError
        If there is none, or more than one; or as `enumerate.scd.jobs.scd_graphs_of` does.

    Examples
    --------
    >>> from graphs.loops.loop import Loop
    >>> fan = SCGraph("abcd", [("a", "b"), ("b", "c"), ("c", "d"), ("d", "a")], [Loop((0, 1, 2, 3))])
    >>> only_scd_graph(fan, 3).rotation["a"]
    (0, 3, None)
    """
    number = total_of(scd_count_job(mechanism_of(mechanism, max_degree)))  # without making them
    command = f"`synth enumerate scd --of FILE --max-degree {max_degree}`"
    if not number:
        raise UnsolvableError(f"no SCD graph has links of up to {max_degree} sides; try a larger --max-degree")
    if number > 1:
        raise UnsolvableError(f"{number} SCD graphs have links of up to {max_degree} sides; {command} lists them")
    return _named_as(mechanism, next(scd_graphs_of(mechanism, max_degree)))


def _named_as(mechanism: SCGraph, scd: SCDGraph) -> SCDGraph:
    """Return an SCD graph with the names, loops and ground of the SC graph that it draws."""
    plain = SCGraph(mechanism.nodes, mechanism.joints, mechanism.loops, closing=mechanism.closing)
    links, joints = isomorphism(scd.sc_graph(), plain)
    rotation = {
        links[link]: [None if side is None else joints[side] for side in sides] for link, sides in scd.rotation.items()
    }
    outer = None
    if scd.outer is not None:
        joint, side = scd.outer
        turned = links[scd.joints[joint][0]] != mechanism.joints[joints[joint]][0]
        outer = joints[joint], ({"left": "right", "right": "left"}[side] if turned else side)
    return SCDGraph(
        mechanism.nodes,
        mechanism.joints,
        mechanism.loops,
        rotation=rotation,
        outer=outer,
        closing=mechanism.closing,
        ground=mechanism.ground,
        special=mechanism.special,
    )
