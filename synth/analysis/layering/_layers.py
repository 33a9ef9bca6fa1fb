"""What `synth layers` asks: whether a crease pattern folds flat, and in which layer orders."""

from collections.abc import Sequence
from typing import overload

from graphs.answer.mobility import sheet_in_frame
from graphs.files.mechanism_like import MechanismLike, mechanism_for, with_stated_precision
from graphs.mechanism.sheet import Sheet
from synth.analysis.layering.counting.job import LayerCountJob, numbers_of
from synth.analysis.layering.counting.problem import LayerProblem
from synth.analysis.layering.counting.propagation import counted
from synth.analysis.layering.flat_creases import StayingFlat, staying_flat
from synth.analysis.layering.orders import FlatFolding, flat_folding


@overload
def layers(
    mechanism: MechanismLike,
    *,
    frame: int | None = None,
    precision: float | None = None,
    explain: bool = True,
    workers: int = 1,
    may_stay_flat: None = None,
) -> FlatFolding: ...


@overload
def layers(
    mechanism: MechanismLike,
    *,
    frame: int | None = None,
    precision: float | None = None,
    explain: bool = True,
    workers: int = 1,
    may_stay_flat: str | Sequence[int],
) -> StayingFlat: ...


def layers(
    mechanism: MechanismLike,
    *,
    frame: int | None = None,
    precision: float | None = None,
    explain: bool = True,
    workers: int = 1,
    may_stay_flat: str | Sequence[int] | None = None,
) -> FlatFolding | StayingFlat:
    """Return whether a crease pattern folds flat, in how many layer orders, and why not if it does not.

    Every mountain, valley and unassigned crease is folded by 180 degrees; unassigned ones either way. A layer order
    says which panel is on top wherever two overlap, so that the paper passes nowhere through itself.

    Parameters
    ----------
    mechanism : Sheet, or the path of a file
    frame : int, optional
        The frame of the file; 0 is the key frame.
    precision : float, optional
        The error of a coordinate, in its unit, as for `synth.mobility`.
    explain : bool, optional
        If there is no layer order, find panels and conditions that contradict each other, none of which can go.
    workers : int, optional
        Processes that count; 1 counts in this one.
    may_stay_flat : "unassigned", "all", or numbers of creases, optional
        Creases that are folded by 180 degrees either way, or stay flat: the orders of all choices are counted.

    Returns
    -------
    FlatFolding, or StayingFlat with `may_stay_flat`
        `orders` is their number, exactly; `components` are the panels whose order is their own. Each order that it
        returns is checked by geometry alone.

    Raises
    ------
    UnsolvableError
        For a sheet without faces or coordinates, in space, or in several parts.
    InvariantError
        For more pairs of panels than the limit ``pairs`` allows, before they take memory, and for more choices of
        creases that stay flat than the limit ``choices`` allows.

    Notes
    -----
    Sources: M. Bern and B. Hayes, The complexity of flat origami (1996); H. A. Akitaya et al., Box pleating is hard
    (2015); J. Ku, Flat-Folder. Theory: docs/theory/layer-orders.md.

    Examples
    --------
    >>> import synth
    >>> answer = synth.layers("data/patterns/bird-base.fold")
    >>> answer.foldable
    True
    """
    sheet = with_stated_precision(mechanism_for("layers", mechanism, Sheet), precision)
    assert isinstance(sheet, Sheet)

    def count(problems: Sequence[LayerProblem]) -> Sequence[int]:
        if workers == 1:
            return list(map(counted, problems))
        return numbers_of(LayerCountJob(tuple(problems)), workers=workers)

    framed = sheet_in_frame(sheet, frame)
    if may_stay_flat is not None:
        return staying_flat(framed, may_stay_flat, count)
    return flat_folding(framed, count, explain=explain)
