# Mistake: every step is told that it starts at time 0.
# Loses: march
# Says: march: The clock stands still
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def march(step, rate, y, dt, steps):
    rows = [y]
    for _ in range(steps):
        rows.append(step(rate, 0.0, rows[-1], dt))
    return np.array(rows)
