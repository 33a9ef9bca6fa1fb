"""Loop sums to 60 digits, by an arithmetic of its own: links as arcs, not as reaches.

Balls of python-flint enclose every value; what they say of a sign is proved for the link angles or lengths as
floats.
"""

from __future__ import annotations

import flint
import numpy as np

DIGITS = 60


def span(link, lam, planar=False):
    """Projected angle of a link, as a ball: on the cone of angle lam, or on the cylinder of radius lam."""
    half = flint.arb(float(link)) / 2
    chord = half / lam if planar else half.sin() / lam.cos()
    return 2 * chord.asin()


def over(links, signs, turns, size, planar=False):
    """Loop sum less 360 k degrees at a size: a lambda or a radius."""
    total = sum((int(s) * span(x, size, planar) for s, x in zip(signs, links, strict=True)), flint.arb(0))
    return total - 2 * turns * flint.arb.pi()


def at_most(size, links, planar=False):
    """Whether every link fits."""
    least = flint.arb(float(max(links))) / 2
    return bool(size >= least) if planar else bool(flint.arb.pi() / 2 - size >= least)


def root(links, signs, turns, low, high, planar=False):
    """The size between two, at which the loop sum has proved different signs, to 50 digits; None if it has not."""
    ends = over(links, signs, turns, low, planar), over(links, signs, turns, high, planar)
    if not (ends[0] * ends[1] < 0):
        return None
    rising = bool(ends[1] > 0)
    for _ in range(160):
        middle = ((low + high) / 2).mid()
        value = over(links, signs, turns, middle, planar)
        if not (value > 0 or value < 0):
            break
        low, high = (low, middle) if bool(value > 0) == rising else (middle, high)
    return low


def loop_on_a_cone(rng, links, lam, spread):
    """Link angles, rounded to floats, of joints at random on an arc round a cone, and the signs and k of their loop."""
    places = rng.uniform(-spread, spread, links)
    steps = np.remainder(np.roll(places, -1) - places + np.pi, 2 * np.pi) - np.pi
    turns = round(float(steps.sum()) / (2 * np.pi))
    last = -(sum((flint.arb(float(x)) for x in steps[:-1]), flint.arb(0)) - 2 * turns * flint.arb.pi())
    exact = [flint.arb(float(x)) for x in steps[:-1]] + [last]
    tilt = flint.arb(float(lam)).cos()
    angles = [float((2 * (tilt * (abs(step) / 2).sin()).asin()).mid()) for step in exact]
    signs = np.array([1 if float(step.mid()) > 0 else -1 for step in exact])
    mirror = signs[0]
    return np.array(angles), tuple((signs * mirror).tolist()), int(turns * mirror)


def signed_sums(angles):
    """Sums of four link angles with signs, and of all less a turn, exactly, then as floats."""
    patterns = [
        (1, 1, 1, -1),
        (1, 1, -1, 1),
        (1, 1, -1, -1),
        (1, -1, 1, 1),
        (1, -1, 1, -1),
        (1, -1, -1, 1),
        (1, -1, -1, -1),
    ]
    sums = [sum(s * flint.arb(float(x)) for s, x in zip(signs, angles, strict=True)) for signs in patterns]
    sums.append(sum(flint.arb(float(x)) for x in angles) - 2 * flint.arb.pi())
    return np.array([float(one.mid()) for one in sums])


def crossed_cone(angles):
    """The crossed cone of a four-bar in closed form (docs/theory/mapping.md), as a ball; None if there is none."""
    half = [flint.arb(float(angle)) / 2 for angle in angles]
    x, y, z, w = half
    middle = sum(half, flint.arb(0)) / 2
    product = middle.sin()
    for angle in half:
        product *= (middle - angle).cos()
    for pair in (x + y - z - w, x + z - y - w, y + z - x - w):
        product *= (pair / 2).sin()
    a, b, c, d = (2 * angle.sin() for angle in half)
    numerator = (a * b - c * d) * (a * c - b * d) * (b * c - a * d)
    if not (numerator > 0 and product >= 0):
        return None
    return (256 * product / numerator).sqrt().atan()
