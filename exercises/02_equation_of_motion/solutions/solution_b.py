# Solution b of exercise 02: written with components, loops and matrices.

# %%
import numpy as np

from exercises import load

given, check = load("02")


# %%
def plate(outline, holes, density):
    area, centre, second = given.polygon(outline)
    mass, moment, about_origin = area, area * centre, second + area * (centre[0] ** 2 + centre[1] ** 2)
    for hole in holes:
        area, centre, second = given.polygon(hole)
        mass -= area
        moment = moment - area * centre
        about_origin -= second + area * (centre[0] ** 2 + centre[1] ** 2)
    centre = moment / mass
    return density * mass, centre, density * (about_origin - mass * (centre[0] ** 2 + centre[1] ** 2))


# %%
def body_rate(q, omega):
    w, x, y, z = q
    matrix = np.array([[-x, -y, -z], [w, -z, y], [z, w, -x], [-y, x, w]])
    return matrix @ omega / 2


# %%
def cross_matrix(a):
    return np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def gyrostat_rate(omega, inertia, wheel, torque):
    momentum = inertia @ omega + wheel
    return np.linalg.inv(inertia) @ (torque + cross_matrix(momentum) @ omega)


# %%
def air_force(velocity, spin, wind, drag, magnus):
    ux, uy, uz = (v - w for v, w in zip(velocity, wind, strict=True))
    speed = (ux * ux + uy * uy + uz * uz) ** 0.5
    sx, sy, sz = spin
    return np.array(
        [
            magnus * (sy * uz - sz * uy) - drag * speed * ux,
            magnus * (sz * ux - sx * uz) - drag * speed * uy,
            magnus * (sx * uy - sy * ux) - drag * speed * uz,
        ]
    )


# %%
nodes, weights = [0.0, 0.5, 1.0], [1 / 6, 2 / 3, 1 / 6]
table = [[], [0.5], [-1.0, 2.0]]


def kutta_step(rate, t, y, dt):
    slopes = []
    for node, row in zip(nodes, table, strict=True):
        slopes.append(rate(t + node * dt, y + dt * sum(a * k for a, k in zip(row, slopes, strict=True))))
    return y + dt * sum(weight * k for weight, k in zip(weights, slopes, strict=True))


# %%
def march(step, rate, y, dt, steps):
    states = np.empty((steps + 1, len(y)))
    states[0] = y
    for k in range(1, steps + 1):
        states[k] = step(rate, (k - 1) * dt, states[k - 1], dt)
    return states


# %%
def flip_time(inertia, wheel, omega, dt, longest):
    still = np.zeros(3)
    for k in range(round(longest / dt)):
        later = kutta_step(lambda _, y: gyrostat_rate(y, inertia, wheel, still), k * dt, omega, dt)
        if (omega[1] > 0) != (later[1] > 0):
            return k * dt + dt * omega[1] / (omega[1] - later[1])
        omega = later
    return np.inf


# %%
def swing(mass, inertia, length, angle, dt, steps):
    about_pivot = inertia + mass * length * length
    rates, angles = np.zeros(steps + 1), np.full(steps + 1, angle)
    for k in range(steps):
        rates[k + 1] = rates[k] - dt * np.sin(angles[k]) * mass * given.GRAVITY * length / about_pivot
        angles[k + 1] = angles[k] + rates[k + 1] * dt
    return angles
