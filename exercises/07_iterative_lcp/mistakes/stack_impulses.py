# Mistake: impulses are returned for forces.
# Loses: stack_forces
# Says: stack_forces: divide by dt
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def stack_forces(count, mass, dt, omega, r):
    A, b = given.column(count)
    return solve_aor(A / mass, 9.81 * dt * b, omega, r, 1e-11, 100_000)
