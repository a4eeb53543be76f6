# Mistake: each component of the velocity is squared for itself, which depends on how the axes lie.
# Loses: air_force
# Says: air_force: squared for itself
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def air_force(velocity, spin, wind, drag, magnus):
    u = velocity - wind
    return -drag * np.abs(u) * u + magnus * np.cross(spin, u)
