"""What a problem may be made of: A, b, bounds and friction, each checked as it comes in.

Each function names the argument, what it got and what would be right, as those of ``reference.inputs`` do.

Slides S11, S12, S13, S17; lectures/06_pivoting_lcp.md.
"""

import numpy as np
import scipy.sparse

from .. import inputs
from ..factored import Factored


def matrix(A):
    """A as a dense array, a csr_array with sorted 32-bit indices, or a Factored: a copy, square, finite."""
    if isinstance(A, Factored):
        return A
    if scipy.sparse.issparse(A):
        if A.dtype.kind not in "biuf":
            raise TypeError(f"A must hold real numbers, but holds {A.dtype}")
        result = scipy.sparse.csr_array(A, dtype=float, copy=True)
        _square(result.shape)
        result.sum_duplicates()
        result.indices, result.indptr = result.indices.astype(np.int32), result.indptr.astype(np.int32)
        if not np.isfinite(result.data).all():
            raise ValueError("A must hold finite numbers only, but its stored entries do not")
        return result
    if not isinstance(A, (np.ndarray, list, tuple)):
        raise TypeError(
            "A must be a dense array, a SciPy sparse array, or a reference.factored.Factored, but is of type "
            f"{type(A).__name__}"
        )
    try:
        shape = np.shape(A)
    except ValueError:
        raise ValueError("A must be a square matrix, but its rows are not all of one length") from None
    shape = (0, 0) if shape == (0,) else shape
    _square(shape)
    return np.ascontiguousarray(real("A", A, shape))


def real(name, value, shape):
    """A new float array of this shape, all finite; complex numbers are refused, not cut."""
    if np.asarray(value).dtype.kind == "c":
        raise TypeError(f"{name} must hold real numbers, but holds complex ones")
    return inputs.array(
        name, np.reshape(value, shape) if 0 in shape and np.size(value) == 0 else value, shape
    )


def _square(shape):
    if len(shape) != 2 or shape[0] != shape[1]:
        raise ValueError(f"A must be square, but has shape {tuple(shape)}")


def bounds(lower, upper, n):
    """(lower, upper), each (n,): numbers or arrays, ±inf allowed; None: 0 and inf."""
    if lower is None and upper is None:
        return np.zeros(n), np.full(n, np.inf)
    both = _bound("lower", 0.0 if lower is None else lower, n), _bound("upper", _upper(upper), n)
    low, high = both
    crossed = np.flatnonzero(low > high)
    if len(crossed):
        i = crossed[0]
        raise ValueError(f"lower must be at most upper, but in row {i} they are {low[i]:g} and {high[i]:g}")
    for name, value, bad in (("lower", low, np.inf), ("upper", high, -np.inf)):
        if (value == bad).any():
            i = np.flatnonzero(value == bad)[0]
            raise ValueError(f"{name} must leave room for a finite λ, but is {bad:g} in row {i}")
    return both


def _upper(upper):
    return np.inf if upper is None else upper


def _bound(name, value, n):
    try:
        result = np.array(value, dtype=float)
    except (TypeError, ValueError):
        raise TypeError(f"{name} must be a number or an array of shape ({n},), but is {value!r}") from None
    if result.ndim == 0:
        result = np.full(n, result)
    if result.shape != (n,):
        raise ValueError(f"{name} must be a number or have shape ({n},), but has shape {result.shape}")
    if np.isnan(result).any():
        raise ValueError(f"{name} must not hold NaN, but does in row {np.flatnonzero(np.isnan(result))[0]}")
    return result


def friction(given, n):
    """(normal, mu), each (n,), from (rows, normals, mu): −1 and 0 where a row is not a friction row.

    rows, normals: whole numbers in pairs; mu: one number, or one a pair, at least 0.
    """
    normal, μ = np.full(n, -1), np.zeros(n)
    if given is None:
        return normal, μ
    if not isinstance(given, (tuple, list)) or len(given) != 3:
        raise TypeError(f"friction must be three things, (rows, normals, mu), but is {given!r}")
    rows, normals = _rows("friction's rows", given[0], n), _rows("friction's normals", given[1], n)
    if rows.shape != normals.shape:
        raise ValueError(
            f"friction needs a normal for each row, but has {len(rows)} rows and {len(normals)} normals"
        )
    if len(np.unique(rows)) < len(rows):
        raise ValueError("friction's rows must differ from one another, but one of them stands there twice")
    chained = np.intersect1d(rows, normals)
    if len(chained):
        own = "its own normal" if np.any(rows == normals) else "the normal of another friction row"
        raise ValueError(f"friction's normals must be other rows, but row {chained[0]} is {own}")
    normal[rows], μ[rows] = normals, coefficients(given[2], len(rows))
    return normal, μ


def _rows(name, value, n):
    result = np.atleast_1d(np.array(value))
    if result.size == 0:
        return np.zeros(0, dtype=int)
    if result.ndim != 1 or result.dtype.kind not in "iu":
        raise TypeError(f"{name} must be a list of whole numbers, but is {value!r}")
    if result.min() < 0 or result.max() >= n:
        raise ValueError(f"{name} must be from 0 to {n - 1}, but go from {result.min()} to {result.max()}")
    return result.astype(int)


def coefficients(mu, count):
    """Coefficients of friction (count,), from one number or as many; at least 0, finite."""
    result = np.full(count, inputs.number("mu", mu)) if np.ndim(mu) == 0 else real("mu", mu, (count,))
    if count and result.min() < 0:
        raise ValueError(f"mu must be at least 0, but holds {result.min():g}")
    return result
