# Mistake: The wind is added to the velocity.
# Loses: air_force
# Says: air_force: The wind is added
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def air_force(velocity, spin, wind, drag, magnus):
    u = velocity + wind
    return -drag * np.linalg.norm(u) * u + magnus * np.cross(spin, u)
