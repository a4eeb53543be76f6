# Mistake: the Magnus force is taken along u × spin.
# Loses: air_force
# Says: air_force: spin first
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def air_force(velocity, spin, wind, drag, magnus):
    u = velocity - wind
    return -drag * np.linalg.norm(u) * u + magnus * np.cross(u, spin)
