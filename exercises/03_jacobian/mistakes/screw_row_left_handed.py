# Mistake: the thread is left-handed.
# Loses: screw_row
# Says: screw_row: The thread has the wrong sign
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def screw_row(axis, arm_i, arm_j, pitch):
    thread = pitch / (2 * np.pi) * axis
    return np.concatenate([-axis, -np.cross(arm_i, axis) - thread, axis, np.cross(arm_j, axis) + thread])
