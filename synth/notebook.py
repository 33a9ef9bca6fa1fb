"""Mechanisms in notebooks: each shows itself as a picture.

Answers know their own tables and say so themselves. Mechanisms are in ``graphs``, which does not know how to draw,
and pictures do not know how they are written; here IPython is told, by the names of classes, so that nothing is
imported before its time.
"""

from __future__ import annotations

import sys
from typing import Any

__all__ = ["load_ipython_extension", "picture_of", "show_in_this_notebook"]

_SHOWN = {
    "graphs.mechanism.sc": "SCGraph",
    "graphs.mechanism.sheet": "Sheet",
    "graphs.mechanism.polyhedron": "PolyhedronModel",
    "graphs.mechanism.solids": "HingedSolids",
    "graphs.mechanism.surfaces": "SurfaceLinkage",
    "graphs.joints.linkage": "JointedLinkage",
    "graphs.mechanism.vertex_edge": "VertexEdgeGraph",
    "enumerate.strings.panel_strings": "ChainString",
    "synth.guidance.orientations": "Orientations",
    "synth.drawing.scene.shapes": "Scene",
}
"""Module to class; what inherits from one is shown too."""


def show_in_this_notebook() -> None:
    """Let mechanisms show themselves, if this is IPython.

    Examples
    --------
    Elsewhere it does nothing:

    >>> show_in_this_notebook()
    """
    shell = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    if shell is not None:
        load_ipython_extension(shell)


def load_ipython_extension(shell: Any) -> None:
    """Let mechanisms show themselves in a shell of IPython: what ``%load_ext synth`` calls.

    ``import synth`` in a notebook does so too.

    Parameters
    ----------
    shell : IPython.core.interactiveshell.InteractiveShell
    """
    formatter = shell.display_formatter.formatters["image/svg+xml"]
    for module, name in _SHOWN.items():
        formatter.for_type_by_name(module, name, picture_of)


def picture_of(thing: Any) -> str | None:
    """Return a picture as SVG, or that of a mechanism; None, for its description, where it cannot be drawn.

    Parameters
    ----------
    thing : object
        A scene, or a mechanism, of a class that the notebook shows.

    Returns
    -------
    str or None

    Examples
    --------
    >>> from graphs.files.ids import mechanism_of_id
    >>> picture_of(mechanism_of_id("k1:Cr"))[:4]
    '<svg'
    """
    from graphs.errors import SynthedraError
    from synth.drawing.mechanisms.pictures import draw
    from synth.drawing.scene.shapes import Scene
    from synth.drawing.scene.svg import svg_text

    try:
        return svg_text(thing if isinstance(thing, Scene) else draw(thing))
    except SynthedraError:
        return None
