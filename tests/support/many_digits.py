"""Loop sums to 60 digits, by an arithmetic of its own: links as arcs, not as reaches.

Balls of python-flint enclose every value; what they say of a sign is proved for the link angles or lengths as
floats.
"""

from __future__ import annotations

from math import fsum

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


def data_rounding(links, lam):
    """How far half a last digit of each link takes a loop sum on a cone, to first order."""
    told = []
    for link in links:
        step = float(span(link, lam).mid())
        told.append(0.5 * np.spacing(link) * np.cos(link / 2) / (float(lam.mid().cos()) * np.cos(step / 2)))
    return fsum(told)


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
