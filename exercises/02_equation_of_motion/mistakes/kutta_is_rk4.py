# Mistake: the classical fourth-order method, which is too good: another scheme is named.
# Loses: kutta_step, march
# Says: kutta_step: classical fourth-order
# Says: march: order is 4


# %%
def kutta_step(rate, t, y, dt):
    k1 = rate(t, y)
    k2 = rate(t + dt / 2, y + dt / 2 * k1)
    k3 = rate(t + dt / 2, y + dt / 2 * k2)
    k4 = rate(t + dt, y + dt * k3)
    return y + (k1 + 2 * (k2 + k3) + k4) * dt / 6
