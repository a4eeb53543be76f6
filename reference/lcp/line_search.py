"""Globalisation: how far to go along a Newton step, so that it leads somewhere from far away, too.

Newton's method knows the equation near λ only. ψ = ½ ‖r‖², which is 0 just at a solution, judges its step:
take t = 1, ½, ¼, … until ψ has gone down by a share of what its slope promises (Armijo). Where r has kinks
the step may not lead down at all; then try steepest descent, −Hᵀr; where that fails too, λ stands still.

Slides S14; lectures/08_newton_lcp.md. Source: Armijo, Pacific J. Math. 16 (1966) 1; De Luca, Facchinei &
Kanzow, Math. Programming 75 (1996) 407.
"""

import numpy as np

_SHARE = 1e-4  # of the decrease that the slope promises
_HALVINGS = 40


def energy(r):
    """ψ = ½ ‖r‖²; inf where r is not finite."""
    with np.errstate(all="ignore"):
        ψ = 0.5 * float(r @ r)
    return ψ if ψ < np.inf else np.inf


def search(residuals, λ, r, step, slope):
    """λ + t step for the first t of 1, ½, ¼, … that brings ψ down, or None.

    residuals(λ) -> r (n,); slope: the derivative of ψ along step; not negative: there is nothing to gain.
    """
    if not (slope < 0 and np.isfinite(step).all()):
        return None
    ψ, t = energy(r), 1.0
    for _ in range(_HALVINGS):
        there = λ + t * step
        if energy(residuals(there)) <= ψ + _SHARE * t * slope:
            return there
        t *= 0.5
    return None


def descend(residuals, λ, r, step, gradient):
    """The next λ: along Newton's step, or against ψ's gradient Hᵀr (n,); None where both lead up."""
    there = search(residuals, λ, r, step, float(gradient @ step))
    if there is None:
        size = float(gradient @ gradient)
        share = 2 * energy(r) / size if size > 0 else 0.0  # where a straight ψ would be 0
        there = search(residuals, λ, r, -share * gradient, -share * size)
    return there
