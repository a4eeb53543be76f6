# Solution b of exercise 08: row by row, and a matrix built column by column.

# %%
import math

import numpy as np

from exercises import load

given, check = load("08")


# %%
def penalised(a, b, tau):
    values = []
    for x, y in zip(a, b, strict=True):
        penalty = x * y if x > 0 and y > 0 else 0.0
        values.append(tau * (x + y - math.sqrt(x * x + y * y)) + (1 - tau) * penalty)
    return np.array(values)


# %%
def slopes(a, b, tau):
    by_a, by_b = np.empty(len(a)), np.empty(len(a))
    for i, (x, y) in enumerate(zip(a, b, strict=True)):
        r = math.sqrt(x * x + y * y)
        c, s = (x / r, y / r) if r > 0 else (math.sqrt(0.5), math.sqrt(0.5))
        by_a[i], by_b[i] = tau * (1 - c), tau * (1 - s)
        if x > 0 and y > 0:
            by_a[i] += (1 - tau) * y
            by_b[i] += (1 - tau) * x
    return by_a, by_b


# %%
def newton_matrix(M, q, lam, tau):
    by_a, by_b = slopes(lam, M.dot(lam) + q, tau)
    H = np.array([[by_b[i] * M[i, j] for j in range(len(q))] for i in range(len(q))])
    H[np.arange(len(q)), np.arange(len(q))] += by_a
    return H


# %%
def step_length(psi, lam, step, slope):
    for halvings in range(41):
        t = 0.5**halvings
        if psi(lam + t * step) <= psi(lam) + 1e-4 * t * slope:
            return t
    return t


# %%
def solve(M, q, start, tau):
    lam = start.copy()
    energy = lambda x: 0.5 * np.linalg.norm(penalised(x, M.dot(x) + q, tau)) ** 2
    for _ in range(300):
        r = penalised(lam, M.dot(lam) + q, tau)
        if np.linalg.norm(r) < 1e-13:
            return lam
        step = np.linalg.lstsq(newton_matrix(M, q, lam, tau), -r, rcond=None)[0]
        lam = lam + step_length(energy, lam, step, -r.dot(r)) * step
    return lam


# %%
def on_path(M, q, mu):
    """An interior point: Newton's method on λ_i w_i = μ², kept positive."""
    lam, w = np.full(len(q), 1.0 + mu), np.full(len(q), 1.0 + mu)
    for _ in range(500):
        infeasible, off = M.dot(lam) + q - w, lam * w - mu**2
        if max(np.abs(infeasible).max(), (np.abs(off) / mu**2).max()) < 1e-13:
            break
        step = np.linalg.solve(np.diag(w) + lam[:, None] * M, -off - lam * infeasible)
        w_step = M.dot(step) + infeasible
        t = 1.0
        while min((lam + t * step).min(), (w + t * w_step).min()) <= 0:
            t *= 0.5
        if t < 1:
            t *= 0.9
        lam, w = lam + t * step, w + t * w_step
    return lam
