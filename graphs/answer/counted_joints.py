"""The mobility report of a linkage with joints of all kinds: the papers' equations, each joint with its freedoms.

Wiener's Eq. 1 holds the freedoms of each joint; his Eqs. 2 and 3 are for joints of one freedom, Eq. 4 for
revolutes. Wampler's count takes joints of all kinds as vertices, rods, and points on lines and planes
(`graphs.joints.as_points`). Theory: docs/theory/joints.md, docs/theory/mobility-by-count.md.
"""

from __future__ import annotations

from dataclasses import replace

from graphs.count.equations import loop_form, modified_cgk, spherical_system, traditional_cgk
from graphs.count.report import EquationResult, MobilityReport, mechanism_class, mobility_report
from graphs.errors import numbered
from graphs.joints.as_points import points_of, rods_between_balls
from graphs.joints.linkage import JointedLinkage, JointKind

__all__ = ["report_of_joints"]

_ONE = "spherical", "planar", "spatial"


def report_of_joints(linkage: JointedLinkage) -> MobilityReport:
    """Report the mobility of a linkage by count of its joints, each with its freedoms.

    Parameters
    ----------
    linkage : JointedLinkage
        Its loops with a centre count three equations each.

    Examples
    --------
    A slider-crank in space, and in a plane:

    >>> from graphs.loops.loop import Loop
    >>> from graphs.mechanism.sc import SCGraph
    >>> joints = [(0, 1), (1, 2), (2, 3), (3, 0)]
    >>> for loops in ((), (Loop(range(4), "infinite"),)):
    ...     crank = JointedLinkage(SCGraph(4, joints, loops), {3: JointKind.PRISMATIC})
    ...     report_of_joints(crank).equations["traditional_cgk"].value
    -2
    1
    """
    chain = linkage.chain
    kind = mechanism_class(chain)
    freedoms = [one.freedoms for one in linkage.kinds.values()]
    if all(one is JointKind.REVOLUTE for one in linkage.kinds.values()):
        bare = mobility_report(chain)
        return replace(bare, equations={**bare.equations, **_wampler(linkage)})
    closed = chain.is_closed
    looped = loop_form(sum(freedoms), len(chain.centred_loops), chain.spatial_loops)
    equations = {
        **_by_wiener(linkage, kind, freedoms),
        "loop_form": EquationResult(
            looped,
            not closed,
            "leaves out that the closing loop has a centre too"
            if closed
            else "joint freedoms, less 3 for each loop with a centre and 6 for each spatial loop",
        ),
        **_wampler(linkage),
    }
    bare = mobility_report(chain)
    return MobilityReport(
        mechanism_class=kind,
        links=len(chain),
        joints=len(chain.joints),
        loops=chain.independent_loops,
        centres=len(chain.centre_classes()),
        mobility=looped,
        equations=equations,
        counts={**bare.counts, "freedoms": sum(freedoms)},
        arrangement=bare.arrangement,
    )


def _by_wiener(linkage: JointedLinkage, kind: str, freedoms: list[int]) -> dict[str, EquationResult]:
    """Evaluate Wiener's Eqs. 1 to 4; their conditions are those of his Table 6, and the kinds of the joints."""
    chain = linkage.chain
    links, joints = len(chain) - chain.components + 1, len(chain.joints)
    bare = mobility_report(chain).equations
    space = 6 if kind == "spatial" else 3
    first = bare["traditional_cgk"]
    if first.applies:
        why = f"Eq. 1 with constraint space {space} for all loops, and the degrees of freedom of each joint"
        first = EquationResult(traditional_cgk(links, freedoms, space), True, why)
    elif first.value is not None:
        first = replace(first, value=traditional_cgk(links, freedoms, space))
    single = all(one == 1 for one in freedoms)
    many = EquationResult(None, False, "for joints with one degree of freedom; these have more")
    second = replace(bare["modified_cgk"], value=modified_cgk(links, joints, space)) if single else many
    third = replace(bare["spherical_system"], value=spherical_system(links, joints)) if single else many
    if bare["modified_cgk"].value is None and single:
        second = bare["modified_cgk"]
    fourth = EquationResult(None, False, "Eq. 4 is for revolute joints")
    return {"traditional_cgk": first, "modified_cgk": second, "spherical_system": third, "polyhedron": fourth}


def _wampler(linkage: JointedLinkage) -> dict[str, EquationResult]:
    """Evaluate Wampler's count: Eq. 5, or 6 with points on lines and planes, or 7 with remote centres."""
    model = points_of(linkage)
    equations = mobility_report(model).equations
    name = "wampler_eq7" if model.centres else "wampler_eq6" if model.on_line or model.on_plane else "wampler_eq5"
    rods = len(list(rods_between_balls(linkage)))
    spins = f"; {numbered(rods, 'rod')} between spherical joints, whose spin is not counted" if rods else ""
    if linkage.chain.is_closed:
        return {name: replace(equations[name], applies=False, why="a centre for each independent loop only")}
    vertices = f"V {model.free_vertices}, E {model.counted_rods}, P {len(model.on_plane)}, L {len(model.on_line)}"
    return {name: replace(equations[name], why=f"{vertices}, S+3 {len(model.centres)}{spins}")}
