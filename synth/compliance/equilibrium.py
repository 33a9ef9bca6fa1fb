"""Poses at which springs and moments are in balance, and the load path of driven joints.

Theory: docs/theory/compliance.md.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from graphs.errors import NumericalError
from graphs.rank.singular_values import null_space
from graphs.tolerances import DOUBLE
from graphs.types import Floats
from synth.compliance.springs import Bent, ElasticLinkage
from synth.motion.newton import corrected, exactly_held
from synth.motion.path import driven_path

__all__ = ["Equilibrium", "LoadPath", "equilibrium", "load_path"]

_STEPS = 200
_LONGEST = 0.2
"""Of a step, in radians of all joints (root of summed squares)."""
_BALANCED = 1e-11
"""Slope of the energy at which it is in balance, as part of the largest moment at hand."""
_SOFT = 1e-6
"""Curvature below this part of the largest is taken for it: else steps are long where the energy is level."""
_HALVINGS = 40
_DOWN = 1e-4
"""Part of the fall that the slope foretells which a step has to bring (Armijo)."""


@dataclass(frozen=True, slots=True)
class Equilibrium:
    """A pose (angles in radians) at which springs and moments are in balance, and their energy.

    `held`, float[D], are the moments that keep driven joints at their angles. `least` is the least curvature of
    the energy along motions that leave driven joints where they are, per squared radian; None where there are
    none. `unbalanced` is the slope of the energy that is left, `error` the loop-closure residual.
    """

    angles: Floats
    energy: float
    held: Floats
    least: float | None
    unbalanced: float
    error: float

    @property
    def stable(self) -> bool:
        """Whether the energy rises along all motions that leave driven joints still."""
        return self.least is None or self.least > 0.0


@dataclass(frozen=True, slots=True)
class LoadPath:
    """Equilibria while one joint, at place `driver`, is driven; the first is where it began.

    `stopped` says why the path ended before its goal; it is empty if it reached it.
    """

    driver: int
    poses: tuple[Equilibrium, ...]
    stopped: str

    @property
    def driven(self) -> Floats:
        """Angles of the joint, radians: float[F]."""
        return np.array([pose.angles[self.driver] for pose in self.poses])

    @property
    def moments(self) -> Floats:
        """Moments that hold it there: float[F]."""
        return np.array([float(pose.held[0]) for pose in self.poses])


def equilibrium(elastic: ElasticLinkage, start: Floats | None = None, held: tuple[int, ...] = ()) -> Equilibrium:
    """Return the equilibrium that the energy falls to from a closed pose.

    Newton's method on the closed poses, with the curvature made positive, and steps halved until the energy falls
    as its slope foretells. The start, radians, is by default the pose of the linkage; joints at the places `held`
    keep their angles. Raises `NumericalError` if a singular pose is met, or balance is not reached.
    """
    angles = elastic.linkage.angles if start is None else start
    values = angles[list(held)]
    for _ in range(_STEPS):
        along, bent = _beside(elastic, angles, held)
        off = float(np.abs(bent.slope).max(initial=0.0))
        moments = np.abs([elastic.slopes(angles), elastic.moments])
        if off <= _BALANCED * max(float(moments.max(initial=0.0)), float(elastic.stiffness.max(initial=0.0))):
            least = float(np.linalg.eigvalsh(bent.curvature)[0]) if along.shape[1] else None
            error = elastic.closure.error(angles)
            return Equilibrium(angles, elastic.energy(angles), bent.held, least, off, error)
        angles = _lower(elastic, angles, along @ _downhill(bent), (held, values), along @ bent.slope)
    raise NumericalError(f"springs came to no balance in {_STEPS} steps: moments of {off:.1e} are left")


def load_path(elastic: ElasticLinkage, start: Floats, driver: int, values: npt.ArrayLike) -> LoadPath:
    """Return the equilibria while the joint at place `driver` is driven to one angle after the other, radians.

    It starts from a closed pose. Raises `NumericalError` as :func:`equilibrium` does.
    """
    poses, stopped = [equilibrium(elastic, start, (driver,))], ""
    for value in np.asarray(values, dtype=float).tolist():
        path = driven_path(elastic.closure, poses[-1].angles, [driver], [[value]])
        if path.stopped:
            stopped = path.stopped
            break
        poses.append(equilibrium(elastic, path.angles[-1], (driver,)))
    return LoadPath(driver, tuple(poses), stopped)


def _beside(elastic: ElasticLinkage, angles: Floats, held: tuple[int, ...]) -> tuple[Floats, Bent]:
    """Return the rates that leave held joints still, float[J, n], and how the energy bends along them."""
    tangent = elastic.tangent(angles)
    along = tangent.rates @ null_space(tangent.rates[list(held)]) if held else tangent.rates
    return along, elastic.bent(angles, tangent, along, held)


def _downhill(bent: Bent) -> Floats:
    """Return Newton's step with the signs of all curvatures made positive, no longer than may be: float[n]."""
    values, vectors = np.linalg.eigh(bent.curvature)
    sizes = np.abs(values)
    sizes = np.maximum(sizes, _SOFT * max(float(sizes.max()), float(np.abs(bent.slope).max())))
    step = -vectors @ ((vectors.T @ bent.slope) / sizes)
    return np.asarray(step * min(1.0, _LONGEST / float(np.linalg.norm(step))))


def _lower(
    elastic: ElasticLinkage, angles: Floats, step: Floats, held: tuple[tuple[int, ...], Floats], slope: Floats
) -> Floats:
    """Return a closed pose along a step at which the energy is lower, held joints at their angles."""
    places, values = held
    before = elastic.energy(angles)
    rounding = 1e-14 * (abs(before) + float(elastic.stiffness.max(initial=0.0)))
    for halving in range(_HALVINGS):
        part = 0.5**halving
        pose = corrected(elastic.closure, angles + part * step, places)
        if places:
            pose = exactly_held(elastic.closure, pose, places, values)
        if pose.error > DOUBLE.closed or np.abs(pose.angles - angles).max() > 2.0 * _LONGEST:
            continue
        if elastic.energy(pose.angles) <= before + _DOWN * part * float(slope @ step) + rounding:
            return pose.angles
    raise NumericalError("springs came to no balance: the energy falls along no step that keeps loops closed")
