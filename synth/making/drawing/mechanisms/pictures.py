"""One picture of any mechanism, of the kind that suits it."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from types import MappingProxyType
from typing import Any, TypeAlias

import networkx as nx

from enumerate.strings.panel_strings import ChainString
from graphs.convert.conversions import graph_of, kind_in_words, to_polyhedron, to_sc, to_solids
from graphs.errors import InvariantError, UnsolvableError, numbered, shown
from graphs.files.mechanism_like import MechanismLike, mechanism_for
from graphs.joints.linkage import JointedLinkage
from graphs.mechanism.polyhedron import PolyhedronModel
from graphs.mechanism.precision import lies_flat
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Sheet
from graphs.mechanism.solids import HingedSolids
from graphs.mechanism.surfaces import SurfaceLinkage
from synth.analysis.folding.configuration import SheetConfiguration
from synth.analysis.motion.configuration import Configuration
from synth.linkages.conformed.orders import OrderOnCircle
from synth.linkages.guidance.orientations import Orientations
from synth.making.drawing.mechanisms.chains import chain_scene, order_of_linkage, order_scene, strip_scene
from synth.making.drawing.mechanisms.creases import crease_scene, overlay_of_marks, overlay_of_repairs
from synth.making.drawing.mechanisms.sc_graphs import sc_scene
from synth.making.drawing.mechanisms.space import folded_scene, model_scene, solids_scene
from synth.making.drawing.scene.frame import BOX, Box, PictureOptions
from synth.making.drawing.scene.writing import Scene

Drawable: TypeAlias = Configuration | MechanismLike | Orientations | ChainString | OrderOnCircle

_SMALL = 200.0
"""Width or height, points, below which no linkage is drawn on its cone."""


def draw(
    mechanism: Drawable,
    kind: str | None = None,
    *,
    colour: str = "letters",
    branch: int | str | None = None,
    numbers: bool = True,
    graph: bool = False,
    box: Box = BOX,
    caption: str | None = "",
) -> Scene:
    """Return a picture of a mechanism.

    Parameters
    ----------
    mechanism : Mechanism, str, Path, Configuration, Orientations, ChainString, OrderOnCircle or networkx graph
        A mechanism, its file or its configuration, orientations of a body, an R/- string, an order of joints
        around a cone, or a plain link-joint graph.
    kind : {"pattern", "marks", "repairs", "flat-folded", "folded", "chain", "graph", "model", "solids", ...}, optional
        One of `KINDS`: a crease pattern in its plane, with the creases whose assignment disagrees with a branch,
        with repairs made when it was read, or folded flat, in its first layer order; a folded sheet in space; links
        as bodies; links as discs with the signs of the centres; vertices and rods; solids in space; a linkage on
        its circle and surface; the order of joints round a cone; the sphere by the order of orientations. By default
        a sheet is a pattern or folded, as its coordinates are; a graph with assumed centres is a chain.
    colour : {"letters", "verdict", "branch", "centres", "none"}, optional
        Colouring of a crease pattern.
    branch : int or str, optional
        Number or signs of the branch to show, with ``colour="branch"`` or marks; by default the one nearest to
        the assignment.
    numbers : bool, optional
        Write the numbers of links and joints.
    graph : bool, optional
        Draw the SC graph over a crease pattern.
    box : (float, float), optional
        Largest width and height, points.
    caption : str, optional
        First line below the picture; with None there are no lines.

    Returns
    -------
    Scene
        A notebook shows it; its `save` writes it to a file.

    Raises
    ------
    InvariantError
        If the kind or the colouring is unknown.
    UnsolvableError
        If the mechanism has no picture of this kind, or the kind has no colourings.

    Examples
    --------
    >>> [layer.name for layer in draw("k1:Cr").layers]
    ['links', 'joints', 'labels', 'caption']
    """
    drawable: object = mechanism_for("draw", mechanism, Drawable)
    if isinstance(drawable, Configuration) and not isinstance(drawable, SheetConfiguration):
        drawable = drawable.given
    kind = _suiting(drawable) if kind is None else kind
    if kind not in KINDS:
        raise InvariantError("kind", f"unknown kind {shown(kind)}", ", ".join(KINDS))
    if kind != "pattern" and (colour != "letters" or (branch is not None and kind != "marks") or graph):
        raise UnsolvableError(
            f"colourings, branches and the SC graph over it require a picture of kind pattern, not {kind}"
        )
    options = PictureOptions(colour, branch, numbers, graph, box, caption)
    return strip_scene(drawable, options) if isinstance(drawable, ChainString) else KINDS[kind](drawable, options)


def _suiting(drawable: object) -> str:
    """Return the kind of picture that suits a mechanism."""
    if isinstance(drawable, SheetConfiguration):
        drawable = drawable.drawn
    if isinstance(drawable, Sheet):
        if drawable.coordinates is None:
            return "graph"
        return "pattern" if lies_flat(drawable) else "folded"
    if isinstance(drawable, PolyhedronModel):
        return "model"
    if isinstance(drawable, HingedSolids) or (isinstance(drawable, JointedLinkage) and drawable.places):
        return "solids"
    if isinstance(drawable, SCDGraph):
        return "graph"
    if isinstance(drawable, Orientations):
        return "sphere"
    if isinstance(drawable, OrderOnCircle) or (isinstance(drawable, SurfaceLinkage) and drawable.steps is not None):
        return "circle"
    assumed = getattr(drawable, "centres_assumed", isinstance(drawable, nx.Graph))
    return "chain" if assumed else "graph"


def _unfit(kind: str, expected: str, drawable: object) -> UnsolvableError:
    return UnsolvableError(f"a picture of kind {kind} requires {expected}, got: {kind_in_words(drawable)}")


def _sheet(drawable: object, kind: str) -> Sheet | SheetConfiguration:
    if not isinstance(drawable, Sheet | SheetConfiguration):
        raise _unfit(kind, "a crease pattern or a folded sheet", drawable)
    return drawable


def _marks(drawable: object, options: PictureOptions) -> Scene:
    sheet = _sheet(drawable, "marks")
    return crease_scene(sheet, replace(options, branch=None), overlay=overlay_of_marks(sheet, options.branch))


def _repairs(drawable: object, options: PictureOptions) -> Scene:
    sheet = _sheet(drawable, "repairs")
    overlay = overlay_of_repairs(sheet.drawn if isinstance(sheet, SheetConfiguration) else sheet)
    return crease_scene(sheet, replace(options, numbers=False), overlay=overlay)


def _flat_folded(drawable: object, options: PictureOptions) -> Scene:
    from synth.analysis.layering._layers import layers
    from synth.making.drawing.mechanisms.flat_folded import flat_folded_scene

    sheet = _sheet(drawable, "flat-folded")
    answer = layers(sheet.drawn if isinstance(sheet, SheetConfiguration) else sheet)
    if not answer.foldable:
        raise UnsolvableError(f"the pattern does not fold flat: {answer.fault}")
    return flat_folded_scene(answer.order(), options)


def _graph_of(drawable: Any) -> Any:
    if isinstance(drawable, SurfaceLinkage | OrderOnCircle):
        return drawable.chain
    return to_sc(drawable) if isinstance(drawable, Sheet) else graph_of(drawable)


def _solids(drawable: object, options: PictureOptions) -> Scene:
    solids = to_solids(drawable) if isinstance(drawable, JointedLinkage) else drawable
    if not isinstance(solids, HingedSolids):
        raise _unfit("solids", "solids hinged at edges", solids)
    return solids_scene(solids, options)


def _surface(kind: str, drawable: object, options: PictureOptions) -> Scene:
    """Return a linkage on the first of its cones or cylinders."""
    if isinstance(drawable, SurfaceLinkage) and drawable.kind != kind:
        raise UnsolvableError(f"the linkage lies on a {drawable.kind}, not on a {kind}; try --as {drawable.kind}")
    if not isinstance(drawable, SurfaceLinkage):
        raise _unfit(kind, f"a linkage defined by links or angles round a {kind}", drawable)
    if min(options.box) < _SMALL:
        raise UnsolvableError(f"a linkage on its {kind} is too large for a catalogue; try its chain (--as chain)")
    from synth.linkages.conformed.linkage_behaviour import linkage_on_surfaces
    from synth.linkages.conformed.rates import ConformedChain
    from synth.making.drawing.conformed import draw_conformed

    linkages = linkage_on_surfaces(drawable)
    if not linkages or linkages[0].surface is None:
        raise UnsolvableError(f"the linkage closes on no {kind}, or on any; try its chain (--as chain)")
    chain = ConformedChain.of(drawable.chain, drawable.chain.ground)
    several = f"first of {numbered(len(linkages), kind)}" if len(linkages) > 1 else ""
    title = options.caption or several
    return draw_conformed(chain, linkages[0].places, linkages[0].surface, title)


def _circle(drawable: object, options: PictureOptions) -> Scene:
    if isinstance(drawable, SurfaceLinkage) and drawable.steps is not None:
        drawable = order_of_linkage(drawable)
    if not isinstance(drawable, OrderOnCircle):
        raise _unfit("circle", "joints in their order round a cone", drawable)
    return order_scene(drawable, options)


def _sphere(drawable: object, options: PictureOptions) -> Scene:
    if not isinstance(drawable, Orientations):
        raise _unfit("sphere", "orientations of a body", drawable)
    from synth.making.drawing.sphere import draw_map

    return draw_map(drawable)


KINDS: Mapping[str, Callable[[Any, PictureOptions], Scene]] = MappingProxyType(
    {
        "pattern": lambda drawable, options: crease_scene(_sheet(drawable, "pattern"), options),
        "marks": _marks,
        "repairs": _repairs,
        "flat-folded": _flat_folded,
        "folded": lambda drawable, options: folded_scene(_sheet(drawable, "folded"), options),
        "chain": lambda drawable, options: chain_scene(_graph_of(drawable), options),
        "graph": lambda drawable, options: sc_scene(_graph_of(drawable), options),
        "model": lambda drawable, options: model_scene(to_polyhedron(drawable), options),
        "solids": _solids,
        "cone": partial(_surface, "cone"),
        "cylinder": partial(_surface, "cylinder"),
        "circle": _circle,
        "sphere": _sphere,
    }
)
"""Name of a kind of picture to the function that makes it."""
