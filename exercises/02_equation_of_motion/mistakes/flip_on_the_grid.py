# Mistake: the time of the step after the flip, with no line drawn between the two steps.
# Loses: flip_time
# Says: flip_time: straight line between the two steps
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def flip_time(inertia, wheel, omega, dt, longest):
    def rate(t, y):
        return gyrostat_rate(y, inertia, wheel, np.zeros(3))

    middle = march(kutta_step, rate, omega, dt, round(longest / dt))[:, 1]
    after = np.flatnonzero(middle < 0)
    return after[0] * dt if len(after) else math.inf
