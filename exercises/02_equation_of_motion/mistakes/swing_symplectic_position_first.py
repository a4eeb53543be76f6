# Mistake: symplectic Euler, but position first.
# Loses: swing
# Says: swing: but position first
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def swing(mass, inertia, length, angle, dt, steps):
    rate, angles = 0.0, [angle]
    for _ in range(steps):
        angles.append(angles[-1] + dt * rate)
        rate -= dt * mass * given.GRAVITY * length * math.sin(angles[-1]) / (inertia + mass * length**2)
    return np.array(angles)
