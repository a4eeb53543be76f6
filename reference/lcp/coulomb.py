"""Coulomb's law by convex ones, one after another: what a pass takes from the pass before.

Coulomb's law is not the gradient of anything, but becomes convex once one of two numbers a contact is given:

    shift    μ|w_t|: added to w_n, it makes the cone's law Coulomb's (De Saxcé)
    limit    μ λ_n:  with friction bounded by it, whatever the normal force now is (Tresca's law)

The shift is right at once where nothing slides. Where a face slides and turns on four corners, of which three
would do, it fails: |w_t| hangs on how λ_n is shared out, which w_n alone could settle, and there the shift
is in the way. It grows in each pass by what the four gaps lack of a plane, say 1e-7 m/s, and would for 1e6
passes. The limit leaves w_n as it is, and λ_n moves on until a corner lifts. Where the gaps are in a plane,
each way to share is right, and has its own friction and its own velocities: Coulomb's law has many solutions.

Slides S10, S14; lectures/08_newton_lcp.md. Source: De Saxcé & Feng, Math. Comput. Modelling 28 (1998) 225;
Haslinger, Math. Methods Appl. Sci. 5 (1983) 422 (fixed point of the limit).
"""

import numpy as np

from ..compiled import compiled
from .contact_sweeps import velocity


@compiled
def begin_shift(rows, u, law):
    """The shift that belongs to u, no limit, and nothing known of how the shift answers."""
    for q in range(len(rows.μ)):
        law.limit[q], law.answer[q, 0], law.answer[q, 1] = -1.0, np.inf, 0.0
        law.shift[q] = wanted_shift(rows, q, u)


@compiled
def renew_shift(rows, u, law):
    """The shift ← μ|w_t|, or further. Returns the worst change that u asks for, a velocity.

    μ|w_t| answers to a change of the shift, by μ²/(1 + μ²) of it where A is a multiple of 1. Each contact's
    last two answers tell by how much, and its shift goes where it answers to itself (the secant method).
    """
    worst = 0.0
    for q in range(len(rows.μ)):
        if rows.μ[q] <= 0:
            continue
        new, old = wanted_shift(rows, q, u), law.shift[q]
        change, changed = new - old, old - law.answer[q, 0]
        worst = max(worst, abs(change))
        share = (new - law.answer[q, 1]) / changed if abs(changed) > 1e-12 * abs(new) else 0.0
        law.answer[q, 0], law.answer[q, 1] = old, new
        law.shift[q] = max(0.0, old + change / (1 - min(max(share, -1.0), 0.8)))
    return worst


@compiled
def wanted_shift(rows, q, u):
    """μ|w_t| of contact q, m/s."""
    along = 0.0
    for r in range(rows.block[q] + 1, rows.block[q + 1]):
        along += velocity(rows, r, u) ** 2
    return max(rows.μ[q], 0.0) * np.sqrt(along)


@compiled
def renew_limit(rows, λ, size, law):
    """The limit ← μ λ_n, and no shift. Returns the worst change, a velocity: times A's diagonal, size."""
    worst = 0.0
    for q in range(len(rows.μ)):
        law.shift[q] = 0.0
        if rows.μ[q] <= 0:
            continue
        new = rows.μ[q] * λ[rows.block[q]]
        worst = max(worst, abs(new - law.limit[q]) * size[q])
        law.limit[q] = new
    return worst
