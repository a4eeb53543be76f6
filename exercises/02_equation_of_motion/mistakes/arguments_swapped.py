# Mistake: velocity and spin stand in the wrong order.
# Loses: air_force
# Says: air_force: power u·F must be
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def air_force(spin, velocity, wind, drag, magnus):
    u = velocity - wind
    return -drag * np.linalg.norm(u) * u + magnus * np.cross(spin, u)
