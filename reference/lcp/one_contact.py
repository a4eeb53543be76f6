"""One contact by itself, solved exactly: w = A λ + q with A 3 × 3, by Coulomb's law or the convex one.

There are three cases, and the first that fits is the answer (A symmetric, positive definite):

    open      λ = 0              where w = q is allowed: q_n ≥ 0 (Coulomb), q_n ≥ μ‖q_t‖ (convex)
    sticks    λ = −A⁻¹ q         where that is within the cone; w = 0
    slides    λ on the cone, w_t = −α λ_t with an α > 0, and w_n = 0 (Coulomb) or μ‖w_t‖ = α μ² λ_n (convex)

For a given α the last is a linear system, (A + α diag(−κ, 1, 1)) λ = −q with κ = 0 (Coulomb) or μ²
(convex), and

    G(α) = ‖λ_t‖ − μ λ_n = 0

is a quartic in α. It needn't be written out: its root lies between bounds at whose ends G has two signs, so
that bisection can't fail. For Coulomb's law these are 0 and ∞. There λ_t = 0 and λ_n = −q_n/A_nn > 0, so G
< 0; at 0, where it would stick, λ is outside the cone, so G > 0. For the convex law the matrix is singular
at one α₀; the root lies below α₀ if λ comes up to it from within the cone, else above. And G/‖λ_t‖ is nearly
a straight line where n and t hardly couple, so that between these ends regula falsi (Illinois) is at the
root after a few tries.

What rounding leaves is 1e-16 times A's condition number. In the plane the second tangent is given a row of
its own, which stays 0.

Slides S10, S14; lectures/08_newton_lcp.md. Source: Bonnefon & Daviet, Quartic formulation of Coulomb 3D
frictional contact, INRIA RT-0400 (2011), for the quartic; Daviet, Bertails-Descoubes & Boissieux, ACM TOG
30 (2011) 139; Dowell & Jarratt, BIT 11 (1971) 168 (Illinois).
"""

import numpy as np

from ..compiled import compiled

_BISECTIONS, _LINES = 200, 50
_NARROW = 4e-16  # of α: two numbers side by side
_EXACT = 2e-16  # G/‖λ_t‖ that is only rounding


@compiled
def solve_contact(A, q_n, q_1, q_2, μ, coulomb):
    """λ (three numbers) of one contact: A (3, 3) symmetric, positive; q the w that there is without λ."""
    return solve_in_axes(A, principal(A[1, 1], A[1, 2], A[2, 2]), q_n, q_1, q_2, μ, coulomb)


@compiled
def solve_in_axes(A, axes, q_n, q_1, q_2, μ, coulomb):
    """``solve_contact``, given the ``principal`` axes of A_tt."""
    if q_n >= (0.0 if coulomb else μ * np.hypot(q_1, q_2)):
        return 0.0, 0.0, 0.0
    if μ == 0:
        return -q_n / A[0, 0], 0.0, 0.0
    c, s, s_1, s_2 = axes
    # in the axes of A_tt, which are turned by the angle of (c, s), all but the first row is diagonal
    a_1, a_2 = c * A[0, 1] + s * A[0, 2], c * A[0, 2] - s * A[0, 1]
    p_1, p_2 = c * q_1 + s * q_2, c * q_2 - s * q_1
    κ = 0.0 if coulomb else μ * μ
    block = (A[0, 0], a_1, a_2, s_1, s_2, q_n, p_1, p_2, μ, κ)
    G, whole, n, t_1, t_2 = surface(0.0, block)
    if whole > 0 and G <= 0 and n >= 0:
        n, t_1, t_2 = refine(block, n / whole, t_1 / whole, t_2 / whole)
    else:
        _, whole, n, t_1, t_2 = surface(find_slip(block), block)
        n, t_1, t_2 = n / whole, t_1 / whole, t_2 / whole
        t = np.hypot(t_1, t_2)
        if t > 0 and n > 0:
            t_1, t_2 = t_1 * (μ * n / t), t_2 * (μ * n / t)
    return n, c * t_1 - s * t_2, s * t_1 + c * t_2


@compiled
def refine(block, n, t_1, t_2):
    """λ of sticking once more: what rounding has left of w is solved for again, and added."""
    A_nn, a_1, a_2, s_1, s_2, q_n, p_1, p_2, μ, κ = block
    w_n = A_nn * n + a_1 * t_1 + a_2 * t_2 + q_n
    w_1, w_2 = a_1 * n + s_1 * t_1 + p_1, a_2 * n + s_2 * t_2 + p_2
    _, whole, more, more_1, more_2 = surface(0.0, (A_nn, a_1, a_2, s_1, s_2, w_n, w_1, w_2, μ, κ))
    return n + more / whole, t_1 + more_1 / whole, t_2 + more_2 / whole


