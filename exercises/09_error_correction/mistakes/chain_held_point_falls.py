# Mistake: the held point falls, too.
# Loses: chain, hang
# Says: chain: The held point has fallen
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def chain(x, v, inverse, length, compliance, dt, sweeps):
    free = v + dt * given.GRAVITY
    new, lam = x + dt * free, np.zeros(len(x) - 1)
    for _ in range(sweeps):
        new, lam = relax(new, lam, inverse, length, compliance, dt)
    return new, (new - x) / dt, lam
