"""Bricard's mechanism: six bars in a ring along a cube's edges, six hinges, and yet it moves.

Six hinges have 30 rows for the 30 velocities of five bars: it should be rigid. It moves since each hinge's
axis is at right angles to both its bars. Every second hinge turns alike: with the angles s and t between
bars that follow each other, π/2 at the start, the ring closes if and only if

    (1 + cos s)(1 + cos t) = 1,   that is   cos(s/2) cos(t/2) = ½.

That is a closed curve. It is followed by a coordinate χ that stops nowhere, with ds/dχ = cos(s/2) sin(t/2)
and dt/dχ = −sin(s/2) cos(t/2); and d'Alembert's principle along it is one equation for χ̈ (as in ``bars``).

Slides S3, S5, S9; lectures/04_embedding.md. Source: Bricard, J. Math. Pures Appl. 3 (1897) 113; Chen, You &
Tarnai, Int. J. Solids Struct. 42 (2005) 2287, for the closure; the IFToMM library of benchmarks.
"""

import numpy as np

from ..joints import Hinge
from ..rotation import multiply, over_arrays
from ..scene import Scene
from ..shapes import Box
from .case import GRAVITY, Case, Motion, position_error, positive
from .integrated import Integrated
from .upright import SLENDER

EDGES = np.array([(1, 0, 0), (0, 1, 0), (0, 0, 1), (-1, 0, 0), (0, -1, 0), (0, 0, -1)], dtype=float)
AXES = np.cross(np.roll(EDGES, 1, axis=0), EDGES)  # hinge k is where edge k begins, edge 0 is the ground
CORNERS = np.concatenate([np.zeros((1, 3)), np.cumsum(EDGES, axis=0)])[:6]
K = np.array([[[0, -z, y], [z, 0, -x], [-y, x, 0]] for x, y, z in AXES])  # K[k] r = axis × r


def bricard(duration=4.0):
    """Five bars of 1 m and 1 kg on edges of a cube, the sixth fixed, let go. Error: over a bar's length."""
    positive(duration=duration)
    scene, group = Scene(), "mechanism"
    for k in range(1, 6):
        half = np.where(EDGES[k] != 0, 0.5, SLENDER / 2)
        scene.add(Box(half), mass=1.0, position=CORNERS[k] + EDGES[k] / 2, group=group)
        scene.join(Hinge(k - 1, k - 2 if k > 1 else None, point=CORNERS[k], axis=AXES[k]))
    scene.join(Hinge(4, None, point=CORNERS[0], axis=AXES[0]))
    return Case(
        "bricard",
        scene,
        duration,
        _Ring(),
        position_error(1.0),
        "relative to a bar",
        "closure (1 + cos s)(1 + cos t) = 1 and one equation of motion, DOP853 to 1e-13",
        "Overconstrained: 30 rows have rank 29 everywhere, and the smallest error would lock it.",
    )


class _Ring:
    """The Motion of the bars; y = (s, t, χ̇)."""

    def __init__(self):
        self.solution = Integrated(self.rate, (np.pi / 2, np.pi / 2, 0.0))
        along, across = SLENDER**2 / 6, (1 + SLENDER**2) / 12  # kg m²
        self.inertia = [np.diag(np.where(edge != 0, along, across)) for edge in EDGES]

    def rate(self, y):
        """Of y = (s, t, χ̇)."""
        speed = y[2]
        (ds, dt), second = _along_the_curve(y[0], y[1])
        torque = inertia = 0.0
        for k, (R, _, dx, ddx, dω, ddω) in enumerate(_recursion(y, (ds, dt), second), start=1):
            I = R @ self.inertia[k] @ R.T
            inertia += dx @ dx + dω @ I @ dω
            torque += -dx[2] * GRAVITY - (dx @ ddx + dω @ I @ ddω) * speed**2
        return np.array([ds * speed, dt * speed, torque / inertia])

    def __call__(self, time):
        states = self.solution(time)
        x, v, ω = (np.empty((*np.shape(time), 5, 3)) for _ in range(3))
        for record, y in enumerate(states):
            first, second = _along_the_curve(y[0], y[1])
            for k, (_, place, dx, _, dω, _) in enumerate(_recursion(y, first, second)):
                x[record, k], v[record, k], ω[record, k] = place, dx * y[2], dω * y[2]
        return Motion(x, _attitudes(states), v, ω)


def _along_the_curve(s, t):
    """First and second derivatives of (s, t) by χ."""
    cs, ss, ct, st = np.cos(s / 2), np.sin(s / 2), np.cos(t / 2), np.sin(t / 2)
    ds, dt = cs * st, -ss * ct
    return (ds, dt), ((-ss * st * ds + cs * ct * dt) / 2, (-cs * ct * ds + ss * st * dt) / 2)


def _recursion(y, first, second):
    """From bar to bar: rotation R, centre x, and the derivatives x', x'', ω', ω'' by χ."""
    R, p, dp, ddp, dω, ddω = np.eye(3), EDGES[0], *np.zeros((4, 3))
    for k in range(1, 6):
        which = 0 if k % 2 else 1
        turn, axis = y[which] - np.pi / 2, R @ AXES[k]
        ddω = ddω + second[which] * axis + first[which] * _cross(dω, axis)
        dω = dω + first[which] * axis
        R = R @ (np.eye(3) + np.sin(turn) * K[k] + (1 - np.cos(turn)) * (K[k] @ K[k]))
        r = R @ EDGES[k]
        dr = _cross(dω, r)
        ddr = _cross(ddω, r) + _cross(dω, dr)
        yield R, p + r / 2, dp + dr / 2, ddp + ddr / 2, dω, ddω
        p, dp, ddp = p + r, dp + dr, ddp + ddr


def _attitudes(states):
    """Quaternions (T, 5, 4) of the bars."""
    q, result = np.zeros((len(states), 4)), []
    q[:, 0] = 1.0
    for k in range(1, 6):
        half = (states[:, 0 if k % 2 else 1] - np.pi / 2) / 2
        turn = np.concatenate([np.cos(half)[:, None], np.sin(half)[:, None] * AXES[k]], axis=1)
        q = over_arrays(multiply)(q, turn)
        result.append(q)
    return np.stack(result, axis=1)


def _cross(a, b):
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
