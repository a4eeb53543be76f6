"""Linkages in a plane with one degree of freedom: four-bar linkage, slider-crank, N four-bars.

Slides S5, S9; lectures/04_embedding.md. Source: Norton, Design of Machinery (2012), chapter 4, for the loop
equations; González, Dopico, Lugrís & Cuadrado, Multibody Syst. Dyn. 16 (2006) 179, for the N four-bars.
"""

import numpy as np

from .. import inputs
from .bars import BarMotion, Bars
from .case import GRAVITY, Case, position_error, positive
from .swing import Swing
from .upright import Upright, bar_inertia


def four_bar(dimension=2, speed=4.0, lengths=(0.5, 1.5, 1.2, 1.6), duration=4.0):
    """A crank turns and a rocker rocks, joined by a coupler. Error: distance over the crank's length.

    lengths: of crank a, coupler b, rocker c and ground d, m, such that the crank can go round (Grashof).
    speed: of the crank at the start, where it stands upright, rad/s. 1 kg per metre.
    """
    a, b, c, d = inputs.array("lengths", lengths, (4,))
    positive(lengths=min(a, b, c, d), duration=duration)
    if max(d - a, a + d) >= b + c or abs(b - c) >= d - a:
        raise ValueError(
            "lengths must let the crank go round, |b − c| < d − a and d + a < b + c, but are "
            f"{tuple(lengths)!r}"
        )

    def angles(q):
        q = np.asarray(q)
        u = np.exp(1j * q)
        reach = d - a * u  # from the crank's end to the rocker's pivot
        r = np.abs(reach)
        θ = np.angle(reach) + np.arccos((b**2 + r**2 - c**2) / (2 * b * r))
        ψ = np.angle(a * u + b * np.exp(1j * θ) - d)
        # a u + b e^{iθ} = d + c e^{iψ}, once and twice by q: two real equations for θ', ψ', then θ'', ψ''
        e, f = b * np.exp(1j * θ), c * np.exp(1j * ψ)
        dθ, dψ = _two(1j * e, -1j * f, -1j * a * u)
        ddθ, ddψ = _two(1j * e, -1j * f, a * u + e * dθ**2 - f * dψ**2)
        return (
            np.stack([q, θ, np.unwrap(ψ) if np.ndim(ψ) else ψ], axis=-1),
            np.stack([np.ones_like(q), dθ, dψ], axis=-1),
            np.stack([np.zeros_like(q), ddθ, ddψ], axis=-1),
        )

    plane, sizes = Upright(dimension), np.array([a, b, c])
    C = np.array([[a / 2, 0, 0], [a, b / 2, 0], [0, 0, c / 2]])
    bars = Bars(sizes, bar_inertia(sizes, sizes), np.array([0, 0, d], dtype=complex), C)
    exact = BarMotion(plane, bars, angles, np.pi / 2, speed)
    crank, coupler, rocker = _add(plane, sizes, bars, exact, np.pi / 2, speed)
    tip = np.exp(1j * angles(np.pi / 2)[0]) * sizes
    plane.join("hinge", crank, None, (0.0, 0.0))
    plane.join("hinge", crank, coupler, _point(tip[0]))
    plane.join("hinge", coupler, rocker, _point(tip[0] + tip[1]))
    plane.join("hinge", rocker, None, (d, 0.0))
    return Case(
        "four_bar",
        plane.scene,
        duration,
        exact,
        position_error(a),
        "relative to the crank",
        "loop equation (Norton, chapter 4) and one equation of motion, DOP853 to 1e-13",
        "A closed loop: no tree. In space four hinges have 20 rows for 17 motions: three are redundant.",
    )


