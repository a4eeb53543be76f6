# Mistake: J is taken for constant.
# Loses: rope, swing
# Says: rope: J̇u is left out
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def rope(x, u, pulleys):
    a, b = x[:2] - pulleys[:2], x[2:] - pulleys[2:]
    return np.concatenate([a / np.linalg.norm(a), b / np.linalg.norm(b)]), 0.0
