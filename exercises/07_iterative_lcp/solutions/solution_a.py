# Solution a of exercise 07: row by row, as the formulas say.

# %%
import numpy as np

from exercises import load

given, check = load("07")


# %%
def aor_sweep(A, b, lam, omega, r):
    new, w = lam.astype(float), A @ lam + b
    for i in range(len(lam)):
        moved = A[i, :i] @ (new[:i] - lam[:i])
        new[i] = max(0.0, lam[i] - (omega * w[i] + r * moved) / A[i, i])
    return new


# %%
def friction_sweep(A, b, lam, normal, mu, omega, r):
    new, w = lam.astype(float), A @ lam + b
    for i in range(len(lam)):
        moved = A[i, :i] @ (new[:i] - lam[:i])
        value = lam[i] - (omega * w[i] + r * moved) / A[i, i]
        if normal[i] < 0:
            new[i] = max(0.0, value)
        else:
            most = mu * new[normal[i]]
            new[i] = min(max(value, -most), most)
    return new


# %%
def solve_aor(A, b, omega, r, tolerance, most):
    lam = np.zeros(len(b))
    for _ in range(most):
        if given.residual(A, b, lam) <= tolerance:
            break
        lam = aor_sweep(A, b, lam, omega, r)
    return lam


# %%
def error_matrix(A, omega, r, free):
    A = A[free][:, free]
    D = np.diag(np.diagonal(A)) + r * np.tril(A, -1)
    return np.eye(len(A)) - omega * np.linalg.solve(D, A)


# %%
def chain_rate(n, omega, r):
    largest = 0.0
    for k in range(1, n + 1):
        square = np.cos((2 * k - 1) * np.pi / (2 * n)) ** 2
        linear = 2 * (omega - 1) - omega * r * square
        roots = np.roots([1.0, linear, (omega - 1) ** 2 - omega * (omega - r) * square])
        largest = max(largest, np.abs(roots).max())
    return float(largest)


# %%
def stack_forces(count, mass, dt, omega, r):
    A, b = given.column(count)
    impulses = solve_aor(A / mass, 9.81 * dt * b, omega, r, 1e-11, 100_000)
    return impulses / dt
