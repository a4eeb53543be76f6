# Mistake: the third slope forgets its part −dt k1.
# Loses: kutta_step, march, flip_time
# Says: kutta_step: part −dt k1 is missing
# Says: flip_time: kutta_step and march fail their own checks


# %%
def kutta_step(rate, t, y, dt):
    k1 = rate(t, y)
    k2 = rate(t + dt / 2, y + dt / 2 * k1)
    k3 = rate(t + dt, y + dt * 2 * k2)
    return y + dt / 6 * (k1 + 4 * k2 + k3)
