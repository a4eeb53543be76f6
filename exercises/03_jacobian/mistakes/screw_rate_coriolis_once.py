# Mistake: the Coriolis term is counted once.
# Loses: screw_rate
# Says: screw_rate: The Coriolis term counts twice
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
whole = screw_rate


def screw_rate(axis, arm_i, arm_j, gap, pitch, u):
    v_i, omega_i, v_j, omega_j = np.split(u, 4)
    apart_rate = v_j + np.cross(omega_j, arm_j) - v_i - np.cross(omega_i, arm_i)
    return whole(axis, arm_i, arm_j, gap, pitch, u) - np.cross(omega_i, axis) @ apart_rate
