"""A rod on its tip in which friction jams, and a block that rocks from corner to corner.

Slides S11, S12; lectures/05_contact.md.
"""

import math

import numpy as np
from scipy.integrate import quad

from ..shapes import Polygon
from .case import GRAVITY, Case, attitude_error, positive
from .ground import Ground
from .integrated import Integrated

JAM, THIN = 10.0, 0.01  # m/s², m: gravity of Painlevé's rod, and half of what it is thick in its middle


def painleve(friction=2.0, duration=0.01):
    """A rod of 1 kg and 2 m, tan θ = 2, whose tip slides at 1 m/s: friction jams, and it stops.

    The error is that of ω at the end, relative. At one step of .01 s the velocity-level LCP says .637279.
    """
    positive(friction=friction, duration=duration)
    if friction < 2:
        raise ValueError(f"friction must be at least 2, or the tip goes on sliding, but is {friction!r}")
    plane, c, s = Ground(2), 1 / math.sqrt(5), 2 / math.sqrt(5)  # of θ
    plane.scene.gravity = np.array([0.0, -JAM])
    tilt = math.atan2(s, c)
    rod = Polygon([(-1, 0), (0, -THIN), (1, 0), (0, THIN)])  # its tip is a corner
    plane.scene.add(
        rod, position=(c, s), orientation=tilt, velocity=(-1.0, 0.0), inertia=1 / 3, friction=friction
    )
    start = np.array([tilt, 0.75 * s])  # angular momentum about the tip is kept: ω = m v a sin θ / (4/3 m a²)
    solution = Integrated(lambda y: np.array([y[1], -0.75 * JAM * np.cos(y[0])]), start)

    def exact(t):
        φ, ω = solution(t).T
        e, across = np.stack([np.cos(φ), np.sin(φ)], axis=1), np.stack([-np.sin(φ), np.cos(φ)], axis=1)
        return plane.moving(e, φ, ω[:, None] * across, ω)

    return Case(
        "painleve",
        plane.scene,
        duration,
        exact,
        lambda run, motion: abs(run.angular_velocity[-1, 1] / motion.angular_velocity[-1, 1] - 1),
        "of ω",
        "Stewart & Trinkle, Int. J. Numer. Methods Eng. 39 (1996) 2673: at the level of velocities the tip "
        "stops at once, by an impact without collision; then the rod turns about it.",
        "At the level of accelerations the LCP has no solution (Painlevé 1895).",
    )


def rocking_block(tilt=0.1, half_width=0.25, half_height=1.0, duration=1.0):
    """A block let go on one corner, that lands and goes on over the other. The error is that of its angle.

    Exact until it lands for the second time; friction keeps the corners from sliding.
    """
    positive(tilt=tilt, half_width=half_width, half_height=half_height, duration=duration)
    α, R = math.atan2(half_width, half_height), math.hypot(half_width, half_height)
    if tilt >= α:
        raise ValueError(f"tilt must be less than {α:.4g} rad, where the block falls over, but is {tilt!r}")
    plane, p2 = Ground(2), 0.75 * GRAVITY / R

    def centre(φ):  # from the corner that it stands on, which is at ∓half_width
        side = np.where(φ > 0, 1.0, -1.0)
        lean = α - np.abs(φ)
        return np.stack([side * (R * np.sin(lean) - half_width), R * np.cos(lean)], axis=-1)

    place = centre(np.array([tilt]))[0]
    plane.box(half_width, half_height, place, orientation=tilt, friction=1.0)
    down = Integrated(lambda y: np.array([y[1], -p2 * np.sin(α - y[0])]), (tilt, 0.0))
    landing = _landing(tilt, α, p2)
    rate = -math.sqrt(2 * p2 * (math.cos(α - tilt) - math.cos(α))) * (1 - 1.5 * math.sin(α) ** 2)
    beyond = Integrated(lambda y: np.array([y[1], p2 * np.sin(α + y[0])]), (0.0, rate))

    def exact(t):
        before, after = down(np.minimum(t, landing)), beyond(np.maximum(t - landing, 0))
        φ, ω = np.where(t[:, None] < landing, before, after).T
        side = np.where(φ > 0, 1.0, -1.0)
        lean = α - np.abs(φ)
        speed = R * ω[:, None] * np.stack([-np.cos(lean), side * np.sin(lean)], axis=-1)
        return plane.moving(centre(φ), φ, speed, ω)

    return Case(
        "rocking_block",
        plane.scene,
        duration,
        exact,
        attitude_error,
        "rad",
        "Housner, Bull. Seismol. Soc. Am. 53 (1963) 403: about each corner an inverted pendulum; an impact "
        "leaves 1 − (3/2) sin²α of ω, by angular momentum about the new corner.",
        "The corner that was stood on must let go as the other lands, within one impact.",
    )


def _landing(tilt, α, p2):
    """When the block lands, s: ∫ dφ/|ω| from 0 to the tilt; φ = tilt − s² rids it of the root at rest."""

    def slowness(s):
        φ = tilt - s * s
        drop = 2 * math.sin(0.5 * s * s) * math.sin(α - tilt + 0.5 * s * s)  # cos(α − tilt) − cos(α − φ)
        return 2 * s / math.sqrt(2 * p2 * drop) if s else 2 / math.sqrt(2 * p2 * math.sin(α - tilt)) + 0 * φ

    return quad(slowness, 0.0, math.sqrt(tilt), epsabs=1e-14, epsrel=1e-13)[0]
