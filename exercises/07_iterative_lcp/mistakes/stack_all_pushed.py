# Mistake: gravity pushes on each contact.
# Loses: stack_forces
# Says: stack_forces: All boxes fall alike
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def stack_forces(count, mass, dt, omega, r):
    A, _ = given.column(count)
    return solve_aor(A / mass, np.full(count, -9.81 * dt), omega, r, 1e-11, 100_000) / dt
