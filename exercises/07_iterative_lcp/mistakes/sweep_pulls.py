# Mistake: λ is not clipped.
# Loses: aor_sweep, solve_aor
# Says: aor_sweep: a contact can't pull


# %%
def aor_sweep(A, b, lam, omega, r):
    new, w = lam.astype(float), A @ lam + b
    for i in range(len(lam)):
        new[i] = lam[i] - (omega * w[i] + r * (A[i, :i] @ (new[:i] - lam[:i]))) / A[i, i]
    return new
