# Odd: functions in another order, with other names for arguments, and defined twice; global names reused.
# Earns: 100
# %%
def swing(*anything):
    return None


sum = 3
list = dict
# %%
del sum, list
# %% solution
# %%
math_sin, math = math.sin, None


def swing(m, I, l, phi0, h, n):
    rate, angles = 0.0, [phi0]
    for _ in range(n):
        rate = rate - h * m * 9.81 * l * math_sin(angles[-1]) / (I + m * l**2)
        angles.append(angles[-1] + h * rate)
    return angles


def flip_time(inertia, wheel, omega, dt, longest, inner=flip_time):
    global math
    import math

    return inner(inertia, wheel, omega, dt, longest)
