# Mistake: the step is added to the caller's own y.
# Loses: kutta_step, march, flip_time
# Says: kutta_step: write into the very array
# Says: march: write into the very array


# %%
def kutta_step(rate, t, y, dt):
    k1 = rate(t, y)
    k2 = rate(t + dt / 2, y + dt / 2 * k1)
    k3 = rate(t + dt, y + dt * (2 * k2 - k1))
    y += dt / 6 * (k1 + 4 * k2 + k3)
    return y
