"""Newton's method for contact with the exact friction cone, in the space of the velocities.

The velocities after a step are those nearest to the free ones, in the measure of the kinetic energy, that the
constraints allow. The augmented Lagrangian turns this into smooth problems, one after another, with
λ̂(u) = P(λ − ρ (J u + c)) and P the projection on the cone of each contact or on the bounds of each row:

    solve    M (u − u_free) = Jᵀ λ̂(u)      by Newton's method, with M + ρ Jᵀ P′ J for its matrix;    then    λ ← λ̂(u)

A weight ρ = 1/(ε A_cc) makes each pass shrink the error by ε/(ε + σ), σ the smallest eigenvalue of the scaled A that is not 0: few
passes, however heavy the top of a stack is. The matrix has one block a body, not one a contact, and stays regular where contacts are
redundant. It changes only with what sticks, slides or parts; where nothing of that changes the factor serves again.

Coulomb's law (``ncp``) is not the gradient of anything, but becomes the convex law once μ|w_t| is added to w_n: that
*shift* is taken from the pass before. With what sticks it is 0, and nothing is lost.

Slides S10, S14; lectures/08_newton_lcp.md. Source: Rockafellar, Math. Oper. Res. 1 (1976) 97 (augmented Lagrangian as proximal
point method); Qi & Sun, Math. Programming 58 (1993) 353 (semismooth Newton); De Saxcé & Feng, Math. Comput. Modelling 28 (1998) 225
(the shift).
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled, compiled_apart
from .envelope import Envelope, add_block, cholesky_in_envelope, make_envelope, solve_in_envelope

NEAR, SMALLEST = 1e-6, 1e-10  # ε to begin with, and where passes shrink the error too slowly; rounding in λ is 1e-16/ε
OPEN, STICKS, SLIDES = 0, 1, 2  # 3: slides the other way, in the plane
MOST_NEWTON, MOST_HALVINGS = 50, 30


class ContactRows(NamedTuple):
    """m rows in blocks: a contact's (n, t) or (n, t1, t2), or a single row with bounds."""

    bodies: np.ndarray  # (m, 2): i and j; −1: what doesn't move
    J: np.ndarray  # (m, 2, k)
    c: np.ndarray  # (m,): what J u must be added to: w = J u + c
    block: np.ndarray  # (B + 1,): block q holds rows block[q] … block[q + 1] − 1
    μ: np.ndarray  # (B,) of a contact; −1: a single row
    lower: np.ndarray  # (m,) bounds of λ of single rows
    upper: np.ndarray  # (m,)


class Pass(NamedTuple):
    """What ``evaluate`` fills in for a velocity u."""

    w: np.ndarray  # (m,)
    λ: np.ndarray  # (m,): λ̂
    slope: np.ndarray  # (m, 3): P′, the rows of each block
    state: np.ndarray  # (B,): 0 open, 1 sticks, 2 slides
    gradient: np.ndarray  # (n, k)


class Factor(NamedTuple):
    """The matrix's factor, and for which states it was made."""

    envelope: Envelope
    L: np.ndarray
    made: np.ndarray  # (B,)


@compiled
def make_pass(rows, n, k):
    """Room for a pass over n bodies."""
    m, blocks = len(rows.c), len(rows.μ)
    return Pass(np.empty(m), np.empty(m), np.zeros((m, 3)), np.zeros(blocks, np.int64), np.empty((n, k)))


@compiled
def make_factor(rows, n, k):
    """Room for the factor; made for no states yet."""
    envelope = make_envelope(rows.bodies, n, k)
    return Factor(envelope, np.empty(envelope.start[-1]), np.full(len(rows.μ), -1))


