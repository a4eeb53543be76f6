# Mistake: each component is clipped by itself.
# Loses: holding, grained
# Says: holding: Each component is clipped by itself
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def holding(pull, mu, normal):
    s = normal * mu
    return np.clip(-pull, -s, s)
