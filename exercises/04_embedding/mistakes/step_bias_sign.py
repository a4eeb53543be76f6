# Mistake: the gap is widened.
# Loses: step
# Says: step: The gap is widened
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def step(x, u, J, mass, force, phi, dt, share):
    free = u + dt * force / mass
    A = dt * (J / mass) @ J.T
    lam = np.linalg.solve(A, -(J @ free - share * phi / dt))
    u = free + dt * (J.T @ lam) / mass
    return x + dt * u, u, lam
