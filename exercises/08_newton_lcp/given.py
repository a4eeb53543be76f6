"""Helpers of the exercise of unit 08, Newton's methods for the LCP (slide S14)."""

import numpy as np


def min_map_energy(M, q):
    """psi(lam) = ½ Σ min(λ_i, w_i)², with w = M λ + q."""

    def psi(lam):
        return 0.5 * float(np.sum(np.minimum(lam, M @ lam + q) ** 2))

    return psi


def show_path(on_path):
    """Draws the central path of a problem of two rows: λ for μ from 3 down to 0.01."""
    M, q = np.array([[2.0, 1.0], [1.0, 2.0]]), np.array([-5.0, -1.0])
    mu = np.geomspace(3, 0.01, 40)
    path = [on_path(M, q, value) for value in mu]
    if any(np.shape(point) != (2,) for point in path):
        print("The picture comes once on_path passes its check.")
        return
    _draw_path(np.array(path), np.array([2.5, 0.0]))


def _draw_path(path, answer):
    import matplotlib.pyplot as plt

    _, axes = plt.subplots(figsize=(5, 3.2))
    axes.plot(*path.T, marker=".", label="central path")
    axes.plot(*answer, marker="*", markersize=12, linestyle="", label="solution")
    axes.set(xlabel="λ₁ (N s)", ylabel="λ₂ (N s)")
    axes.legend()
    plt.show()
