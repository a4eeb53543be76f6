# Mistake: the pitch is taken as the way of a radian.
# Loses: screw_row
# Says: screw_row: pitch is the way of a whole turn
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def screw_row(axis, arm_i, arm_j, pitch):
    thread = pitch * axis
    return np.concatenate([-axis, -np.cross(arm_i, axis) + thread, axis, np.cross(arm_j, axis) - thread])
