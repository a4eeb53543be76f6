# Mistake: the angular momentum of the two wheels is kept, as if they had no bearings.
# Loses: gears
# Says: gears: The angular momentum of the two wheels is not kept
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def gears(radii, inertia, omega):
    unfit = inertia[0] / radii[0] - inertia[1] / radii[1]
    rim = (inertia @ omega) / unfit
    after = np.array([rim / radii[0], -rim / radii[1]])
    return after[0], after[1], inertia[0] * (after[0] - omega[0]) / radii[0]
