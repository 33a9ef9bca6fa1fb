"""All SCD graphs of a chain, the plainest way: every drawing, every outer face, every number of open edges."""

from __future__ import annotations

from itertools import combinations_with_replacement, permutations, product

from graphs.errors import InvariantError
from graphs.loops.loop import Loop
from graphs.mechanism.drawing import trace_faces
from graphs.mechanism.scd import SCDGraph


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
        ways = [w for k in range(most - len(sides) + 1) for w in combinations_with_replacement(range(len(sides)), k)]
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
        for corner in scd.faces[scd.drawing.outer_face].corners:
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


def scd_codes(joints, most):
    """The codes of all SCD graphs of a chain whose rules hold."""
    found = set()
    for rotation, faces in drawings(joints):
        for outer in faces:
            loops = [Loop(face.joints) for face in faces if face is not outer] if len(faces) > 1 else []
            corner = outer.corners[0]
            side = "left" if joints[corner.leaving][0] == corner.link else "right"
            for placed in placements(rotation, most):
                try:
                    scd = SCDGraph(len(rotation), joints, loops, rotation=placed, outer=(corner.leaving, side))
                except InvariantError:
                    continue
                found.add(code(scd))
    return found
