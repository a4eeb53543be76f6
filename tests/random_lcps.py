"""Random small LCPs of every sort, and judges of answers that share nothing with the reference."""

import itertools
from fractions import Fraction

import numpy as np
import scipy.optimize

LIMITS = (
    (0, np.inf),
    (-np.inf, np.inf),
    (-1, 1),
    (0, 2),
    (1, 1),
    (-np.inf, 0),
    (-2, np.inf),
)
KINDS = ("whole", "semidefinite", "nonnegative", "p", "real", "singular")


def parts(seed, largest=4):
    """(A, b, lower, upper, friction, kind): n ≤ largest; singular, ambiguous, unsolvable ones too."""
    random = np.random.default_rng(seed)
    n, kind = random.integers(0, largest + 1), KINDS[random.integers(len(KINDS))]
    A, b = matrix(random, n, kind), random.integers(-3, 4, n).astype(float)
    lower, upper, friction = np.zeros(n), np.full(n, np.inf), None
    if random.random() < 0.5:
        lower, upper = np.array(LIMITS)[random.integers(0, len(LIMITS), n)].reshape(n, 2).T.copy()
    if n >= 2 and random.random() < 0.25:
        friction = [1], [0], float(random.choice([0, 0.3, 0.5, 2.0]))
        if random.random() < 0.8:
            lower[0], upper[0] = 0, np.inf
    if random.random() < 0.2:  # other units of λ
        unit = 10.0 ** random.integers(-12, 13)
        A, lower, upper = A / unit, lower * unit, upper * unit
    if random.random() < 0.2:  # other units of w
        unit = 10.0 ** random.integers(-12, 13)
        A, b = A * unit, b * unit
    return A, b, lower, upper, friction, kind


