# Mistake: the wheels turn the same way, as in a belt drive.
# Loses: train
# Says: train: Wheels in mesh turn opposite ways
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def train(radii, inertia, omega, drive, drag, dt, steps):
    J = np.array([[radii[0], -radii[1], 0], [0, radii[1], -radii[2]]])
    for _ in range(steps):
        torque = np.array([drive, 0, -drag * omega[2]])
        _, omega, lam = step(np.zeros(3), omega, J, inertia, torque, np.zeros(2), dt, 0.0)
    return omega, lam
