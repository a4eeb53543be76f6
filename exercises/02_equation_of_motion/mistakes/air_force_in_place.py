# Mistake: the wind is taken off the caller's own velocity.
# Loses: air_force
# Says: air_force: write into the very array
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def air_force(velocity, spin, wind, drag, magnus):
    velocity -= wind
    return -drag * np.linalg.norm(velocity) * velocity + magnus * np.cross(spin, velocity)
