# Mistake: all three slopes are taken at the time t.
# Loses: kutta_step, march
# Says: kutta_step: slopes are taken at the time t


# %%
def kutta_step(rate, t, y, dt):
    k1 = rate(t, y)
    k2 = rate(t, y + dt / 2 * k1)
    k3 = rate(t, y + dt * (2 * k2 - k1))
    return y + dt / 6 * (k1 + 4 * k2 + k3)
