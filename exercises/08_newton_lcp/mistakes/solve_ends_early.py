# Mistake: the iteration ends at an error of a hundredth.
# Loses: solve
# Says: solve: The iteration ends too early
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def solve(M, q, start, tau):
    phi = lambda lam: penalised(lam, M @ lam + q, tau)
    psi = lambda lam: 0.5 * np.sum(phi(lam) ** 2)
    lam = np.array(start, dtype=float)
    for _ in range(200):
        value = phi(lam)
        if np.max(np.abs(value)) <= 1e-2:
            break
        step = -np.linalg.solve(newton_matrix(M, q, lam, tau), value)
        lam = lam + step_length(psi, lam, step, -np.sum(value**2)) * step
    return lam
