"""Friction on the ground: a block that sticks or slides, a ball that slides until it rolls, a spinning disc.

Slides S11, S12, S17; lectures/05_contact.md.
"""

import math

import numpy as np

from ..shapes import Plane
from .case import GRAVITY, Case, attitude_error, position_error, positive
from .ground import Ground, speed_error, standing

G = GRAVITY


def slope(share=1.005, angle=math.pi / 6, dimension=2, duration=3.0):
    """A cube of 1 m on a slope; its friction is ``share`` times tan(angle), what it needs to stick.

    The error is the creep, m, where it sticks, and relative to the distance where it slides.
    """
    positive(share=share, angle=angle, duration=duration)
    if angle >= math.pi / 4:
        raise ValueError(f"angle must be less than π/4, where a cube tips over, but is {angle!r}")
    plane = Ground(dimension, slope=angle)
    plane.box(0.5, 0.5, (0.0, 0.5), friction=share * math.tan(angle))
    rate = G * math.sin(angle) * max(0.0, 1 - share)

    def exact(t):
        way, rest = 0.5 * rate * t**2, 0 * t
        place = np.stack([way, rest + 0.5], axis=1)
        return plane.moving(place, rest, np.stack([rate * t, rest], axis=1), rest)

    return Case(
        "slope",
        plane.scene,
        duration,
        exact,
        position_error(0.5 * rate * duration**2 or 1.0),
        "of the distance" if rate else "m",
        "Coulomb: it sticks if μ ≥ tan θ; else it slides by ½ g (sin θ − μ cos θ) t².",
        "Rest must be rest: whatever slips a little each step creeps.",
    )


def rolling(speed=2.0, friction=0.3, radius=0.3, dimension=2, duration=1.0):
    """A disc, in space a sphere, that is set down sliding at ``speed``. The error: of the final speed."""
    positive(speed=speed, friction=friction, radius=radius, duration=duration)
    plane = Ground(dimension)
    plane.ball(radius, (0.0, radius), velocity=plane.vector((speed, 0.0)), friction=friction)
    k = 1 / 2 if dimension == 2 else 2 / 5  # moment of inertia / (m r²)
    rolls = speed / (friction * G * (1 + 1 / k))  # when friction has made the slip vanish

    def exact(t):
        s, rest = np.minimum(t, rolls), 0 * t
        v = speed - friction * G * s
        way = speed * s - 0.5 * friction * G * s**2 + v * (t - s)
        ω = -friction * G * s / (k * radius)
        φ = 0.5 * ω * s + ω * (t - s)
        place = np.stack([way, rest + radius], axis=1)
        return plane.moving(place, φ, np.stack([v, rest], axis=1), ω)

    return Case(
        "rolling",
        plane.scene,
        duration,
        exact,
        speed_error(speed),
        "of the speed",
        "Angular momentum about a point of the ground is kept: 1/(1 + I/m r²) of the speed is left, 2/3 for "
        "a disc, 5/7 for a sphere, whatever μ (Goldstein, Classical Mechanics, 1980, chapter 5).",
        "Sliding turns to rolling within a step, and from then on friction is 0.",
    )


