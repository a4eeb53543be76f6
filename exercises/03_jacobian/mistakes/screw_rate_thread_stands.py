# Mistake: the axis of the thread is taken not to turn.
# Loses: screw_rate
# Says: screw_rate: The thread's own part is missing
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def screw_rate(axis, arm_i, arm_j, gap, pitch, u):
    v_i, omega_i, v_j, omega_j = np.split(u, 4)
    axis_rate = np.cross(omega_i, axis)
    apart_rate = v_j + np.cross(omega_j, arm_j) - v_i - np.cross(omega_i, arm_i)
    inward = np.cross(omega_j, np.cross(omega_j, arm_j)) - np.cross(omega_i, np.cross(omega_i, arm_i))
    carried = np.cross(omega_i, axis_rate) @ (gap * axis)
    return axis @ inward + 2 * axis_rate @ apart_rate + carried
