# Mistake: the row is body i as seen from j.
# Loses: screw_row
# Says: screw_row: The row is −w
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def screw_row(axis, arm_i, arm_j, pitch):
    thread = pitch / (2 * np.pi) * axis
    return np.concatenate([axis, np.cross(arm_i, axis) - thread, -axis, thread - np.cross(arm_j, axis)])