@compiled
def principal(a, b, d):
    """The principal axis (c, s) of [[a, b], [b, d]], and its two eigenvalues, at least a rounding above 0."""
    half, mean = 0.5 * (a - d), 0.5 * (a + d)
    radius = np.hypot(half, b)
    angle = 0.5 * np.arctan2(b, half) if radius > 0 else 0.0
    least = 1e-15 * mean
    return np.cos(angle), np.sin(angle), max(mean + radius, least), max(mean - radius, least)


@compiled
def surface(α, block):
    """G, Schur's complement, and λ of the linear system for α, all but the second times that complement.

    G's sign is that of ‖λ_t‖ − μ λ_n where the complement is positive, and of ‖λ_t‖ + μ λ_n where not: so
    it does not jump where λ passes through infinity.
    """
    A_nn, a_1, a_2, s_1, s_2, q_n, p_1, p_2, μ, κ = block
    x_1, x_2 = 1 / (s_1 + α), 1 / (s_2 + α)
    whole = A_nn - α * κ - a_1 * a_1 * x_1 - a_2 * a_2 * x_2
    n = a_1 * p_1 * x_1 + a_2 * p_2 * x_2 - q_n
    t_1, t_2 = -x_1 * (p_1 * whole + a_1 * n), -x_2 * (p_2 * whole + a_2 * n)
    return np.hypot(t_1, t_2) - μ * n, whole, n, t_1, t_2


@compiled
def find_slip(block):
    """The α > 0 at which λ lies on the cone, from between two at which G has two signs."""
    s_1, κ, outside, inside = block[3], block[9], 0.0, 1.0
    if κ > 0:
        inside = singular(block)
        _, _, n, _, _ = surface(inside, block)
        if n < 0:  # λ comes up to infinity from the wrong side: it is beyond
            outside, grow = 2 * inside + s_1, 0
            while beyond(outside, block) <= 0 and grow < 1000:
                outside, grow = 2 * outside, grow + 1
            return close_in(inside, outside, block, True)
    else:
        inside, grow = s_1, 0
        while surface(inside, block)[0] > 0 and grow < 1000:
            outside, inside, grow = inside, 2 * inside, grow + 1
    return close_in(inside, outside, block, False)


@compiled
def beyond(α, block):
    """‖λ_t‖ − μ λ_n past the singular α, times |Schur's complement|: positive outside the cone."""
    _, _, n, t_1, t_2 = surface(α, block)
    return np.hypot(t_1, t_2) + block[8] * n


@compiled
def singular(block):
    """The α₀ > 0 at which the convex law's matrix is singular: Schur's complement is 0."""
    low, high = 0.0, block[0] / block[9]
    for _ in range(_BISECTIONS):
        α = 0.5 * (low + high)
        if high - low <= _NARROW * high:
            break
        if surface(α, block)[1] > 0:
            low = α
        else:
            high = α
    return low


@compiled
def outside_by(α, block, past):
    """G/‖λ_t‖, or past the singular α what ``beyond`` tells instead of G: positive outside the cone."""
    G, _, n, t_1, t_2 = surface(α, block)
    t = np.hypot(t_1, t_2)
    if past:
        G = t + block[8] * n
    return G / t if t > 0 else (-1.0 if G <= 0 else 1.0)


@compiled
def close_in(inside, outside, block, past):
    """The α between two at which λ is inside the cone and outside it: λ is on the cone."""
    low, high, stayed = outside_by(inside, block, past), outside_by(outside, block, past), 0
    for lines in range(_LINES + _BISECTIONS):
        if low == 0 or abs(outside - inside) <= _NARROW * max(inside, outside):
            break
        α = inside + (outside - inside) * (low / (low - high))
        if lines >= _LINES or not min(inside, outside) < α < max(inside, outside):
            α = 0.5 * (inside + outside)
        G = outside_by(α, block, past)
        if abs(G) <= _EXACT:
            return α
        if G <= 0:
            inside, low, high, stayed = α, G, 0.5 * high if stayed == 1 else high, 1
        else:
            outside, high, low, stayed = α, G, 0.5 * low if stayed == -1 else low, -1
    return inside
