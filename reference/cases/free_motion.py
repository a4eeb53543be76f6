"""Bodies in flight, with and without drag, and two masses on a spring.

The answers are the textbook solutions of m ẍ = m g − c ẋ and of the damped oscillator.

Slides S4, S9; lectures/02_equation_of_motion.md. Source: Landau & Lifshitz, Mechanics (1976), sections 25 and
13.
"""

import numpy as np

from ..scene import Scene
from ..shapes import Box, Point, Polygon
from .case import (
    GRAVITY,
    Case,
    Motion,
    at_rest,
    checked_dimension,
    flight_error,
    position_error,
    positive,
)
from .free_top import FreeTop


def _gravity(dimension):
    return np.array([0.0] * (dimension - 1) + [-GRAVITY])


def _columns(time):
    """Times (…,) made to broadcast against bodies and components: (…, 1, 1)."""
    return np.asarray(time, dtype=float)[..., None, None]


def free_fall(dimension=3, duration=2.0):
    """A point mass, thrown: x = x₀ + v₀ t + ½ g t². Error: distance over the depth ½ g T² fallen."""
    positive(duration=duration)
    g = _gravity(checked_dimension(dimension))
    start, speed = np.array([1.0, -2.0, 3.0])[-dimension:], np.array([2.0, 1.0, 4.0])[-dimension:]
    scene = Scene(gravity=g)
    scene.add(Point(), mass=2.0, position=start, velocity=speed)

    def exact(time):
        t = _columns(time)
        turned = at_rest(np.shape(t)[:-1], dimension)
        return Motion(start + speed * t + g * t**2 / 2, turned[0], speed + g * t, turned[1])

    return Case(
        "free_fall",
        scene,
        duration,
        exact,
        position_error(GRAVITY * duration**2 / 2),
        "relative to the fall",
        "Galilei; Landau & Lifshitz, Mechanics",
        "Nothing, for order 2 and above. The symplectic Eulers are off by ½ g T dt, on opposite sides.",
    )


def projectile_drag(dimension=3, drag=0.8, mass=2.0, duration=2.0):
    """A ball thrown against linear drag: v = v∞ + (v₀ − v∞) e^(−t/τ), with τ = m/c and v∞ = g τ.

    drag: c in N s/m. Error: distance over the length |v₀| T.
    """
    positive(drag=drag, mass=mass, duration=duration)
    g, τ = _gravity(checked_dimension(dimension)), mass / drag
    start, speed = np.zeros(dimension), np.array([5.0, 12.0, 9.0])[-dimension:]
    scene = Scene(gravity=g)
    scene.drag(scene.add(Point(), mass=mass, position=start, velocity=speed), drag)

    def exact(time):
        t = _columns(time)
        gone, final = -np.expm1(-t / τ), g * τ  # gone: the share of the first velocity that drag has taken
        turned = at_rest(np.shape(t)[:-1], dimension)
        position = start + final * t + (speed - final) * τ * gone
        return Motion(position, turned[0], speed + (final - speed) * gone, turned[1])

    return Case(
        "projectile_drag",
        scene,
        duration,
        exact,
        position_error(np.linalg.norm(speed) * duration),
        "relative to |v₀| T",
        "Landau & Lifshitz, Mechanics, section 25",
        "The force depends on the velocity, so a splitting must take care to stay of order 2.",
    )


