"""A checker of layer orders that knows geometry alone: a total order in each cell, and strands that do not cross.

At each segment of the image the strands are drawn as arcs: those of creases on their side, those that run across from
one side to the other. Two arcs cross exactly if their ends alternate.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from synth.layering.constraints import decided_at
from synth.layering.image import OUTSIDE, FoldedImage

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
    flipped = image.panels.flipped
    for number, strand in enumerate(image.strands):
        cells = (strand.left, strand.right)
        for side, (cell, turning) in enumerate(zip(cells, strand.turning, strict=True)):
            arcs = [sorted((place[cell][one], place[cell][other])) for one, other, _ in turning]
            heights = [place[cell][panel] for panel in strand.through]
            for low, high in arcs:
                if any(low < height < high for height in heights):
                    return f"a panel runs through a crease at segment {number}"
                if any(low < first < high < last for first, last in arcs):
                    return f"two creases cross at segment {number}"
            for one, other in ((one, other) for one, other, _ in turning):
                low, high = sorted((place[cell][one], place[cell][other]))
                if any(low < place[cell][there.panel] < high for there in strand.leaving[side]):
                    return f"a panel leaves through a crease at segment {number}"
            if any(place[cell][upper] < place[cell][lower] for upper, lower in decided_at(strand, side)):
                return f"a panel leaves through another at segment {number}"
            for one, other, joint in turning:
                if joint in valleys:
                    upper_is_other = place[cell][other] > place[cell][one]
                    if upper_is_other == (valleys[joint] == bool(flipped[one])):
                        return f"crease {joint} is folded the other way"
        if OUTSIDE not in cells:
            orders = [sorted(strand.through, key=place[cell].__getitem__) for cell in cells]
            if orders[0] != orders[1]:
                return f"two panels change places at segment {number}"
    for cell, one, other, there, first, second in image.bundles:
        if (place[cell][one] > place[cell][other]) != (place[there][first] > place[there][second]):
            return f"panels {one} and {other} change places where they leave their plane"
    return ""
