"""Spherical four-bars through configurations in closed form: nothing here is shared with the walk of `synth.analysis.motion`.

The crank turns about A and carries B, the follower about D and carries C; arcs BC and CD are rigid. At a crank angle
the triangle B, C, D has two mirror images, told apart by the sign of det(B, C, D), and none where the arc BD is outside
the limits of the triangle. So a motion stays on one branch as long as BD stays strictly between these.
"""

import numpy as np
from scipy.spatial.transform import Rotation

GRID = 2001
"""Crank angles that are looked at between two configurations."""


def arc(one, other):
    return np.arctan2(np.linalg.norm(np.cross(one, other)), one @ other)


def turns_in_order(values, sense):
    """Crank angles as they are passed in one sense; None if that takes more than a turn."""
    steps = np.remainder(sense * np.diff(values), 2.0 * np.pi)
    return None if steps.sum() > 2.0 * np.pi else values[0] + sense * np.concatenate([[0.0], np.cumsum(steps)])


def takes_in_order(crank, follower, motions):
    """Whether one of the two senses takes a four-bar through configurations on one branch.

    `crank` and `follower` are the axes (A, B) and (D, C) at the first configuration, `motions` the rotations of both
    links at each: float[K, 3, 3].
    """
    (a, b), (d, c) = crank, follower
    across = np.cross(a, b)
    places = motions[0] @ b
    values = np.arctan2(places @ across, places @ np.cross(across, a))
    modes = [
        np.sign(np.linalg.det([b_there, c_there, d])) for b_there, c_there in zip(places, motions[1] @ c, strict=True)
    ]
    least, most = abs(arc(b, c) - arc(c, d)), np.pi - abs(np.pi - arc(b, c) - arc(c, d))
    for sense in (1, -1):
        goals = turns_in_order(values, sense)
        if goals is None or len(set(modes)) > 1:
            continue
        way = np.interp(np.linspace(0, len(goals) - 1, GRID * (len(goals) - 1)), np.arange(len(goals)), goals)
        on_the_way = Rotation.from_rotvec((way - values[0])[:, None] * a).apply(b)
        arcs = np.array([arc(one, d) for one in on_the_way])
        if (arcs > least).all() and (arcs < most).all():
            return True
    return False
