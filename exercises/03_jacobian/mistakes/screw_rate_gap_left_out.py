# Mistake: the gap is left out of the second derivative.
# Loses: screw_rate
# Says: screw_rate: The gap is left out
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def screw_rate(axis, arm_i, arm_j, gap, pitch, u):
    v_i, omega_i, v_j, omega_j = np.split(u, 4)
    axis_rate = np.cross(omega_i, axis)
    apart_rate = v_j + np.cross(omega_j, arm_j) - v_i - np.cross(omega_i, arm_i)
    inward = np.cross(omega_j, np.cross(omega_j, arm_j)) - np.cross(omega_i, np.cross(omega_i, arm_i))
    thread = pitch / (2 * np.pi) * axis_rate @ (omega_j - omega_i)
    return axis @ inward + 2 * axis_rate @ apart_rate - thread
