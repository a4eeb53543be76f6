# Mistake: Newton's method without the line search.
# Loses: solve
# Says: solve: It is Newton's method with full steps
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def solve(M, q, start, tau):
    lam = np.array(start, dtype=float)
    for _ in range(200):
        value = penalised(lam, M @ lam + q, tau)
        if np.max(np.abs(value)) <= 1e-12:
            break
        lam = lam - np.linalg.solve(newton_matrix(M, q, lam, tau), value)
    return lam