def descent(share=1.1, angle=0.4, radius=0.3, dimension=2, duration=1.0):
    """A disc, in space a sphere, let go on a slope; its friction is ``share`` of what rolling needs.

    The error is that of velocity and spin (times the radius) at the end, relative to the speed.
    """
    positive(share=share, angle=angle, radius=radius, duration=duration)
    if angle >= math.pi / 2:
        raise ValueError(f"angle must be less than π/2, but is {angle!r}")
    plane = Ground(dimension, slope=angle)
    k = 1 / 2 if dimension == 2 else 2 / 5  # moment of inertia / (m r²)
    needed = k / (1 + k) * math.tan(angle)
    plane.ball(radius, (0.0, radius), friction=share * needed)
    held = min(share, 1.0) * needed * math.cos(angle)  # friction / (m g)
    a, α = G * (math.sin(angle) - held), -G * held / (k * radius)

    def exact(t):
        rest = 0 * t
        place, speed = np.stack([0.5 * a * t**2, rest + radius], axis=1), np.stack([a * t, rest], axis=1)
        return plane.moving(place, 0.5 * α * t**2, speed, α * t)

    def measure(run, motion):
        off = np.linalg.norm(run.velocity[-1, 1] - motion.velocity[-1, 1])
        turns = np.linalg.norm(run.angular_velocity[-1, 1] - motion.angular_velocity[-1, 1])
        return (off + radius * turns) / (a * duration)

    return Case(
        "descent",
        plane.scene,
        duration,
        exact,
        measure,
        "of the speed",
        "Rolling takes friction of I/(I + m r²) m g sin θ: it does not slip if μ ≥ ⅓ tan θ (disc), 2/7 tan θ "
        "(sphere); else it slips, by Coulomb's law (Goldstein, Classical Mechanics, 1980, chapter 5).",
        "Static friction below its limit must be found, not set to μ N.",
    )


def pulled_block(share=1.02, direction=0.7, duration=1.0):
    """A cube of 1 m and 1 kg, μ = ½, pulled over level ground along ``direction``, rad, in space.

    share: the pull over what friction bears, m g/2. The error: m where it sticks, else of the distance.
    """
    positive(share=share, duration=duration)
    plane = Ground(3)
    plane.box(0.5, 0.5, (0.0, 0.5), friction=0.5)
    along, rate = np.array([math.cos(direction), math.sin(direction), 0.0]), 0.5 * G * max(0.0, share - 1)
    force = np.stack([0 * along, 0.5 * G * share * along])
    plane.scene.force(lambda t, state: (force, np.zeros_like(force)))

    def exact(t):
        still = standing(plane.scene)(t)
        way, speed = np.zeros((len(t), 2, 3)), np.zeros((len(t), 2, 3))
        way[:, 1], speed[:, 1] = 0.5 * rate * t[:, None] ** 2 * along, rate * t[:, None] * along
        return still._replace(position=still.position + way, velocity=speed)

    return Case(
        "pulled_block",
        plane.scene,
        duration,
        exact,
        position_error(0.5 * rate * duration**2 or 1.0),
        "of the distance" if rate else "m",
        "Coulomb: friction is at most μ N in every direction, and opposed to the slip.",
        "A pyramid inscribed in the cone bears as little as 1/√2 of it aslant, a box √2 times as much.",
    )


def spinning_disc(spin=20.0, friction=0.3, radius=0.2, duration=None):
    """A spinning disc set down in a corner, touching floor and wall. The error is that of its angle, rad."""
    positive(spin=spin, friction=friction, radius=radius)
    plane, μ = Ground(2), friction
    plane.scene.add(Plane((1.0, 0.0)), friction=1.0)
    plane.ball(radius, (radius, radius), angular_velocity=spin, friction=μ)
    brake = 2 * μ * (1 + μ) * G / ((1 + μ**2) * radius)  # rad/s²
    stops = spin / brake
    duration = round(1.5 * stops, 1) + 0.1 if duration is None else duration

    def exact(t):
        s, rest = np.minimum(t, stops), np.zeros((len(t), 3))
        φ, ω, place = rest.copy(), rest.copy(), np.zeros((len(t), 3, 2))
        φ[:, 2], ω[:, 2], place[:, 2] = spin * s - 0.5 * brake * s**2, spin - brake * s, radius
        return plane.motion(place, φ, 0 * place, ω)

    return Case(
        "spinning_disc",
        plane.scene,
        duration,
        exact,
        attitude_error,
        "rad",
        "Irodov, Problems in General Physics (1981), 1.254: N_floor = m g/(1 + μ²), N_wall = μ N_floor, so "
        "it stops after ω₀ r (1 + μ²)/(2 μ (1 + μ) g), in (1 + μ²) ω₀² r/(8π μ (1 + μ) g) turns.",
        "Two sliding contacts that need each other's force; then it must stop, and stay.",
    )
