# Mistake: the finer run is returned as it is.
# Loses: roll
# Says: roll: It is off as one run of first order is
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def roll(centre, radius, a, dt, steps):
    return one_run(centre, radius, a, dt / 2, 2 * steps)
