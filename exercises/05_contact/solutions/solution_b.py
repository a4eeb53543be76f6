# Solution b of exercise 05: Newton's method, components, and points by angle.

# %%
import math

import numpy as np

from exercises import load

given, check = load("05")


# %%
def gap(centre, radius, a):
    """Newton's method on the slope of the squared distance, from straight below."""
    cx, cy = centre
    x = cx
    for _ in range(40):
        f = (x - cx) + 2 * a * x * (a * x * x - cy)
        slope = 1 + 2 * a * (3 * a * x * x - cy)
        x -= f / max(slope, 0.5)
    length = math.sqrt(1 + 4 * a * a * x * x)
    nx, ny = -2 * a * x / length, 1 / length
    px, py = x, a * x * x
    return (cx - px) * nx + (cy - py) * ny - radius, np.array([px, py]), np.array([nx, ny])


# %%
def rows(centre, radius, a):
    size, _, (nx, ny) = gap(centre, radius, a)
    return np.array([[nx, ny, 0], [-ny, nx, -(radius + size / 2)]])


# %%
def after(centre, radius, a, u, mass, mu, dt):
    size, _, (nx, ny) = gap(centre, radius, a)
    rho, I = radius + size / 2, 0.5 * mass * radius**2
    vx, vy, omega = u[0], u[1] - dt * given.G, u[2]
    push = mass * (-(nx * vx + ny * vy) - size / dt)
    push = push if push > 0 else 0.0
    slip = -ny * vx + nx * vy - rho * omega
    hold = -slip / (1 / mass + rho**2 / I)
    if abs(hold) > mu * push:
        hold = math.copysign(mu * push, hold)
    return np.array(
        [
            vx + (nx * push - ny * hold) / mass,
            vy + (ny * push + nx * hold) / mass,
            omega - rho * hold / I,
        ]
    )


# %%
def roll(centre, radius, a, dt, steps):
    ends = []
    for halves in (1, 2):
        x, y, u = centre[0], centre[1], np.zeros(3)
        for _ in range(halves * steps):
            u = after(np.array([x, y]), radius, a, u, 1.0, 1.0, dt / halves)
            x, y = x + dt / halves * u[0], y + dt / halves * u[1]
        ends.append(np.array([x, y]))
    return ends[1] + (ends[1] - ends[0])


# %%
def sliding(w, mu, normal):
    p, q = mu[0] * w[0], mu[1] * w[1]
    if p == 0 and q == 0:
        return np.array([0.0, 0.0])
    angle = math.atan2(q, p)
    return -normal * np.array([mu[0] * math.cos(angle), mu[1] * math.sin(angle)])


# %%
def holding(pull, mu, normal):
    s1, s2 = normal * mu[0], normal * mu[1]
    p1, p2 = -pull[0], -pull[1]
    if (p1 / s1) ** 2 + (p2 / s2) ** 2 <= 1:
        return np.array([p1, p2])
    low, high = 0.0, 1e3
    for _ in range(200):
        tau = (low + high) / 2
        if (s1 * p1 / (s1**2 + tau)) ** 2 + (s2 * p2 / (s2**2 + tau)) ** 2 > 1:
            low = tau
        else:
            high = tau
    return np.array([s1**2 * p1 / (s1**2 + tau), s2**2 * p2 / (s2**2 + tau)])


# %%
def grained(pull, mu, normal, angle):
    turn = complex(math.cos(angle), math.sin(angle))
    inside = complex(*pull) / turn
    found = complex(*holding(np.array([inside.real, inside.imag]), mu, normal)) * turn
    return np.array([found.real, found.imag])
