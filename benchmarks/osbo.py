"""The rigid-origami solver of osbo (Newton's method, compiled by numba), on the same frames as ours.

Its file is taken from the folder that SYNTHEDRA_PEERS names, or from ../shared/peers; what only draws is left out.
"""

from __future__ import annotations

import importlib.util
import os
import sys
from collections.abc import Mapping
from pathlib import Path
from statistics import median
from time import process_time
from types import ModuleType
from typing import Any

import numpy as np

from graphs.mechanism.sheet import Sheet

PEERS = Path(os.environ.get("SYNTHEDRA_PEERS", Path(__file__).resolve().parents[2] / "shared" / "peers"))


def _module() -> ModuleType | None:
    """Return its module, None where it is not at hand."""
    path = PEERS / "osbo-rigid-origami" / "rigid_origami.py"
    if not path.exists():
        return None
    for name in ("pyvista", "vtk"):  # only draw
        sys.modules.setdefault(name, ModuleType(name))
    spec = importlib.util.spec_from_file_location("rigid_origami", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def frames_of_osbo(
    flat: Sheet, angles: Mapping[tuple[int, int], float], driven: tuple[int, int], count: int
) -> dict[str, Any] | None:
    """Return the median milliseconds of its frames, a degree each, and how well loops close.

    Fold angles are by edge, radians, those of the configuration to begin with. None where the program is not at hand.
    """
    module = _module()
    if module is None:
        return None
    points = np.zeros((flat.vertices, 3))
    points[:, :2] = np.array(flat.coordinates)[:, :2]
    solver = module.MeshProcessor(points, [list(face) for face in flat.faces])
    solver.precompute_folding_tree()
    begun = {frozenset(edge): angle for edge, angle in angles.items()}
    pairs = [frozenset(edge) for edge in solver.edges]
    state = np.array([begun.get(pair, 0.0) for pair in pairs])
    held = np.array([pair == frozenset(driven) for pair in pairs])
    step = np.sign(state[held]) * np.radians(1.0)
    times, error = [], 0.0
    for number in range(count + 1):  # the first frame compiles
        start = process_time()
        state[held] += step
        state = module.NewtonSolver(
            module.compute_residual, module.compute_jacobian_analytical, state, solver,
            held_edges=held, verbose=False,
        )  # fmt: skip
        solver.reconstruct_surface(state)
        if number:
            times.append(1000.0 * (process_time() - start))
        error = max(error, float(np.abs(module.compute_residual(state, solver)).max()))
    return {"median": median(times), "closure": error}
