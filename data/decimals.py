"""Numbers of the files under data/: nine decimals, the same on every machine.

Sines and solutions of equations differ in their last digits from processor to processor. Nine decimals are far from
where they differ, and what is special about the geometry of a sheet is told within the precision that its digits
show. A ring of solids that moves by its proportions alone, as Bennett's, could not move with nine: `ring` of
`synth.catalogue.patterns.hinged_rings` keeps fourteen of what has a closed form.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from graphs.convert.conversions import Mechanism
from graphs.joints.linkage import JointedLinkage, JointPlace
from graphs.mechanism.sheet import Sheet
from synth.catalogue.patterns.panels import rounded

DIGITS = 9


def with_few_decimals(mechanism: Mechanism) -> Mechanism:
    """Return a mechanism whose coordinates have nine decimals."""
    match mechanism:
        case Sheet(coordinates=places) if places is not None:
            return rounded(mechanism, DIGITS)
        case JointedLinkage():
            places_of = {
                joint: JointPlace(_short(place.point), tuple(map(_short, place.axes)))
                for joint, place in mechanism.places.items()
            }
            return replace(mechanism, places=places_of)
    return mechanism


def _short(vector: Sequence[float]) -> tuple[float, float, float]:
    x, y, z = (round(float(number), DIGITS) + 0.0 for number in vector)
    return (x, y, z)
