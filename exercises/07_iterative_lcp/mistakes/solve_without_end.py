# Mistake: the limit on the sweeps is not heeded.
# Loses: solve_aor
# Says: solve_aor: More sweeps are done
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def solve_aor(A, b, omega, r, tolerance, most):
    lam = np.zeros(len(b))
    while given.residual(A, b, lam) > tolerance:
        lam = aor_sweep(A, b, lam, omega, r)
    return lam
