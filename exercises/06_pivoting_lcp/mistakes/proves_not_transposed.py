# Mistake: A in place of its transpose.
# Loses: proves
# Says: proves: Aᵀ y ≤ 0
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def proves(A, b, y):
    """Whether y proves that the problem has no solution."""
    force = A @ y
    holds = y.min() >= -given.SLACK and force.max() <= given.SLACK and y @ b < -given.SLACK
    return ("proof" if holds else "no proof"), force
