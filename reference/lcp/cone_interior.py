"""From where to start where much sticks, slides and parts: an interior-point method for contact's convex law.

Newton's method for the kinks of ``smooth_pass`` tries one state of the contacts after another. In a heap there
are more states than it can try. Here λ and w stay *inside* their cones, where nothing has kinks, and approach
the answer together along the path on which all their products are the same, s ∘ z = t e, with t → 0:

    M (u − u_free) = Jᵀ λ,    w = J u + c,    s ∘ z = t e;     z = (μ λ_n, λ_t),  s = (w_n/μ, w_t)

z and s then live in one and the same round cone. Each step is a linear system with M + Jᵀ W⁻² J, W a block a
contact: the scaling that takes z and s to the same point, W z = W⁻¹ s (Nesterov and Todd's). 10 to 25 steps,
whatever the heap, and from any start. What it finds, to 1e-10, is where the passes of ``cone_newton`` begin.

Slides S14; lectures/08_newton_lcp.md. Source: Nesterov & Todd, SIAM J. Optim. 8 (1998) 324; Mehrotra, SIAM J.
Optim. 2 (1992) 575 (two solves a step); Acary, Armand, Nguyen & Shpakovych, Optim. Methods Softw. 39 (2024)
(friction by such methods).
"""

import numpy as np

from ..compiled import compiled, compiled_apart
from .augmented import STICKS, ContactRows, inner
from .block_cholesky import factorise, solve
from .smooth_pass import fill_matrix

MOST_STEPS, CLOSE = 40, 1e-10
SMALLEST_FRICTION = 1e-3  # less is taken for this: z and s would be too thin to be computed with
BACK = 0.99  # of the way to where a cone ends
FIRM = 1e-4  # ε of what has bounds on both sides, or none: it is held, as if it had none


@compiled
def start_inside(rows, M, free, λ, u, size, scale, factor, out):
    """λ (m,) and u (n, k) of the convex law, roughly: in place. Returns the steps taken.

    size (B,): A's largest diagonal entry of each block; scale: the worst free w, m/s. factor, out: room.
    """
    rows, unit = make_round(rows)
    m, blocks = len(unit), len(size)
    s, z, ds, dz, p, r = np.zeros(m), np.zeros(m), np.zeros(m), np.zeros(m), np.zeros(m), np.zeros(m)
    turn, θ, held, ρ = np.zeros(m), np.ones(blocks), np.zeros(blocks, np.bool_), np.ones(blocks)
    for q in range(blocks):
        i = rows.block[q]
        held[q] = rows.μ[q] < 0 and not (rows.lower[i] == 0 and rows.upper[i] == np.inf)
        if not held[q]:
            s[i], z[i] = scale * unit[i], scale / (size[q] * unit[i])
    du, right, cones = np.empty_like(u), np.empty_like(u), max(1, blocks - held.sum())
    u[:], out.state[:] = free, STICKS
    for step in range(MOST_STEPS):
        off = look(rows, M, free, s, z, u, p, out.gradient, unit)
        total, worst = 0.0, 0.0
        for q in range(blocks):
            first, end = rows.block[q], rows.block[q + 1]
            if held[q]:
                out.slope[first, 0] = 1 / (FIRM * size[q])
                continue
            product = inner(s[first:end], z[first:end])
            total, worst = total + product, max(worst, product * size[q])
            θ[q] = find_scaling(s[first:end], z[first:end], turn[first:end])
            put_inverse_square(turn[first:end], θ[q], out.slope[first:end])
        if max(off, np.sqrt(worst)) <= CLOSE * scale:
            break
        fill_matrix(rows, M, ρ, out, factor)
        if not factorise(factor.blocks):
            break
        way = 1.0
        for correcting in range(2):
            target = (1 - way) ** 3 * total / cones
            for q in range(blocks):
                first, end = rows.block[q], rows.block[q + 1]
                if not held[q]:
                    if correcting:
                        aim(s[first:end], z[first:end], ds[first:end], dz[first:end], turn[first:end], θ[q],
                            target, r[first:end])  # fmt: skip
                    else:
                        r[first:end] = -z[first:end]
            pull(rows, out, r, p, right)
            solve(factor.blocks, right, du)
            way = move_along(rows, out, r, p, du, held, s, z, ds, dz)
        way = min(1.0, BACK * way)
        for i in range(len(u)):
            for a in range(u.shape[1]):
                u[i, a] += way * du[i, a]
        for i in range(m):
            s[i], z[i] = s[i] + way * ds[i], z[i] + way * dz[i]
    for i in range(m):
        λ[i] = unit[i] * z[i]
    factor.made[:] = -1
    return step


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


@compiled_apart
def look(rows, M, free, s, z, u, p, gradient, unit):
    """p = J u + c − s, and −gradient = Jᵀ z − M (u − free). Returns the worst of both, as a velocity."""
    worst, k = 0.0, u.shape[1]
    for i in range(len(u)):
        for a in range(k):
            total = 0.0
            for b in range(k):
                total += M[i, a, b] * (u[i, b] - free[i, b])
            gradient[i, a] = total
    for r in range(len(p)):
        p[r] = rows.c[r] - s[r]
        for side in range(2):
            i = rows.bodies[r, side]
            if i >= 0:
                p[r] += inner(rows.J[r, side], u[i])
                for a in range(k):
                    gradient[i, a] -= rows.J[r, side, a] * z[r]
        worst = max(worst, abs(p[r]) / unit[r])
    for i in range(len(u)):
        for a in range(k):
            worst = max(worst, abs(gradient[i, a]) / M[i, a, a])
    return worst


