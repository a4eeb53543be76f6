# Mistake: the rate against i is taken for the rate in the world.
# Loses: screw_motion
# Says: screw_motion: the rate against body i
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def screw_motion(axis, arm_i, arm_j, gap, pitch, v_i, omega_i, turn):
    omega_j = turn * axis
    at_point = v_i + np.cross(omega_i, arm_i + gap * axis) + pitch / (2 * np.pi) * turn * axis
    return at_point - np.cross(omega_j, arm_j), omega_j
