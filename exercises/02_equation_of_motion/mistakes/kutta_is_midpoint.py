# Mistake: the midpoint method, of order 2, in the place of Kutta's third-order method.
# Loses: kutta_step, march
# Says: kutta_step: midpoint method
# Says: march: is of order 2


# %%
def kutta_step(rate, t, y, dt):
    return y + dt * rate(t + dt / 2, y + dt / 2 * rate(t, y))
