"""The linear systems inside Newton's methods: solved directly, dense or sparse, singular ones too.

Slides S14; lectures/08_newton_lcp.md. Source: Levenberg, Quart. Appl. Math. 2 (1944) 164, for the damped
least squares.
"""

import warnings

import numpy as np
import scipy.linalg
import scipy.sparse
import scipy.sparse.linalg

from ..factored import Factored

_DENSE = 150  # rows up to which a sparse system is cut and solved faster as a dense one
_GOOD = 1e-7  # what a solve must leave of the right side, to be taken for a solution
_DAMPING = 1e-10


def formed(A):
    """A as an array, or as a csr_array where it is sparse and large: direct methods need its entries."""
    A = A.tosparse() if isinstance(A, Factored) else A
    return A.toarray() if scipy.sparse.issparse(A) and A.shape[0] <= _DENSE else A


def solve(H, r):
    """x of H x = r, H (n, n) dense or sparse; of a singular H a x that leaves as little of r as can be."""
    if not len(r):
        return np.zeros(0)
    if scipy.sparse.issparse(H) and len(r) <= _DENSE:
        H = H.toarray()
    x = _direct(H, r)
    with np.errstate(all="ignore"):
        if np.isfinite(x).all() and np.abs(H @ x - r).max() <= _GOOD * np.abs(r).max():
            return x
    return _least_squares(H, r)


def _direct(H, r):
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # that H is singular shows in x
            if scipy.sparse.issparse(H):
                return scipy.sparse.linalg.splu(scipy.sparse.csc_array(H)).solve(r)
            return np.linalg.solve(H, r)
    except (RuntimeError, np.linalg.LinAlgError):
        return np.full(len(r), np.nan)


def _least_squares(H, r):
    """The shortest x that leaves the least of r; sparse: nearly so, by (HᵀH + ε) x = Hᵀ r."""
    if not np.isfinite(H.data if scipy.sparse.issparse(H) else H).all() or not np.isfinite(r).all():
        return np.full(len(r), np.nan)
    if not scipy.sparse.issparse(H):
        try:
            return scipy.linalg.lstsq(H, r, cond=1e-12, check_finite=False)[0]
        except np.linalg.LinAlgError:
            return np.full(len(r), np.nan)
    normal = scipy.sparse.csc_array(H.T @ H)
    ε = _DAMPING * max(normal.diagonal().max(), np.finfo(float).tiny)
    damped = normal + ε * scipy.sparse.eye_array(len(r))
    x = np.zeros(len(r))
    for _ in range(3):  # each time what is left over, so that ε vanishes from what H can reach
        x += _direct(damped, H.T @ (r - H @ x))
    return x


def factored_solve(H):
    """The function r → x of H x = r: H (n, n), dense or sparse, factored once; if singular, as ``solve``."""
    direct = _factor(H)

    def apply(r):
        x = direct(r)
        fine = np.isfinite(x).all() and np.abs(H @ x - r).max(initial=0) <= _GOOD * np.abs(r).max(initial=0)
        return x if fine else _least_squares(H, r)

    return apply


def _factor(H):
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            if scipy.sparse.issparse(H):
                return scipy.sparse.linalg.splu(scipy.sparse.csc_array(H)).solve
            LU = scipy.linalg.lu_factor(H, check_finite=False)
            return lambda r: scipy.linalg.lu_solve(LU, r, check_finite=False)
    except (RuntimeError, ValueError, np.linalg.LinAlgError):
        return lambda r: np.full(len(r), np.nan)
