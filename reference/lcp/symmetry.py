"""Whether A is symmetric, and why a method that needs it, or needs cones, can't treat a problem.

Slides S14, S15; lectures/08_newton_lcp.md.
"""

import numpy as np

from ..factored import Factored
from .problem import LCP, ConeProblem


def asymmetry(A):
    """How far A is from Aᵀ, relative to its largest entry: 0 where it is symmetric.

    Of a factored A, which has no entries, two vectors tell: x · A y against y · A x.
    """
    if not isinstance(A, Factored):
        size = abs(A).max() if A.shape[0] else 0
        return abs(A - A.T).max() / size if size > 0 else 0.0
    random = np.random.default_rng(0)
    x, y = random.normal(size=(2, A.shape[0]))
    one, other = x * (A @ y), y * (A @ x)
    size = np.abs(one).sum() + np.abs(other).sum()
    return abs(one.sum() - other.sum()) / size if size > 0 else 0.0


def why_not_symmetric(problem):
    """Why a method that makes ½ λᵀAλ + bᵀλ smaller can't treat a problem; "" where it can."""
    if problem.scale == np.inf:
        return "b over A's entries overflows: the numbers of this problem are too far apart."
    if asymmetry(problem.A) > 1e-10:
        return "This method needs a symmetric A (A = Aᵀ): only then is there an energy to make smaller."
    if problem.A.diagonal().min(initial=0) < 0:
        return "This method needs a positive semidefinite A, but some A_ii is negative."
    return ""


def why_no_box(problem):
    """Why a method for fixed bounds and symmetric A can't treat a problem; "" where it can."""
    if not isinstance(problem, LCP):
        return "This method keeps to bounds, and can't treat the exact friction cone: take a cone method."
    if problem.has_friction:
        return (
            "This method needs fixed bounds, but friction's move with λ_n: take one that goes row by row, "
            "Newton's method, or the exact cone."
        )
    return why_not_symmetric(problem)


def why_no_cone(problem):
    """Why a method for friction cones and symmetric A can't treat a problem; "" where it can."""
    if not isinstance(problem, ConeProblem):
        return "This method is made for friction cones: give it a ConeProblem, or take a method for bounds."
    reason = why_not_symmetric(problem)
    if not reason and (problem.A.diagonal() <= 0).any():
        return "This method needs positive A_ii: each row must be able to change its own w."
    return reason
