"""The problems: LCP (also boxed, mixed, with friction bounds) and ConeProblem (the exact friction cone).

    w = A λ + b,    row by row   w = 0 inside the bounds,   w ≥ 0 at the lower,   w ≤ 0 at the upper one

A joint's row has no bounds; a contact's has 0 … ∞, so λ ≥ 0, w ≥ 0, λ w = 0; a motor's has ± its greatest
force; friction has ±μ λ_n. A problem only says what is asked. It measures any λ (``residual``), and knows
nothing of how one is found.

Slides S11–S14, S17; lectures/06_pivoting_lcp.md.
"""

from functools import cached_property

import numpy as np
import scipy.sparse

from .. import inputs
from ..compiled import compiled
from ..factored import Factored
from . import given
from .merit import ConeTerms, Terms, cone_merit, merit

EPSILON = np.finfo(float).eps


class _Problem:
    """What both kinds share: A, b, their number of rows ``n``, and the one measure of error."""

    def __init__(self, A, b):
        self.A = given.matrix(A)
        self.n = self.A.shape[0]
        self.b = given.real("b", b, (self.n,))

    def w(self, λ):
        """w = A λ + b (n,)."""
        with np.errstate(all="ignore"):  # an overflow shows in the residual, which is then inf
            return self.A @ λ + self.b

    def residual(self, λ, w=None):
        """How far λ (n,) is from solving the problem, relative to λ⁰: at most 1e-10 is a solution to most.

        ``merit`` says of what it is made. w: where it is known already. 0 where both λ and λ⁰ solve exactly;
        inf where λ or w are not finite, and where only λ⁰ solves exactly. Never NaN.
        """
        λ = np.asarray(λ, dtype=float)
        return relative(self.merit(λ, self.w(λ) if w is None else w), self.scale)

    def rounding(self, λ):
        """How far rounding may have moved each w_i (n,): about ε (|A||λ| + |b|)_i, as that is summed up."""
        with np.errstate(all="ignore"):
            return EPSILON * (sizes(self.A, λ) + np.abs(self.b))

    def noise(self, λ):
        """How far rounding may have moved the r_i of λ (n,), at most: a length of λ, as the merit is."""
        d = self.terms.d
        d = d if len(d) == self.n else np.repeat(d, self.n // len(d))
        return float((self.rounding(λ) / d).max(initial=0))

    zero_rows = ()

    @cached_property
    def scale(self):
        """The merit of λ⁰, by which every other is divided; inf where the numbers are too large for that."""
        value = self.merit(self.origin, self.w_at_origin)
        return value if np.isfinite(value) else np.inf

    @property
    def w_at_origin(self):
        """w of λ⁰ (n,), not to be written into."""
        return self.w(self.origin) if self.origin.any() else self.b

    def merit(self, λ, w):
        """max |r_i| of λ (n,) with its w (n,), a length of λ."""
        with np.errstate(all="ignore"):
            return float(self.measure(self.terms, λ, w))


class LCP(_Problem):
    """Find λ within its bounds with w = A λ + b zero inside them, ≥ 0 at the lower, ≤ 0 at the upper one.

    A (n, n): a dense array, a SciPy sparse array of any format, or a ``Factored``; b (n,). lower, upper:
    numbers or (n,), ±inf allowed; None: 0 and inf. friction: (rows, normals, mu): the bounds of row rows[k]
    are ±mu[k] λ[normals[k]] (of the λ that is returned, S17; mu may be one number); what lower and upper
    say of those rows is not heeded. A negative λ_n allows no friction.
    Raises ValueError or TypeError, which name the argument.
    """

    measure = staticmethod(merit)

    def __init__(self, A, b, lower=None, upper=None, friction=None):
        super().__init__(A, b)
        low, high = given.bounds(lower, upper, self.n)
        normal, μ = given.friction(friction, self.n)
        self.has_friction = friction is not None and bool((normal >= 0).any())
        if self.has_friction:
            low[normal >= 0], high[normal >= 0] = -np.inf, np.inf
        # Whether it only asks λ ≥ 0, w ≥ 0, λᵀw = 0
        self.is_plain = (lower is None and upper is None and friction is None) or not (
            self.has_friction or low.any() or (high < np.inf).any()
        )
        d, empty = row_scales(self.A)
        self.terms = Terms(self.b, d, low, high, normal, μ)
        self.lower, self.upper = low, high
        # Rows of zeros in A whose w_i = b_i has a sign: whatever else, λ_i must be at one of its bounds.
        # There the residual has no unit to measure with, and would call b_i small beside large λ.
        self.zero_rows = empty[self.b[empty] != 0]

    @cached_property
    def origin(self):
        """λ⁰ = clip(0, lower, upper) (n,)."""
        return np.minimum(np.maximum(0.0, self.lower), self.upper)

    def bounds(self, λ):
        """(lower, upper), each (n,), at this λ: friction rows have ±μ λ_n."""
        _, _, low, high, normal, μ = self.terms
        most = μ * np.maximum(np.asarray(λ, dtype=float)[normal], 0) if self.n else μ
        return np.where(normal >= 0, -most, low), np.where(normal >= 0, most, high)

    def bounds_of_zero_rows(self, λ):
        """The bound (k,) that each of ``zero_rows`` must be at; ±inf where no λ_i is right."""
        low, high = (bound[self.zero_rows] for bound in self.bounds(λ))
        return np.where(self.b[self.zero_rows] > 0, low, high)

    def __repr__(self):
        return f"LCP of {self.n} rows, A {form(self.A)}{', with friction bounds' * self.has_friction}"


class ConeProblem(_Problem):
    """Find λ in the friction cones, blocks (n, t1, t2) or in the plane (n, t), by one of two laws.

    law "ncp", Coulomb: λ in the cone ‖λ_t‖ ≤ μ λ_n; w_n ≥ 0 and λ_n w_n = 0; w_t = 0 inside the cone, and
    against λ_t on its surface. law "ccp", convex: λ in the cone, w in its dual ‖w_t‖ μ ≤ w_n, λ · w = 0: the
    minimum of ½ λᵀAλ + bᵀλ where A is symmetric and positive; a sliding contact then moves apart.

    A, b as for ``LCP``; mu: one number, or one a block, at least 0. dimension: 3 for blocks of three, 2 for
    blocks of two. None: what the length of mu says; where mu is one number 3, or 2 if only that divides n.
    Raises ValueError or TypeError, which name the argument.
    """

    measure = staticmethod(cone_merit)

    def __init__(self, A, b, mu, law="ncp", dimension=None):
        super().__init__(A, b)
        self.law = inputs.choice("law", law, ("ncp", "ccp"))
        self.size = _block_size(self.n, mu, dimension)
        self.mu = given.coefficients(mu, self.n // self.size)
        d, _ = row_scales(self.A, self.size)
        self.terms = ConeTerms(self.b, d, self.mu, self.size, law == "ncp")

    @cached_property
    def origin(self):
        """λ⁰ = 0 (n,), the tip of the cones."""
        return np.zeros(self.n)

    def __repr__(self):
        return f"ConeProblem ({self.law}) of {len(self.mu)} blocks of {self.size}, A {form(self.A)}"


def relative(merit, scale):
    """A merit over that of λ⁰: 0/0 = 0, and inf where the quotient says nothing."""
    if merit == 0 and scale < np.inf:
        return 0.0
    return merit / scale if merit < np.inf and 0 < scale < np.inf else np.inf


def form(A):
    """What A is: "dense", "sparse" or "factored"."""
    if isinstance(A, Factored):
        return "factored"
    return "sparse" if scipy.sparse.issparse(A) else "dense"


def row_scales(A, size=1):
    """(d, empty): d, one for each block of ``size`` rows: its largest A_ii if that is positive, else its
    largest |A_ij|, else 1; empty (k,): the blocks where it is that 1.
    """
    d = A.diagonal().astype(float)
    d = d if size == 1 else d.reshape(-1, size).max(axis=1, initial=-np.inf)
    rest = np.flatnonzero(~(d > 0))
    if not len(rest):
        return d, rest
    rows = (rest[:, None] * size + np.arange(size)).ravel()
    peaks = row_peaks(A, rows).reshape(-1, size).max(axis=1)
    d[rest] = np.where(peaks > 0, peaks, 1.0)
    return d, rest[peaks == 0]


def row_peaks(A, rows):
    """max_j |A_ij| of these rows."""
    if isinstance(A, Factored):
        return A.row_peaks(rows)
    peaks = abs(A[rows]).max(axis=1)
    return peaks.toarray().ravel() if scipy.sparse.issparse(peaks) else peaks


def sizes(A, λ):
    """The sizes of what is summed up in A λ (n,): |A| |λ|, where A is a matrix."""
    if isinstance(A, Factored):
        return A.sizes(λ)
    return abs(A) @ np.abs(λ) if scipy.sparse.issparse(A) else _dense_sizes(A, λ)


@compiled(reorder=True)
def _dense_sizes(A, λ):
    result = np.empty(len(λ))
    for i in range(len(λ)):
        total = 0.0
        for j in range(len(λ)):
            total += abs(A[i, j] * λ[j])
        result[i] = total
    return result


def _block_size(n, mu, dimension):
    """3 or 2: how many rows a contact has."""
    if dimension is not None:
        if dimension not in (2, 3):
            raise ValueError(f"dimension must be 3 (in space) or 2 (in the plane), but is {dimension!r}")
        size = int(dimension)
    elif np.ndim(mu) == 0:
        size = 2 if n % 3 and n % 2 == 0 else 3
    else:
        size = 2 if 2 * np.size(mu) == n and n else 3
    if n % size or (np.ndim(mu) and np.size(mu) * size != n):
        raise ValueError(
            f"b must have blocks of three (n, t1, t2) or two (n, t), one for each of mu, but has {n} rows "
            f"for mu of shape {np.shape(mu)}"
        )
    return size
