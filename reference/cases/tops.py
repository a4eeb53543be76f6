"""Tops: the free one that turns over, and the heavy one that precesses.

Slides S4, S9; lectures/02_equation_of_motion.md. Source: Landau & Lifshitz, Mechanics (1976), sections 35–37;
Goldstein, Classical Mechanics (1980), section 5-7.
"""

import numpy as np

from ..rotation import multiply, over_arrays
from ..scene import Scene
from ..shapes import Sphere
from .case import Case, Motion, attitude_error, positive
from .free_top import FreeTop


def torque_free_top(inertia=(1.0, 2.0, 3.0), rates=(0.01, 1.0, 0.0), duration=42.0):
    """A body spun about almost its middle axis: it turns over, and back (Dzhanibekov). Error: attitude, rad.

    inertia: principal moments (3,), kg m²; rates: angular velocity at the start, body frame, rad/s. With the
    values given the body-frame rates return after 41.50921953 s; ``case.exact.period`` is that time.
    """
    positive(duration=duration)
    top = FreeTop(inertia, rates)
    scene = Scene(gravity=(0, 0, 0))
    scene.add(Sphere(0.5), mass=1.0, inertia=inertia, angular_velocity=rates)
    return Case(
        "torque_free_top",
        scene,
        duration,
        _Turning(top),
        attitude_error,
        "rad",
        "Landau & Lifshitz, Mechanics, section 37; period 4 K(m) / p",
        "Spin about the middle axis is unstable: an early error grows a hundredfold before the first flip.",
    )


class _Turning:
    """The Motion of a ``top`` that only turns: it has attitude(t), angular_velocity(t) and a period."""

    def __init__(self, top):
        self.top, self.period = top, top.period

    def __call__(self, time):
        still = np.zeros((*np.shape(time), 1, 3))
        return Motion(
            still, self.top.attitude(time)[..., None, :], still, self.top.angular_velocity(time)[..., None, :]
        )


ACROSS, ALONG = 0.08, 0.03  # of the heavy top about its tip: I₁ and I₃, kg m²
WEIGHT, ARM, HEIGHT = 9.81, 0.25, 2.0  # m g, N; l, m, from the tip to the centre of mass; H, m, see heavy_top


def heavy_top(tilt=0.6, spin=30.0, duration=2.0, fast=False):
    """A symmetric top on a fixed tip, precessing steadily at a tilt from the vertical. Error: attitude, rad.

    tilt: θ, rad; spin: ω₃ about the top's axis, rad/s; fast: the faster of the two steady precessions.

    **How it is written without a joint.** About a fixed point, too, I ω̇ + ω × I ω = torque, with the inertia
    about that point. So the tip is the body's reference point, at rest at the origin, with the inertia about
    the tip. The torque of the weight is that of two springs of no length at rest, stiffness k, from the
    points ±l e₃ of the body to the points ∓H ẑ of the world. Each pulls by k times the distance between its
    ends; with 2 k H = m g,

        force   k (−H ẑ − l e₃) + k (H ẑ + l e₃) = 0,
        torque  2 k l e₃ × (−H ẑ) = l e₃ × (−m g ẑ).

    Their energy is m g l cos θ and a constant. There is no gravity in the scene, and nothing moves the tip.
    """
    positive(spin=spin, duration=duration)
    if not 0 < tilt < np.pi / 2:
        raise ValueError(f"tilt must lie between 0 and π/2, but is {tilt!r}")
    top = SteadyPrecession(tilt, spin, _steady_rate(tilt, spin, fast))
    scene = Scene(gravity=(0, 0, 0))
    start = {"orientation": top.attitude(0.0), "angular_velocity": top.angular_velocity(0.0)}
    body = scene.add(Sphere(0.2), mass=1.0, inertia=(ACROSS, ACROSS, ALONG), **start)
    axis = np.array([0.0, -np.sin(tilt), np.cos(tilt)])  # e₃ at the start
    for side in (1.0, -1.0):
        ends = {"point_a": side * ARM * axis, "point_b": (0, 0, -side * HEIGHT)}
        scene.spring(body, None, WEIGHT / (2 * HEIGHT), length=0, **ends)
    return Case(
        "heavy_top",
        scene,
        duration,
        _Turning(top),
        attitude_error,
        "rad",
        "Goldstein, Classical Mechanics, section 5-7: steady precession",
        "Spin and precession differ many times in speed, and any error in the rates starts a nodding.",
    )


def _steady_rate(tilt, spin, fast):
    """Ω from I₁ cos θ Ω² − I₃ ω₃ Ω + m g l = 0: the smaller root, or the larger one for ``fast``."""
    momentum, moment = ALONG * spin, WEIGHT * ARM
    least = np.sqrt(4 * ACROSS * np.cos(tilt) * moment)
    if momentum < least:
        raise ValueError(
            f"spin must be at least {least / ALONG:.6g} rad/s to precess steadily at this tilt, but is {spin}"
        )
    root = np.sqrt(momentum**2 - least**2)
    return 2 * moment / (momentum - root if fast else momentum + root)


class SteadyPrecession:
    """A top at tilt θ that precesses about ẑ at Ω, ω₃ = ψ̇ + Ω cos θ: attitude R_z(Ω t) R_x(θ) R_z(ψ̇ t)."""

    def __init__(self, tilt, spin, precession):
        self.tilt, self.precession = tilt, precession
        self.own = spin - precession * np.cos(tilt)  # ψ̇
        self.period = 2 * np.pi / precession

    def attitude(self, time):
        """Quaternions (…, 4), body → world, at the times (…,)."""
        time, product = np.asarray(time, dtype=float), over_arrays(multiply)
        return product(product(turn(2, self.precession * time), turn(0, self.tilt)), turn(2, self.own * time))

    def angular_velocity(self, time):
        """Ω ẑ + ψ̇ e₃ in the world's frame, (…, 3), rad/s."""
        φ = self.precession * np.asarray(time, dtype=float)
        sin, cos = np.sin(self.tilt), np.cos(self.tilt)
        axis = np.stack([sin * np.sin(φ), -sin * np.cos(φ), cos * np.ones_like(φ)], axis=-1)
        return self.own * axis + np.array([0.0, 0.0, self.precession])


def turn(axis, angle):
    """The quaternion (…, 4) of a turn by ``angle``, rad, about a coordinate axis."""
    q = np.zeros((*np.shape(angle), 4))
    q[..., 0], q[..., 1 + axis] = np.cos(np.asarray(angle) / 2), np.sin(np.asarray(angle) / 2)
    return q
