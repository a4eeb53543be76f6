# Mistake: the way from −h to h is taken as h.
# Loses: slope
# Says: slope: divide by that
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def slope(phi, pose, u, h):
    return (phi(given.moved(pose, u, h)) - phi(given.moved(pose, u, -h))) / h