def slider_crank(dimension=2, speed=8.0, crank=0.5, rod=1.2, duration=4.0):
    """A crank drives a slider along the x axis through a rod. Error: distance over the crank's length.

    speed: of the crank at the start, where it stands upright, rad/s; crank, rod: lengths, m, rod > crank.
    Bars have 1 kg per metre, the slider 1 kg.
    """
    positive(crank=crank, rod=rod, duration=duration)
    if rod <= crank:
        raise ValueError(f"rod must be longer than the crank, {crank:g} m, but is {rod!r}")

    def angles(q):
        q = np.asarray(q)
        θ = -np.arcsin(crank / rod * np.sin(q))  # crank sin q + rod sin θ = 0, and its derivatives
        dθ = -crank * np.cos(q) / (rod * np.cos(θ))
        ddθ = (crank * np.sin(q) / rod + np.sin(θ) * dθ**2) / np.cos(θ)
        zero = np.zeros_like(q)
        return (
            np.stack([q, θ, zero], axis=-1),
            np.stack([zero + 1, dθ, zero], axis=-1),
            np.stack([zero, ddθ, zero], axis=-1),
        )

    plane, size = Upright(dimension), 0.3  # m, the slider's length
    masses, lengths = np.array([crank, rod, 1.0]), np.array([crank, rod, size])
    C = np.array([[crank / 2, 0, 0], [crank, rod / 2, 0], [crank, rod, 0]])
    bars = Bars(masses, bar_inertia(masses, lengths), np.zeros(3, dtype=complex), C)
    exact = BarMotion(plane, bars, angles, np.pi / 2, speed)
    turning, pushing, slider = _add(plane, lengths, bars, exact, np.pi / 2, speed)
    plane.join("hinge", turning, None, (0.0, 0.0))
    plane.join("hinge", turning, pushing, (0.0, crank))
    plane.join("hinge", pushing, slider, (np.sqrt(rod**2 - crank**2), 0.0))
    plane.slide(slider, None, (1.0, 0.0))
    return Case(
        "slider_crank",
        plane.scene,
        duration,
        exact,
        position_error(crank),
        "relative to the crank",
        "loop equation in closed form and one equation of motion, DOP853 to 1e-13",
        "A loop with a slider: turning and pushing meet, with units rad and m in one J.",
    )


def n_four_bars(n=4, dimension=2, speed=1.0, duration=10.0):
    """n square windows side by side, upright: n + 1 bars on the ground, n across. Error: over a bar's length.

    All bars have 1 m and 1 kg; speed: of the bars across at the start, m/s, not 0. As the ground bars stay
    parallel the bars across only move along, and all is one pendulum that goes round.
    """
    n = inputs.whole("n", n, least=1)
    positive(speed=speed, duration=duration)
    plane = Upright(dimension)
    exact = _Windows(plane, n, speed)
    place, φ, velocity, ω = (value[0] for value in exact.state(np.zeros(1)))
    for k in range(2 * n + 1):
        plane.bar(1.0, 1.0, place[k], φ[k], velocity[k], ω[k])
    for k in range(n + 1):
        plane.join("hinge", k, None, (k, 0.0))
        for across in (n + k, n + 1 + k)[k == 0 : 2 - (k == n)]:
            plane.join("hinge", k, across, (k, 1.0))
    return Case(
        "n_four_bars",
        plane.scene,
        duration,
        exact,
        position_error(1.0),
        "relative to a bar",
        "IFToMM benchmark; as one pendulum, Digital Library of Mathematical Functions, 22.19",
        "Twice a turn all bars lie in one line: J loses rank, and a window could fold over instead.",
    )


class _Windows:
    """The Motion of n windows: bars 0 … n stand on the ground at x = 0 … n, n + 1 … 2n lie across."""

    def __init__(self, plane, n, speed):
        self.plane, self.n = plane, n
        inertia = (n + 1) * (bar_inertia(1.0, 1.0) + 0.25) + n  # of q̇²/2
        self.swing = Swing(np.sqrt(GRAVITY * ((n + 1) / 2 + n) / inertia), np.pi, -speed)

    def state(self, time):
        """Centres (T, 2n + 1, 2), angles (T, 2n + 1), and their rates."""
        θ, rate = self.swing(time)
        q, n = θ - np.pi / 2, self.n  # the bars' angle from the horizontal
        out = np.stack([np.cos(q), np.sin(q)], axis=-1)[:, None]
        across = rate[:, None, None] * np.stack([-np.sin(q), np.cos(q)], axis=-1)[:, None]
        share = np.array([0.5] * (n + 1) + [1.0] * n)[:, None]
        foot = np.array([*range(n + 1), *(k + 0.5 for k in range(n))], dtype=float)
        turns = np.array([1.0] * (n + 1) + [0.0] * n)
        place = share * out + np.stack([foot, 0 * foot], axis=-1)
        return place, turns * q[:, None], share * across, turns * rate[:, None]

    def __call__(self, time):
        return self.plane.motion(*self.state(np.asarray(time, dtype=float)))


def _add(plane, lengths, bars, exact, q, speed):
    """The bars of a BarMotion at its start; returns their numbers."""
    place, φ, velocity, ω = exact.state(np.array(q), np.array(speed))
    return [
        plane.bar(lengths[k], bars.masses[k], place[k], φ[k], velocity[k], ω[k]) for k in range(len(lengths))
    ]


def _two(p, q, r):
    """Real s and t with s p + t q = r, all complex."""
    s = np.imag(r * np.conj(q)) / np.imag(p * np.conj(q))
    return s, np.imag(r * np.conj(p)) / np.imag(q * np.conj(p))


def _point(z):
    return z.real, z.imag
