# Mistake: the point of j is taken to be where that of i is.
# Loses: screw_motion
# Says: screw_motion: The gap is left out
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def screw_motion(axis, arm_i, arm_j, gap, pitch, v_i, omega_i, turn):
    omega_j = omega_i + turn * axis
    at_point = v_i + np.cross(omega_i, arm_i) + pitch / (2 * np.pi) * turn * axis
    return at_point - np.cross(omega_j, arm_j), omega_j
