"""A checker of layer orders that knows geometry alone: a total order in each cell, and strands that do not cross.

At each segment of the image the strands are drawn as arcs: those of creases on their side, those that run across from
one side to the other. Two arcs cross exactly if their ends alternate.
"""

from collections.abc import Mapping, Sequence

from synth.analysis.layering.constraints import decided_at
from synth.analysis.layering.image import OUTSIDE, FoldedImage, SegmentStrands

Stacks = Sequence[Sequence[int]]
"""The panels over each cell, from the lowest to the highest."""


def fault_of(image: FoldedImage, stacks: Stacks, valleys: Mapping[int, bool]) -> str:
    """Return what is wrong with the panels over each cell; empty if they are a folded state.

    `valleys` says of assigned creases whether they are valleys.
    """
    for cell, (stack, panels) in enumerate(zip(stacks, image.above, strict=True)):
        if sorted(stack) != panels.tolist():
            return f"cell {cell} has other panels than lie there"
    place = [{panel: height for height, panel in enumerate(stack)} for stack in stacks]
    for number, strand in enumerate(image.strands):
        for side, cell in enumerate((strand.left, strand.right)):
            fault = "" if cell == OUTSIDE else _fault_on_side(strand, side, place[cell])
            if fault:
                return f"{fault} at segment {number}"
            for one, other, joint in strand.turning[side]:
                if joint in valleys:
                    upper_is_other = place[cell][other] > place[cell][one]
                    if upper_is_other == (valleys[joint] == bool(image.panels.flipped[one])):
                        return f"crease {joint} is folded the other way"
        if OUTSIDE not in (strand.left, strand.right):
            orders = [sorted(strand.through, key=place[cell].__getitem__) for cell in (strand.left, strand.right)]
            if orders[0] != orders[1]:
                return f"two panels change places at segment {number}"
    for cell, one, other, there, first, second in image.bundles:
        if (place[cell][one] > place[cell][other]) != (place[there][first] > place[there][second]):
            return f"panels {one} and {other} change places where they leave their plane"
    return ""


def _fault_on_side(strand: SegmentStrands, side: int, place: Mapping[int, int]) -> str:
    """Return what is wrong with the strands on one side of a segment; `place` has the height of each panel."""
    arcs = [sorted((place[one], place[other])) for one, other, _ in strand.turning[side]]
    heights = [place[panel] for panel in (*strand.through, *(there.panel for there in strand.leaving[side]))]
    for low, high in arcs:
        if any(low < height < high for height in heights):
            return "a panel runs through a crease"
        if any(low < first < high < last for first, last in arcs):
            return "two creases cross"
    if any(place[upper] < place[lower] for upper, lower in decided_at(strand, side)):
        return "a panel that leaves the plane runs through another"
    return ""
