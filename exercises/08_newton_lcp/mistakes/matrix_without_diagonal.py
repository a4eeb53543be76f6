# Mistake: the slopes by λ are left out.
# Loses: newton_matrix, solve
# Says: newton_matrix: The diagonal D_a is missing
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def newton_matrix(M, q, lam, tau):
    _, by_b = slopes(lam, M @ lam + q, tau)
    return by_b[:, None] * M
