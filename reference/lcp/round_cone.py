"""A round cone x_0 ≥ |x_1| and its points: what interior-point methods ask of it.

The cone has a product, x ∘ y = (x·y, x_0 y_1 + y_0 x_1), for which e = (1, 0) is one. W is the symmetric
map of the cone onto itself that takes two of its points, z and s, to one and the same, W z = W⁻¹ s. It is
known by its size θ and a point ``turn`` of determinant 1.

Slides S14; lectures/08_newton_lcp.md. Source: Nesterov & Todd, SIAM J. Optim. 8 (1998) 324; Alizadeh &
Goldfarb, Math. Programming 95 (2003) 3 (the product, and W).
"""

import numpy as np

from ..compiled import inner
from .augmented import dot

THIN = 1e-14  # √determinant over x_0: nearer to the surface rounding decides


@inner
def determinant(x):
    """x_0² − |x_1|²: positive inside the cone."""
    along = 0.0
    for a in range(1, len(x)):
        along += x[a] * x[a]
    along = np.sqrt(along)
    return (x[0] - along) * (x[0] + along)


@inner
def product(x, y, d):
    """Σ x_a y_a of the first d."""
    total = 0.0
    for a in range(d):
        total += x[a] * y[a]
    return total


@inner
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


@inner
def find_scaling(s, z, turn):
    """θ, and turn (d,) with determinant 1, of the W that takes z and s to the same point."""
    det_s = np.sqrt(max(determinant(s), (THIN * s[0]) ** 2))
    det_z = np.sqrt(max(determinant(z), (THIN * z[0]) ** 2))
    γ = np.sqrt(0.5 * (1 + dot(s, z) / (det_s * det_z)))
    for a in range(len(s)):
        turn[a] = 0.5 * (s[a] / det_s + (z[a] if a == 0 else -z[a]) / det_z) / γ
    return np.sqrt(det_s / det_z)


@inner
def put_inverse_square(turn, θ, slope):
    """W⁻² into slope (d, 3)."""
    for a in range(len(turn)):
        for b in range(len(turn)):
            sign = 1.0 if (a == 0) == (b == 0) else -1.0
            own = (1.0 if a == 0 else -1.0) if a == b else 0.0
            slope[a, b] = (2 * sign * turn[a] * turn[b] - own) / (θ * θ)


@inner
def scaled(turn, θ, sign, x, a):
    """Entry a of W x (sign 1) or W⁻¹ x (sign −1)."""
    along = 0.0
    for b in range(1, len(x)):
        along += sign * turn[b] * x[b]
    f = θ if sign > 0 else 1 / θ
    if a == 0:
        return f * (turn[0] * x[0] + along)
    return f * (x[a] + (x[0] + along / (1 + turn[0])) * sign * turn[a])


@inner
def aim(s, z, ds, dz, turn, θ, target, r, room):
    """r (d,): what z is to change by, but for W⁻² times what s does, so that s ∘ z becomes target e.

    In the scaled space, l = W z: r = W⁻¹ (l \\ (target e − l ∘ l − W⁻¹ ds ∘ W dz)).
    """
    d = len(s)
    l, x, y, right = room[0], room[1], room[2], room[3]
    for a in range(d):
        l[a], x[a], y[a] = (
            scaled(turn, θ, 1.0, z, a),
            scaled(turn, θ, -1.0, ds, a),
            scaled(turn, θ, 1.0, dz, a),
        )
    right[0] = target - product(l, l, d) - product(x, y, d)
    along = 0.0
    for a in range(1, d):
        right[a] = -2 * l[0] * l[a] - x[0] * y[a] - y[0] * x[a]
        along += l[a] * right[a]
    x[0] = (l[0] * right[0] - along) / max(determinant(l[:d]), (THIN * l[0]) ** 2)
    for a in range(1, d):
        x[a] = (right[a] - x[0] * l[a]) / l[0]
    for a in range(d):
        r[a] = scaled(turn, θ, -1.0, x[:d], a)
