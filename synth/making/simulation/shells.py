"""Links on a cone or a cylinder as parts of shells, in layers one outside another, so that none lies in another."""

from math import cos, sin

import numpy as np

from graphs.errors import UnsolvableError
from graphs.mechanism.surfaces import Cone, Surface, SurfaceLinkage
from graphs.types import Floats, LinkId
from synth.analysis.motion.linkage import Linkage, placed_links
from synth.analysis.moving._configuration_of import Movable
from synth.linkages.conformed.linkage_behaviour import OnSurface
from synth.linkages.conformed.rates import ConformedChain
from synth.linkages.conformed.rates_over_angles import links_in_layers
from synth.making.simulation.bodies import Shell
from synth.making.templates.template import linkage_on_a_surface

_APART = 3.0
"""Distance of layers in thicknesses, as in templates."""


def shells_of(
    mechanism: Movable | None, linkage: Linkage, angles: Floats, metre: float, thickness: float
) -> dict[LinkId, Shell]:
    """Return the links of a linkage on a surface as shells at joint angles, in metres; none of any other mechanism.

    A link reaches from its first joint to its last, and along the ruling lines as pictures show it; a link with one
    joint has no width, and is left out. `metre` is the extent, `thickness` that of a shell.
    """
    if isinstance(mechanism, SurfaceLinkage):
        mechanism = linkage_on_a_surface(mechanism)
    if not isinstance(mechanism, OnSurface) or mechanism.surface is None:
        return {}
    chain = ConformedChain.of(mechanism.chain)
    laid = links_in_layers(chain, mechanism.places, mechanism.begins(chain))
    unit_length = metre / linkage.extent
    turns, shifts = (part[0] for part in placed_links(linkage, angles[None]))
    numbers = {link: number for number, link in enumerate(linkage.graph.nodes)}
    shells = {}
    for link, layer, (start, width) in zip(chain.links, laid.layers.tolist(), laid.arcs.tolist(), strict=True):
        if width <= 0.0:
            continue
        turn, shift = turns[numbers[link]], shifts[numbers[link]]
        origin = (shift - turn @ (linkage.middle / linkage.extent)) * metre + linkage.middle * unit_length
        profile = _profile(mechanism.surface, layer * _APART * thickness, thickness, unit_length)
        shells[link] = Shell(origin, turn, profile, start, width)
    return shells


def _profile(surface: Surface, height: float, thickness: float, unit_length: float) -> Floats:
    """Return distances from the axis and heights along it, float[4, 2]: the outer side first, counter-clockwise."""
    inner, outer = (unit_length * end for end in surface.spans)
    if isinstance(surface, Cone):
        along, outward = (
            np.array([cos(surface.angle), -sin(surface.angle)]),
            np.array([sin(surface.angle), cos(surface.angle)]),
        )
        base = np.zeros(2)
    else:
        along, outward = np.array([0.0, -1.0]), np.array([1.0, 0.0])
        base = np.array([unit_length * surface.radius, 0.0])
    low, high = height - thickness / 2.0, height + thickness / 2.0
    corners = [(outer, high), (inner, high), (inner, low), (outer, low)]
    profile = np.array([base + up * along + out * outward for up, out in corners])
    if profile[:, 0].min() <= 0.0:
        raise UnsolvableError("links are thicker than the surface is wide; try a smaller thickness")
    return profile
