# Mistake: the moment of inertia about the centre of mass, where the pivot's is needed.
# Loses: swing
# Says: swing: add m·length²
# ruff: noqa: F821 (names that are not defined here are solution_a's)

# %%
def swing(mass, inertia, length, angle, dt, steps):
    rate, angles = 0.0, [angle]
    for _ in range(steps):
        rate -= dt * mass * given.GRAVITY * length * math.sin(angles[-1]) / inertia
        angles.append(angles[-1] + dt * rate)
    return np.array(angles)
