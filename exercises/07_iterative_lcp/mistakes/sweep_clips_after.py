# Mistake: λ is clipped after the sweep, not within it.
# Loses: aor_sweep, solve_aor
# Says: aor_sweep: λ is clipped after the sweep
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def aor_sweep(A, b, lam, omega, r):
    new, w = lam.astype(float), A @ lam + b
    for i in range(len(lam)):
        new[i] = lam[i] - (omega * w[i] + r * (A[i, :i] @ (new[:i] - lam[:i]))) / A[i, i]
    return np.maximum(new, 0.0)