@compiled
def cone_newton_kernel(rows, M, free, coulomb, λ, tolerance, max_iterations, history):
    """u (n, k) and λ (m,), which holds the start and is changed in place. M (n, k, k), free (n, k).

    Returns (u, passes, error): the error is the worst violation of w by λ's change in the last pass, m/s, over the worst
    free one.
    """
    n, k = free.shape
    blocks = len(rows.μ)
    out, trial = make_pass(rows, n, k), make_pass(rows, n, k)
    factor = make_factor(rows, n, k)
    size, shift, ρ = np.empty(blocks), np.zeros(blocks), np.empty(blocks)
    u, scale = free.copy(), block_sizes(rows, M, free, size)
    if scale == 0:
        λ[:] = 0
        return u, 0, 0.0
    add_impulses(rows, M, λ, u)
    answer = np.zeros((blocks, 2))
    if coulomb:
        evaluate(rows, M, free, λ, np.ones(blocks), shift, u, out)
        renew_shift(rows, out.w, shift, answer)
        answer[:, 0], answer[:, 1] = np.inf, 0.0
    ε, error, drift = NEAR, np.inf, np.inf
    for passes in range(max_iterations):
        for q in range(blocks):
            ρ[q] = 1 / (ε * size[q])
        solve_smooth(rows, M, free, λ, ρ, shift, factor, u, 0.1 * tolerance * scale, out, trial)
        before, drift = drift, renew(rows, out, λ, ρ) / scale
        shifted = renew_shift(rows, out.w, shift, answer) / scale if coulomb else 0.0
        error = max(drift, shifted)
        if passes < len(history):
            history[passes] = error
        if error <= tolerance:
            return u, passes + 1, error
        if drift > max(0.25 * before, shifted) and ε > SMALLEST:
            ε *= 0.01
            factor.made[:] = -1
    return u, max_iterations, error


@compiled_apart
def block_sizes(rows, M, free, size):
    """A's largest diagonal entry of each block; returns the worst |w| of the free velocities."""
    scale = 0.0
    for q in range(len(size)):
        size[q] = 0.0
        for r in range(rows.block[q], rows.block[q + 1]):
            w, diagonal = rows.c[r], 0.0
            for side in range(2):
                i = rows.bodies[r, side]
                if i >= 0:
                    w += inner(rows.J[r, side], free[i])
                    diagonal += over_mass(M[i], rows.J[r, side])
            size[q] = max(size[q], diagonal)
            scale = max(scale, abs(w))
    return scale


@compiled
def add_impulses(rows, M, λ, u):
    """u + M⁻¹ Jᵀ λ, roughly: with the diagonal of M, since it is only where Newton's method starts."""
    for r in range(len(λ)):
        for side in range(2):
            i = rows.bodies[r, side]
            if i >= 0:
                for a in range(u.shape[1]):
                    u[i, a] += rows.J[r, side, a] * λ[r] / M[i, a, a]


@compiled
def inner(a, b):
    """Σ a_k b_k."""
    total = 0.0
    for k in range(len(a)):
        total += a[k] * b[k]
    return total


@compiled
def over_mass(M, a):
    """a · M⁻¹ a for one body: masses first, then the inertia, a number or (3, 3)."""
    if len(a) == 3:
        return a[0] ** 2 / M[0, 0] + a[1] ** 2 / M[1, 1] + a[2] ** 2 / M[2, 2]
    I = M[3:, 3:]
    x, y, z = a[3], a[4], a[5]
    p, q, s = (  # the cofactors of the first row, over the determinant below
        I[1, 1] * I[2, 2] - I[1, 2] ** 2,
        I[0, 2] * I[1, 2] - I[0, 1] * I[2, 2],
        I[0, 1] * I[1, 2] - I[0, 2] * I[1, 1],
    )
    determinant = I[0, 0] * p + I[0, 1] * q + I[0, 2] * s
    turning = p * x * x + (I[0, 0] * I[2, 2] - I[0, 2] ** 2) * y * y + (I[0, 0] * I[1, 1] - I[0, 1] ** 2) * z * z
    turning += 2 * (q * x * y + s * x * z + (I[0, 1] * I[0, 2] - I[0, 0] * I[1, 2]) * y * z)
    return (a[0] ** 2 + a[1] ** 2 + a[2] ** 2) / M[0, 0] + turning / determinant


