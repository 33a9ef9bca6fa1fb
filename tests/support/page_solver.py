"""The solver of the page asked beside the one in Python: the same questions, both answers."""

from __future__ import annotations

import json
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from synth.analysis.folding.panel_collisions import PanelShapes
from synth.analysis.motion.closure import ClosureEquations, corrected
from synth.analysis.motion.linkage import link_motions
from synth.analysis.motion.path import PathOptions, driven_path
from synth.making.viewer.linkage import solver_data
from synth.making.viewer.page_data import MovingLinkage

WEB = Path(__file__).resolve().parents[2] / "synth" / "making" / "viewer" / "web"


def node() -> str:
    """Where node is; the test skips where it is missing."""
    found = shutil.which("node")
    if found is None:
        pytest.skip("node is not installed")
    return found


def answers(questions: list[dict]) -> list[dict]:
    """What the solver of the page says; the test skips where what it imports is not installed."""
    if not (WEB / "node_modules" / "three").is_dir():
        pytest.skip("the packages of the page are not installed (make test-web)")
    asked = json.dumps(questions)
    run = subprocess.run([node(), WEB / "src" / "answers.js"], input=asked, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    return json.loads(run.stdout)


@dataclass
class Asked:
    """One linkage: where the solvers begin, and what Python says."""

    question: dict
    residual: np.ndarray
    gathered: np.ndarray
    near: np.ndarray
    frames: np.ndarray
    stopped: str
    places: np.ndarray
    crossing: list[tuple[int, int] | None]
    """Of each frame, the first two panels that cross."""


def asked_of(
    moving: MovingLinkage, rng: np.random.Generator, turn: float = 0.8, frames: int = 4, *, panels: bool = True
) -> Asked:
    """Ask for residuals anywhere, for the pose next to a disturbed one, and for a path of a driven joint.

    With panels, also which of them cross: for that node needs the packages of the page.
    """
    linkage, bodies = moving.linkage, moving.bodies
    closure = ClosureEquations(linkage)
    anywhere = linkage.angles + rng.normal(scale=0.7, size=closure.joints)
    residual, jacobian = closure.at(anywhere)
    way = moving.ways.all[moving.ways.taken]
    direction = way.rates if moving.ways.singular else None
    driver = int(np.abs(way.rates).argmax())
    start, sign = linkage.angles[driver], np.sign(way.rates[driver])
    sign = -sign if moving.limited and abs(start + sign * turn) > np.pi else sign
    goals = start + sign * np.linspace(turn / frames, turn, frames)
    towards = None if direction is None else direction * sign * np.sign(way.rates[driver])
    limited = np.full(closure.joints, moving.limited)
    path = driven_path(closure, linkage.angles, [driver], goals[:, None], options=PathOptions(towards, limited))
    near = path.angles[-1] + rng.normal(scale=1e-3, size=closure.joints)
    ground = list(linkage.graph.nodes)[moving.ground]
    faces = bodies.faces if moving.limited and panels else []
    question = {
        "linkage": solver_data(linkage, limited=moving.limited, ground=ground),
        "anywhere": anywhere.tolist(),
        "near": near.tolist(),
        "direction": None if towards is None else towards.tolist(),
        "driver": driver,
        "held": [],
        "goals": goals.tolist(),
        "vertices": bodies.vertices.tolist(),
        "owners": bodies.owners,
        "faces": [{"link": link, "vertices": around} for link, around in faces],
    }
    motions = list(link_motions(linkage, path.angles, ground).values())
    carried = zip(bodies.vertices, bodies.owners, strict=True)
    places = np.array([motions[owner][0] @ v + motions[owner][1] for v, owner in carried])
    gathered, closed = jacobian.T @ residual, corrected(closure, near).angles
    pieces = PanelShapes([around for _, around in faces], [link for link, _ in faces], bodies.vertices)
    crossing = [pieces.crossing(frame) for frame in places.swapaxes(0, 1)]
    return Asked(question, residual, gathered, closed, path.angles, path.stopped, places, crossing)
