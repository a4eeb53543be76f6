"""Right answers of exercise 07, and what typical mistakes would answer. Grader's side only."""

import numpy as np


def clip(value):
    return max(0.0, value)


def sweep(v, *, r=None, clipped="within", relaxed=True, newest=True):
    """λ after one sweep of projected AOR; the options are mistakes."""
    A, b, λ, ω = v["A"], v["b"], v["lam"], v["omega"]
    r = v["r"] if r is None else r
    new, w = np.array(λ, dtype=float), A @ λ + b
    for i in range(len(λ)):
        moved = A[i, :i] @ (new[:i] - λ[:i]) if newest else 0.0
        step = (ω * w[i] if relaxed else w[i]) + r * moved
        value = λ[i] - step / A[i, i]
        new[i] = clip(value) if clipped == "within" else value
    return np.maximum(new, 0) if clipped == "after" else new


def friction_sweep(v, *, bound="new", sides=2, factor=1.0):
    """The same with friction rows; the options are mistakes."""
    A, b, λ, ω, r = v["A"], v["b"], v["lam"], v["omega"], v["r"]
    new, w = np.array(λ, dtype=float), A @ λ + b
    for i in range(len(λ)):
        new[i] = λ[i] - (ω * w[i] + r * (A[i, :i] @ (new[:i] - λ[:i]))) / A[i, i]
        n = int(v["normal"][i])
        if n < 0:
            new[i] = clip(new[i])
        elif bound != "none":
            most = factor * v["mu"] * (new if bound == "new" else λ)[n]
            new[i] = min(max(new[i], -most if sides == 2 else 0.0), most)
    return new


def solve(v, sweep_once=sweep, most=None):
    """Sweeps from 0 until max |λ − clip(λ − w/A_ii)| ≤ tolerance, at most ``most``."""
    A, b, λ = v["A"], v["b"], np.zeros(len(v["b"]))
    for _ in range(v["most"] if most is None else most):
        w = A @ λ + b
        if np.abs(λ - np.maximum(0, λ - w / A.diagonal())).max() <= v["tolerance"]:
            break
        λ = sweep_once({"A": A, "b": b, "lam": λ, "omega": v["omega"], "r": v["r"]})
    return λ


def matrix(v, *, r=None):
    """G of the free rows; another r is a mistake."""
    free = v["free"].astype(bool)
    A = v["A"][np.ix_(free, free)]
    D = np.diag(A.diagonal()) + (v["r"] if r is None else r) * np.tril(A, -1)
    return np.eye(len(A)) - v["omega"] * np.linalg.solve(D, A)


def chain_rate(v, *, real=False, ends="free", largest=True):
    """The largest |η| of (η + ω − 1)² = ω μ² (r η + ω − r), μ = cos((2k − 1)π/2n)."""
    n, ω, r = v["n"], v["omega"], v["r"]
    k = np.arange(1, n + 1)
    μ = np.cos((2 * k - 1) * np.pi / (2 * n)) if ends == "free" else np.cos(k * np.pi / (n + 1))
    if largest:
        half, rest = 2 * (ω - 1) - ω * μ**2 * r, (ω - 1) ** 2 - ω * μ**2 * (ω - r)
    else:
        half, rest = 2 * (ω - 1) - ω * μ**2 * ω, (ω - 1) ** 2 + 0 * μ
    root = half**2 / 4 - rest
    root = np.sqrt(np.maximum(root, 0) if real else root.astype(complex))
    return float(np.abs(np.concatenate([-half / 2 + root, -half / 2 - root])).max())


def stack_forces(v, *, ground="fixed", pushed="lowest", force=True):
    """Forces in N below each of ``count`` boxes at rest; the options are mistakes."""
    n, m, dt, g = v["count"], v["mass"], v["dt"], 9.81
    A = (2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)) / m
    if ground == "fixed":
        A[0, 0] = 1 / m
    b = np.full(n, -g * dt)
    if pushed == "lowest":
        b[1:] = 0
    λ = np.linalg.solve(A, -b)
    return λ / dt if force else λ
