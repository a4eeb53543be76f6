# Mistake: each gear is solved as if the other were not there.
# Loses: train
# Says: train: Each gear was solved as if it were alone
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def train(radii, inertia, omega, drive, drag, dt, steps):
    J = np.array([[radii[0], radii[1], 0], [0, radii[1], radii[2]]])
    for _ in range(steps):
        free = omega + dt * np.array([drive, 0, -drag * omega[2]]) / inertia
        lam = -(J @ free) / (dt * np.sum(J**2 / inertia, axis=1))
        omega = free + dt * J.T @ lam / inertia
    return omega, lam
