# Mistake: the penalty is a b, whatever the signs.
# Loses: penalised, solve
# Says: penalised: where one of the two is not positive it must be 0
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def penalised(a, b, tau):
    return tau * (a + b - np.hypot(a, b)) + (1 - tau) * a * b
