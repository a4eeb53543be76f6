# Odd: the starter with two functions written.
# Earns: 25
# %%
import numpy as np

from exercises import load

given, check = load("02")
# %%
def plate(outline, holes, density):
    """Returns (mass, centre, inertia)."""
    ...
# %%
check("plate")
# %%
def body_rate(q, omega):
    return np.array([-q[1:] @ omega, *(q[0] * omega + np.cross(q[1:], omega))]) / 2
# %%
check("body_rate")
# %%
def air_force(velocity, spin, wind, drag, magnus):
    u = velocity - wind
    return magnus * np.cross(spin, u) - drag * u * np.sqrt(u @ u)
