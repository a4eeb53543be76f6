# Mistake: the sign of the move.
# Loses: relax, chain, hang
# Says: relax: The link is stretched further
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def relax(x, lam, inverse, length, compliance, dt):
    x, lam, soft = x.copy(), lam.copy(), compliance / dt**2
    for k in range(len(lam)):
        d = x[k + 1] - x[k]
        size = np.linalg.norm(d)
        w = inverse[k : k + 2]
        change = -(size - length + soft * lam[k]) / (w.sum() + soft)
        lam[k] += change
        x[k] += w[0] * change * d / size
        x[k + 1] -= w[1] * change * d / size
    return x, lam
