# Mistake: kutta_step is called, whatever step is handed in.
# Loses: march
# Says: march: whatever `step` it is given
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def march(step, rate, y, dt, steps):
    rows = [y]
    for k in range(steps):
        rows.append(kutta_step(rate, k * dt, rows[-1], dt))
    return np.array(rows)
