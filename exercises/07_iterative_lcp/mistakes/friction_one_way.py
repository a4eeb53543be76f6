# Mistake: friction may push one way only.
# Loses: friction_sweep
# Says: friction_sweep: either way


# %%
def friction_sweep(A, b, lam, normal, mu, omega, r):
    new, w = lam.astype(float), A @ lam + b
    for i in range(len(lam)):
        value = lam[i] - (omega * w[i] + r * (A[i, :i] @ (new[:i] - lam[:i]))) / A[i, i]
        most = mu * new[normal[i]]
        new[i] = max(0.0, value) if normal[i] < 0 else min(max(value, 0.0), most)
    return new
