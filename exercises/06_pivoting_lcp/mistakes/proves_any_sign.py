# Mistake: y may be negative.
# Loses: proves
# Says: proves: y ≥ 0 is not asked for
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def proves(A, b, y):
    """Whether y proves that the problem has no solution."""
    force = A.T @ y
    holds = force.max() <= given.SLACK and y @ b < -given.SLACK
    return ("proof" if holds else "no proof"), force
