# Mistake: positions move with the new velocities.
# Loses: lift
# Says: lift: pymunk moves the positions first
# ruff: noqa: F821 (names that are not defined here are solution_a's)


# %%
def lift(x, v, mass, radius, bias, slop, dt, steps):
    x, v, pseudo = x.copy(), v.copy(), np.zeros(2)
    away = np.array([-1, 1]) / mass / np.sum(1 / mass)
    for _ in range(steps):
        pseudo = np.zeros(2)
        depth = 2 * radius - (x[1] - x[0])
        if depth > 0:
            v += away * max(0, v[0] - v[1])
            pseudo = away * (1 - bias**dt) * max(0, depth - slop) / dt
        x += dt * (v + pseudo)
    return x, v
