# Mistake: rows at a bound are left in.
# Loses: error_matrix
# Says: error_matrix: rows at a bound
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def error_matrix(A, omega, r, free):
    D = np.diag(np.diagonal(A)) + r * np.tril(A, -1)
    return np.eye(len(A)) - omega * np.linalg.solve(D, A)
