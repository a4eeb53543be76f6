# Mistake: λ is found once a step.
# Loses: swing
# Says: swing: λ is held over the whole step
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def swing(x, u, mass, pulleys, dt, steps):
    y = np.concatenate([x, u])
    for _ in range(steps):
        J, turning = rope(y[:4], y[4:], pulleys)
        A, b = embed(J[None], mass, given.weight(mass), np.array([turning]))
        force = given.weight(mass) + J * np.linalg.solve(A, -b)
        y = given.rk4(lambda y, force=force: np.concatenate([y[4:], force / mass]), y, dt)
    return y[:4], y[4:]