@compiled
def determinant(x):
    """x_0² − |x_1|²: positive inside the cone."""
    total = x[0] * x[0]
    for a in range(1, len(x)):
        total -= x[a] * x[a]
    return total


@compiled
def find_scaling(s, z, turn):
    """θ, and turn (d,) with determinant 1, of the W that takes z and s to the same point."""
    det_s, det_z = np.sqrt(determinant(s)), np.sqrt(determinant(z))
    γ = np.sqrt(0.5 * (1 + inner(s, z) / (det_s * det_z)))
    for a in range(len(s)):
        turn[a] = 0.5 * (s[a] / det_s + (z[a] if a == 0 else -z[a]) / det_z) / γ
    return np.sqrt(det_s / det_z)


@compiled
def put_inverse_square(turn, θ, slope):
    """W⁻² into slope (d, 3)."""
    for a in range(len(turn)):
        for b in range(len(turn)):
            sign = 1.0 if (a == 0) == (b == 0) else -1.0
            own = (1.0 if a == 0 else -1.0) if a == b else 0.0
            slope[a, b] = (2 * sign * turn[a] * turn[b] - own) / (θ * θ)


@compiled
def scaled(turn, θ, sign, x, a):
    """Entry a of W x (sign 1) or W⁻¹ x (sign −1)."""
    along = 0.0
    for b in range(1, len(x)):
        along += sign * turn[b] * x[b]
    f = θ if sign > 0 else 1 / θ
    if a == 0:
        return f * (turn[0] * x[0] + along)
    return f * (x[a] + (x[0] + along / (1 + turn[0])) * sign * turn[a])


@compiled
def aim(s, z, ds, dz, turn, θ, target, r):
    """r (d,): what z is to change by, but for W⁻² times what s does, so that s ∘ z becomes target e.

    In the scaled space, l = W z: r = W⁻¹ (l \\ (target e − l ∘ l − W⁻¹ ds ∘ W dz)).
    """
    d = len(s)
    l, x, y, right = np.empty(d), np.empty(d), np.empty(d), np.empty(d)
    for a in range(d):
        l[a], x[a], y[a] = (
            scaled(turn, θ, 1.0, z, a),
            scaled(turn, θ, -1.0, ds, a),
            scaled(turn, θ, 1.0, dz, a),
        )
    right[0] = target - inner(l, l) - inner(x, y)
    along = 0.0
    for a in range(1, d):
        right[a] = -2 * l[0] * l[a] - x[0] * y[a] - y[0] * x[a]
        along += l[a] * right[a]
    x[0] = (l[0] * right[0] - along) / determinant(l)
    for a in range(1, d):
        x[a] = (right[a] - x[0] * l[a]) / l[0]
    for a in range(d):
        r[a] = scaled(turn, θ, -1.0, x, a)


@compiled
def weighted(rows, slope, q, r, x):
    """Entry of row r of block q of W⁻² x."""
    total, first = 0.0, rows.block[q]
    for b in range(first, rows.block[q + 1]):
        total += slope[r, b - first] * x[b]
    return total


@compiled_apart
def pull(rows, out, r, p, right):
    """right (n, k) = −gradient + Jᵀ (r − W⁻² p)."""
    for i in range(len(right)):
        for a in range(right.shape[1]):
            right[i, a] = -out.gradient[i, a]
    for q in range(len(rows.μ)):
        for c in range(rows.block[q], rows.block[q + 1]):
            force = r[c] - weighted(rows, out.slope, q, c, p)
            for side in range(2):
                i = rows.bodies[c, side]
                if i >= 0:
                    for a in range(right.shape[1]):
                        right[i, a] += rows.J[c, side, a] * force


@compiled_apart
def move_along(rows, out, r, p, du, held, s, z, ds, dz):
    """ds and dz that go with du. Returns how far to go, at most 1, until the first cone ends."""
    way = 1.0
    for q in range(len(rows.μ)):
        first, end = rows.block[q], rows.block[q + 1]
        for c in range(first, end):
            ds[c] = p[c]
            for side in range(2):
                i = rows.bodies[c, side]
                if i >= 0:
                    ds[c] += inner(rows.J[c, side], du[i])
        for c in range(first, end):
            dz[c] = r[c] - weighted(rows, out.slope, q, c, ds)
        if held[q]:
            ds[first] = 0.0
        else:
            way = min(way, to_boundary(s[first:end], ds[first:end]), to_boundary(z[first:end], dz[first:end]))
    return way


@compiled
def to_boundary(x, dx):
    """The largest t ≤ 1 with x + t dx in the cone: up to the first root of its determinant, a quadratic."""
    a, b, c = determinant(dx), x[0] * dx[0], determinant(x)
    for e in range(1, len(x)):
        b -= x[e] * dx[e]
    t = 1.0 if dx[0] >= 0 else min(1.0, -x[0] / dx[0])
    inside = b * b - a * c
    if inside >= 0:
        for divisor in (b + np.sqrt(inside), b - np.sqrt(inside)):
            if divisor < 0:
                t = min(t, -c / divisor)
    return t
