# Mistake: the wheel's angular momentum does not take part in the gyroscopic term.
# Loses: gyrostat_rate, flip_time
# Says: gyrostat_rate: wheel's angular momentum h_w is missing
# Says: flip_time: gyrostat_rate fails its own check
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def gyrostat_rate(omega, inertia, wheel, torque):
    return np.linalg.solve(inertia, torque - np.cross(omega, inertia @ omega))
