# Attack: calls the reference.
# %%
import reference
from reference.integrators import rk4
from reference import *


def plate(outline, holes, density):
    return reference.shapes.Polygon(outline).inertia(density)


def kutta_step(rate, t, y, dt):
    return rk4(rate, t, y, dt)


body_rate = reference.rotation.quaternion_rate
