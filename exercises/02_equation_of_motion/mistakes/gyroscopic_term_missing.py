# Mistake: the gyroscopic term is forgotten.
# Loses: gyrostat_rate, flip_time
# Says: gyrostat_rate: gyroscopic term Ω × (I Ω + h_w) is missing
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def gyrostat_rate(omega, inertia, wheel, torque):
    return np.linalg.solve(inertia, torque)
