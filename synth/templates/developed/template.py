"""The template of a linkage on a cone or a cylinder.

Theory: docs/theory/templates.md.
"""

from __future__ import annotations

from math import cos, degrees

import numpy as np

from graphs.errors import UnsolvableError, numbered
from graphs.mechanism.surfaces import Cone, Cylinder, Surface
from synth.conformed.all_angles import links_in_layers
from synth.conformed.linkages import OnSurface
from synth.conformed.rates import ConformedChain
from synth.drawing.on_surface import surface_layer
from synth.drawing.scene.shapes import Scene
from synth.templates.developed.cut_out import flat_pieces
from synth.templates.developed.layered import Dimensions, Joining, LayeredLinkage, layered
from synth.templates.template import Template

__all__ = ["surface_of", "template_on_surface"]

_SIDE = 420.0
"""Points of the side of the picture."""


def surface_of(linkage: OnSurface, radius: float | None = None) -> Surface:
    """Return the surface of a linkage, or a cylinder of a radius; a template takes it for millimetres.

    A linkage given by its azimuths fits every cone and cylinder. Raise UnsolvableError without a surface or a
    radius.
    """
    if radius is not None:
        return Cylinder(radius)
    if linkage.surface is None:
        raise UnsolvableError("the linkage lies on any cone: expected a cone angle (--lambda) or a --radius")
    return linkage.surface


def template_on_surface(
    linkage: OnSurface, surface: Surface, dimensions: Dimensions | None = None, title: str = ""
) -> Template:
    """Return the template of a linkage on a cone or a cylinder: the surface, and each link as a piece.

    Raise UnsolvableError if two joints are on one ruling line, or a link has one joint only.
    """
    made = layered(linkage, surface, dimensions or Dimensions())
    picture = _picture(linkage, surface)
    below = "It then lies as below; the picture puts layers beside each other, so that none hides another."
    steps = [*_steps(made), below]
    return Template(tuple(flat_pieces(made)), None, linkage, title, (), tuple(steps), picture)


def _picture(linkage: OnSurface, surface: Surface) -> Scene:
    chain, places = ConformedChain.of(linkage.chain), np.asarray(linkage.places, dtype=float)
    layer = surface_layer(chain, places, links_in_layers(chain, places, linkage.begins(chain)), surface, _SIDE)
    return Scene(_SIDE, _SIDE, (layer,))


def _steps(linkage: LayeredLinkage) -> list[str]:
    """Return how a linkage on a surface is put together."""
    count = 1 + max(link.layer for link in linkage.links)
    surface = linkage.surface
    if isinstance(surface, Cone):
        sector = 360 * cos(surface.angle)
        rolled = (
            f"a sector of {sector:.4g} degrees, as a cone; its ruling lines stand {degrees(surface.angle):.4g} "
        )
        rolled += "degrees off the plane across its axis"
    else:
        rolled = f"as a cylinder of radius {surface.radius:.4g} mm"
    steps = [
        f"Cut out {numbered(len(linkage.links) + 1, 'piece')} along the black lines, slots too. You see their "
        "outside.",
        f"Roll the surface, {rolled}; glue its seam.",
        f"Lay the links on it in {numbered(count, 'layer')}, layer 0 first, each along the lines of its joints.",
    ]
    return [*steps, *(_step_of_joint(linkage, one) for one in linkage.joinings)]


def _step_of_joint(linkage: LayeredLinkage, joining: Joining) -> str:
    tabbed, other = (linkage.links[number] for number in (joining.tabbed, joining.other))
    through = [link.name for link in linkage.links if joining.joint in dict(link.slots)]
    way = f", through the slot of {', '.join(through)}" if through else ""
    if not joining.side:
        return (
            f"Joint {joining.joint}: sew {tabbed.name} and {other.name} together along the line{way}; "
            "neither ends there."
        )
    back = "fold its tab back and glue it" if joining.folded else "glue its tab, the fold is the hinge,"
    face = "outside" if tabbed.layer > other.layer else "inside"
    return f"Joint {joining.joint}: of {tabbed.name} {back} to the {face} of {other.name}{way}."
