# Solution b of exercise 09: a linear system for the acceleration, components, and centres of mass.

# %%
import math

import numpy as np

from exercises import load

given, check = load("09")


# %%
def acceleration(x, v, length, alpha, beta):
    """Unknown are the two accelerations and λ: two equations of motion, one of the rod."""
    r = math.hypot(x[0], x[1])
    nx, ny = x[0] / r, x[1] / r
    rate = nx * v[0] + ny * v[1]
    nx_dot, ny_dot = (v[0] - nx * rate) / r, (v[1] - ny * rate) / r
    wanted = -2 * alpha * rate - beta * beta * (r - length) - (nx_dot * v[0] + ny_dot * v[1])
    matrix = [[1, 0, -nx], [0, 1, -ny], [nx, ny, 0]]
    return np.linalg.solve(matrix, [0, -given.G, wanted])[:2]


# %%
def swing(x, v, length, alpha, beta, dt, steps):
    for _ in range(steps):
        stages = []
        for part in (0, dt / 2, dt / 2, dt):
            at, speed = (x, v) if not stages else (x + part * stages[-1][0], v + part * stages[-1][1])
            stages.append((speed, acceleration(at, speed, length, alpha, beta)))
        x, v = (
            start + dt / 6 * (stages[0][i] + 2 * stages[1][i] + 2 * stages[2][i] + stages[3][i])
            for i, start in enumerate((x, v))
        )
    return x, v


# %%
def relax(x, lam, inverse, length, compliance, dt):
    points, tensions = [tuple(point) for point in x], list(lam)
    soft = compliance / (dt * dt)
    for k in range(len(tensions)):
        (ax, ay), (bx, by) = points[k], points[k + 1]
        size = math.hypot(bx - ax, by - ay)
        nx, ny = (bx - ax) / size, (by - ay) / size
        wa, wb = inverse[k], inverse[k + 1]
        change = (length - size - soft * tensions[k]) / (wa + wb + soft)
        tensions[k] += change
        points[k] = ax - wa * change * nx, ay - wa * change * ny
        points[k + 1] = bx + wb * change * nx, by + wb * change * ny
    return np.array(points), np.array(tensions)


# %%
def chain(x, v, inverse, length, compliance, dt, sweeps):
    new = x + dt * v
    new[inverse > 0, 1] -= dt**2 * given.G
    lam = np.zeros(len(x) - 1)
    for _ in range(sweeps):
        new, lam = relax(new, lam, inverse, length, compliance, dt)
    return new, (new - x) / dt, lam


# %%
def hang(mass, length, compliance, dt):
    """Stops when the points no longer move."""
    inverse = np.array([0.0, *(1 / m for m in mass)])
    x = np.zeros((len(inverse), 2))
    x[1:, 1] = -length * np.arange(1, len(inverse))
    v, moved = np.zeros_like(x), 1.0
    while moved > 1e-9:
        before = x
        x, v, lam = chain(x, v, inverse, length, compliance, dt, 120)
        moved = np.abs(x - before).max()
    sizes = np.hypot(*(x[1:] - x[:-1]).T)
    return sizes - length, np.array([-value / dt / dt for value in lam])


# %%
def pin(x, v, mass, length, error_bias, max_bias, dt, steps):
    """The centre of mass goes on evenly; the distance follows the rule."""
    total = mass[0] + mass[1]
    centre, drift = mass @ x / total, mass @ v / total
    distance, rate = x[1] - x[0], v[1] - v[0]
    for _ in range(steps):
        centre, distance = centre + dt * drift, distance + dt * rate
        rate = (math.exp(dt * math.log(error_bias)) - 1) * (distance - length) / dt
        rate = min(max(rate, -max_bias), max_bias)
    parts = np.array([-mass[1], mass[0]]) / total
    return centre + parts * distance, drift + parts * rate


# %%
def lift(x, v, mass, radius, bias, slop, dt, steps):
    total = mass[0] + mass[1]
    centre, drift = mass @ x / total, mass @ v / total
    distance, rate, pushed = x[1] - x[0], v[1] - v[0], 0.0
    for _ in range(steps):
        centre, distance = centre + dt * drift, distance + dt * rate + pushed
        pushed = 0.0
        if distance < 2 * radius:
            rate = max(rate, 0.0)
            pushed = (1 - bias**dt) * max(2 * radius - slop - distance, 0.0)
    parts = np.array([-mass[1], mass[0]]) / total
    return centre + parts * distance, drift + parts * rate
