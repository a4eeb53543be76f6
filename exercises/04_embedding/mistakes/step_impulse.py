# Mistake: A without the step: λ is an impulse.
# Loses: step, train
# Says: step: λ is an impulse
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def step(x, u, J, mass, force, phi, dt, share):
    free = u + dt * force / mass
    A = (J / mass) @ J.T
    lam = np.linalg.solve(A, -(J @ free + share * phi / dt))
    u = free + (J.T @ lam) / mass
    return x + dt * u, u, lam
