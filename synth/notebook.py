"""Mechanisms in notebooks: each shows itself as a picture.

Answers print their own tables. Mechanisms are in ``graphs``, which cannot draw, and pictures do not know how they
are written; so IPython gets the names of classes here, and nothing is imported before it is needed.
"""

import sys
from typing import Any

__all__ = ["load_ipython_extension"]

_SHOWN = {
    "graphs.mechanism.sc": "SCGraph",
    "graphs.mechanism.sheet": "Sheet",
    "graphs.mechanism.polyhedron": "PolyhedronModel",
    "graphs.mechanism.solids": "HingedSolids",
    "graphs.mechanism.surfaces": "SurfaceLinkage",
    "graphs.joints.linkage": "JointedLinkage",
    "graphs.mechanism.vertex_edge": "VertexEdgeGraph",
    "enumerate.strings.panel_strings": "ChainString",
    "synth.linkages.guidance.orientations": "Orientations",
    "synth.making.drawing.scene.writing": "Scene",
}
"""Module to class; subclasses are shown too."""


def show_in_this_notebook() -> None:
    """Let mechanisms show themselves if this is IPython; elsewhere do nothing."""
    shell = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    if shell is not None:
        load_ipython_extension(shell)


def load_ipython_extension(shell: Any) -> None:
    """Let mechanisms show themselves in a shell of IPython: ``%load_ext synth`` and ``import synth`` call this.

    Parameters
    ----------
    shell : IPython.core.interactiveshell.InteractiveShell

    Examples
    --------
    In a notebook, once, unless it imports synthedra itself::

        %load_ext synth
    """
    formatter = shell.display_formatter.formatters["image/svg+xml"]
    for module, name in _SHOWN.items():
        formatter.for_type_by_name(module, name, picture_of)


def picture_of(thing: Any) -> str | None:
    """Return a scene or a mechanism as SVG; None if it cannot be drawn, so that IPython prints its description.

    >>> from graphs.files.formats import mechanism_of_id
    >>> picture_of(mechanism_of_id("k1:Cr"))[:4]
    '<svg'
    """
    from graphs.errors import SynthedraError
    from synth.making.drawing.mechanisms.pictures import draw
    from synth.making.drawing.scene.writing import Scene, svg_text

    try:
        return svg_text(thing if isinstance(thing, Scene) else draw(thing))
    except SynthedraError:
        return None
