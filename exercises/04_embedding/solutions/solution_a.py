# Solution a of exercise 04: written with matrices.

# %%
import numpy as np

from exercises import load

given, check = load("04")


# %%
def rope(x, u, pulleys):
    """J (4,) and J̇ u of the rope's length."""
    J, rate = np.zeros(4), 0.0
    for side in (slice(0, 2), slice(2, 4)):
        offset = x[side] - pulleys[side]
        r = np.linalg.norm(offset)
        n = offset / r
        J[side] = n
        rate += (u[side] @ u[side] - (n @ u[side]) ** 2) / r
    return J, rate


# %%
def embed(J, mass, force, rate):
    """A and b of A λ + b = 0, for accelerations."""
    B = J / mass
    return B @ J.T, B @ force + rate


# %%
def shortest(A, b):
    """The shortest λ with A λ + b = 0."""
    return np.linalg.lstsq(A, -b, rcond=1e-10)[0]


# %%
def step(x, u, J, mass, force, phi, dt, share):
    """One step at the level of velocities: (x, u, λ)."""
    free = u + dt * force / mass
    A = dt * (J / mass) @ J.T
    b = J @ free + share * phi / dt
    lam = np.linalg.solve(A, -b)
    u = free + dt * (J.T @ lam) / mass
    return x + dt * u, u, lam


# %%
def project(x, mass, pulleys, length):
    """The place nearest by mass where the rope fits."""
    for _ in range(30):
        phi = np.linalg.norm(x[:2] - pulleys[:2]) + np.linalg.norm(x[2:] - pulleys[2:]) - length
        if abs(phi) < 1e-12:
            break
        J, _ = rope(x, np.zeros(4), pulleys)
        x = x - J / mass * phi / (J @ (J / mass))
    return x


# %%
def swing(x, u, mass, pulleys, dt, steps):
    """(x, u) after so many steps of RK4."""

    def rate(y):
        J, turning = rope(y[:4], y[4:], pulleys)
        A, b = embed(J[None], mass, given.weight(mass), np.array([turning]))
        lam = np.linalg.solve(A, -b)
        return np.concatenate([y[4:], (given.weight(mass) + J * lam) / mass])

    y = np.concatenate([x, u])
    for _ in range(steps):
        y = given.rk4(rate, y, dt)
    return y[:4], y[4:]


# %%
def train(radii, inertia, omega, drive, drag, dt, steps):
    """(ω, λ) of three wheels in mesh."""
    J = np.array([[radii[0], radii[1], 0], [0, radii[1], radii[2]]])
    for _ in range(steps):
        torque = np.array([drive, 0, -drag * omega[2]])
        _, omega, lam = step(np.zeros(3), omega, J, inertia, torque, np.zeros(2), dt, 0.0)
    return omega, lam
