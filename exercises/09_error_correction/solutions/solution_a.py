# Solution a of exercise 09: vectors, λ by the row's formula, a loop over the links.

# %%
import numpy as np

from exercises import load

given, check = load("09")


# %%
def acceleration(x, v, length, alpha, beta):
    r = np.linalg.norm(x)
    n = x / r
    phi, rate = r - length, n @ v
    turning = (v @ v - rate**2) / r
    lam = -2 * alpha * rate - beta**2 * phi - turning - n @ given.GRAVITY
    return given.GRAVITY + lam * n


# %%
def swing(x, v, length, alpha, beta, dt, steps):
    def rate(y):
        return np.concatenate([y[2:], acceleration(y[:2], y[2:], length, alpha, beta)])

    y = np.concatenate([x, v])
    for _ in range(steps):
        y = given.rk4(rate, y, dt)
    return y[:2], y[2:]


# %%
def relax(x, lam, inverse, length, compliance, dt):
    x, lam, soft = x.copy(), lam.copy(), compliance / dt**2
    for k in range(len(lam)):
        d = x[k + 1] - x[k]
        size = np.linalg.norm(d)
        w = inverse[k : k + 2]
        change = -(size - length + soft * lam[k]) / (w.sum() + soft)
        lam[k] += change
        x[k] -= w[0] * change * d / size
        x[k + 1] += w[1] * change * d / size
    return x, lam


# %%
def chain(x, v, inverse, length, compliance, dt, sweeps):
    free = v + dt * np.where(inverse[:, None] > 0, given.GRAVITY, 0)
    new, lam = x + dt * free, np.zeros(len(x) - 1)
    for _ in range(sweeps):
        new, lam = relax(new, lam, inverse, length, compliance, dt)
    return new, (new - x) / dt, lam


# %%
def hang(mass, length, compliance, dt):
    n = len(mass)
    x = np.column_stack([np.zeros(n + 1), -length * np.arange(n + 1)])
    v, inverse = np.zeros_like(x), np.concatenate([[0], 1 / mass])
    for _ in range(200):
        x, v, lam = chain(x, v, inverse, length, compliance, dt, 100)
        if np.abs(v).max() < 1e-9:
            break
    return -np.diff(x[:, 1]) - length, -lam / dt**2


# %%
def pin(x, v, mass, length, error_bias, max_bias, dt, steps):
    x, v = x.copy(), v.copy()
    for _ in range(steps):
        x += dt * v
        wanted = -(1 - error_bias**dt) * (x[1] - x[0] - length) / dt
        wanted = np.clip(wanted, -max_bias, max_bias)
        push = (wanted - (v[1] - v[0])) / np.sum(1 / mass)
        v += push * np.array([-1, 1]) / mass
    return x, v


# %%
def lift(x, v, mass, radius, bias, slop, dt, steps):
    x, v, pseudo = x.copy(), v.copy(), np.zeros(2)
    away = np.array([-1, 1]) / mass / np.sum(1 / mass)
    for _ in range(steps):
        x += dt * (v + pseudo)
        pseudo = np.zeros(2)
        depth = 2 * radius - (x[1] - x[0])
        if depth > 0:
            v += away * max(0, v[0] - v[1])
            pseudo = away * (1 - bias**dt) * max(0, depth - slop) / dt
    return x, v
