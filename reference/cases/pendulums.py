"""Pendulums: one, whose motion is known in closed form; two, one hanging on the other; and a door.

Slides S5, S9; lectures/04_embedding.md. Source: Whittaker, Analytical Dynamics (1937), chapter
IV.
"""

import numpy as np

from .. import inputs
from ..joints import BallJoint, Hinge
from ..rotation import multiply, over_arrays, rotation_matrix
from ..scene import Scene
from ..shapes import Box
from .case import GRAVITY, Case, Motion, flight_error, position_error, positive
from .chains import chain
from .swing import Swing
from .upright import Upright, bar_inertia, checked_joint


def pendulum(angle=np.pi / 2, joint="hinge", dimension=2, length=1.0, mass=1.0, duration=4.0):
    """A bar that swings from its end, let go at ``angle`` from hanging. Error: distance over the length.

    angle: rad, between 0 and π. joint: "hinge"; "ball", in space; or "distance", a point on a massless rod.
    ``case.exact.period`` is the period, s.
    """
    positive(length=length, mass=mass, duration=duration)
    checked_joint(joint, dimension)
    if not 0 < angle < np.pi:
        raise ValueError(f"angle must lie between 0 and π, but is {angle!r}")
    plane = Upright(dimension)
    arm = length if joint == "distance" else length / 2
    moment = 0.0 if joint == "distance" else bar_inertia(mass, length)
    exact = _OnItsEnd(plane, arm, Swing(np.sqrt(mass * GRAVITY * arm / (moment + mass * arm**2)), angle))
    place, φ = exact.place(angle)
    body = plane.point(mass, place) if joint == "distance" else plane.bar(length, mass, place, φ)
    plane.join(joint, body, None, (0.0, 0.0))
    return Case(
        "pendulum",
        plane.scene,
        duration,
        exact,
        position_error(length),
        "relative to the length",
        "Whittaker, Analytical Dynamics, chapter IV: T/T₀ = 2 K(sin(angle/2)) / π",
        "The period grows with the angle, without bound at the top: a phase error shows there first.",
    )


class _OnItsEnd:
    """The Motion of a body whose centre swings at ``arm`` from the origin; θ counts from hanging."""

    def __init__(self, plane, arm, swing):
        self.plane, self.arm, self.swing, self.period = plane, arm, swing, swing.period

    def place(self, θ):
        """Position (…, 2) and the bar's angle (…,) from the horizontal."""
        return self.arm * np.stack([np.sin(θ), -np.cos(θ)], axis=-1), θ - np.pi / 2

    def __call__(self, time):
        θ, speed = self.swing(np.asarray(time)[..., None])
        place, φ = self.place(θ)
        velocity = self.arm * speed[..., None] * np.stack([np.cos(θ), np.sin(θ)], axis=-1)
        points = self.plane.scene.bodies[0].inertia is None
        return self.plane.motion(place, 0 * φ if points else φ, velocity, 0 * speed if points else speed)


def double_pendulum(dimension=2, joint="hinge", duration=2.0):
    """Two bars of 1 m and 1 kg, one hanging on the other, let go level. Error: of the tip, m."""
    case = chain(n=2, end_mass=1, dimension=dimension, joint=joint, duration=duration)
    return Case(
        "double_pendulum",
        case.scene,
        duration,
        case.exact,
        lambda run, motion: 2 * case.measure(run, motion),  # the chain's is relative to its 2 m
        "m",
        "angles integrated by DOP853 to 1e-12",
        "Order by order: an early error grows with time, in the long run exponentially, for it is chaotic.",
    )


def door(hinges=2, joint="hinge", tilt=0.2, angle=np.pi / 2, duration=4.0):
    """A door that swings on an axis leaning from the vertical. Error: relative to its width, and rad.

    hinges: how many, from 1; from 2 on they are redundant. joint: "hinge", or "ball", of which it takes two.
    tilt: of the axis, rad; angle: from where the door hangs at rest, at which it is let go, rad.
    ``case.exact.force(t)`` (T, 3), N: what all its hinges together do to the door.
    """
    positive(duration=duration)
    least = 2 if inputs.choice("joint", joint, ("ball", "hinge")) == "ball" else 1
    hinges = inputs.whole("hinges", hinges, least=least)
    if not (0 < tilt < np.pi / 2 and 0 < angle < np.pi):
        raise ValueError(f"tilt must lie in (0, π/2) and angle in (0, π), but are {tilt!r} and {angle!r}")
    exact = _LeaningDoor(tilt, angle)
    start, scene = exact(np.zeros(1)), Scene()
    door = scene.add(
        Box(exact.half_extents),
        mass=exact.mass,
        position=start.position[0, 0],
        orientation=start.orientation[0, 0],
    )
    for height in np.linspace(-0.7, 0.7, hinges) if hinges > 1 else (0.0,):
        point = height * exact.axis
        scene.join(
            Hinge(door, None, point=point, axis=exact.axis)
            if joint == "hinge"
            else BallJoint(door, None, point=point)
        )
    return Case(
        "door",
        scene,
        duration,
        exact,
        flight_error(2 * exact.half_extents[0]),
        "relative to the width, and rad",
        "compound pendulum in the part of gravity across the axis; force = m (a − g)",
        "Two hinges have 10 rows of rank 5: what each does is not determined, the door's motion is.",
    )


class _LeaningDoor:
    """The Motion of the door; its hinges lie on ``axis`` (3,) through the origin."""

    half_extents, mass = (0.45, 0.02, 1.0), 20.0

    def __init__(self, tilt, angle):
        arm, thick, _ = self.half_extents
        self.arm, self.gravity = arm, np.array([0, 0, -GRAVITY])
        moment = self.mass * ((arm**2 + thick**2) / 3 + arm**2)  # about the hinges
        self.swing = Swing(np.sqrt(self.mass * GRAVITY * np.sin(tilt) * arm / moment), angle)
        self.lean = np.array([np.cos(tilt / 2), 0.0, np.sin(tilt / 2), 0.0])  # z → axis, x → downhill
        self.frame = rotation_matrix(self.lean)
        self.axis = self.frame[:, 2]

    def _along(self, time):
        """θ, θ̇ and the unit vectors (…, 3) along the door's width, and in the sense of growing θ."""
        θ, speed = self.swing(time)
        zero = np.zeros(np.shape(θ))
        out = np.stack([np.cos(θ), np.sin(θ), zero], axis=-1) @ self.frame.T
        return θ, speed, out, np.cross(self.axis, out)

    def __call__(self, time):
        θ, speed, out, across = self._along(np.asarray(time)[..., None])
        turn = np.stack([np.cos(θ / 2), 0 * θ, 0 * θ, np.sin(θ / 2)], axis=-1)
        return Motion(
            self.arm * out,
            over_arrays(multiply)(self.lean, turn),
            self.arm * speed[..., None] * across,
            speed[..., None] * self.axis,
        )

    def force(self, time):
        """m (a − g): the sum of the hinges' forces on the door, N, (…, 3)."""
        _, speed, out, across = self._along(time)
        turning = self.swing.acceleration(time)[..., None] * across - speed[..., None] ** 2 * out
        return self.mass * (self.arm * turning - self.gravity)
