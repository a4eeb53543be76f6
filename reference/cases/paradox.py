"""Kane's paradox: an impact with friction that gains energy under Newton's law of impact.

Slides S10–S12; lectures/05_contact.md.
"""

import math

import numpy as np

from ..shapes import Polygon
from .case import Case, positive
from .ground import Ground

DROP, THIN = 0.05, 0.01  # m: how far above the ground it starts, and half of what the rod is thick
TILT = math.pi / 4


def kane(restitution=0.9, slip=0.6, friction=0.5, duration=0.1):
    """A rod of 1 kg and 2 m, at 45°, falls at 1 m/s and drifts at ``slip``; its tip meets the ground.

    Run it with ``impact="newton"``: the error is that of velocity and spin afterwards. By default no energy
    is gained, and the rebound is less.
    """
    positive(restitution=restitution, slip=slip, friction=friction, duration=duration)
    c, s = math.cos(TILT), math.sin(TILT)
    A = np.array([[1 + 3 * c * c, -3 * c * s], [-3 * c * s, 1 + 3 * s * s]])  # of w_n, w_t at the tip; I = ⅓
    n, t = np.linalg.solve(A, [1 + restitution, -slip])
    if restitution > 1 or not 0 < t <= friction * n:
        raise ValueError(
            "restitution, slip and friction must let the tip stick and be dragged on (restitution ≤ 1, "
            f"0 < λ_t ≤ μ λ_n), but they are {restitution}, {slip}, {friction}: λ_t/λ_n is {t / n:.3g}"
        )
    plane = Ground(2)
    plane.scene.gravity = np.zeros(2)
    rod, start = Polygon([(-1, 0), (0, -THIN), (1, 0), (0, THIN)]), np.array([c, s + DROP])
    before, after = np.array([slip, -1.0]), np.array([slip + t, n - 1.0])
    spin = 3 * (s * t - c * n)
    plane.scene.add(
        rod,
        position=start,
        orientation=TILT,
        velocity=before,
        inertia=1 / 3,
        friction=friction,
        restitution=restitution,
    )

    def exact(time):
        since = np.maximum(time - DROP, 0.0)
        place = start + np.minimum(time, DROP)[:, None] * before + since[:, None] * after
        later = (time > DROP)[:, None]
        return plane.moving(place, TILT + spin * since, np.where(later, after, before), spin * later[:, 0])

    def measure(run, motion):
        off = np.linalg.norm(run.velocity[-1, 1] - motion.velocity[-1, 1])
        return off + abs(run.angular_velocity[-1, 1] - motion.angular_velocity[-1, 1])

    return Case(
        "kane",
        plane.scene,
        duration,
        exact,
        measure,
        "m/s",
        "Newton's law w_n⁺ = −e w_n with a tip that sticks, w_t⁺ = 0: two equations for the impulses (Kane & "
        "Levinson, Dynamics: Theory and Applications, 1985, section 5.8; Stronge, Impact Mechanics, 2000).",
        "Friction drags the tip on in the direction in which it slid: the energy grows, by 8 % with e = .9.",
    )
