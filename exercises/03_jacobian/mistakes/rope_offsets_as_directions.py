# Mistake: the offsets are not made unit vectors.
# Loses: rope
# Says: rope: The directions are not of length 1
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def rope(arm_i, arm_j, offset_i, offset_j, ratio, u, tension):
    n_i, n_j = offset_i, offset_j
    row = np.concatenate([n_i, np.cross(arm_i, n_i), ratio * n_j, ratio * np.cross(arm_j, n_j)])
    return row @ u, -tension * row
