# Mistake: the slopes by w multiply the columns of M.
# Loses: newton_matrix, solve
# Says: newton_matrix: D_b multiplies the columns of M
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def newton_matrix(M, q, lam, tau):
    by_a, by_b = slopes(lam, M @ lam + q, tau)
    return np.diag(by_a) + by_b * M
