# Mistake: the torque is divided by the diagonal of the inertia.
# Loses: gyrostat_rate
# Says: gyrostat_rate: needs np.linalg.solve
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def gyrostat_rate(omega, inertia, wheel, torque):
    return (torque - np.cross(omega, inertia @ omega + wheel)) / np.diag(inertia)
