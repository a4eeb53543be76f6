# Odd: changes its arguments in place.
# Earns: 100
# %% solution
# %%
pure = air_force, body_rate


def air_force(velocity, spin, wind, drag, magnus):
    force = pure[0](velocity, spin, wind, drag, magnus)
    velocity -= wind
    spin *= 0
    return force


def body_rate(q, omega):
    result = pure[1](q, omega)
    q[:] = 0
    omega[:] = np.nan
    return result
