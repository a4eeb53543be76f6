# Mistake: λ is held over the step.
# Loses: swing
# Says: swing: λ is held over the whole step
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def swing(x, v, length, alpha, beta, dt, steps):
    def rate(y):
        return np.concatenate([y[2:], acceleration(y[:2], y[2:], length, alpha, beta)])

    y = np.concatenate([x, v])
    for _ in range(steps):
        held = rate(y)[2:]
        y = given.rk4(lambda z, held=held: np.concatenate([z[2:], held]), y, dt)
    return y[:2], y[2:]
