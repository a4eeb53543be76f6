# Mistake: the start is not in the result.
# Loses: march
# Says: march: the start, then the state after each step
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def march(step, rate, y, dt, steps):
    rows = []
    for k in range(steps):
        y = step(rate, k * dt, y, dt)
        rows.append(y)
    return np.array(rows)


# %%
def flip_time(inertia, wheel, omega, dt, longest):
    def rate(t, y):
        return gyrostat_rate(y, inertia, wheel, np.zeros(3))

    middle = np.append(omega[1], march(kutta_step, rate, omega, dt, round(longest / dt))[:, 1])
    flips = np.flatnonzero(middle[:-1] * middle[1:] <= 0)
    if len(flips) == 0:
        return math.inf
    return (flips[0] + middle[flips[0]] / (middle[flips[0]] - middle[flips[0] + 1])) * dt
