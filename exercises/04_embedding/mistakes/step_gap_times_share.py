# Mistake: the gap is not divided by the step.
# Loses: step
# Says: step: must be divided by Δt
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def step(x, u, J, mass, force, phi, dt, share):
    free = u + dt * force / mass
    A = dt * (J / mass) @ J.T
    lam = np.linalg.solve(A, -(J @ free + share * phi))
    u = free + dt * (J.T @ lam) / mass
    return x + dt * u, u, lam
