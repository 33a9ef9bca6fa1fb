"""Random mechanisms for property tests."""

from __future__ import annotations

import random
from collections import Counter

import networkx as nx
from hypothesis import strategies as st

from graphs.errors import InvariantError
from graphs.loops.loop import Centre, Loop
from graphs.mechanism.drawing import face_cycles, trace_faces
from graphs.mechanism.polyhedron import PointConstraint, PolyhedronModel, RemoteCentre
from graphs.mechanism.sc import SCGraph
from graphs.mechanism.scd import SCDGraph

ODD_NAMES = ["<script>alert(1)</script>", "'; --", "🦆", "[bold]red[/bold]", "x" * 10_000, "a b\tc", "\u202eabc", ""]

randoms = st.randoms(use_true_random=False)


def random_sc(rng: random.Random, *, largest: int = 8) -> SCGraph:
    """Return a random SC graph: any graph, some of its fundamental cycles as loops."""
    while True:
        n = rng.randint(1, largest)
        pairs = [(rng.randrange(k), k) for k in range(1, n)]
        if n > 1:
            pairs += [tuple(rng.sample(range(n), 2)) for _ in range(rng.randint(0, 5))]
        graph = nx.Graph(pairs[: n - 1])
        loops = []
        for joint in range(n - 1, len(pairs)):
            if rng.random() < 0.7:
                path = nx.shortest_path(graph, *pairs[joint])
                around = [pairs.index(tuple(sorted(p))) if tuple(sorted(p)) in pairs[: n - 1]
                          else pairs.index(tuple(sorted(p, reverse=True))) for p in zip(path, path[1:], strict=False)]  # fmt: skip
                centre = rng.choice(["finite", "finite", "finite", "infinite", "none"])
                loops.append(Loop((*around, joint), centre, rng.choice([None, "A", "B"])))
        names = list(range(n))
        if rng.random() < 0.3:
            names = [f"link {k}" for k in range(n)]
            names[0] = rng.choice(ODD_NAMES)
        try:
            return SCGraph(names, [(names[a], names[b]) for a, b in pairs], loops, ground=rng.choice([None, names[-1]]))
        except InvariantError as error:
            assert error.rule == "centre classes"


def random_drawing(
    rng: random.Random, links: int, joins: int
) -> tuple[dict[int, tuple[int, int]], dict[int, list[int | None]]]:
    """Return joints and rotations of a random map: a tree of panels, then open edges of one face joined."""
    rotation: dict[int, list[int | None]] = {0: [None] * rng.randint(3, 5)}
    joints: dict[int, tuple[int, int]] = {}
    for link in range(1, links):
        parent = rng.choice([k for k, sides in rotation.items() if None in sides])
        where = rng.choice([i for i, side in enumerate(rotation[parent]) if side is None])
        joint = len(joints)
        joints[joint] = (parent, link)
        rotation[parent][where] = joint
        rotation[link] = [joint, *[None] * rng.choice([2, 2, 2, 3])]
    for _ in range(joins):
        faces, _ = trace_faces(joints, {k: tuple(v) for k, v in rotation.items()})
        face = rng.choice(faces)
        around = open_edges_of(face, rotation)
        if len(around) < 2:
            continue
        first = rng.randrange(len(around))
        second = (first + 1) % len(around) if rng.random() < 0.6 else rng.randrange(len(around))
        (a, i), (b, k) = around[first], around[second]
        if a == b:
            continue
        joint = len(joints)
        joints[joint] = (a, b)
        rotation[a][i] = rotation[b][k] = joint
    return joints, rotation


def open_edges_of(face, rotation) -> list[tuple[int, int]]:
    """Return (link, side) of the open edges of a face, in walking order."""
    found = []
    for corner in face.corners:
        size = len(rotation[corner.link])
        for step in range(1, corner.open_edges + 1):
            shift = step if corner.arriving is not None else step - 1
            found.append((corner.link, (corner.first_side - shift) % size))
    return found


def random_scd(rng: random.Random, *, refused: Counter[str] | None = None, most: int = 9) -> SCDGraph:
    """Return a random valid SCD graph; count the rules that turned others down."""
    for _ in range(200):
        joints, rotation = random_drawing(rng, rng.randint(1, most), rng.randint(0, 8))
        faces, _ = trace_faces(joints, {k: tuple(v) for k, v in rotation.items()})
        outer = rng.choice([face for face in faces if face.open_edges >= 3] or list(faces))
        loops = []
        for face in faces:
            cycles = face_cycles(face)
            if face is not outer and len(cycles) == 1:
                closed = not face.open_edges
                centre = "finite" if closed else rng.choice(["finite", "finite", "infinite", "none"])
                loops.append(Loop(cycles[0], centre))
        corner = outer.corners[0]
        side = None
        if corner.leaving is not None:
            side = (corner.leaving, "left" if joints[corner.leaving][0] == corner.link else "right")
        try:
            return SCDGraph(len(rotation), joints, loops, rotation=rotation, outer=side)
        except InvariantError as error:
            if refused is not None:
                refused[error.rule] += 1
    return SCDGraph(1, {}, rotation={0: [None] * 3})


def random_model(rng: random.Random) -> PolyhedronModel:
    """Return a random polyhedron model with every kind of term."""
    n = rng.randint(1, 8)
    rods = [(a, b) for a in range(n) for b in range(a) if rng.random() < 0.5]
    ground = rng.choice([None, [], list(range(rng.randint(0, n)))])
    constraints = []
    if n >= 4:
        constraints = [PointConstraint(v, tuple(rng.sample([u for u in range(n) if u != v], 2))) for v in range(2)]
    if ground is not None:
        constraints.append(PointConstraint(0, "ground"))
    return PolyhedronModel(
        n,
        rods,
        coordinates={v: [rng.uniform(-1, 1) for _ in range(3)] for v in range(n)} if rng.random() < 0.5 else None,
        centres=[RemoteCentre(rng.randint(0, 5), tuple(rods[:2]), rng.choice([None, "S"]))],
        on_line=constraints,
        scissors=[tuple(rng.sample(range(n), 4))] if n >= 4 else [],
        ground=ground,
        links={"a": tuple(range(n))},
    )


sc_graphs = st.builds(random_sc, randoms)
scd_graphs = st.builds(random_scd, randoms)
models = st.builds(random_model, randoms)

__all__ = ["ODD_NAMES", "Centre", "models", "random_drawing", "random_scd", "sc_graphs", "scd_graphs"]
