"""One picture of any mechanism, of the kind that suits it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from types import MappingProxyType
from typing import Any, TypeAlias

import networkx as nx

from enumerate.strings.panel_strings import ChainString
from graphs.convert.table import Mechanism, graph_of, to_polyhedron, to_sc, to_solids
from graphs.errors import InvariantError, UnsolvableError, check_argument, numbered, shown
from graphs.joints.linkage import JointedLinkage
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.precision import lies_flat
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.mechanism.surfaces import SurfaceLinkage
from synth.drawing.mechanisms.chains import (
    ChainLook,
    OrderOnCircle,
    chain_scene,
    order_of_linkage,
    order_scene,
    strip_scene,
)
from synth.drawing.mechanisms.creases import COLOURINGS, crease_scene, overlay_of_marks, overlay_of_repairs
from synth.drawing.mechanisms.sc_graphs import sc_scene
from synth.drawing.mechanisms.space import folded_scene, model_scene, solids_scene
from synth.drawing.scene.frame import BOX, Box
from synth.drawing.scene.writing import Scene
from synth.folding.configuration import SheetConfiguration
from synth.guidance.orientations import Orientations
from synth.motion.configuration import Configuration

__all__ = ["COLOURINGS", "KINDS", "Drawable", "PictureOptions", "draw"]

Drawable: TypeAlias = Configuration | Mechanism | Orientations | ChainString | OrderOnCircle | nx.Graph

_SMALL = 200.0
"""Width or height, points, below which a chain has smaller joints, without numbers."""


@dataclass(frozen=True, slots=True)
class PictureOptions:
    """Options of a picture, which is at most as large as `box`, (width, height) in points.

    `colour` is one of `COLOURINGS`; `branch` goes with ``colour="branch"``: its number or its signs, or None for
    the one nearest to the assignment. `numbers` are those of links and joints; `graph` puts the SC graph over a
    crease pattern. `caption` is the first line below the picture; with None there are none.
    """

    colour: str = "letters"
    branch: int | str | None = None
    numbers: bool = True
    graph: bool = False
    box: Box = BOX
    caption: str | None = ""


def draw(thing: Drawable, kind: str | None = None, **look: Any) -> Scene:
    """Return a picture of a mechanism.

    Parameters
    ----------
    thing : Mechanism, Configuration, Orientations, ChainString, OrderOnCircle or networkx graph
        A mechanism or its configuration, orientations of a body, an R/- string, an order of joints round a cone,
        or a plain link-joint graph.
    kind : {"pattern", "marks", "repairs", "folded", "chain", "graph", "model", "solids", "cone", ...}, optional
        One of `KINDS`: a crease pattern in its plane, with the creases whose assignment disagrees with a branch,
        or with repairs made when it was read; a folded sheet in space; links as bodies; links as discs with the
        signs of the centres; vertices and rods; solids in space; a linkage on its circle and surface; the order of
        joints round a cone; the sphere by the order of orientations. By default a sheet is a pattern or folded, as
        its coordinates are; a graph with assumed centres is a chain.
    **look
        Fields of `PictureOptions`: ``colour``, ``branch``, ``numbers``, ``graph``, ``box``, ``caption``.

    Returns
    -------
    Scene
        A notebook shows it; `synth.drawing.save_scene` writes it.

    Raises
    ------
    InvariantError
        If the kind or the colouring is unknown.
    UnsolvableError
        If the thing has no picture of this kind, or the kind has no colourings.

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
        raise InvariantError("kind", f"unknown kind {shown(kind)}", ", ".join(KINDS))
    how = PictureOptions(**look)
    branched = how.branch is not None and kind != "marks"
    if kind != "pattern" and (how.colour != "letters" or branched or how.graph):
        raise UnsolvableError(
            f"colourings, branches and the SC graph over it require a picture of the kind pattern, not {kind}"
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


def _unfit(kind: str, expected: str, thing: object) -> UnsolvableError:
    return UnsolvableError(f"a picture of the kind {kind} requires {expected}, got {repr(thing).strip('<>')}")


def _sheet(thing: object, kind: str) -> Sheet | SheetConfiguration:
    if not isinstance(thing, Sheet | SheetConfiguration):
        raise _unfit(kind, "a crease pattern or a folded sheet", thing)
    return thing


def _pattern(thing: Any, look: PictureOptions) -> Scene:
    return crease_scene(
        _sheet(thing, "pattern"),
        colour=look.colour,
        branch=look.branch,
        numbers=look.numbers,
        graph=look.graph,
        box=look.box,
        caption=look.caption,
    )


def _marks(thing: Any, look: PictureOptions) -> Scene:
    sheet = _sheet(thing, "marks")
    overlay = overlay_of_marks(sheet, look.branch)
    return crease_scene(sheet, numbers=look.numbers, box=look.box, caption=look.caption, overlay=overlay)


def _repairs(thing: Any, look: PictureOptions) -> Scene:
    sheet = _sheet(thing, "repairs")
    overlay = overlay_of_repairs(sheet.drawn if isinstance(sheet, SheetConfiguration) else sheet)
    return crease_scene(sheet, numbers=False, box=look.box, caption=look.caption, overlay=overlay)


def _folded(thing: Any, look: PictureOptions) -> Scene:
    return folded_scene(_sheet(thing, "folded"), numbers=look.numbers, box=look.box, caption=look.caption)


def _chain(thing: Any, look: PictureOptions) -> Scene:
    how = ChainLook(look.numbers, look.numbers)
    if min(look.box) < _SMALL:
        how = ChainLook(look.numbers, False, size=5.0, dot=1.6)
    return chain_scene(_graph_of(thing), look=how, box=look.box, caption=look.caption)


def _sc_graph(thing: Any, look: PictureOptions) -> Scene:
    graph = thing if isinstance(thing, SCDGraph) else _graph_of(thing)
    return sc_scene(graph, box=look.box, caption=look.caption)


def _graph_of(thing: Any) -> Any:
    if isinstance(thing, SurfaceLinkage | OrderOnCircle):
        return thing.chain
    return to_sc(thing) if isinstance(thing, Sheet) else graph_of(thing)


def _model(thing: Any, look: PictureOptions) -> Scene:
    model = thing if isinstance(thing, PolyhedronModel) else to_polyhedron(thing)
    return model_scene(model, box=look.box, caption=look.caption)


def _solids(thing: Any, look: PictureOptions) -> Scene:
    if isinstance(thing, JointedLinkage):
        thing = to_solids(thing)
    if not isinstance(thing, HingedSolids):
        raise _unfit("solids", "solids hinged at edges", thing)
    return solids_scene(thing, numbers=look.numbers, box=look.box, caption=look.caption)


def _surface(kind: str, thing: Any, look: PictureOptions) -> Scene:
    """Return a linkage on the first of its cones or cylinders."""
    if not isinstance(thing, SurfaceLinkage) or thing.kind != kind:
        raise _unfit(kind, f"a linkage defined by links or angles round a {kind}", thing)
    if min(look.box) < _SMALL:
        raise UnsolvableError(f"a linkage on its {kind} is too large for a catalogue; try its chain (--as chain)")
    from synth.conformed.linkages import linkage_on_surfaces
    from synth.conformed.rates import ConformedChain
    from synth.drawing.conformed import draw_conformed

    linkages = linkage_on_surfaces(thing)
    if not linkages or linkages[0].surface is None:
        raise UnsolvableError(f"the linkage closes on no {kind}, or on any; try its chain (--as chain)")
    chain = ConformedChain.of(thing.chain, thing.chain.ground)
    title = look.caption or f"first of {numbered(len(linkages), kind)}"
    return draw_conformed(chain, linkages[0].places, linkages[0].surface, title)


def _circle(thing: Any, look: PictureOptions) -> Scene:
    if isinstance(thing, SurfaceLinkage) and thing.steps is not None:
        thing = order_of_linkage(thing)
    if not isinstance(thing, OrderOnCircle):
        raise _unfit("circle", "joints in their order round a cone", thing)
    return order_scene(thing, numbers=look.numbers, box=look.box, caption=look.caption)


def _sphere(thing: Any, look: PictureOptions) -> Scene:
    if not isinstance(thing, Orientations):
        raise _unfit("sphere", "orientations of a body", thing)
    from synth.drawing.sphere import draw_map

    return draw_map(thing)


KINDS: Mapping[str, Callable[[Any, PictureOptions], Scene]] = MappingProxyType(
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
"""Name of a kind of picture to the function that makes it."""
