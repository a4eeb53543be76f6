# Solution b of exercise 07: w is kept up to date, and matrices instead of rows.

# %%
import numpy as np

from exercises import load

given, check = load("07")


# %%
def swept(A, b, lam, omega, r, low, high):
    """A sweep in which each row that has moved tells those after it; low, high: functions of (i, λ)."""
    lam = np.array(lam, dtype=float)
    rest = omega * (A @ lam + b)
    for i, a in enumerate(np.diag(A)):
        value = np.clip(lam[i] - rest[i] / a, low(i, lam), high(i, lam))
        rest = rest + r * A[:, i] * (value - lam[i])
        lam[i] = value
    return lam


def aor_sweep(A, b, lam, omega, r):
    return swept(A, b, lam, omega, r, lambda i, x: 0.0, lambda i, x: np.inf)


# %%
def friction_sweep(A, b, lam, normal, mu, omega, r):
    def high(i, x):
        return np.inf if normal[i] == -1 else mu * x[normal[i]]

    return swept(A, b, lam, omega, r, lambda i, x: 0.0 if normal[i] == -1 else -high(i, x), high)


# %%
def solve_aor(A, b, omega, r, tolerance, most):
    lam, done = np.zeros(len(b)), 0
    while done < most and given.residual(A, b, lam) > tolerance:
        lam, done = aor_sweep(A, b, lam, omega, r), done + 1
    return lam


# %%
def error_matrix(A, omega, r, free):
    rows = np.flatnonzero(free)
    A = A[np.ix_(rows, rows)]
    columns = []
    for e in np.eye(len(rows)):
        new, w = e.copy(), A @ e
        for i in range(len(e)):
            new[i] = e[i] - (omega * w[i] + r * np.dot(A[i, :i], (new - e)[:i])) / A[i, i]
        columns.append(new)
    return np.array(columns).T


# %%
def chain_rate(n, omega, r):
    square = np.cos(np.pi * (np.arange(n) + 0.5) / n) ** 2
    half = omega - 1 - omega * r * square / 2
    root = np.sqrt(half**2 - (omega - 1) ** 2 + omega * (omega - r) * square + 0j)
    return float(max(abs(-half + root).max(), abs(-half - root).max()))


# %%
def stack_forces(count, mass, dt, omega, r):
    A = (
        np.diag(np.full(count, 2.0)) - np.diag(np.ones(count - 1), 1) - np.diag(np.ones(count - 1), -1)
    ) / mass
    A[0, 0] = 1 / mass
    push = np.where(np.arange(count) == 0, -9.81, 0.0)  # a force for an impulse: dt = 1 s
    return solve_aor(A, push, omega, r, 1e-9, 100_000)
