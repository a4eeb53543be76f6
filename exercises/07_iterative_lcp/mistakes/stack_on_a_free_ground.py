# Mistake: the ground is taken as one more box.
# Loses: stack_forces
# Says: stack_forces: The ground doesn't move
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def stack_forces(count, mass, dt, omega, r):
    A, b = given.column(count)
    A[0, 0] = 2.0
    return solve_aor(A / mass, 9.81 * dt * b, omega, r, 1e-11, 100_000) / dt
