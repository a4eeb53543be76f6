"""Impacts: a ball that bounces to rest, and Newton's cradle.

Slides S10–S12; lectures/05_contact.md.
"""

import math

import numpy as np

from ..shapes import Disc, Sphere
from .case import GRAVITY, Case, position_error, positive
from .ground import Ground, counted, speed_error
from .upright import Upright

LAWS = ("sequential", "newton")


def bounce(restitution=0.5, height=1.0, dimension=2, duration=2.0):
    """A ball dropped from ``height``; the error is the largest of its position, relative to that height."""
    positive(restitution=restitution, height=height, duration=duration)
    if restitution > 1:
        raise ValueError(f"restitution must be at most 1, but is {restitution!r}")
    plane, radius = Ground(dimension), 0.1
    plane.ball(radius, (0.0, height + radius), restitution=restitution)

    def exact(t):
        z, v = flight(t, height, restitution)
        rest = 0 * z
        place, speed = np.stack([rest, radius + z], axis=1), np.stack([rest, v], axis=1)
        return plane.moving(place, rest, speed, rest)

    return Case(
        "bounce",
        plane.scene,
        duration,
        exact,
        position_error(height),
        "of the height",
        "Newton's law of impact: flights e times as long each, a geometric series, so it is at rest after "
        "(1 + e)/(1 − e) √(2h/g), 1.354571 s for e = ½ and h = 1 m.",
        "Infinitely many impacts in finite time; then rest, without a jitter.",
    )


def flight(t, height, e):
    """Height and speed (T,) of a point that falls from rest and keeps e of its speed at each impact."""
    first = math.sqrt(2 * height / GRAVITY)
    z, v = height - 0.5 * GRAVITY * t**2, -GRAVITY * t
    start, up = first, e * GRAVITY * first
    while start < t.max() and up > 1e-12 * GRAVITY * first:
        now = t >= start
        s = t[now] - start
        z[now], v[now] = up * s - 0.5 * GRAVITY * s**2, up - GRAVITY * s
        start, up = start + 2 * up / GRAVITY, e * up
    z[t >= start], v[t >= start] = 0.0, 0.0
    return z, v


def cradle(n=5, incoming=1, law="sequential", dimension=2, duration=0.5):
    """n equal balls in a row that touch, ``incoming`` of them moving at 1 m/s; e = 1, no friction.

    Run it with ``impact=law``. "sequential": one pair after the other, as many go out as came in; "newton":
    all at once, for three balls with one coming in. The error is that of the velocities, m/s.
    """
    counted(n=n, incoming=incoming)
    positive(duration=duration)
    if law not in LAWS:
        raise ValueError(f"law must be one of {', '.join(LAWS)}, but is {law!r}")
    if incoming >= n or (law == "newton" and (n, incoming) != (3, 1)):
        raise ValueError(
            "incoming must be less than n, and under the law 'newton' n = 3 and incoming = 1, but they are "
            f"{n} and {incoming}"
        )
    row = Upright(dimension, gravity=0.0)
    into = (np.arange(n) < incoming).astype(float)
    out = into[::-1] if law == "sequential" else np.array([-1.0, 2.0, 2.0]) / 3
    for i in range(n):
        velocity = row.vector((into[i], 0.0))
        place = row.vector((float(i), 0.0))
        row.scene.add(_ball(dimension), position=place, velocity=velocity, friction=0, restitution=1.0)

    def exact(t):
        now = np.where(t[:, None] > 0, out, into)
        along, rest = np.arange(n) + t[:, None] * out, np.zeros((len(t), n))
        return row.motion(np.stack([along, rest], axis=-1), rest, np.stack([now, rest], axis=-1), rest)

    return Case(
        "cradle",
        row.scene,
        duration,
        exact,
        speed_error(1.0),
        "of the speed",
        "Momentum and energy, pair by pair (sequential); w⁺ = −w⁻ at all contacts at once (newton): Glocker, "
        "Set-Valued Force Laws (2001); Nguyen & Brogliato, Multiple Impacts in Dissipative Granular Chains "
        "(2014).",
        "Balls that touch: the answer depends on the order in which impacts are dealt with, not on forces.",
    )


def _ball(dimension):
    return Disc(0.5) if dimension == 2 else Sphere(0.5)
