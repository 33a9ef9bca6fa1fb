"""The template of a linkage on a cone or a cylinder.

Theory: docs/theory/templates.md.
"""

from __future__ import annotations

from math import cos, degrees

import numpy as np

from graphs.errors import UnsolvableError, numbered
from synth.conformed.layers import links_in_layers
from synth.conformed.linkages import OnCone
from synth.conformed.rates import ConformedChain
from synth.drawing.on_cone import cone_layer
from synth.drawing.scene.shapes import Scene
from synth.templates.developed.cut_out import flat_pieces
from synth.templates.developed.layered import Dimensions, Joining, LayeredLinkage, layered
from synth.templates.developed.surfaces import Cone, Cylinder, Surface
from synth.templates.template import Template

__all__ = ["surface_of", "template_on_surface"]

_SIDE = 420.0
"""Points of the side of the picture."""


def surface_of(linkage: OnCone, radius: float | None = None) -> Surface:
    """Return the cone of a linkage, or a cylinder of a radius in millimetres.

    A linkage given by its azimuths fits every cone and cylinder. Raise UnsolvableError without a cone angle or a
    radius.
    """
    if radius is not None:
        return Cylinder(radius)
    if linkage.cone_angle is None:
        raise UnsolvableError("the linkage lies on any cone: expected a cone angle (--lambda) or a --radius")
    return Cone(linkage.cone_angle)


def template_on_surface(
    linkage: OnCone, surface: Surface, dimensions: Dimensions | None = None, title: str = ""
) -> Template:
    """Return the template of a linkage on a cone or a cylinder: the surface, and each link as a piece.

    Raise UnsolvableError if two joints are on one ruling line, or a link has one joint only.
    """
    made = layered(linkage, surface, dimensions or Dimensions())
    picture = _picture(linkage, surface)
    steps = _steps(made)
    if picture is not None:
        steps.append(
            "It then lies as below; the picture puts layers beside each other, so that none hides another."
        )
    return Template(tuple(flat_pieces(made)), None, linkage, title, (), tuple(steps), picture)


def _picture(linkage: OnCone, surface: Surface) -> Scene | None:
    if not isinstance(surface, Cone):
        return None
    chain, places = ConformedChain.of(linkage.chain), np.asarray(linkage.places, dtype=float)
    layer = cone_layer(chain, places, links_in_layers(chain, places), surface.angle, _SIDE)
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
