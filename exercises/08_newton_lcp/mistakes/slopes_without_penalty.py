# Mistake: the slopes are those of Fischer and Burmeister's function alone.
# Loses: slopes, newton_matrix
# Says: slopes: The penalty has slopes, too
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def slopes(a, b, tau):
    size = np.hypot(a, b)
    safe = np.where(size > 0, size, 1)
    corner = 1 - np.sqrt(0.5)
    return (
        tau * np.where(size > 0, 1 - a / safe, corner),
        tau * np.where(size > 0, 1 - b / safe, corner),
    )
