"""Helpers of the exercise of unit 06, pivoting methods for the LCP (slides S13, S14)."""

import numpy as np

SLACK = 1e-9  # what is off by less counts as right


def solve(A, b, inside):
    """`(lam, w)`, arrays of n, for the choice `inside`, an array of n truth values.

    Where a row is inside, w is 0 and λ is found; where it isn't, λ is 0 and w follows.
    """
    lam = np.zeros(len(b))
    on = np.flatnonzero(inside)
    if len(on):
        lam[on] = np.linalg.solve(A[np.ix_(on, on)], -b[on])
    w = A @ lam + b
    w[on] = 0
    return lam, w


def ring(n, strength):
    """A matrix with 1 on the diagonal and `strength` right of it, round the corner too: P for odd n."""
    return np.eye(n) + strength * np.roll(np.eye(n), 1, axis=1)
