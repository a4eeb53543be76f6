# Mistake: the rope pulls at the first mass only.
# Loses: swing
# Says: swing: The rope pulls at the first mass only
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def swing(x, u, mass, pulleys, dt, steps):
    def rate(y):
        J, turning = rope(y[:4], y[4:], pulleys)
        A, b = embed(J[None], mass, given.weight(mass), np.array([turning]))
        pull = J * np.linalg.solve(A, -b) * np.array([1, 1, 0, 0])
        return np.concatenate([y[4:], (given.weight(mass) + pull) / mass])

    y = np.concatenate([x, u])
    for _ in range(steps):
        y = given.rk4(rate, y, dt)
    return y[:4], y[4:]
