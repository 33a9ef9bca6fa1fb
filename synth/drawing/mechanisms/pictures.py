"""One picture of any mechanism: which kind suits it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from types import MappingProxyType
from typing import Any, TypeAlias

import networkx as nx

from enumerate.strings.panel_strings import ChainString
from graphs.convert.table import Mechanism, graph_of, to_sc, to_solids
from graphs.errors import InvariantError, UnsolvableError, check_argument, numbered, shown
from graphs.joints.linkage import JointedLinkage
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.precision import lies_flat
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.mechanism.surfaces import SurfaceLinkage
from synth.drawing.mechanisms.chains import ChainLook, chain_scene
from synth.drawing.mechanisms.creases import COLOURINGS, crease_scene
from synth.drawing.mechanisms.marks import overlay_of_marks
from synth.drawing.mechanisms.orders import OrderOnCircle, order_of_linkage, order_scene
from synth.drawing.mechanisms.repairs import overlay_of_repairs
from synth.drawing.mechanisms.sc_graphs import sc_scene
from synth.drawing.mechanisms.space import folded_scene, model_scene, solids_scene
from synth.drawing.mechanisms.strips import strip_scene
from synth.drawing.scene.frame import COLUMN
from synth.drawing.scene.shapes import Scene
from synth.folding.configuration import SheetConfiguration
from synth.guidance.orientations import Orientations
from synth.motion.configuration import Configuration

__all__ = ["COLOURINGS", "KINDS", "Drawable", "Look", "draw"]


Drawable: TypeAlias = Configuration | Mechanism | Orientations | ChainString | OrderOnCircle | nx.Graph

_SMALL = 200.0
"""Points of width and height below which a chain has smaller joints, without numbers."""


@dataclass(frozen=True, slots=True)
class Look:
    """What a picture shows; at most as large as `box`, (width, height) in points.

    `colour` is one of `COLOURINGS`; `branch` goes with ``colour="branch"``: its number or its signs, or None for
    the one that agrees best with the assignment. `numbers` are those of links and joints; `graph` puts the SC
    graph over a crease pattern. `caption` is the first line below the picture; with None there are none.
    """

    colour: str = "letters"
    branch: int | str | None = None
    numbers: bool = True
    graph: bool = False
    box: tuple[float, float] = (COLUMN, COLUMN)
    caption: str | None = ""


def draw(thing: Drawable, kind: str | None = None, **look: Any) -> Scene:
    """Return a picture of a mechanism.

    Parameters
    ----------
    thing : Mechanism, Configuration, Orientations, ChainString, OrderOnCircle or networkx graph
        What a file may hold, or where that moves from; a string; an order of joints round a cone; a plain
        link-joint graph.
    kind : {"pattern", "marks", "repairs", "folded", "chain", "graph", "model", "solids", "cone", ...}, optional
        One of `KINDS`. A crease pattern in its plane, with the creases whose assignment disagrees with a branch,
        or with what was repaired when it was read; a folded sheet in space, links as bodies, links as discs with
        the signs of the centres, vertices and rods, solids in space, a linkage on its circle and surface, the
        order of joints round a cone, the sphere by the order of orientations. Without it what suits the thing: a
        sheet is a pattern or folded, as it lies; a graph whose centres nobody gave is a chain.
    **look
        Fields of `Look`: ``colour``, ``branch``, ``numbers``, ``graph``, ``box``, ``caption``.

    Returns
    -------
    Scene
        A notebook shows it; `synth.drawing.save_scene` writes it.

    Raises
    ------
    InvariantError
        If the kind or the colouring is not known.
    UnsolvableError
        If the thing cannot be drawn so, or is to be drawn otherwise than as a pattern and in colours of one.

    Examples
    --------
    >>> from graphs.files.formats import read
    >>> [layer.name for layer in draw(read("k1:Cr")).layers]
    ['links', 'joints', 'labels', 'caption']
    """
    check_argument("draw", thing, Drawable)
    if isinstance(thing, Configuration) and not isinstance(thing, SheetConfiguration):
        thing = thing.given
    kind = _suiting(thing) if kind is None else kind
    if kind not in KINDS:
        raise InvariantError("kind", f"the kind {shown(kind)} is not known", ", ".join(KINDS))
    how = Look(**look)
    branched = how.branch is not None and kind != "marks"
    if kind != "pattern" and (how.colour != "letters" or branched or how.graph):
        raise UnsolvableError(
            f"colourings, branches and the graph over it are of a pattern; this is drawn as {kind}"
        )
    if isinstance(thing, ChainString):
        return strip_scene(thing, box=how.box, caption=how.caption)
    return KINDS[kind](thing, how)


def _suiting(thing: object) -> str:
    """Return the kind of picture that suits a thing."""
    if isinstance(thing, SheetConfiguration):
        thing = thing.drawn
    if isinstance(thing, Sheet):
        if thing.coordinates is None:
            return "graph"
        return "pattern" if lies_flat(thing) else "folded"
    if isinstance(thing, PolyhedronModel):
        return "model"
    if isinstance(thing, HingedSolids) or (isinstance(thing, JointedLinkage) and thing.places):
        return "solids"
    if isinstance(thing, SCDGraph):
        return "graph"
    if isinstance(thing, Orientations):
        return "sphere"
    if isinstance(thing, OrderOnCircle) or (isinstance(thing, SurfaceLinkage) and thing.steps is not None):
        return "circle"
    assumed = getattr(thing, "centres_assumed", isinstance(thing, nx.Graph))
    return "chain" if assumed else "graph"


def _pattern(thing: Any, look: Look) -> Scene:
    return crease_scene(
        _sheet(thing),
        colour=look.colour,
        branch=look.branch,
        numbers=look.numbers,
        graph=look.graph,
        box=look.box,
        caption=look.caption,
    )


def _marks(thing: Any, look: Look) -> Scene:
    overlay = overlay_of_marks(_sheet(thing), look.branch)
    return crease_scene(_sheet(thing), numbers=look.numbers, box=look.box, caption=look.caption, overlay=overlay)


def _repairs(thing: Any, look: Look) -> Scene:
    sheet = _sheet(thing)
    overlay = overlay_of_repairs(sheet.drawn if isinstance(sheet, SheetConfiguration) else sheet)
    return crease_scene(sheet, numbers=False, box=look.box, caption=look.caption, overlay=overlay)


def _folded(thing: Any, look: Look) -> Scene:
    return folded_scene(_sheet(thing), numbers=look.numbers, box=look.box, caption=look.caption)


def _chain(thing: Any, look: Look) -> Scene:
    how = ChainLook(look.numbers, look.numbers)
    if min(look.box) < _SMALL:
        how = ChainLook(look.numbers, False, size=5.0, dot=1.6)
    return chain_scene(_graph_of(thing), look=how, box=look.box, caption=look.caption)


def _sc_graph(thing: Any, look: Look) -> Scene:
    scene_of = thing if isinstance(thing, SCDGraph) else _graph_of(thing)
    return sc_scene(scene_of, box=look.box, caption=look.caption)


def _surface(kind: str, thing: Any, look: Look) -> Scene:
    """Return a linkage on the first of its cones or cylinders, or say that it has none."""
    if not isinstance(thing, SurfaceLinkage) or thing.kind != kind:
        raise UnsolvableError(
            f"only a linkage given by its links, or angles round a {kind}, can be drawn so, and this is {thing!r}"
        )
    if min(look.box) < _SMALL:
        raise UnsolvableError(f"a linkage on its {kind} needs a picture of its own: of many, chains can be drawn")
    from synth.conformed.linkages import linkage_on_surfaces
    from synth.conformed.rates import ConformedChain
    from synth.drawing.conformed import draw_conformed

    found = linkage_on_surfaces(thing)
    if not found or found[0].surface is None:
        raise UnsolvableError(f"the linkage closes on no {kind}, or on any; its chain can be drawn (--as chain)")
    chain = ConformedChain.of(thing.chain, thing.chain.ground)
    title = look.caption or f"first of {numbered(len(found), kind)}"
    return draw_conformed(chain, found[0].places, found[0].surface, title)


def _solids(thing: Any, look: Look) -> Scene:
    if isinstance(thing, JointedLinkage):
        thing = to_solids(thing)
    if not isinstance(thing, HingedSolids):
        raise UnsolvableError(f"only solids hinged at edges can be drawn so, and this is {thing!r}")
    return solids_scene(thing, numbers=look.numbers, box=look.box, caption=look.caption)


def _circle(thing: Any, look: Look) -> Scene:
    if isinstance(thing, SurfaceLinkage) and thing.steps is not None:
        thing = order_of_linkage(thing)
    if not isinstance(thing, OrderOnCircle):
        raise UnsolvableError(f"only joints in their order round a cone can be drawn so, and this is {thing!r}")
    return order_scene(thing, numbers=look.numbers, box=look.box, caption=look.caption)


def _sphere(thing: Any, look: Look) -> Scene:
    if not isinstance(thing, Orientations):
        raise UnsolvableError(f"only orientations of a body can be drawn so, and this is {thing!r}")
    from synth.drawing.order_map import draw_map

    return draw_map(thing)


def _graph_of(thing: Any) -> Any:
    if isinstance(thing, SurfaceLinkage | OrderOnCircle):
        return thing.chain
    return to_sc(thing) if isinstance(thing, Sheet) else graph_of(thing)


def _model(thing: Any, look: Look) -> Scene:
    if not isinstance(thing, PolyhedronModel):
        from graphs.convert.table import to_polyhedron

        thing = to_polyhedron(thing)
    return model_scene(thing, box=look.box, caption=look.caption)


def _sheet(thing: object) -> Sheet | SheetConfiguration:
    if not isinstance(thing, Sheet | SheetConfiguration):
        raise UnsolvableError(f"only a crease pattern or a folded sheet can be drawn so, and this is {thing!r}")
    return thing


KINDS: Mapping[str, Callable[[Any, Look], Scene]] = MappingProxyType(
    {
        "pattern": _pattern,
        "marks": _marks,
        "repairs": _repairs,
        "folded": _folded,
        "chain": _chain,
        "graph": _sc_graph,
        "model": _model,
        "solids": _solids,
        "cone": partial(_surface, "cone"),
        "cylinder": partial(_surface, "cylinder"),
        "circle": _circle,
        "sphere": _sphere,
    }
)
"""Name of a kind of picture to what makes it."""
