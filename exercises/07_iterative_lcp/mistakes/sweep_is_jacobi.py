# Mistake: all rows from the old λ only.
# Loses: aor_sweep, solve_aor
# Says: aor_sweep: this is damped Jacobi
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def aor_sweep(A, b, lam, omega, r):
    return np.maximum(0.0, lam - omega * (A @ lam + b) / np.diagonal(A))
