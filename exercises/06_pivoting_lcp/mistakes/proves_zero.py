# Mistake: y · b = 0 is taken for a proof.
# Loses: proves
# Says: proves: less than 0
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def proves(A, b, y):
    """Whether y proves that the problem has no solution."""
    force = A.T @ y
    holds = y.min() >= -given.SLACK and force.max() <= given.SLACK and y @ b <= given.SLACK
    return ("proof" if holds else "no proof"), force
