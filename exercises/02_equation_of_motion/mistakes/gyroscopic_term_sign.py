# Mistake: the cross product of the gyroscopic term is taken the other way round.
# Loses: gyrostat_rate, flip_time
# Says: gyrostat_rate: gyroscopic term has the wrong sign
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def gyrostat_rate(omega, inertia, wheel, torque):
    return np.linalg.solve(inertia, torque - np.cross(inertia @ omega + wheel, omega))
