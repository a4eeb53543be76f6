# Mistake: the impulse is taken as a change of velocity.
# Loses: gears
# Says: gears: The inertias are left out
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def gears(radii, inertia, omega):
    lam = -(radii @ omega) / np.sum(radii**2)
    after = omega + radii * lam
    return after[0], after[1], lam
