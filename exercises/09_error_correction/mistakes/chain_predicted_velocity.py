# Mistake: the velocity is the predicted one.
# Loses: chain, hang
# Says: chain: The velocity is the predicted one
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def chain(x, v, inverse, length, compliance, dt, sweeps):
    free = v + dt * np.where(inverse[:, None] > 0, given.GRAVITY, 0)
    new, lam = x + dt * free, np.zeros(len(x) - 1)
    for _ in range(sweeps):
        new, lam = relax(new, lam, inverse, length, compliance, dt)
    return new, free, lam
