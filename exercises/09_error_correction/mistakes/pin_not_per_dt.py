# Mistake: the gap is not divided by dt.
# Loses: pin
# Says: pin: The correction is a velocity
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def pin(x, v, mass, length, error_bias, max_bias, dt, steps):
    x, v = x.copy(), v.copy()
    for _ in range(steps):
        x += dt * v
        wanted = -(1 - error_bias**dt) * (x[1] - x[0] - length)
        wanted = np.clip(wanted, -max_bias, max_bias)
        push = (wanted - (v[1] - v[0])) / np.sum(1 / mass)
        v += push * np.array([-1, 1]) / mass
    return x, v
