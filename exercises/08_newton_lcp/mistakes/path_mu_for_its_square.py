# Mistake: 4 μ stands under the root, so that λ w is μ.
# Loses: on_path
# Says: on_path: λ_i w_i is μ, not μ²
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def on_path(M, q, mu):
    def phi(lam):
        w = M @ lam + q
        return lam + w - np.sqrt((lam - w) ** 2 + 4 * mu)

    lam = np.zeros(len(q))
    for _ in range(200):
        value, apart = phi(lam), lam - M @ lam - q
        if np.max(np.abs(value)) <= 1e-13:
            break
        share = apart / np.sqrt(apart**2 + 4 * mu)
        H = np.diag(1 - share) + (1 + share)[:, None] * M
        step = -np.linalg.solve(H, value)
        psi = lambda x: 0.5 * np.sum(phi(x) ** 2)
        lam = lam + step_length(psi, lam, step, -np.sum(value**2)) * step
    return lam
