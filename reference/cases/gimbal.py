"""A gyroscope on a gimbal: two rings and a rotor, on three hinges, precessing and nodding.

Two angular momenta are kept: the rotor's about its axis, I_rotor,3 ω₃, and all of it about the vertical,

    p_φ = (I_outer,3 + (J + I_inner,3) sin² θ + I_inner,3 cos² θ) φ̇ + I_rotor,3 ω₃ cos θ,

with J = I_inner,2 + I_rotor,1 + m l² − I_inner,3. What is left is one equation, for the nodding:

    (I_inner,1 + I_rotor,1 + m l²) θ̈ = sin θ (J cos θ φ̇² − I_rotor,3 ω₃ φ̇ + m g l);

the precession is steady where its right-hand side is 0.

Slides S4, S5, S9; lectures/04_embedding.md. Source: Goldstein, Classical Mechanics (1980), section 5-7, to
which the rings' moments are added.
"""

import numpy as np

from .. import inputs
from ..joints import Hinge
from ..rotation import multiply, over_arrays
from ..scene import Scene
from ..shapes import Sphere
from .case import GRAVITY, Case, Motion, attitude_error, positive
from .integrated import Integrated
from .tops import turn

OUTER, INNER, ROTOR = (0.03, 0.03, 0.04), (0.02, 0.015, 0.015), (0.004, 0.004, 0.008)  # moments, kg m²
RING, DISC, ARM = 0.5, 1.0, 0.05  # kg, of a ring and of the rotor; m, from the centre to the rotor
J = INNER[1] + ROTOR[0] + DISC * ARM**2 - INNER[2]


def gimbal_gyroscope(tilt=1.0, spin=60.0, precession=None, duration=2.0):
    """A rotor off the centre of two rings precesses about the vertical. Error: of any attitude, rad.

    tilt: θ of the rotor's axis from the vertical at the start, rad; spin: ω₃ of the rotor about its axis,
    rad/s, all told. precession: Ω of the outer ring at the start, rad/s; None: the slower steady one; with
    any other it nods. The outer ring turns about the vertical, the inner one in it about a horizontal axis,
    the rotor in that one.
    """
    positive(spin=spin, duration=duration)
    if not 0 < tilt < np.pi / 2:
        raise ValueError(f"tilt must lie between 0 and π/2, but is {tilt!r}")
    steady = steady_rate(tilt, spin) if precession is None else precession
    exact = _Gimbal(tilt, spin, inputs.number("precession", steady), precession is None)
    start, scene = exact(np.zeros(1)), Scene()
    for k, (mass, moments) in enumerate(((RING, OUTER), (RING, INNER), (DISC, ROTOR))):
        scene.add(
            Sphere(0.1),
            mass=mass,
            inertia=moments,
            position=start.position[0, k],
            orientation=start.orientation[0, k],
            velocity=start.velocity[0, k],
            angular_velocity=start.angular_velocity[0, k],
            group="gyroscope",
        )
    scene.join(Hinge(0, None, point=(0, 0, 0), axis=(0, 0, 1)))
    scene.join(Hinge(1, 0, point=(0, 0, 0), axis=(1, 0, 0)))
    scene.join(Hinge(2, 1, point=start.position[0, 2], axis=start.position[0, 2]))
    return Case(
        "gimbal_gyroscope",
        scene,
        duration,
        exact,
        attitude_error,
        "rad",
        "Lagrange's equations of three angles, two of them cyclic; DOP853 to 1e-13 where it nods",
        "Spin and precession differ many times in speed, and the joints carry the gyroscopic torque.",
    )


def steady_rate(tilt, spin):
    """The slower steady precession, rad/s: J cos θ Ω² − I_rotor,3 ω₃ Ω + m g l = 0."""
    momentum, moment = ROTOR[2] * spin, DISC * GRAVITY * ARM
    least = 2 * np.sqrt(J * np.cos(tilt) * moment)
    if momentum < least:
        raise ValueError(
            f"spin must be at least {least / ROTOR[2]:.6g} rad/s to precess steadily at this tilt, but is "
            f"{spin!r}"
        )
    return 2 * moment / (momentum + np.sqrt(momentum**2 - least**2))


class _Gimbal:
    """The Motion of outer ring, inner ring and rotor: R_z(φ), R_z(φ) R_x(θ), R_z(φ) R_x(θ) R_z(ψ).

    ψ̇ = ω₃ − φ̇ cos θ. y = (θ, θ̇, φ, ψ).
    """

    def __init__(self, tilt, spin, precession, steady):
        self.spin = spin
        self.turning = self.moment(tilt) * precession + ROTOR[2] * spin * np.cos(tilt)  # p_φ, N m s
        self.solution = Integrated(self.rate, (tilt, 0.0, 0.0, 0.0))
        if steady:  # then the equation's answer needs no integration
            own = spin - precession * np.cos(tilt)
            self.solution = lambda time: np.stack(
                [tilt + 0 * time, 0 * time, precession * time, own * time], axis=-1
            )

    def moment(self, θ):
        """Of all but the rotor's spin, about the vertical, kg m²."""
        return OUTER[2] + (J + INNER[2]) * np.sin(θ) ** 2 + INNER[2] * np.cos(θ) ** 2

    def precession(self, θ):
        """φ̇ from the conserved angular momentum about the vertical."""
        return (self.turning - ROTOR[2] * self.spin * np.cos(θ)) / self.moment(θ)

    def rate(self, y):
        """Of y = (θ, θ̇, φ, ψ)."""
        θ, nodding, _, _ = y
        Ω = self.precession(θ)
        torque = J * Ω**2 * np.cos(θ) - ROTOR[2] * self.spin * Ω + DISC * GRAVITY * ARM
        nod = np.sin(θ) * torque / (INNER[0] + ROTOR[0] + DISC * ARM**2)
        return np.array([nodding, nod, Ω, self.spin - Ω * np.cos(θ)])

    def __call__(self, time):
        θ, nodding, φ, ψ = np.moveaxis(self.solution(np.asarray(time, dtype=float)), -1, 0)
        product, zero = over_arrays(multiply), np.zeros_like(θ)
        outer, line = turn(2, φ), np.stack([np.cos(φ), np.sin(φ), zero], axis=-1)  # line: of the nodes
        inner = product(outer, turn(0, θ))
        axis = np.stack([np.sin(θ) * np.sin(φ), -np.sin(θ) * np.cos(φ), np.cos(θ)], axis=-1)
        Ω = self.precession(θ)[:, None] * np.array([0.0, 0.0, 1.0])
        leaning = Ω + nodding[:, None] * line
        rotor = leaning + (self.spin - Ω[:, 2:] * axis[:, 2:]) * axis
        still = np.zeros_like(axis)
        return Motion(
            np.stack([still, still, ARM * axis], axis=1),
            np.stack([outer, inner, product(inner, turn(2, ψ))], axis=1),
            np.stack([still, still, ARM * np.cross(leaning, axis)], axis=1),
            np.stack([Ω, leaning, rotor], axis=1),
        )
