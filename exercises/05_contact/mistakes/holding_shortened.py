# Mistake: the pull is shortened.
# Loses: holding, grained
# Says: holding: The pull is shortened
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def holding(pull, mu, normal):
    s = normal * mu
    if np.sum((pull / s) ** 2) <= 1:
        return -pull
    return -pull / np.linalg.norm(pull / s)
