"""R/- strings as strips of panels: rectangles between parallel creases, triangles between creases that meet.

Source: Wiener 2016, sections 5.1.2 and 5.2. Theory: docs/theory/realisation.md, docs/theory/strings.md.
"""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from enumerate.strings.panel_strings import ChainString, chain_scd
from graphs.errors import numbered
from graphs.geometry import rotated, unit
from graphs.mechanism.scd import SCDGraph
from graphs.mechanism.sheet import Edge, sides_of_face
from graphs.types import Floats
from synth.catalogue.realisation.drawing import PanelDrawing
from synth.catalogue.realisation.measures import opened_angles
from synth.catalogue.realisation.pattern import Pattern

_FAN = np.radians(45.0)
"""The angle of a triangle, for strips that stay far enough from their own beginning."""
_TURNED = np.radians(150.0)
"""A strip turns by less than this, from any part of it to any other."""
_VARIED = 0.2
_FOLDED = (float(np.radians(30.0)), float(np.radians(60.0)))
"""In space creases are folded by angles between these, up and down by turns. Where all fold by one angle, the
bodies of RR-RR-RR have five freedoms, not six."""


def drawn_string(chain: ChainString, mode: str | None = None) -> tuple[SCDGraph, tuple[str, ...]]:
    """Return the SCD graph of a string in a mode of `chain_scd`, both ends quadrilaterals, and notes on it."""
    scd = chain_scd(chain, mode, ends=(4, 4))
    between = f"{numbered(chain.dof, 'freedom')} between the first and the last panel of a generic realisation"
    notes = [f"{chain.text}: joints {chain.mechanism}, {between}"]
    if mode:
        notes.append(f"mode {mode}: the next point in which creases meet is on the same side (S) or the other (D)")
    elif sum(k >= 2 for k in chain.clusters) > 1:
        notes.append("all points in which creases meet are on one side of the strip")
    return scd, tuple(notes)


def is_strip(pattern: Pattern) -> bool:
    """Return whether panels follow each other as those of a string do: triangles or quadrilaterals between two."""
    sides = [{frozenset(side) for side in sides_of_face(panel)} for panel in pattern.panels]
    creases = [frozenset(crease) for crease in pattern.creases]
    if len(creases) != len(sides) - 1 or not creases:
        return False
    in_order = all(crease in sides[i] and crease in sides[i + 1] for i, crease in enumerate(creases))
    common = [len(crease & following) for crease, following in pairwise(creases)]
    inner = [len(row) for row in sides[1:-1]]
    return in_order and all((size, met) in ((3, 1), (4, 0)) for size, met in zip(inner, common, strict=True))


def strips(pattern: Pattern, seed: int, tries: int) -> Iterator[PanelDrawing]:
    """Yield strips: panels between parallel creases are rectangles, creases of a cluster meet in a point.

    The first has panels that are all alike, every other has its own widths and angles. The first and last panel of
    the pattern may have any number of sides.
    """
    # the greatest angle of triangles with which no part of the strip turns round to another
    apices = [_apex(pattern, panel) for panel in range(len(pattern.panels))]
    turned = np.cumsum([0, *(0 if apex is None else apex[1] for apex in apices)])
    fan = float(min(_FAN, _TURNED / max(np.ptp(turned), 1)))
    for number in range(tries):
        random = np.random.default_rng((seed, number))
        spread = _VARIED if number or seed else 0.0
        parts = np.exp(-spread * random.random(len(pattern.panels)))
        places = _placed(pattern, fan * parts, parts)
        angles, _ = opened_angles(pattern, places)
        round_border = pattern.sums_at(pattern.outer) @ angles
        yield PanelDrawing(places, angles, bool((round_border <= np.pi).all()), number)


def folded_strip(pattern: Pattern, places: Floats, random: np.random.Generator) -> tuple[Floats, Floats]:
    """Return a strip with its creases folded up and down by turns, each by an angle of its own: rectangles stay.

    Returns places float[V, 3], and the fold angles, radians, above 0 at valleys.
    """
    points = np.column_stack([places, np.zeros(len(places))])
    least, most = _FOLDED
    angles = random.uniform(least, most, len(pattern.creases)) * (-1.0) ** np.arange(len(pattern.creases))
    for number in reversed(range(len(pattern.creases))):
        a, b = _directed(pattern, number + 1, pattern.creases[number])
        after = sorted({vertex for panel in pattern.panels[number + 1 :] for vertex in panel} - {a, b})
        axis = unit(points[b] - points[a])
        points[after] = points[a] + rotated(points[after] - points[a], axis, angles[number])
    return points, angles


def _directed(pattern: Pattern, panel: int, crease: Edge) -> Edge:
    """Return a crease as the boundary of a panel passes it, counter-clockwise."""
    return next(side for side in sides_of_face(pattern.panels[panel]) if set(side) == set(crease))


def _apex(pattern: Pattern, panel: int) -> tuple[int, int] | None:
    """Return the vertex in which the two creases of a panel meet, and 1 if the strip turns left there, else -1."""
    if not 0 < panel < len(pattern.panels) - 1:
        return None
    common = set(pattern.creases[panel - 1]) & set(pattern.creases[panel])
    if not common:
        return None
    (apex,) = common
    return apex, 1 if _directed(pattern, panel, pattern.creases[panel - 1])[0] == apex else -1


def _placed(pattern: Pattern, fans: Floats, widths: Floats) -> Floats:
    """Return float[V, 2]: places, each panel attached to the crease that it shares with the one before."""
    places = np.zeros((pattern.vertices, 2))
    a, b = _directed(pattern, 0, pattern.creases[0])
    places[b] = (0.0, 1.0)
    _add_panel(pattern, 0, (a, b), widths[0], places)
    for panel in range(1, len(pattern.panels)):
        shared = _directed(pattern, panel, pattern.creases[panel - 1])
        apex_and_turn = _apex(pattern, panel)
        if apex_and_turn is None:
            _add_panel(pattern, panel, shared, widths[panel], places)
            continue
        apex, turn = apex_and_turn
        far = shared[1] if apex == shared[0] else shared[0]
        (new,) = set(pattern.panels[panel]) - set(shared)
        cos, sin = np.cos(fans[panel]), turn * np.sin(fans[panel])
        places[new] = places[apex] + np.array([[cos, -sin], [sin, cos]]) @ (places[far] - places[apex])
    return places


def _add_panel(pattern: Pattern, panel: int, shared: Edge, width: float, places: Floats) -> None:
    """Place the other vertices of a panel on half an ellipse on the left of a side: two make a rectangle."""
    around = pattern.panels[panel]
    start = around.index(shared[0])
    along = places[shared[1]] - places[shared[0]]
    off = width * np.array([-along[1], along[0]])
    others = len(around) - 2
    for place in range(others):
        angle = np.pi * (place + 0.5) / others
        across, up = np.sqrt(0.5) * np.cos(angle), np.sqrt(2.0) * np.sin(angle)
        middle = (places[shared[0]] + places[shared[1]]) / 2
        places[around[(start + 2 + place) % len(around)]] = middle + across * along + up * off
