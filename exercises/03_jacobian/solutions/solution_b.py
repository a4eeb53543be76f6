# Solution b of exercise 03: written with matrices, and by differentiating step by step.

# %%
import numpy as np

from exercises import load

given, check = load("03")


# %%
def skew(a):
    return np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def point_rows(arm_i, arm_j):
    """3 rows: velocity of j's point minus that of i's."""
    return np.hstack([-np.eye(3), skew(arm_i), np.eye(3), -skew(arm_j)])


def turn_rows():
    return np.hstack([np.zeros((3, 3)), -np.eye(3), np.zeros((3, 3)), np.eye(3)])


def screw_row(axis, arm_i, arm_j, pitch):
    return axis @ (point_rows(arm_i, arm_j) - pitch / (2 * np.pi) * turn_rows())


# %%
def screw_motion(axis, arm_i, arm_j, gap, pitch, v_i, omega_i, turn):
    omega_j = omega_i + turn * axis
    reach = arm_i + gap * axis - arm_j  # from i's centre to j's
    v_j = v_i + skew(omega_i) @ reach + turn * (pitch / (2 * np.pi) * axis + skew(arm_j) @ axis)
    return v_j, omega_j


# %%
def screw_rate(axis, arm_i, arm_j, gap, pitch, u):
    omega_i, omega_j = u[3:6], u[9:12]
    turning_i, turning_j = skew(omega_i), skew(omega_j)
    axis_rate, axis_second = turning_i @ axis, turning_i @ turning_i @ axis
    along = axis @ (turning_j @ turning_j @ arm_j) - axis @ (turning_i @ turning_i @ arm_i)
    coriolis = axis_rate @ point_rows(arm_i, arm_j) @ u
    return along + 2 * coriolis + gap * axis @ axis_second - pitch / (2 * np.pi) * (axis_rate @ omega_j)


# %%
def slope(phi, pose, u, h):
    later, earlier = (phi(given.moved(pose, u, sign * h)) for sign in (1, -1))
    return 0.5 * (later - earlier) / h


# %%
def rope(arm_i, arm_j, offset_i, offset_j, ratio, u, tension):
    w, forces = 0.0, []
    for k, (arm, offset, share) in enumerate(((arm_i, offset_i, 1), (arm_j, offset_j, ratio))):
        n = offset / np.sqrt(offset @ offset)
        v, omega = u[6 * k : 6 * k + 3], u[6 * k + 3 : 6 * k + 6]
        w += share * n @ (v + np.cross(omega, arm))
        pull = -tension * share * n
        forces += [*pull, *np.cross(arm, pull)]
    return w, np.array(forces)


# %%
def gears(radii, inertia, omega):
    J = radii.reshape(1, 2)
    A = J @ np.diag(1 / inertia) @ J.T
    lam = np.linalg.solve(A, -J @ omega)
    after = omega + np.diag(1 / inertia) @ J.T @ lam
    return after[0], after[1], lam[0]
