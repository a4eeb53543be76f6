# Solution a of exercise 05: roots, matrices and a root finder.

# %%
import numpy as np
from scipy.optimize import brentq

from exercises import load

given, check = load("05")
G = given.G


# %%
def gap(centre, radius, a):
    """The nearest of the real roots of the cubic."""
    if a == 0:
        x = centre[0]
    else:
        roots = np.roots([2 * a**2, 0, 1 - 2 * a * centre[1], -centre[0]])
        roots = roots[np.abs(roots.imag) < 1e-7].real
        x = roots[np.argmin((roots - centre[0]) ** 2 + (a * roots**2 - centre[1]) ** 2)]
    point = np.array([x, a * x**2])
    normal = np.array([-2 * a * x, 1]) / np.hypot(2 * a * x, 1)
    return (centre - point) @ normal - radius, point, normal


# %%
def rows(centre, radius, a):
    size, _, n = gap(centre, radius, a)
    r, t = -(radius + size / 2) * n, np.array([-n[1], n[0]])
    return np.array([[*e, r[0] * e[1] - r[1] * e[0]] for e in (n, t)])


# %%
def after(centre, radius, a, u, mass, mu, dt):
    size = gap(centre, radius, a)[0]
    J = rows(centre, radius, a)
    M = np.diag([mass, mass, mass * radius**2 / 2])
    free = u + dt * np.array([0, -G, 0])
    A, b = J @ np.linalg.inv(M) @ J.T, J @ free
    normal = max(0, -(b[0] + size / dt) / A[0, 0])
    along = np.clip(-b[1] / A[1, 1], -mu * normal, mu * normal)
    return free + np.linalg.solve(M, J.T @ [normal, along])


# %%
def one_run(centre, radius, a, dt, steps):
    u = np.zeros(3)
    for _ in range(steps):
        u = after(centre, radius, a, u, 1.0, 1.0, dt)
        centre = centre + dt * u[:2]
    return centre


# %%
def roll(centre, radius, a, dt, steps):
    coarse, fine = (one_run(centre, radius, a, dt / k, k * steps) for k in (1, 2))
    return 2 * fine - coarse


# %%
def sliding(w, mu, normal):
    size = np.linalg.norm(mu * w)
    return -normal * mu**2 * w / size if size > 0 else np.zeros(2)


# %%
def holding(pull, mu, normal):
    s = normal * mu
    if np.sum((pull / s) ** 2) <= 1:
        return -pull
    tau = brentq(lambda x: np.sum((s * pull / (s**2 + x)) ** 2) - 1, 0, 100, xtol=1e-14)
    return -(s**2) * pull / (s**2 + tau)


# %%
def grained(pull, mu, normal, angle):
    c, s = np.cos(angle), np.sin(angle)
    R = np.array([[c, -s], [s, c]])
    return R @ holding(R.T @ pull, mu, normal)
