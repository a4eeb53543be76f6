# Mistake: friction is clipped by the λ_n of before the sweep.
# Loses: friction_sweep
# Says: friction_sweep: the one just renewed


# %%
def friction_sweep(A, b, lam, normal, mu, omega, r):
    new, w = lam.astype(float), A @ lam + b
    for i in range(len(lam)):
        value = lam[i] - (omega * w[i] + r * (A[i, :i] @ (new[:i] - lam[:i]))) / A[i, i]
        most = mu * lam[normal[i]]
        new[i] = max(0.0, value) if normal[i] < 0 else min(max(value, -most), most)
    return new