def matrix(random, n, kind):
    whole = random.integers(-3, 4, (n, n)).astype(float)
    narrow = random.integers(-2, 3, (n, n // 2)).astype(float)
    return {
        "whole": whole,
        "semidefinite": whole @ whole.T,
        "nonnegative": np.abs(whole),
        "p": whole @ whole.T + whole - whole.T + np.eye(n),  # positive definite, not symmetric
        "real": random.normal(size=(n, n)),
        "singular": narrow @ narrow.T,
    }[kind]


def limits(lower, upper, friction, λ):
    """The bounds at this λ."""
    lower, upper = list(lower), list(upper)
    if friction is not None:
        for row, normal in zip(*friction[:2], strict=True):
            upper[row] = friction[2] * max(λ[normal], 0)
            lower[row] = -upper[row]
    return lower, upper


def exactly(x):
    """A finite double as the fraction it is; ±inf as it is."""
    return Fraction(float(x)) if np.isfinite(x) else float(x)


def origin(lower, upper, friction):
    """λ⁰ (n,): 0, or the bound nearest to it; a friction row's bounds are not those that stand there."""
    λ = np.clip(0.0, lower, upper)
    λ[[] if friction is None else friction[0]] = 0
    return λ


def gaps(A, b, lower, upper, friction, λ):
    """(r, w, d), lists of n fractions: r_i = λ_i − clip(λ_i − w_i/d_i, lower_i, upper_i) without rounding."""
    b, λ, lower, upper = (list(map(exactly, x)) for x in (b, λ, lower, upper))
    friction = None if friction is None else (*friction[:2], exactly(friction[2]))
    lower, upper = limits(lower, upper, friction, λ)
    rows = [list(map(exactly, row)) for row in A]
    w = [b_i + sum(a * x for a, x in zip(row, λ, strict=True)) for row, b_i in zip(rows, b, strict=True)]
    d = [row[i] if row[i] > 0 else max(map(abs, row)) or Fraction(1) for i, row in enumerate(rows)]
    step = [x - w_i / d_i for x, w_i, d_i in zip(λ, w, d, strict=True)]
    r = [x - min(max(s, l), u) for x, s, l, u in zip(λ, step, lower, upper, strict=True)]
    return r, w, d


def largest_gap(A, b, lower, upper, friction, tolerance=1e-10):
    """What max |r_i| of a λ called solved may come to, in exact numbers; no more for large λ than for small.

    A solver sees w_i only to rounding: of n + 1 products summed up, each off by 2⁻⁵³, so by (n + 1)/2 times
    ε (|A||λ| + |b|)_i at most. It promises that ε (…) hides no more than the tolerance: a λ so large that it
    would must not be called solved, unless it hides at most twice as much as at λ⁰ itself. So the tolerance
    and (n + 1)/2 times the same, times the size of r(λ⁰); and twice what rounding may come to at λ⁰.
    """
    start = origin(lower, upper, friction)
    r, _, d = gaps(A, b, lower, upper, friction, start)
    size = float(max(map(abs, r), default=0))
    rounding = (len(b) + 1) * 2.0**-53 * (np.abs(A) @ np.abs(start) + np.abs(b)) / np.array(d, dtype=float)
    return tolerance * size * (1 + (len(b) + 1) / 2) + 2 * rounding.max(initial=0)


def is_answer(A, b, lower, upper, friction, λ, most=None):
    """Whether λ solves it: in exact numbers no |r_i| is above ``most``, by default ``largest_gap``.

    A row of zeros has no d to make a length of w_i = b_i: there λ_i must be as near to its very bound.
    """
    if not np.isfinite(λ).all():
        return False
    most = largest_gap(A, b, lower, upper, friction) if most is None else most
    r, _, _ = gaps(A, b, lower, upper, friction, λ)
    low, high = limits(lower, upper, friction, λ)
    for i in np.flatnonzero(~np.abs(A).any(axis=1) & (np.array(b) != 0)):
        r[i] = λ[i] - (low[i] if b[i] > 0 else high[i])
    return max(map(abs, r), default=0) <= most


def farthest(A, b, lower, upper, λ, tolerance=1e-10):
    """How far, in the 2-norm, a solved λ may be from the one solution, where A is positive definite.

    With r the gaps of λ and e its error, y = λ − r is within the bounds, and the two inequalities that y and
    the solution satisfy give eᵀAe ≤ (A e)ᵀr + (D r)ᵀe, so ‖e‖ ≤ (‖A‖ + max d) ‖r‖ / c with c the least
    eigenvalue of (A + Aᵀ)/2; and |r_i| is at most ``largest_gap``.
    """
    if not len(b):
        return 0.0
    d = gaps(A, b, lower, upper, None, λ)[2]
    r = np.sqrt(len(b)) * largest_gap(A, b, lower, upper, None, tolerance)
    return (np.linalg.norm(A, 2) + float(max(d))) / np.linalg.eigvalsh((A + A.T) / 2)[0] * r


def solvable(A, b, lower, upper, friction):
    """Whether there is a solution, found by linear programs (HiGHS): one for each choice of a piece a row.

    A row is at its lower bound with w ≥ 0, at its upper with w ≤ 0, or between them with w = 0. Friction
    bounds are ±μ λ_n where λ_n ≥ 0, and 0 else: two sets of programs. Unlike an enumeration of isolated
    solutions this sees whole lines of them, too. λ and w are in units in which A, b and the bounds are
    about 1, since HiGHS takes less than 1e-7 for 0.
    """
    A, b, lower, upper = _of_one(A, b, lower, upper)
    n = len(b)
    low = [(np.zeros(n), l) for l in lower]  # bounds as a·λ + c
    high = [(np.zeros(n), u) for u in upper]
    anywhere = [(None, None)] * n
    cases = [(low, high, anywhere)]
    if friction is not None:
        (t,), (k,), μ = friction
        cases = []
        for moving, side in ((μ * np.eye(n)[k], (0, None)), (np.zeros(n), (None, 0))):
            bounds = _with(low, t, (-moving, 0.0)), _with(high, t, (moving, 0.0))
            cases.append((*bounds, _with(anywhere, k, side)))
    for low, high, range_ in cases:
        pieces = [
            ["w", *("l" * bool(np.isfinite(l[1]))), *("u" * bool(np.isfinite(u[1])))]
            for l, u in zip(low, high, strict=True)
        ]
        if any(_holds_somewhere(A, b, low, high, range_, choice) for choice in itertools.product(*pieces)):
            return True
    return False


def _of_one(A, b, lower, upper):
    """The same problem with rows and b of about 1, and λ in units of what it may come to."""
    peak = np.abs(A).max(axis=1, initial=0)
    row = 1 / np.where(peak > 0, peak, np.maximum(np.abs(b), 1e-300))
    A, b = row[:, None] * A, row * b
    regular = np.abs(b[peak > 0]).max(initial=0)
    unit = max(regular, *(np.abs(x[np.isfinite(x)]).max(initial=0) for x in (lower, upper)))
    unit = unit if unit > 0 else 1.0
    return A, b / np.where(peak > 0, unit, 1), lower / unit, upper / unit


def _with(items, k, item):
    return [*items[:k], item, *items[k + 1 :]]


def _holds_somewhere(A, b, low, high, range_, choice):
    n, equal, less = len(b), [], []  # rows (a, c) with a·λ = c, a·λ ≤ c
    for i, piece in enumerate(choice):
        own, (l, l0), (u, u0) = np.eye(n)[i], low[i], high[i]
        if piece == "w":
            equal.append((A[i], -b[i]))
            less += [(l - own, -l0)] * bool(np.isfinite(l0)) + [(own - u, u0)] * bool(np.isfinite(u0))
        elif piece == "l":
            equal.append((own - l, l0))
            less.append((-A[i], b[i]))
        else:
            equal.append((own - u, u0))
            less.append((A[i], -b[i]))
    if not n:
        return True
    (A_eq, b_eq), (A_ub, b_ub) = (
        (np.array([a for a, _ in rows]).reshape(-1, n), [c for _, c in rows]) for rows in (equal, less)
    )
    found = scipy.optimize.linprog(np.zeros(n), A_ub, b_ub, A_eq, b_eq, bounds=range_, method="highs")
    return found.status != 2


def nothing_feasible(A, b, lower, upper):
    """Whether a linear program (HiGHS) finds no λ within its bounds that gives each w its sign."""
    A, b, lower, upper = _of_one(A, b, lower, upper)
    rises, falls = np.isfinite(lower), np.isfinite(upper)  # w > 0 allowed, w < 0 allowed
    at_least, at_most = np.flatnonzero(~falls), np.flatnonzero(~rises)
    rows, right = np.vstack([-A[at_least], A[at_most]]), np.concatenate([b[at_least], -b[at_most]])
    bounds = list(zip(lower, upper, strict=True))
    found = scipy.optimize.linprog(np.zeros(len(b)), rows, right, bounds=bounds, method="highs")
    return found.status == 2
