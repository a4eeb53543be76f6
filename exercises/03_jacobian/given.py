"""Helpers of the exercise of unit 03, the Jacobian (slides S5–S7)."""

import numpy as np


def turned(q, r):
    """The vector r, fixed to a body of attitude q = (w, x, y, z), in the world's frame."""
    w, x = q[0], q[1:]
    return r + 2 * np.cross(x, np.cross(x, r) + w * r)


def product(p, q):
    """The product of two quaternions (w, x, y, z): first the rotation q, then p."""
    vector = p[0] * q[1:] + q[0] * p[1:] + np.cross(p[1:], q[1:])
    return np.concatenate([[p[0] * q[0] - p[1:] @ q[1:]], vector])


def moved(pose, u, t):
    """Where two bodies are after the time t at constant velocities.

    pose: array of 14, (x_i, q_i, x_j, q_j), positions in m and attitudes (w, x, y, z). u: array of 12,
    (v_i, ω_i, v_j, ω_j), world frame.
    """
    result = np.array(pose, dtype=float)
    for body in range(2):
        v, ω = u[6 * body : 6 * body + 3], u[6 * body + 3 : 6 * body + 6]
        angle = t * np.linalg.norm(ω)
        turn = np.concatenate([[np.cos(angle / 2)], 0.5 * t * np.sinc(angle / (2 * np.pi)) * ω])
        result[7 * body : 7 * body + 3] += t * v
        result[7 * body + 3 : 7 * body + 7] = product(turn, pose[7 * body + 3 : 7 * body + 7])
    return result


def screw(axis, point_i, point_j, pitch):
    """φ(pose) of a screw joint: how far body j is from where its thread would have it, in m.

    axis, point_i: fixed to body i, in its own frame, as seen from its centre; point_j likewise to body j. The
    thread's zero is where both bodies have the same attitude.
    """

    def phi(pose):
        x_i, q_i, x_j, q_j = pose[:3], pose[3:7], pose[7:10], pose[10:14]
        apart = x_j + turned(q_j, point_j) - x_i - turned(q_i, point_i)
        relative = product(q_i * np.array([1, -1, -1, -1]), q_j)
        angle = 2 * np.arctan2(relative[1:] @ axis, relative[0])
        return turned(q_i, axis) @ apart - pitch / (2 * np.pi) * angle

    return phi


def rope(pulley_i, pulley_j, point_i, point_j, ratio):
    """φ(pose) of a rope over two pulleys that stand still, in m, but for the rope's constant length.

    pulley_i, pulley_j: in the world; point_i, point_j: fixed to body i and j, as seen from their centres, in
    their own frames.
    """

    def phi(pose):
        first = pose[:3] + turned(pose[3:7], point_i) - pulley_i
        second = pose[7:10] + turned(pose[10:14], point_j) - pulley_j
        return np.linalg.norm(first) + ratio * np.linalg.norm(second)

    return phi


def show_slope(slope):
    """Draws the error of slope against h, for a rope from which a body flies away in a straight line."""
    pulley, v = np.array([0.0, 0.0, 2.0]), np.array([1.0, 0.5, -0.3])
    phi = rope(pulley, pulley, np.zeros(3), np.zeros(3), 1.0)
    pose = np.array([0.5, 0.0, 0, 1, 0, 0, 0, 0.6, -0.4, 0.2, 1, 0, 0, 0])
    exact = (pose[:3] - pulley) @ v / np.linalg.norm(pose[:3] - pulley)
    steps = 0.5 / 2.0 ** np.arange(30)
    slopes = [slope(phi, pose, np.concatenate([v, np.zeros(9)]), h) for h in steps]
    if any(not isinstance(value, (int, float, np.floating)) for value in slopes):
        print("The picture comes once slope passes its check.")
        return
    _draw_slope(steps, np.abs(np.array(slopes) - exact))


def _draw_slope(steps, errors):
    import matplotlib.pyplot as plt

    _, axes = plt.subplots(figsize=(6, 3.4), layout="constrained")
    axes.loglog(steps, np.maximum(errors, 1e-18), "o-", color="#0072B2", label="error of slope")
    axes.loglog(steps[:12], errors[0] * (steps[:12] / steps[0]) ** 2, "--", color="#D55E00", label="order 2")
    axes.set(xlabel="h in s", ylabel="error in m/s")
    axes.legend()
    plt.show()
