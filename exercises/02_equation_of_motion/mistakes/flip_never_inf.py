# Mistake: a body that does not turn over is said to do so at the end of the run.
# Loses: flip_time
# Says: flip_time: return np.inf after
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def flip_time(inertia, wheel, omega, dt, longest):
    for k in range(round(longest / dt)):
        later = kutta_step(lambda t, y: gyrostat_rate(y, inertia, wheel, np.zeros(3)), k * dt, omega, dt)
        if later[1] <= 0:
            return (k + omega[1] / (omega[1] - later[1])) * dt
        omega = later
    return longest
