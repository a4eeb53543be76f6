# Mistake: it slides down without friction.
# Loses: roll
# Says: roll: The disc slides without turning
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def one_run(centre, radius, a, dt, steps):
    u = np.zeros(3)
    for _ in range(steps):
        u = after(centre, radius, a, u, 1.0, 0.0, dt)
        centre = centre + dt * u[:2]
    return centre