def spring(dimension=3, stiffness=40.0, damping=0.0, length=1.0, stretch=0.25, duration=4.0):
    """Two masses on one spring, drifting: the distance swings with ω² = k/μ − γ², μ the reduced mass, γ =
    c/2μ.

    stiffness: N/m; damping: N s/m, below critical; length and stretch at the start: m. Error: distance over
    stretch.
    """
    positive(stiffness=stiffness, length=length, stretch=stretch, duration=duration)
    masses, drift = np.array([1.0, 3.0]), np.array([0.3, -0.2, 0.1])[-checked_dimension(dimension) :]
    μ = masses.prod() / masses.sum()
    γ = damping / (2 * μ)
    if not 0 <= γ**2 < stiffness / μ:
        raise ValueError(
            f"damping must be from 0 to below 2 √(k μ) = {2 * np.sqrt(stiffness * μ):g}, but is {damping!r}"
        )
    ω = np.sqrt(stiffness / μ - γ**2)
    axis = np.array([2.0, 1.0, 2.0])[-dimension:]
    axis /= np.linalg.norm(axis)
    share = np.array([-masses[1], masses[0]])[:, None] / masses.sum() * axis  # of the distance, for each mass
    scene = Scene(gravity=np.zeros(dimension))
    for mass, part in zip(masses, share, strict=True):
        scene.add(Point(), mass=mass, position=part * (length + stretch), velocity=drift)
    scene.spring(0, 1, stiffness, damping=damping, length=length)

    def exact(time):
        t = _columns(time)
        fade, cos, sin = stretch * np.exp(-γ * t), np.cos(ω * t), np.sin(ω * t)
        s, rate = fade * (cos + γ / ω * sin), -fade * (ω + γ**2 / ω) * sin
        turned = at_rest((*np.shape(t)[:-2], 2), dimension)
        return Motion(drift * t + share * (length + s), turned[0], drift + share * rate, turned[1])

    return Case(
        "spring",
        scene,
        duration,
        exact,
        position_error(stretch),
        "relative to the first stretch",
        "Landau & Lifshitz, Mechanics, sections 13 and 25",
        "Phase: the error grows with time. Explicit Euler gains energy in every swing.",
    )


def planar_flight(spin=7.0, duration=2.0):
    """A pentagon thrown spinning, in the plane: its centre on the parabola, its angle φ₀ + ω t. Error: see
    flight_error.

    spin: rad/s. The position error is relative to the depth ½ g T² fallen.
    """
    positive(duration=duration)
    g, start, speed, angle = _gravity(2), np.array([1.0, 2.0]), np.array([3.0, 8.0]), 0.4
    scene = Scene(gravity=g)
    pentagon = Polygon([(0.0, 0.0), (0.6, -0.1), (0.9, 0.4), (0.4, 0.8), (-0.1, 0.5)])
    scene.add(pentagon, mass=1.5, position=start, velocity=speed, orientation=angle, angular_velocity=spin)

    def exact(time):
        t = _columns(time)
        turn = angle + spin * t[..., 0]
        return Motion(start + speed * t + g * t**2 / 2, turn, speed + g * t, np.full_like(turn, spin))

    return Case(
        "planar_flight",
        scene,
        duration,
        exact,
        flight_error(GRAVITY * duration**2 / 2),
        "relative, and rad",
        "Landau & Lifshitz, Mechanics",
        "Nothing but speed: a step is a dozen multiplications, so what a call costs decides.",
    )


def tumbling_box(duration=2.0):
    """A box thrown tumbling, in space: parabola and torque-free top at once. Error: see flight_error."""
    positive(duration=duration)
    g, start, speed = _gravity(3), np.array([0.0, 0.0, 1.0]), np.array([2.0, -1.0, 9.0])
    box, mass, rates = Box((0.15, 0.25, 0.4)), 1.2, np.array([0.6, 5.0, 1.0])  # rates in the body's frame
    attitude = np.array([0.8, 0.4, -0.2, 0.4])
    top = FreeTop(np.diag(box.inertia(mass)), rates, attitude)
    scene = Scene(gravity=g)
    scene.add(
        box,
        mass=mass,
        position=start,
        velocity=speed,
        orientation=attitude,
        angular_velocity=top.angular_velocity(0.0),
    )

    def exact(time):
        t = _columns(time)
        return Motion(
            start + speed * t + g * t**2 / 2,
            top.attitude(time)[..., None, :],
            speed + g * t,
            top.angular_velocity(time)[..., None, :],
        )

    return Case(
        "tumbling_box",
        scene,
        duration,
        exact,
        flight_error(GRAVITY * duration**2 / 2),
        "relative, and rad",
        "Landau & Lifshitz, Mechanics, section 37",
        "The gyroscopic term: translation is exact at once, rotation is not.",
    )
