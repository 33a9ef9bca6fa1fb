"""Conical linkages built and moved in space, by none of the formulas that evaluate candidates."""

from __future__ import annotations

import numpy as np

from graphs.mechanism.surfaces import joint_axes
from synth.linkages.conformed.dihedrals import dihedral_angles


def turned(vector, axis, angle):
    """Rodrigues' rotation."""
    c, s = np.cos(angle), np.sin(angle)
    return c * vector + s * np.cross(axis, vector) + (1 - c) * np.dot(axis, vector) * axis


def closing_error(steps, angles, lam):
    """Walk round a loop by link angles and dihedral angles; return how far off the first axis and plane we end."""
    theta = dihedral_angles(steps, lam)
    start = joint_axes(np.cumsum([0.0, *steps[:-1]]), lam)
    axis = start[0]
    ahead = start[1] - np.dot(start[1], axis) * axis
    ahead /= np.linalg.norm(ahead)
    here, heading = axis, ahead
    for i in range(len(steps)):
        there = np.cos(angles[i]) * here + np.sin(angles[i]) * heading
        back = np.sin(angles[i]) * here - np.cos(angles[i]) * heading
        here, heading = there, turned(back, there, theta[(i + 1) % len(steps)])
    return max(np.abs(here - axis).max(), np.abs(heading - ahead).max())


class Space:
    """A linkage in space: unit axes, links as bodies that turn about the apex."""

    def __init__(self, chain, ground, places, lam):
        self.joints = list(chain.joints.items())
        self.links = list(chain)
        self.ground, self.lam = ground, lam
        self.axes = joint_axes(places, lam)
        self.paths = {ground: []}
        work, tree = [ground], set()
        while work:
            link = work.pop(0)
            for i, (_, (a, b)) in enumerate(self.joints):
                other = b if a == link else a
                if link in (a, b) and other not in self.paths:
                    self.paths[other] = [*self.paths[link], (i, 1 if link == a else -1)]
                    tree.add(i)
                    work.append(other)
        self.cuts = [i for i in range(len(self.joints)) if i not in tree]

    def rotation(self, link, q):
        """Rotation of a link from the conformed pose: joints turned by q, outermost last."""
        matrix = np.eye(3)
        for i, sign in self.paths[link]:
            matrix = matrix @ exponential(self.axes[i] * sign * q[i])
        return matrix

    def residual(self, q):
        """Rotation vectors that are left over at the joints that close the loops."""
        left = []
        for i in self.cuts:
            a, b = self.joints[i][1]
            gap = self.rotation(b, q).T @ self.rotation(a, q) @ exponential(self.axes[i] * q[i])
            left.append([gap[2, 1] - gap[1, 2], gap[0, 2] - gap[2, 0], gap[1, 0] - gap[0, 1]])
        return np.concatenate(left) / 2

    def jacobian(self):
        """Derivative of the residual at the conformed pose."""
        made = np.zeros((3 * len(self.cuts), len(self.joints)))
        for k, i in enumerate(self.cuts):
            a, b = self.joints[i][1]
            rows = slice(3 * k, 3 * k + 3)
            for link, factor in ((a, 1), (b, -1)):
                for j, sign in self.paths[link]:
                    made[rows, j] += factor * sign * self.axes[j]
            made[rows, i] += self.axes[i]
        return made

    def moved(self, q0):
        """Nearest q that closes."""
        q, inverse = q0.copy(), np.linalg.pinv(self.jacobian())
        for _ in range(30):
            error = self.residual(q)
            if np.abs(error).max() < 1e-14:
                break
            q -= inverse @ error
        return q, np.abs(self.residual(q)).max()

    def outward(self, link, azimuths, q):
        """How far outward of the cone points of a link are, that lay on it at some azimuths; radians."""
        e = joint_axes(np.asarray(azimuths), self.lam) @ self.rotation(link, q).T
        return self.lam - np.arctan2(-e[:, 1], np.hypot(e[:, 0], e[:, 2]))


def exponential(vector):
    """Rotation matrix of a rotation vector."""
    angle = np.linalg.norm(vector)
    x, y, z = vector
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    if angle < 1e-12:
        return np.eye(3) + cross
    return np.eye(3) + np.sin(angle) / angle * cross + (1 - np.cos(angle)) / angle**2 * cross @ cross
