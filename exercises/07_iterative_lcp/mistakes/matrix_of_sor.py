# Mistake: the matrix of SOR.
# Loses: error_matrix
# Says: error_matrix: r is not used
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def error_matrix(A, omega, r, free):
    A = A[free][:, free]
    D = np.diag(np.diagonal(A)) / omega + np.tril(A, -1)
    return np.eye(len(A)) - np.linalg.solve(D, A)
