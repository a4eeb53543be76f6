# Mistake: the moments are axis × arm.
# Loses: screw_row
# Says: screw_row: The moments have the wrong sign
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def screw_row(axis, arm_i, arm_j, pitch):
    thread = pitch / (2 * np.pi) * axis
    return np.concatenate([-axis, -np.cross(axis, arm_i) + thread, axis, np.cross(axis, arm_j) - thread])
