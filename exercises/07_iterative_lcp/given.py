"""Helpers of the exercise of unit 07, iterative methods (slides S14–S17)."""

import numpy as np


def column(n):
    """(A, b) of n equal boxes of 1 kg on one another, on the ground, g dt = 1: the answer is n, …, 1."""
    A = 2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
    A[0, 0] = 1.0
    b = np.zeros(n)
    b[0] = -1.0
    return A, b


def coupled(n=3, coupling=0.9):
    """(A, b) of equal rows that push one another: positive definite, and Jacobi overshoots."""
    return (1 - coupling) * np.eye(n) + coupling * np.ones((n, n)), -np.ones(n)


def residual(A, b, lam):
    """max |λ_i − clip(λ_i − w_i/A_ii)| for λ ≥ 0: 0 where λ solves the LCP."""
    return np.abs(lam - np.maximum(0, lam - (A @ lam + b) / np.diagonal(A))).max()
