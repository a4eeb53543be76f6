# Mistake: all links look at the old positions.
# Loses: relax, chain, hang
# Says: relax: All links look at the old positions
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def relax(x, lam, inverse, length, compliance, dt):
    old, x, lam, soft = x.copy(), x.copy(), lam.copy(), compliance / dt**2
    for k in range(len(lam)):
        d = old[k + 1] - old[k]
        size = np.linalg.norm(d)
        w = inverse[k : k + 2]
        change = -(size - length + soft * lam[k]) / (w.sum() + soft)
        lam[k] += change
        x[k] -= w[0] * change * d / size
        x[k + 1] += w[1] * change * d / size
    return x, lam
