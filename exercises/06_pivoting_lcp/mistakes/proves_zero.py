# Mistake: y · b = 0 is taken for a proof.
# Loses: proves
# Says: proves: less than 0
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def proves(A, b, y):
    """Whether y proves that the problem has no solution."""
    return bool(y.min() >= -given.SLACK and (A.T @ y).max() <= given.SLACK and y @ b <= given.SLACK)
