# Mistake: r is not used: SOR, whatever r is.
# Loses: aor_sweep
# Says: aor_sweep: r is not used


# %%
def aor_sweep(A, b, lam, omega, r):
    new = lam.astype(float)
    for i in range(len(lam)):
        new[i] = max(0.0, new[i] - omega * (A[i] @ new + b[i]) / A[i, i])
    return new
