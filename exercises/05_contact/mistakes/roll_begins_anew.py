# Mistake: the velocity is not carried on.
# Loses: roll
# Says: roll: The disc stays where it was
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def one_run(centre, radius, a, dt, steps):
    u = np.zeros(3)
    for _ in range(steps):
        u = after(centre, radius, a, np.zeros(3), 1.0, 1.0, dt)
        centre = centre + dt * u[:2]
    return centre
