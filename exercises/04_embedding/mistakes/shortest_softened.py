# Mistake: A is made regular by a small number on its diagonal.
# Loses: shortest
# Says: shortest: added to A's diagonal
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def shortest(A, b):
    return np.linalg.solve(A + 1e-3 * np.eye(len(b)), -b)
