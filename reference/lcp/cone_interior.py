"""From where to start where much sticks, slides and parts: an interior-point method for contact.

Newton's method for the kinks of ``smooth_pass`` tries one state of the contacts after another. In a heap
there are more than it can try. Here λ and w stay *inside* their cones, where nothing has kinks, and approach
the answer together along the path on which all their products are the same, s ∘ z = t e, with t → 0:

    M (u − u_free) = Jᵀ λ,    s = Φ(J u + c),    s ∘ z = t e;     z = (μ λ_n, λ_t)

Φ(w) = (w_n/μ, w_t) for the convex law; for Coulomb's |w_t| is added to the first (De Saxcé). z and s then
live in one and the same round cone. Each step is a linear system with M + Jᵀ W⁻² Φ′ J, W a block a contact:
the scaling that takes z and s to the same point, W z = W⁻¹ s (Nesterov and Todd's). 10 to 40 steps, whatever
the heap, and from any start. That such a path leads to the answer is proved for the convex law only; in heaps
it does for Coulomb's, too, all but always. Where it leads is where the passes of ``cone_newton`` begin.

Slides S14; lectures/08_newton_lcp.md. Source: Nesterov & Todd, SIAM J. Optim. 8 (1998) 324; Mehrotra, SIAM J.
Optim. 2 (1992) 575 (two solves a step); Acary, Armand, Nguyen & Shpakovych, Optim. Methods Softw. 39 (2024)
(friction by such methods).
"""

import numpy as np

from ..compiled import compiled_apart, inner, inner_apart
from .augmented import STICKS, ContactRows, dot
from .block_lu import factorise, solve
from .inside_step import Inside, advance, look, move_along, pull
from .round_cone import aim, find_scaling, put_inverse_square
from .smooth_pass import copy_all, fill_matrix, forget

MOST_STEPS, PATIENCE = 60, 8  # steps in all, and without getting nearer
SMALLEST_FRICTION = 1e-3  # less is taken for this: z and s would be too thin to be computed with
BACK, STUCK = 0.99, 0.1  # of the way to where a cone ends; a way that is none
FIRM = 1e-4  # ε of what has bounds on both sides, or none: it is held, as if it had none


@compiled_apart
def start_inside(rows, M, free, coulomb, near, λ, u, size, scale, factor, out):
    """λ (m,) and u (n, k), roughly: in place. Returns the steps taken.

    near: the error, over scale, at which to stop. size (B,): A's largest diagonal entry of each block; scale:
    the worst free w, m/s. factor, out: room.
    """
    rows, unit = make_round(rows)
    m = len(unit)
    inside = Inside(
        np.zeros(m), np.zeros(m), np.zeros(m), np.zeros(m), np.zeros(m), np.zeros(m), np.zeros(m),
        np.zeros(m), np.zeros((m, 3)), np.zeros(len(size)), np.zeros((4, 3)),
    )  # fmt: skip
    right, ρ, cones = np.empty_like(u), np.ones(len(size)), begin(rows, unit, size, scale, inside, out)
    copy_all(free, u)
    steps, best, best_u, since = 0, np.inf, u.copy(), 0
    while steps < MOST_STEPS:
        off = look(rows, M, free, coulomb, u, inside, out.gradient, unit)
        total, worst = scale_all(rows, size, inside, out.slope)
        off, since = max(off, np.sqrt(worst)), since + 1
        if off < best:
            keep(unit, inside.z, u, λ, best_u)
            best, since = off, since if off > 0.9 * best else 0
        if off <= near * scale or since == PATIENCE:
            break
        fill_matrix(rows, M, ρ, out, factor)
        if not factorise(factor.blocks, not coulomb):
            break
        way = 1.0
        for correcting in range(2):
            aim_all(rows, inside, (1 - way) ** 3 * total / cones, correcting == 1)
            pull(rows, out, inside, right)
            solve(factor.blocks, right, factor.move)
            way = move_along(rows, factor.move, inside)
        if not way > STUCK:  # as far as rounding lets it come
            break
        advance(min(1.0, BACK * way), factor.move, u, inside)
        steps += 1
    copy_all(best_u, u)
    forget(factor)
    return steps


@inner
def keep(unit, z, u, λ, best_u):
    """λ and u as they are now."""
    for r in range(len(λ)):
        λ[r] = unit[r] * z[r]
    copy_all(u, best_u)


@inner_apart
def begin(rows, unit, size, scale, inside, out):
    """s and z on the axes of their cones; θ = −1 where there is none. Returns how many (at least 1)."""
    cones = 0
    for q in range(len(size)):
        i, out.state[q], inside.θ[q] = rows.block[q], STICKS, -1.0
        if rows.μ[q] >= 0 or (rows.lower[i] == 0 and rows.upper[i] == np.inf):
            inside.s[i], inside.z[i], inside.θ[q] = scale * unit[i], scale / (size[q] * unit[i]), 1.0
            cones += 1
    return max(cones, 1)


@inner_apart
def scale_all(rows, size, inside, slope):
    """W of each cone, and W⁻² Φ′ into slope. Returns Σ s·z, and the worst of them as a velocity squared."""
    total, worst = 0.0, 0.0
    for q in range(len(size)):
        first, end = rows.block[q], rows.block[q + 1]
        if inside.θ[q] < 0:
            inside.square[first, 0] = slope[first, 0] = 1 / (FIRM * size[q])
            continue
        s, z, turn = inside.s[first:end], inside.z[first:end], inside.turn[first:end]
        product = dot(s, z)
        total, worst = total + product, max(worst, product * size[q])
        inside.θ[q] = find_scaling(s, z, turn)
        put_inverse_square(turn, inside.θ[q], inside.square[first:end])
        for r in range(first, end):
            for a in range(end - first):
                slope[r, a] = inside.square[r, a] + inside.square[r, 0] * inside.t[first + a]
    return total, worst


@inner_apart
def aim_all(rows, inside, target, correcting):
    """r of each cone: −z for what would be best if all were linear; then so that s ∘ z becomes target e."""
    for q in range(len(inside.θ)):
        first, end = rows.block[q], rows.block[q + 1]
        if inside.θ[q] > 0 and correcting:
            s, z, turn = inside.s[first:end], inside.z[first:end], inside.turn[first:end]
            ds, dz, r = inside.ds[first:end], inside.dz[first:end], inside.r[first:end]
            aim(s, z, ds, dz, turn, inside.θ[q], target, r, inside.room)
        elif inside.θ[q] > 0:
            for i in range(first, end):
                inside.r[i] = -inside.z[i]


@compiled_apart
def make_round(rows):
    """The rows with J and c in units in which each cone is round, w_n/μ and w_t; and the units (m,)."""
    unit = np.ones(len(rows.c))
    for q in range(len(rows.μ)):
        if rows.μ[q] >= 0:
            unit[rows.block[q]] = 1 / max(rows.μ[q], SMALLEST_FRICTION)
    J, c = rows.J.copy(), unit * rows.c
    for r in range(len(c)):
        J[r] *= unit[r]
    return ContactRows(rows.bodies, J, c, rows.block, rows.μ, rows.lower, rows.upper), unit
