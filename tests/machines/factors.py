"""What differs from machine to machine, one factor at a time: an environment for a child process, and its proof.

OpenBLAS picks its kernels by processor, and takes a name it does not know, or a kernel it was built without, for
another; a kernel that the processor lacks ends the process with SIGILL where it first calculates. So a child process
calculates first, and is asked which kernels it runs with: numpy and scipy each bring a library of their own.
"""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

__all__ = ["FACTORS", "Factor", "environment_for", "reason_to_leave_out"]

ROOT = Path(__file__).resolve().parent.parent.parent
_VARIED = (
    "OPENBLAS_CORETYPE",
    "OPENBLAS_NUM_THREADS",
    "OMP_NUM_THREADS",
    "PYTHONHASHSEED",
    "NPY_DISABLE_CPU_FEATURES",
    "SYNTHEDRA_COMPILED",
)
_SYNONYMS = {"Katmai": "Prescott"}
"""Builds for x86-64 have one kernel for the oldest processors, asked for by one name and reported by another."""

_PROBE = """
import ctypes, numpy, scipy.linalg
matrix = numpy.eye(64) + numpy.ones((64, 64))  # instructions that the processor lacks are met here
numpy.linalg.svd(matrix @ matrix), scipy.linalg.qr(matrix, pivoting=True), scipy.linalg.cho_factor(matrix)
from numpy._core._multiarray_umath import __cpu_features__
with open("/proc/self/maps") as maps:
    places = sorted({line.split()[-1] for line in maps if "openblas" in line})
for library in map(ctypes.CDLL, places):
    for name in (p + "openblas_get_corename" + s for p in ("scipy_", "") for s in ("64_", "")):
        if hasattr(library, name):
            function = getattr(library, name)
            function.restype = ctypes.c_char_p
            print("kernel", function().decode())
            break
print("X86_V3", __cpu_features__.get("X86_V3", False))
"""


@dataclass(frozen=True)
class Factor:
    """One thing that differs between machines.

    Attributes
    ----------
    name : str
    environment : dict of str to str
        Variables of the child process, beside those of this one.
    report : str or None
        A line that the probe prints under this factor and not otherwise; kernels: of each library.
    """

    name: str
    environment: dict[str, str]
    report: str | None = None


def _kernel(name: str) -> Factor:
    return Factor(name, {"OPENBLAS_CORETYPE": name}, f"kernel {name}")


FACTORS = {
    factor.name: factor
    for factor in (
        *map(_kernel, ("SkylakeX", "Haswell", "Sandybridge", "Nehalem", "Prescott")),
        Factor("two-threads", {"OPENBLAS_NUM_THREADS": "2"}),
        Factor("hash-seed", {"PYTHONHASHSEED": "20212020"}),
        Factor("not-compiled", {"SYNTHEDRA_COMPILED": "never"}),
        Factor("no-avx2", {"NPY_DISABLE_CPU_FEATURES": "X86_V3"}, "X86_V3 False"),
    )
}
"""By name. numpy 2.4 knows groups of instructions only: AVX2 is part of X86_V3."""


def environment_for(factor: Factor | None) -> dict[str, str]:
    """Return the environment of a child process: this one's, with nothing else varied than the factor."""
    plain = {key: value for key, value in os.environ.items() if key not in _VARIED}
    path = os.pathsep.join(filter(None, [str(ROOT), plain.get("PYTHONPATH")]))
    fixed = {"PYTHONHASHSEED": "0", "PYTHONPATH": path}
    return plain | fixed | (factor.environment if factor else {})


def reason_to_leave_out(factor: Factor) -> str | None:
    """Return why this machine cannot run under a factor, or None where it can."""
    child = subprocess.run(
        [sys.executable, "-c", _PROBE], env=environment_for(factor), capture_output=True, text=True, check=False
    )
    if child.returncode < 0:
        return f"the processor lacks it (signal {-child.returncode})"
    if child.returncode:
        return f"the probe failed: {child.stderr.strip().splitlines()[-1]}"
    if factor.report is None:
        return None
    subject, wanted = factor.report.split()
    reports = [line.split()[1] for line in child.stdout.splitlines() if line.split()[0] == subject]
    reports = [_SYNONYMS.get(report, report) for report in reports]
    if set(reports) != {wanted}:
        return f"expected {wanted}, the libraries report {', '.join(reports) or 'nothing'}"
    return None
