"""Right answers to the exercise of unit 08, and what typical mistakes would answer. Grader's side only."""

import numpy as np

import exercises

given = exercises.part("08_newton_lcp", "given")


def positive(x):
    return np.maximum(x, 0)


def penalised(v, sign=1, parts=True, root=True, shares="right"):
    """τ (a + b − √(a² + b²)) + (1 − τ) a₊ b₊."""
    a, b, τ = v["a"], v["b"], v["tau"]
    product = positive(a) * positive(b) if parts else a * b
    τ, rest = (τ, 1 - τ) if shares == "right" else (1 - τ, τ)
    size = np.hypot(a, b) if root else a * a + b * b
    return τ * (a + b - size) + sign * rest * product


def slopes(v, penalty=True, swapped=False, corner=0.29289321881345254):
    """Derivatives of ``penalised`` by a and by b."""
    a, b, τ = v["a"], v["b"], v["tau"]
    size = np.hypot(a, b)
    safe = np.where(size > 0, size, 1)
    by_a, by_b = (τ * np.where(size > 0, 1 - x / safe, corner) for x in (a, b))
    both = (a > 0) & (b > 0) & penalty
    first, second = (a, b) if swapped else (b, a)
    return by_a + (1 - τ) * np.where(both, first, 0), by_b + (1 - τ) * np.where(both, second, 0)


def newton_matrix(v, columns=False, own=True):
    """D_a + D_b M."""
    M, λ = v["M"], v["lam"]
    by_a, by_b = slopes({"a": λ, "b": M @ λ + v["q"], "tau": v["tau"]})
    scaled = M * by_b if columns else by_b[:, None] * M
    return own * np.diag(by_a) + scaled


def step_length(v, share=1e-4, first=1.0, further=1.0):
    """The first of 1, ½, ¼, … with ψ(λ + t Δ) ≤ ψ(λ) + 1e-4 t slope."""
    psi, t = v["psi"].build(given), first
    while t > 1e-12 and psi(v["lam"] + t * v["step"]) > psi(v["lam"]) + share * t * v["slope"]:
        t /= 2
    return t * further


def newton(value_and_matrix, λ, most=300, search=True, enough=1e-13):
    """Newton's method with the line search; None where it fails."""
    for _ in range(most):
        r, H = value_and_matrix(λ)
        if np.abs(r).max() <= enough:
            break
        Δ, t = -np.linalg.solve(H, r), 1.0
        while search and t > 1e-10:
            if np.sum(value_and_matrix(λ + t * Δ)[0] ** 2) <= (1 - 2e-4 * t) * np.sum(r**2):
                break
            t /= 2
        λ = λ + t * Δ
    return λ


def solve(v, **how):
    """The solution of the LCP, which is unique: M is a P-matrix."""
    M, q, τ = v["M"], v["q"], v["tau"]

    def value_and_matrix(λ):
        w = M @ λ + q
        part = {"a": λ, "b": w, "tau": τ}
        return penalised(part), newton_matrix({"M": M, "q": q, "lam": λ, "tau": τ})

    return newton(value_and_matrix, np.array(v["start"], dtype=float), **how)


def on_path(v, μ=None):
    """λ > 0 with w > 0 and λ_i w_i = μ²."""
    M, q = v["M"], v["q"]
    μ = v["mu"] if μ is None else μ

    def value_and_matrix(λ):
        w = M @ λ + q
        root = np.sqrt((λ - w) ** 2 + 4 * μ**2)
        share = (λ - w) / root
        return λ + w - root, np.diag(1 - share) + (1 + share)[:, None] * M

    return newton(value_and_matrix, np.zeros(len(q)))
