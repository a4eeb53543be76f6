"""Random small LCPs of every sort, and judges of answers that share nothing with the reference."""

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
    regular = np.abs(A).sum(axis=1).all()  # a row of zeros has no unit of its own: d = 1 there, by definition
    if random.random() < 0.2 and regular:  # other units of λ
        unit = 10.0 ** random.integers(-12, 13)
        A, lower, upper = A / unit, lower * unit, upper * unit
    if random.random() < 0.2 and regular:  # other units of w
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
        "p": whole @ whole.T + whole - whole.T + np.eye(n),
        "real": random.normal(size=(n, n)),
        "singular": narrow @ narrow.T,
    }[kind]


def limits(lower, upper, friction, λ):
    """The bounds at this λ."""
    lower, upper = lower.copy(), upper.copy()
    if friction is not None:
        for row, normal in zip(*friction[:2], strict=True):
            upper[row] = friction[2] * max(λ[normal], 0)
            lower[row] = -upper[row]
    return lower, upper


def is_answer(A, b, lower, upper, friction, λ, tolerance=1e-7):
    """Whether λ solves it by the definition, but for the tolerance in the units of each row."""
    if not np.isfinite(λ).all():
        return False
    lower, upper = limits(lower, upper, friction, λ)
    w, peak = A @ λ + b, np.abs(A).max(axis=1, initial=0)
    finite = [np.abs(x[np.isfinite(x)]).max(initial=0) for x in (lower, upper, λ)]
    force = np.abs(A) @ np.abs(λ) + np.abs(b)
    loose = tolerance * max(*finite, (force / np.where(peak > 0, peak, np.inf)).max(initial=0))
    loose_w = np.maximum(tolerance * force, loose * np.where(peak > 0, peak, 1))  # loose in λ, as a w
    if (λ < lower - loose).any() or (λ > upper + loose).any():
        return False
    right = (np.abs(w) <= loose_w) | ((w > 0) & (λ <= lower + loose)) | ((w < 0) & (λ >= upper - loose))
    return bool(right.all())


def nothing_feasible(A, b, lower, upper):
    """Whether a linear program (HiGHS) finds no λ within its bounds that gives each w its sign."""
    size = max(np.abs(A).max(initial=0), 1e-300)
    rises, falls = np.isfinite(lower), np.isfinite(upper)  # w > 0 allowed, w < 0 allowed
    at_least, at_most = np.flatnonzero(~falls), np.flatnonzero(~rises)
    scale = 1 / np.maximum(np.abs(b).max(initial=0), 1e-300)  # λ in units of b/A
    bounds = [(l * size * scale, u * size * scale) for l, u in zip(lower, upper, strict=True)]
    rows = np.vstack([-A[at_least], A[at_most]]) / size
    right = np.concatenate([b[at_least], -b[at_most]]) * scale
    found = scipy.optimize.linprog(np.zeros(len(b)), rows, right, bounds=bounds, method="highs")
    return found.status == 2
