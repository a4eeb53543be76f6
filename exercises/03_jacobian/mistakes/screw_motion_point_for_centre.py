# Mistake: the velocity of the point is returned for that of the centre.
# Loses: screw_motion
# Says: screw_motion: the velocity of the point
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def screw_motion(axis, arm_i, arm_j, gap, pitch, v_i, omega_i, turn):
    at_point = v_i + np.cross(omega_i, arm_i + gap * axis) + pitch / (2 * np.pi) * turn * axis
    return at_point, omega_i + turn * axis
