# Mistake: a forward difference.
# Loses: slope
# Says: slope: The difference is one-sided
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def slope(phi, pose, u, h):
    return (phi(given.moved(pose, u, h)) - phi(pose)) / h