@compiled_apart
def solve_smooth(rows, M, free, λ, ρ, shift, factor, u, tolerance, out, trial):
    """Newton's method for one pass, with step halving: u in place, and what ``evaluate`` finds there into out."""
    value = evaluate(rows, M, free, λ, ρ, shift, u, out)
    move, tried = np.empty_like(u), np.empty_like(u)
    rest, before, whole = worst_rate(M, out.gradient), np.inf, False
    for newton in range(MOST_NEWTON):
        fresh = stands_for(factor.made, out.state, u.shape[1])
        if rest <= tolerance or (whole and fresh and rest > 0.5 * before):  # good, or as good as rounding lets it be
            return
        if not fresh:
            fill_matrix(rows, M, ρ, out, factor)
            cholesky_in_envelope(factor.envelope, factor.L)
        solve_in_envelope(factor.envelope, factor.L, out.gradient, move)
        downhill, length, new = 0.0, 1.0, np.inf
        for i in range(len(u)):
            downhill -= inner(out.gradient[i], move[i])
        for halving in range(MOST_HALVINGS):
            for i in range(len(u)):
                for a in range(u.shape[1]):
                    tried[i, a] = u[i, a] - length * move[i, a]
            new = evaluate(rows, M, free, λ, ρ, shift, tried, trial)
            if new <= value + 1e-4 * length * downhill + 1e-13 * abs(value):
                break
            length *= 0.5
        whole, value, before = length == 1.0, new, rest
        u[:], out.w[:], out.λ[:], out.slope[:] = tried, trial.w, trial.λ, trial.slope
        out.state[:], out.gradient[:] = trial.state, trial.gradient
        rest = worst_rate(M, out.gradient)


@compiled
def stands_for(made, state, k):
    """Whether the matrix made for some states serves these too. In space what slides changes it all the time."""
    for q in range(len(state)):
        if made[q] != state[q] or (state[q] == SLIDES and k == 6):
            return False
    return True


@compiled
def worst_rate(M, gradient):
    """The worst entry of M⁻¹ times the gradient, roughly: by the diagonal of M."""
    worst = 0.0
    for i in range(len(gradient)):
        for a in range(gradient.shape[1]):
            worst = max(worst, abs(gradient[i, a]) / M[i, a, a])
    return worst


@compiled_apart
def evaluate(rows, M, free, λ, ρ, shift, u, out):
    """The augmented Lagrangian at u, with λ̂, P′ and the gradient into ``out``."""
    value, k = 0.0, u.shape[1]
    for i in range(len(u)):
        for a in range(k):
            total = 0.0
            for b in range(k):
                total += M[i, a, b] * (u[i, b] - free[i, b])
            out.gradient[i, a] = total
            value += 0.5 * total * (u[i, a] - free[i, a])
    for q in range(len(rows.μ)):
        first, end = rows.block[q], rows.block[q + 1]
        for r in range(first, end):
            w = rows.c[r]
            for side in range(2):
                i = rows.bodies[r, side]
                if i >= 0:
                    w += inner(rows.J[r, side], u[i])
            out.w[r] = w
            out.λ[r] = λ[r] - ρ[q] * (w + shift[q] if r == first else w)
        value += project(rows, q, first, end, out) / ρ[q]
        for r in range(first, end):
            for side in range(2):
                i = rows.bodies[r, side]
                if i >= 0:
                    for a in range(k):
                        out.gradient[i, a] -= rows.J[r, side, a] * out.λ[r]
    return value


@compiled
def project(rows, q, first, end, out):
    """P of block q in place, P′ and the state; returns y·P(y) − ½ P(y)², whose gradient P is."""
    y, μ = out.λ, rows.μ[q]
    for r in range(first, end):
        put_slope(out.slope, r, 0.0, 0.0, 0.0)
    if μ < 0:
        before = y[first]
        y[first] = min(max(before, rows.lower[first]), rows.upper[first])
        out.state[q] = STICKS if y[first] == before else OPEN
        out.slope[first, 0] = float(out.state[q])
        return before * y[first] - 0.5 * y[first] ** 2
    n, along = y[first], 0.0
    for r in range(first + 1, end):
        along += y[r] ** 2
    tangential = np.sqrt(along)
    if tangential <= μ * n:  # within the cone: it sticks
        out.state[q] = STICKS
        for r in range(first, end):
            out.slope[r, r - first] = 1.0
        return 0.5 * (n * n + along)
    if μ * tangential <= -n:  # within the polar cone: it parts
        out.state[q] = OPEN
        for r in range(first, end):
            y[r] = 0.0
        return 0.0
    return slide(rows, q, n, tangential, out)


