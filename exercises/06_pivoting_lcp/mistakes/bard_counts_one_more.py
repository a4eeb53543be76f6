# Mistake: the last look is counted as a pivot.
# Loses: bard
# Says: bard: One pivot too many
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def bard(A, b, most):
    """λ and the number of pivots by Bard's rule."""
    inside, pivots = np.zeros(len(b), dtype=bool), 0
    y = basic(A, b, inside)
    while y.min() < -given.SLACK and pivots < most:
        i = y.argmin()
        inside[i] = not inside[i]
        pivots += 1
        y = basic(A, b, inside)
    return np.where(inside, y, 0.0), pivots + 1
