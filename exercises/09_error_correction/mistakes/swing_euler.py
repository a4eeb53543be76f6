# Mistake: Euler's method.
# Loses: swing
# Says: swing: This is Euler's method
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def swing(x, v, length, alpha, beta, dt, steps):
    def rate(y):
        return np.concatenate([y[2:], acceleration(y[:2], y[2:], length, alpha, beta)])

    y = np.concatenate([x, v])
    for _ in range(steps):
        y = y + dt * rate(y)
    return y[:2], y[2:]
