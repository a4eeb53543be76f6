# Mistake: the right slopes with the weights 1, 2, 1.
# Loses: kutta_step, march
# Says: kutta_step: their weights are not


# %%
def kutta_step(rate, t, y, dt):
    k1 = rate(t, y)
    k2 = rate(t + dt / 2, y + dt / 2 * k1)
    k3 = rate(t + dt, y + dt * (2 * k2 - k1))
    return y + dt / 4 * (k1 + 2 * k2 + k3)
