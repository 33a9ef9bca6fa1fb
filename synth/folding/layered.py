"""Layer orders at the configuration of a crease pattern. Theory: docs/theory/layer-orders.md."""

from pathlib import Path

from graphs.errors import check_argument
from graphs.files.accepted import mechanism_for
from graphs.mechanism.sheet import Sheet
from synth.folding.configuration import SheetConfiguration, configuration_of_sheet
from synth.layering.counting.settling import counted
from synth.layering.space.orders import LayersInSpace, layers_in_space


def layers_at(
    mechanism: Sheet | SheetConfiguration | str | Path, *, frame: int | None = None, precision: float | None = None
) -> LayersInSpace:
    """Return the layer orders of a crease pattern at the configuration of its coordinates.

    Where panels lie on each other, a layer order says which one is on top; elsewhere there is nothing to order. Seen
    along a segment, the paper goes from one plane to another without passing through itself.

    Parameters
    ----------
    mechanism : Sheet, SheetConfiguration, or the path of a file
    frame : int, optional
        The frame of the file; 0 is the key frame.
    precision : float, optional
        The error of a coordinate, in its unit, as for `synth.mobility`.

    Returns
    -------
    LayersInSpace
        `orders` is their number: 1 where no panels lie on each other, 0 where every order has the paper pass through
        itself.

    Raises
    ------
    UnsolvableError
        If the sheet has no coordinates, or its loops are not closed.

    Examples
    --------
    A strip of three squares, both creases folded by 180 degrees as valleys: the outer squares are in one place.

    >>> from math import pi
    >>> corners = ((0, 0, 0), (1, 0, 0), (0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0), (0, 1, 0), (1, 1, 0))
    >>> faces = ((0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6))
    >>> strip = Sheet(8, ((1, 5), (2, 6)), "VV", faces, corners, fold_angles=(pi, pi))
    >>> layers_at(strip).orders
    2
    """
    check_argument("layers_at", mechanism, Sheet | SheetConfiguration | str | Path)
    if isinstance(mechanism, SheetConfiguration):
        at = mechanism
    else:
        sheet = mechanism_for("layers_at", mechanism, Sheet)
        assert isinstance(sheet, Sheet)
        at = configuration_of_sheet(sheet, frame=frame, precision=precision, mend=False)
    return layers_in_space(at.posed(), lambda problems: list(map(counted, problems)))
