# Mistake: drag along u/|u|, which is 0/0 where the ball is carried along by the wind.
# Loses: air_force
# Says: air_force: 0/0 where u = velocity − wind is 0
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def air_force(velocity, spin, wind, drag, magnus):
    u = velocity - wind
    speed = np.linalg.norm(u)
    return -drag * speed**2 * (u / speed) + magnus * np.cross(spin, u)