@compiled
def slide(rows, q, n, tangential, out):
    """P on the cone's surface: f (1, μ t), with t the unit vector along which y pulls, and f its share of y."""
    μ, first, d = rows.μ[q], rows.block[q], rows.block[q + 1] - rows.block[q]
    t1 = out.λ[first + 1] / tangential
    t2 = out.λ[first + 2] / tangential if d == 3 else 0.0
    share = 1 / (1 + μ * μ)
    f = (n + μ * tangential) * share
    across = μ * f / tangential if d == 3 else 0.0  # turning t is all that the second tangent adds
    put_slope(out.slope, first, share, share * μ * t1, share * μ * t2)
    both = share * μ * μ * t1 * t2 - across * t1 * t2
    put_slope(out.slope, first + 1, share * μ * t1, share * μ * μ * t1 * t1 + across * t2 * t2, both)
    out.λ[first], out.λ[first + 1] = f, μ * f * t1
    if d == 3:
        put_slope(out.slope, first + 2, share * μ * t2, both, share * μ * μ * t2 * t2 + across * t1 * t1)
        out.λ[first + 2] = μ * f * t2
    out.state[q] = SLIDES if t1 > 0 or d == 3 else SLIDES + 1
    return 0.5 * (1 + μ * μ) * f * f


@compiled
def put_slope(slope, r, a, b, c):
    """Row r of P′."""
    slope[r, 0], slope[r, 1], slope[r, 2] = a, b, c


@compiled_apart
def fill_matrix(rows, M, ρ, out, factor):
    """M + ρ Jᵀ P′ J, block by block."""
    k, envelope, L = M.shape[1], factor.envelope, factor.L
    L[:] = 0
    factor.made[:] = out.state
    unit, weighted = np.zeros(k), np.empty(k)
    for i in range(len(M)):
        for a in range(k):
            unit[a] = 1.0
            add_block(envelope, L, i, i, k, unit, M[i, a], 1.0)
            unit[a] = 0.0
    for q in range(len(rows.μ)):
        if out.state[q] == OPEN:
            continue
        first, end = rows.block[q], rows.block[q + 1]
        for r in range(first, end):
            for side in range(2):
                i = rows.bodies[r, side]
                if i < 0:
                    continue
                weighted[:] = 0
                for s in range(first, end):
                    for a in range(k):
                        weighted[a] += out.slope[r, s - first] * rows.J[s, side, a]
                for other in range(2):
                    j = rows.bodies[r, other]
                    if j >= 0:
                        add_block(envelope, L, i, j, k, weighted, rows.J[r, other], ρ[q])


@compiled
def renew(rows, out, λ, ρ):
    """λ ← λ̂. Returns the worst change, as a velocity."""
    worst = 0.0
    for q in range(len(ρ)):
        for r in range(rows.block[q], rows.block[q + 1]):
            worst = max(worst, abs(out.λ[r] - λ[r]) / ρ[q])
            λ[r] = out.λ[r]
    return worst


@compiled
def renew_shift(rows, w, shift, answer):
    """The shift ← μ|w_t|, which makes the law Coulomb's. Returns the worst change, a velocity.

    μ|w_t| answers to a change of the shift, by μ²/(1 + μ²) of it where A is a multiple of 1. ``answer`` (B, 2) holds each contact's shift and
    μ|w_t| of the pass before; they tell by how much, and the shift goes where it answers to itself (the secant method).
    """
    worst = 0.0
    for q in range(len(shift)):
        first = rows.block[q]
        if rows.μ[q] <= 0:
            continue
        along = 0.0
        for r in range(first + 1, rows.block[q + 1]):
            along += w[r] ** 2
        new = rows.μ[q] * np.sqrt(along)
        change, changed = new - shift[q], shift[q] - answer[q, 0]
        worst = max(worst, abs(change))
        share = (new - answer[q, 1]) / changed if abs(changed) > 1e-12 * abs(new) else 0.0
        answer[q, 0], answer[q, 1] = shift[q], new
        shift[q] = max(0.0, shift[q] + change / (1 - min(max(share, -1.0), 0.8)))
    return worst


