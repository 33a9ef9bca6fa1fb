"""The SCD rules let through as many graphs as the design counts, by plain enumeration."""

from itertools import combinations_with_replacement, permutations, product

import pytest

from graphs.errors import InvariantError
from graphs.loops import Loop
from graphs.rotation import trace_faces
from graphs.scd import SCDGraph

FOUR_BAR = [(0, 1), (1, 2), (2, 3), (3, 0)]
WATT = [(0, 1), (1, 2), (2, 3), (3, 0), (3, 4), (4, 5), (5, 0)]
STEPHENSON = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (4, 5), (5, 2)]


def drawings(joints):
    """Every set of rotations that draws a graph on the sphere."""
    n = 1 + max(map(max, joints))
    around = [[j for j, ends in enumerate(joints) if link in ends] for link in range(n)]
    for turns in product(*([(row[0], *rest) for rest in permutations(row[1:])] for row in around)):
        rotation = dict(enumerate(turns))
        faces, _ = trace_faces(dict(enumerate(joints)), rotation)
        if n - len(joints) + len(faces) == 2:
            yield rotation, faces


def placements(rotation, most):
    """Every way to give each link three to ``most`` sides by open edges after its joints."""
    choices = []
    for sides in rotation.values():
        ways = [
            w for k in range(most - len(sides) + 1) for w in combinations_with_replacement(range(len(sides)), k)
        ]
        choices.append([w for w in ways if len(sides) + len(w) >= 3])
    for choice in product(*choices):
        yield {
            link: tuple(x for i, side in enumerate(sides) for x in (side, *[None] * way.count(i)))
            for (link, sides), way in zip(rotation.items(), choice, strict=True)
        }


def code(scd):
    """The least breadth-first code over the darts of the outer face and both orientations."""
    codes = []
    for mirror in (False, True):
        turns = {link: sides[::-1] if mirror else sides for link, sides in scd.rotation.items()}
        for corner in scd.faces[scd.outer_face].corners:
            first = corner.arriving if mirror else corner.leaving
            number, start, order, text = {corner.link: 0}, {corner.link: first}, [corner.link], []
            for link in order:
                at = turns[link].index(start[link])
                for side in turns[link][at:] + turns[link][:at]:
                    if side is not None:
                        other = sum(scd.joints[side]) - link
                        if other not in number:
                            number[other] = len(number)
                            start[other] = side
                            order.append(other)
                    text.append(-1 if side is None else number[other])
                text.append(-2)
            codes.append(tuple(text))
    return min(codes)


@pytest.mark.parametrize(
    ("joints", "most", "count"),
    [(FOUR_BAR, 3, 1), (FOUR_BAR, 4, 7), (WATT, 3, 1), (STEPHENSON, 3, 0)],
    ids=["four-bar D=3", "four-bar D=4", "Watt D=3", "Stephenson D=3"],
)
def test_counts_of_the_design(joints, most, count):
    found = set()
    for rotation, faces in drawings(joints):
        for outer in faces:
            loops = [Loop(face.joints) for face in faces if face is not outer]
            corner = outer.corners[0]
            side = "left" if joints[corner.leaving][0] == corner.link else "right"
            for placed in placements(rotation, most):
                try:
                    scd = SCDGraph(len(rotation), joints, loops, rotation=placed, outer=(corner.leaving, side))
                except InvariantError:
                    continue
                found.add(code(scd))
    assert len(found) == count
