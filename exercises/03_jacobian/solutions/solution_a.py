# Solution a of exercise 03: written with vectors.

# %%
import numpy as np

from exercises import load

given, check = load("03")


# %%
def screw_row(axis, arm_i, arm_j, pitch):
    """The row of J: w = axis·(velocity of j's point − that of i's) − pitch/2π axis·(ω_j − ω_i)."""
    thread = pitch / (2 * np.pi) * axis
    return np.concatenate([-axis, -np.cross(arm_i, axis) + thread, axis, np.cross(arm_j, axis) - thread])


# %%
def screw_motion(axis, arm_i, arm_j, gap, pitch, v_i, omega_i, turn):
    """(v_j, ω_j) of a body that turns along the screw."""
    omega_j = omega_i + turn * axis
    at_point = v_i + np.cross(omega_i, arm_i + gap * axis) + pitch / (2 * np.pi) * turn * axis
    return at_point - np.cross(omega_j, arm_j), omega_j


# %%
def screw_rate(axis, arm_i, arm_j, gap, pitch, u):
    """J̇ u, with u held constant."""
    v_i, omega_i, v_j, omega_j = np.split(u, 4)
    axis_rate = np.cross(omega_i, axis)
    apart_rate = v_j + np.cross(omega_j, arm_j) - v_i - np.cross(omega_i, arm_i)
    inward = np.cross(omega_j, np.cross(omega_j, arm_j)) - np.cross(omega_i, np.cross(omega_i, arm_i))
    carried = np.cross(omega_i, axis_rate) @ (gap * axis)
    thread = pitch / (2 * np.pi) * axis_rate @ (omega_j - omega_i)
    return axis @ inward + 2 * axis_rate @ apart_rate + carried - thread


# %%
def slope(phi, pose, u, h):
    """φ̇ by a central difference."""
    return (phi(given.moved(pose, u, h)) - phi(given.moved(pose, u, -h))) / (2 * h)


# %%
def rope(arm_i, arm_j, offset_i, offset_j, ratio, u, tension):
    """w, and the forces on both bodies."""
    n_i, n_j = offset_i / np.linalg.norm(offset_i), offset_j / np.linalg.norm(offset_j)
    row = np.concatenate([n_i, np.cross(arm_i, n_i), ratio * n_j, ratio * np.cross(arm_j, n_j)])
    return row @ u, -tension * row


# %%
def gears(radii, inertia, omega):
    """(ω_i, ω_j, λ) after the wheels have met."""
    lam = -(radii @ omega) / np.sum(radii**2 / inertia)
    after = omega + radii * lam / inertia
    return after[0], after[1], lam
