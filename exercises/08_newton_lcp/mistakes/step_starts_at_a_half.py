# Mistake: the whole step is never tried.
# Loses: step_length
# Says: step_length: The first step to try is 1


# %%
def step_length(psi, lam, step, slope):
    t, before = 0.5, psi(lam)
    while t > 1e-12 and psi(lam + t * step) > before + 1e-4 * t * slope:
        t /= 2
    return t
