# Mistake: α and β have changed places.
# Loses: swing
# Says: swing: α and β have changed places
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def swing(x, v, length, alpha, beta, dt, steps):
    def rate(y):
        return np.concatenate([y[2:], acceleration(y[:2], y[2:], length, beta, alpha)])

    y = np.concatenate([x, v])
    for _ in range(steps):
        y = given.rk4(rate, y, dt)
    return y[:2], y[2:]
