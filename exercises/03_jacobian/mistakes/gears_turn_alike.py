# Mistake: the wheels turn the same way, as in a belt drive.
# Loses: gears
# Says: gears: Wheels in mesh turn opposite ways
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def gears(radii, inertia, omega):
    J = np.array([radii[0], -radii[1]])
    lam = -(J @ omega) / np.sum(J**2 / inertia)
    after = omega + J * lam / inertia
    return after[0], after[1], lam
