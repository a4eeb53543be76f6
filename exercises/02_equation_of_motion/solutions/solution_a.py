# Solution a of exercise 02: written with vectors and small functions.

# %%
import math

import numpy as np

from exercises import load

given, check = load("02")


# %%
def plate(outline, holes, density):
    """Mass, centre of mass and moment of inertia about that centre, of a plate with holes."""
    signs = np.array([1] + [-1] * len(holes))
    areas, centres, seconds = zip(*(given.polygon(corners) for corners in (outline, *holes)), strict=True)
    masses = density * signs * np.array(areas)
    mass = masses.sum()
    centre = masses @ np.array(centres) / mass
    distances = np.sum((np.array(centres) - centre) ** 2, axis=1)
    return mass, centre, density * signs @ np.array(seconds) + masses @ distances


# %%
def body_rate(q, omega):
    """q̇ from the angular velocity in the body's frame."""
    w, x = q[0], q[1:]
    return 0.5 * np.concatenate([[-x @ omega], w * omega + np.cross(x, omega)])


# %%
def gyrostat_rate(omega, inertia, wheel, torque):
    """Ω̇ in the body's frame, of a body that carries a wheel."""
    return np.linalg.solve(inertia, torque - np.cross(omega, inertia @ omega + wheel))


# %%
def air_force(velocity, spin, wind, drag, magnus):
    """Drag and Magnus force on a ball."""
    u = velocity - wind
    return -drag * np.linalg.norm(u) * u + magnus * np.cross(spin, u)


# %%
def kutta_step(rate, t, y, dt):
    """The state at t + dt, by Kutta's third-order method."""
    k1 = rate(t, y)
    k2 = rate(t + dt / 2, y + dt / 2 * k1)
    k3 = rate(t + dt, y + dt * (2 * k2 - k1))
    return y + dt / 6 * (k1 + 4 * k2 + k3)


# %%
def march(step, rate, y, dt, steps):
    """All states of a run, as the rows of an array."""
    rows = [y]
    for k in range(steps):
        rows.append(step(rate, k * dt, rows[-1], dt))
    return np.array(rows)


# %%
def flip_time(inertia, wheel, omega, dt, longest):
    """When the second component of Ω first changes its sign; math.inf if it does not until `longest`."""

    def rate(t, y):
        return gyrostat_rate(y, inertia, wheel, np.zeros(3))

    middle = march(kutta_step, rate, omega, dt, round(longest / dt))[:, 1]
    flips = np.flatnonzero(middle[:-1] * middle[1:] <= 0)
    if len(flips) == 0:
        return math.inf
    k = flips[0]
    return (k + middle[k] / (middle[k] - middle[k + 1])) * dt


# %%
def swing(mass, inertia, length, angle, dt, steps):
    """Angles of a pendulum that is let go at `angle`, as pybullet steps it."""
    rate, angles = 0.0, [angle]
    for _ in range(steps):
        rate -= dt * mass * given.GRAVITY * length * math.sin(angles[-1]) / (inertia + mass * length**2)
        angles.append(angles[-1] + dt * rate)
    return np.array(angles)
