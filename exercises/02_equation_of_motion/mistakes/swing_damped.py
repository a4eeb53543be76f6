# Mistake: the rate is damped a little at each step, as engines do unless told not to.
# Loses: swing
# Says: swing: No damping
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def swing(mass, inertia, length, angle, dt, steps):
    rate, angles = 0.0, [angle]
    for _ in range(steps):
        rate -= dt * mass * given.GRAVITY * length * math.sin(angles[-1]) / (inertia + mass * length**2)
        rate *= 1 - 0.04 * dt
        angles.append(angles[-1] + dt * rate)
    return np.array(angles)
