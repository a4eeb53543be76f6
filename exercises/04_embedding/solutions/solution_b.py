# Solution b of exercise 04: written with the whole system of u and λ, and with numbers.

# %%
import numpy as np

from exercises import load

given, check = load("04")


# %%
def rope(x, u, pulleys):
    a, b = x[:2] - pulleys[:2], x[2:] - pulleys[2:]
    r, s = np.hypot(*a), np.hypot(*b)
    around = (a[0] * u[1] - a[1] * u[0]) ** 2 / r**3 + (b[0] * u[3] - b[1] * u[2]) ** 2 / s**3
    return np.array([a[0] / r, a[1] / r, b[0] / s, b[1] / s]), around


# %%
def embed(J, mass, force, rate):
    inverse = np.diag(1 / mass)
    return J @ inverse @ J.T, J @ inverse @ force + rate


# %%
def shortest(A, b):
    values, vectors = np.linalg.eigh(A)
    there = values > 1e-10 * values[-1]
    return -vectors[:, there] @ ((vectors[:, there].T @ b) / values[there])


# %%
def whole(mass, J, right, wanted, h):
    """M x − h Jᵀ λ = right and J x = wanted, in one system."""
    n, m = len(mass), len(J)
    system = np.block([[np.diag(mass), -h * J.T], [J, np.zeros((m, m))]])
    both = np.linalg.solve(system, np.concatenate([right, wanted]))
    return both[:n], both[n:]


def step(x, u, J, mass, force, phi, dt, share):
    after, lam = whole(mass, J, mass * u + dt * force, -share * phi / dt, dt)
    return x + dt * after, after, lam


# %%
def project(x, mass, pulleys, length):
    phi = 1.0
    while abs(phi) > 1e-13:
        J, _ = rope(x, 0 * x, pulleys)
        phi = np.hypot(*(x - pulleys)[:2]) + np.hypot(*(x - pulleys)[2:]) - length
        x = x + whole(mass, J[None], 0 * x, np.array([-phi]), 1.0)[0]
        if abs(phi) < 1e-14 * length:
            break
    return x


# %%
def swing(x, u, mass, pulleys, dt, steps):
    def rate(y):
        J, turning = rope(y[:4], y[4:], pulleys)
        acceleration, _ = whole(mass, J[None], given.weight(mass), np.array([-turning]), 1.0)
        return np.concatenate([y[4:], acceleration])

    y = np.concatenate([x, u])
    for _ in range(steps):
        y = given.rk4(rate, y, dt)
    return y[:4], y[4:]


# %%
def train(radii, inertia, omega, drive, drag, dt, steps):
    lam = np.zeros(2)
    spread = radii**2 / inertia
    A = np.array([[spread[0] + spread[1], spread[1]], [spread[1], spread[1] + spread[2]]])
    for _ in range(steps):
        free = omega + dt * np.array([drive, 0, -drag * omega[2]]) / inertia
        slip = radii[:-1] * free[:-1] + radii[1:] * free[1:]
        lam = -np.linalg.inv(A) @ slip / dt
        omega = free + dt * radii * np.array([lam[0], lam[0] + lam[1], lam[1]]) / inertia
    return omega, lam
