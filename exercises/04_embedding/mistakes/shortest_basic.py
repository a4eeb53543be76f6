# Mistake: a redundant row is dropped, its λ is 0.
# Loses: shortest
# Says: shortest: Rows that depend on others were left out
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def shortest(A, b):
    taken = []
    for k in range(len(b)):
        trial = [*taken, k]
        if np.linalg.matrix_rank(A[np.ix_(trial, trial)], tol=1e-8) == len(trial):
            taken = trial
    lam = np.zeros(len(b))
    lam[taken] = np.linalg.solve(A[np.ix_(taken, taken)], -b[taken])
    return lam
