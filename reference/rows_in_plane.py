"""Rows of J in the plane: ω, moments and angles are numbers, along the third axis.

Slides S5–S7; lectures/03_jacobian.md.
"""

import numpy as np

from .compiled import compiled, compiled_apart
from .joints import DISTANCE, LINEAR


@compiled_apart
def fill_rows_in_plane(index, geometry, x, q, v, ω, frame, φ, J, rate):
    """All rows, in the plane: the same with ω and the moments along the third axis."""
    for i in range(len(q)):
        frame[i, 0], frame[i, 1] = np.cos(q[i, 0]), np.sin(q[i, 0])
    for k in range(len(index)):
        kind, i, j = index[k, 0], index[k, 1], index[k, 2]
        ω_i, ω_j = spin_in_plane(ω, i), spin_in_plane(ω, j)
        if kind != LINEAR and kind != DISTANCE:  # a TURN
            put_in_plane(J, k, 0.0, 0.0, 1.0, 1.0)
            φ[k] = (q[j, 0] if j >= 0 else 0.0) - (q[i, 0] if i >= 0 else 0.0)
            rate[k] = 0.0
            continue
        r_i, p_i, v_i = point_in_plane(frame, x, v, ω_i, i, geometry[k, 0], geometry[k, 1])
        r_j, p_j, v_j = point_in_plane(frame, x, v, ω_j, j, geometry[k, 3], geometry[k, 4])
        Δx, Δy = p_j[0] - p_i[0], p_j[1] - p_i[1]
        vx, vy = v_j[0] - v_i[0], v_j[1] - v_i[1]
        ax, ay = ω_i * ω_i * r_i[0] - ω_j * ω_j * r_j[0], ω_i * ω_i * r_i[1] - ω_j * ω_j * r_j[1]
        if kind == LINEAR:
            ex, ey = turned_in_plane(frame, i, geometry[k, 6], geometry[k, 7])
            r_i = (r_i[0] + Δx, r_i[1] + Δy)
            φ[k] = ex * Δx + ey * Δy
            rate[k] = ex * ax + ey * ay + 2 * ω_i * (ex * vy - ey * vx) - ω_i * ω_i * φ[k]
        else:
            length = np.sqrt(Δx * Δx + Δy * Δy)
            ex, ey = Δx / length, Δy / length
            φ[k] = length
            rate[k] = ex * ax + ey * ay + (ex * vy - ey * vx) ** 2 / length
        put_in_plane(J, k, ex, ey, r_i[0] * ey - r_i[1] * ex, r_j[0] * ey - r_j[1] * ex)


@compiled
def put_in_plane(J, k, ex, ey, moment_i, moment_j):
    """The same in the plane."""
    J[k, 0, 0], J[k, 0, 1], J[k, 0, 2] = -ex, -ey, -moment_i
    J[k, 1, 0], J[k, 1, 1], J[k, 1, 2] = ex, ey, moment_j


@compiled
def turned_in_plane(frame, i, x, y):
    """The same in the plane."""
    if i < 0 or i >= len(frame):
        return x, y
    return frame[i, 0] * x - frame[i, 1] * y, frame[i, 1] * x + frame[i, 0] * y


@compiled
def point_in_plane(frame, x, v, ω, i, a, b):
    """The same in the plane."""
    if i < 0:
        return (0.0, 0.0), (a, b), (0.0, 0.0)
    r = turned_in_plane(frame, i, a, b)
    return r, (x[i, 0] + r[0], x[i, 1] + r[1]), (v[i, 0] - ω * r[1], v[i, 1] + ω * r[0])


@compiled
def spin_in_plane(ω, i):
    """The same in the plane, a number."""
    return ω[i, 0] if 0 <= i < len(ω) else 0.0
