"""Coulomb's law by convex ones: what a pass takes from the pass before; and how far λ and w are from the law.

Coulomb's law is not the gradient of anything, but becomes convex once one of two numbers a contact is given:

    shift    μ|w_t|: added to w_n, it makes the cone's law Coulomb's (De Saxcé)
    limit    μ λ_n:  with friction bounded by it, whatever the normal force now is (Tresca's law)

The shift is right at once where nothing slides. Where a face slides and turns on four corners, of which three
would do, it fails: |w_t| hangs on how λ_n is shared out, which w_n alone could settle, and there the shift
is in the way. It grows in each pass by what the four gaps lack of a plane, say 1e-7 m/s, and would for 1e6
passes. The limit leaves w_n as it is, and λ_n moves on until a corner lifts. Where the gaps are in a plane,
each way to share is right, and has its own friction and its own velocities: Coulomb's law has many solutions.

The error of a contact is how far λ is from P(λ − Φ(w)/A_cc), times A_cc: a velocity. Φ adds μ|w_t| to w_n
for Coulomb's law, and γ λ_n for what gives way; P is the projection on the cone, or on a row's bounds. It is
0 just where the law holds, and about |w| where a contact that sticks still moves.

Slides S10, S14; lectures/08_newton_lcp.md. Source: De Saxcé & Feng, Math. Comput. Modelling 28 (1998) 225;
Haslinger, Math. Methods Appl. Sci. 5 (1983) 422 (fixed point of the limit).
"""

import numpy as np

from ..compiled import inner, inner_apart
from .augmented import SLIDES


@inner
def begin_shift(rows, w, law):
    """The shift that belongs to w, and nothing known of how the shift answers."""
    for q in range(len(rows.μ)):
        law.answer[q, 0], law.answer[q, 1] = np.inf, 0.0
        law.shift[q] = max(rows.μ[q], 0.0) * along(rows, q, w)


@inner
def renew_shift(rows, w, law):
    """The shift ← μ|w_t|, or further.

    μ|w_t| answers to a change of the shift, by μ²/(1 + μ²) of it where A is a multiple of 1. Each contact's
    last two answers tell by how much, and its shift goes where it answers to itself (the secant method).
    """
    for q in range(len(rows.μ)):
        if rows.μ[q] <= 0:
            continue
        new, old = rows.μ[q] * along(rows, q, w), law.shift[q]
        change, changed = new - old, old - law.answer[q, 0]
        share = (new - law.answer[q, 1]) / changed if abs(changed) > 1e-12 * abs(new) else 0.0
        law.answer[q, 0], law.answer[q, 1] = old, new
        law.shift[q] = max(0.0, old + change / (1 - min(max(share, -1.0), 0.8)))


@inner
def renew_limit(rows, λ, law):
    """The limit ← μ λ_n, and no shift."""
    for q in range(len(rows.μ)):
        law.shift[q] = 0.0
        if rows.μ[q] > 0:
            law.limit[q] = rows.μ[q] * max(λ[rows.block[q]], 0.0)


@inner
def no_limit(law):
    """The cone again."""
    for q in range(len(law.limit)):
        law.limit[q] = -1.0


@inner
def worst_change(rows, out, law):
    """The most by which the shift that w asks for, where contacts slide, differs from the one used, m/s."""
    worst = 0.0
    for q in range(len(rows.μ)):
        if rows.μ[q] > 0 and out.state[q] >= SLIDES:
            worst = max(worst, abs(rows.μ[q] * along(rows, q, out.w) - law.shift[q]))
    return worst


@inner
def along(rows, q, w):
    """|w_t| of contact q, m/s."""
    total = 0.0
    for r in range(rows.block[q] + 1, rows.block[q + 1]):
        total += w[r] * w[r]
    return np.sqrt(total)


@inner_apart
def breach(rows, size, softness, coulomb, λ, w):
    """The worst error of all blocks, m/s. size (B,): A_cc."""
    worst = 0.0
    for q in range(len(rows.μ)):
        n, μ, a = rows.block[q], rows.μ[q], 1 / size[q]
        pull = λ[n] - a * (w[n] + softness[q] * λ[n])
        if μ < 0:
            off = abs(min(max(pull, rows.lower[n]), rows.upper[n]) - λ[n])
        else:
            off = off_cone(rows, q, pull - a * μ * along(rows, q, w) if coulomb else pull, a, λ, w)
        off *= size[q]
        worst = max(worst, off) if off < np.inf else np.inf  # nan must not pass for 0
    return worst


@inner
def off_cone(rows, q, pull, a, λ, w):
    """How far the projection of (pull, λ_t − a w_t) on the cone of contact q is from its λ."""
    n, end, μ = rows.block[q], rows.block[q + 1], rows.μ[q]
    tangential = 0.0
    for r in range(n + 1, end):
        tangential += (λ[r] - a * w[r]) ** 2
    tangential = np.sqrt(tangential)
    if tangential <= μ * pull:
        to, share = pull, 1.0
    elif μ * tangential <= -pull:
        to, share = 0.0, 0.0
    else:
        to = (pull + μ * tangential) / (1 + μ * μ)
        share = μ * to / tangential
    off = (to - λ[n]) ** 2
    for r in range(n + 1, end):
        off += (share * (λ[r] - a * w[r]) - λ[r]) ** 2
    return np.sqrt(off)
