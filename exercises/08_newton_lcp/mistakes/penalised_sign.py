# Mistake: the penalty is subtracted.
# Loses: penalised, solve
# Says: penalised: The penalty is subtracted
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def penalised(a, b, tau):
    return tau * (a + b - np.hypot(a, b)) - (1 - tau) * np.maximum(a, 0) * np.maximum(b, 0)
