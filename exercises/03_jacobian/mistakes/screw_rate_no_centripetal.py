# Mistake: the points are not accelerated by their bodies' turning.
# Loses: screw_rate
# Says: screw_rate: The centripetal terms ω × (ω × r) are missing
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def screw_rate(axis, arm_i, arm_j, gap, pitch, u):
    v_i, omega_i, v_j, omega_j = np.split(u, 4)
    axis_rate = np.cross(omega_i, axis)
    apart_rate = v_j + np.cross(omega_j, arm_j) - v_i - np.cross(omega_i, arm_i)
    carried = np.cross(omega_i, axis_rate) @ (gap * axis)
    thread = pitch / (2 * np.pi) * axis_rate @ (omega_j - omega_i)
    return 2 * axis_rate @ apart_rate + carried - thread
