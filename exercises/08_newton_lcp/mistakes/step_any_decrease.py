# Mistake: any decrease is taken.
# Loses: step_length
# Says: step_length: Any decrease is taken


# %%
def step_length(psi, lam, step, slope):
    t, before = 1.0, psi(lam)
    while t > 1e-12 and psi(lam + t * step) > before:
        t /= 2
    return t
