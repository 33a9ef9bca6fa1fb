"""Exact rank: a Miura mesh of 40 x 40 panels, and the rank of a closure against sympy and against an SVD.

    python benchmarks/exact_rank.py

writes the figures to benchmarks/results/exact_rank.json. All in one run: the closure of a mesh about 40 x 40 and
about 300 x 300, placed, built and ranked modulo one prime; sympy's DomainMatrix on the same numbers modulo that
prime (installed into a temporary folder, with numbers of its own); numpy's singular values of a real matrix of one
shape and pattern with it.
"""

from __future__ import annotations

import json
import os
import platform
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median
from time import perf_counter

import numpy as np

from graphs.convert.panels import polyhedron_of, scd_from_panels
from graphs.loops.loop import Loop
from graphs.mechanism.sc import SCGraph
from graphs.rank.exact import centres_of_loops, closure_modulo, closure_of, exact_mobility, matrix_modulo
from graphs.rank.realisation import PRIMES, GenericRealisation, PrimeField, Reals, realise
from graphs.rank.rods import exact_mobility_of_model

RUNS = 25
SYMPY = """
import json, sys
from time import perf_counter
from sympy import GF
from sympy.polys.matrices import DomainMatrix
rows, shape, prime = json.load(sys.stdin)
start = perf_counter()
field = GF(prime)
made = {i: {int(j): field(v) for j, v in row.items()} for i, row in enumerate(rows) if row}
rank = DomainMatrix(made, tuple(shape), field).rank()
print(json.dumps([perf_counter() - start, rank]))
"""


def mesh(rows: int, columns: int) -> SCGraph:
    """Return a mesh of quadrilaterals: its inner vertices are centres."""
    joints = {("h", i, j): (i * columns + j, i * columns + j + 1) for i in range(rows) for j in range(columns - 1)}
    joints |= {("v", i, j): (i * columns + j, (i + 1) * columns + j) for i in range(rows - 1) for j in range(columns)}
    loops = [
        Loop((("h", i, j), ("v", i, j + 1), ("h", i + 1, j), ("v", i, j)))
        for i in range(rows - 1)
        for j in range(columns - 1)
    ]
    return SCGraph(rows * columns, joints, loops)


def timed(job: object) -> float:
    """Return the median time of a job."""
    assert callable(job)
    taken = []
    for _ in range(RUNS):
        start = perf_counter()
        job()
        taken.append(perf_counter() - start)
    return median(taken)


def sympy_rank(sc: SCGraph) -> tuple[float, int] | None:
    """Return time and rank by sympy, of the equations as they are; None if it does not install."""
    closure = closure_modulo(sc, PRIMES[0])
    shape = [len(closure.rows), len(closure.joints)]
    with tempfile.TemporaryDirectory() as folder:
        install = [sys.executable, "-m", "pip", "install", "-q", "--target", folder, "sympy"]
        if subprocess.run(install, check=False, capture_output=True).returncode:
            return None
        code = f"import sys; sys.path.insert(0, {folder!r})\n{SYMPY}"
        told = json.dumps([[{str(j): v for j, v in row.items()} for row in closure.rows], shape, PRIMES[0]])
        out = [
            json.loads(subprocess.run([sys.executable, "-c", code], input=told, capture_output=True, text=True,
                                      check=True, env={**os.environ, "SYMPY_GROUND_TYPES": "python"}).stdout)
            for _ in range(3)
        ]  # fmt: skip
    return median(taken for taken, _ in out), out[0][1]


def real_matrix(sc: SCGraph) -> np.ndarray:
    """Return the closure of a random member over the reals."""
    field = Reals()
    placed = realise(sc, field)
    closure = closure_of(sc, placed.axes, centres_of_loops(sc, placed), field)
    matrix = np.zeros((len(closure.rows), len(closure.joints)))
    for row, values in enumerate(closure.rows):
        matrix[row, list(values)] = list(values.values())
    return matrix


def main() -> None:
    """Time everything and store the figures."""
    figures: dict[str, object] = {"python": platform.python_version()}
    small, middle = mesh(5, 5), mesh(13, 13)
    for name, sc in (("40 x 40", small), ("300 x 300", middle)):
        closure = closure_modulo(sc, PRIMES[0])
        matrix = matrix_modulo(closure, PRIMES[0])
        ours = timed(lambda sc=sc: exact_mobility(sc, PRIMES[:1]))
        field = PrimeField(PRIMES[0])
        member = sc, realise(sc, field), field
        real = real_matrix(sc)
        svd = timed(lambda real=real: np.linalg.svd(real, compute_uv=False))
        figures[name] = {
            "shape": [len(closure.rows), len(closure.joints)],
            "rank": int(matrix.rank()),
            "placed, built, ranked": round(ours, 6),
            "built, ranked": round(timed(lambda member=member: built_and_ranked(*member)), 6),
            "singular values": round(svd, 6),
        }
        print(name, figures[name], flush=True)
    other = sympy_rank(small)
    if other is not None:
        taken, rank = other
        row = figures["40 x 40"]
        assert isinstance(row, dict)
        assert rank == row["rank"]
        row["sympy"] = round(taken, 6)
        row["sympy / ours"] = round(taken / row["built, ranked"], 1)
        print("sympy", row["sympy"], row["sympy / ours"], flush=True)
    row = figures["300 x 300"]
    assert isinstance(row, dict)
    row["ours / singular values"] = round(row["placed, built, ranked"] / row["singular values"], 2)
    large = mesh(40, 40)
    start = perf_counter()
    found = exact_mobility(large)
    figures["mesh 40 x 40, two primes"] = {"mobility": found.mobility, "seconds": round(perf_counter() - start, 2)}
    print(figures["mesh 40 x 40, two primes"], flush=True)
    corners = {(i, j): i * 21 + j for i in range(21) for j in range(21)}
    panels = [
        (corners[i, j], corners[i, j + 1], corners[i + 1, j + 1], corners[i + 1, j])
        for i in range(20)
        for j in range(20)
    ]
    model = polyhedron_of(scd_from_panels(panels))
    start = perf_counter()
    by_rods = exact_mobility_of_model(model)
    figures["rods, 20 x 20 panels, two primes"] = {
        "mobility": by_rods.mobility,
        "seconds": round(perf_counter() - start, 2),
    }
    print(figures["rods, 20 x 20 panels, two primes"], flush=True)
    (Path(__file__).parent / "results" / "exact_rank.json").write_text(json.dumps(figures, indent=2) + "\n")


def built_and_ranked(sc: SCGraph, placed: GenericRealisation, field: PrimeField) -> int:
    """Build and rank the equations of a member that is placed already."""
    closure = closure_of(sc, placed.axes, centres_of_loops(sc, placed), field)
    return int(matrix_modulo(closure, PRIMES[0]).rank())


if __name__ == "__main__":
    main()
