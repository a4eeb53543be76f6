# Solution a of exercise 08: whole arrays.

# %%
import numpy as np

from exercises import load

given, check = load("08")


# %%
def penalised(a, b, tau):
    """τ φ(a, b) + (1 − τ) a₊ b₊."""
    return tau * (a + b - np.hypot(a, b)) + (1 - tau) * np.maximum(a, 0) * np.maximum(b, 0)


# %%
def slopes(a, b, tau):
    """The derivatives by a and by b; at (0, 0) those of the diagonal."""
    size = np.hypot(a, b)
    corner = size == 0
    size = np.where(corner, 1, size)
    by_a = np.where(corner, 1 - np.sqrt(0.5), 1 - a / size)
    by_b = np.where(corner, 1 - np.sqrt(0.5), 1 - b / size)
    both = (a > 0) & (b > 0)
    return (
        tau * by_a + (1 - tau) * np.where(both, b, 0),
        tau * by_b + (1 - tau) * np.where(both, a, 0),
    )


# %%
def newton_matrix(M, q, lam, tau):
    """H = D_a + D_b M."""
    by_a, by_b = slopes(lam, M @ lam + q, tau)
    return np.diag(by_a) + by_b[:, None] * M


# %%
def step_length(psi, lam, step, slope):
    """The first t of 1, ½, ¼, … that brings psi down enough."""
    t, before = 1.0, psi(lam)
    while t > 1e-12 and psi(lam + t * step) > before + 1e-4 * t * slope:
        t /= 2
    return t


# %%
def solve(M, q, start, tau):
    """Newton's method on the penalised function, with the line search."""
    phi = lambda lam: penalised(lam, M @ lam + q, tau)
    psi = lambda lam: 0.5 * np.sum(phi(lam) ** 2)
    lam = np.array(start, dtype=float)
    for _ in range(200):
        value = phi(lam)
        if np.max(np.abs(value)) <= 1e-12:
            break
        step = -np.linalg.solve(newton_matrix(M, q, lam, tau), value)
        lam = lam + step_length(psi, lam, step, -np.sum(value**2)) * step
    return lam


# %%
def on_path(M, q, mu):
    """λ with λ_i w_i = μ², both positive, by Newton's method on the smoothed function."""

    def phi(lam):
        w = M @ lam + q
        return lam + w - np.sqrt((lam - w) ** 2 + 4 * mu**2)

    lam = np.zeros(len(q))
    for _ in range(200):
        value, apart = phi(lam), lam - M @ lam - q
        if np.max(np.abs(value)) <= 1e-13:
            break
        share = apart / np.sqrt(apart**2 + 4 * mu**2)
        H = np.diag(1 - share) + (1 + share)[:, None] * M
        step = -np.linalg.solve(H, value)
        psi = lambda x: 0.5 * np.sum(phi(x) ** 2)
        lam = lam + step_length(psi, lam, step, -np.sum(value**2)) * step
    return lam
