# Mistake: a list of states, of which no column can be taken, where an array is asked for.
# Loses: march, flip_time
# Says: march: not of the kind asked for
# Says: flip_time: march fails its own check

# %%
def march(step, rate, y, dt, steps):
    rows = [y]
    for k in range(steps):
        rows.append(step(rate, k * dt, rows[-1], dt))
    return rows
