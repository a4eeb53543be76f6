# Mistake: the exact motion, with small steps in between, where the engine's own step is asked for.
# Loses: swing
# Says: swing: exact motion, or nearly so
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def swing(mass, inertia, length, angle, dt, steps):
    factor = mass * given.GRAVITY * length / (inertia + mass * length**2)
    angles, y = [angle], np.array([angle, 0.0])
    for _ in range(steps):
        for _ in range(4):
            y = kutta_step(lambda t, y: np.array([y[1], -factor * math.sin(y[0])]), 0.0, y, dt / 4)
        angles.append(y[0])
    return np.array(angles)
