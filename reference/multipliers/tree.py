"""A solver linear in the number of links, for joints that form a tree: no loops.

From the leaves to the root each body hands on to its parent what it and all beyond it resist with: its
articulated inertia H, the mass matrix of the body that the parent *feels*. From the root to the leaves come
then the changes of velocity, and with them λ. A itself is never formed, so that a body with very many joints
costs no more than a chain.

    body c, joint (J_c, J_p) to its parent p:     S = J_c H_c⁻¹ J_cᵀ
    up      H_p += J_pᵀ S⁻¹ J_p                   s = right − J_c H_c⁻¹ g_c,   g_p += J_pᵀ S⁻¹ s
    down    λ = S⁻¹ (s − J_p δu_p)                δu_c = H_c⁻¹ (J_cᵀ λ + g_c)

Slides S8, S9; lectures/04_embedding.md. Source: Baraff, Linear-time dynamics using Lagrange multipliers,
SIGGRAPH 1996; Featherstone, Rigid Body Dynamics Algorithms (2008), chapter 7 (the articulated inertia).
"""

import numpy as np

from ..compiled import lean, merged
from .cholesky import cholesky, solve_cholesky
from .factor import make_factor


def prepare(rows, system):
    """A ``Factor``: links (n, 5), from the leaves to the roots: a body, its parent (−1: none that moves), at
    which side of their joint's rows the body is, the joint's first row, and how many it has.

    values: H of each of the M bodies; G = J_c H_c⁻¹, S and P = S⁻¹ J_p of each link, k² each, with k = 6
    velocities a body in space, 3 in the plane; then g and δu of each body, s of each link, and room for a
    vector, k each.
    Raises ValueError where the joints close a loop.
    """
    M, k = len(system.mass), 6 if len(system.gravity) == 3 else 3
    links = links_of_tree(rows, M)
    if links is None:
        raise ValueError("solver must be another one than 'tree' here: the joints close a loop")
    n = len(links)
    return make_factor(links=links, values=(M + 3 * n) * k * k + (2 * M + n + 1) * k)


def links_of_tree(rows, M):
    """(body, parent, side, first row, count) of each link, leaves first; None where there is a loop."""
    joints, seen = {}, set()
    for number, first, count in zip(
        *np.unique(rows.joint, return_index=True, return_counts=True), strict=True
    ):
        i, j = rows.bodies[first].tolist()
        joints.setdefault(i, []).append((number, j, 1, first, count))
        joints.setdefault(j, []).append((number, i, 0, first, count))
    links, used = [], set()
    for root in [-1, *range(M)]:
        if root in seen:
            continue
        seen.add(root)
        links += [] if root < 0 else [(root, -1, 0, 0, 0)]
        waiting = [root]
        while waiting:
            i = waiting.pop()
            for number, j, side, first, count in joints.get(i, ()):
                if number in used:
                    continue
                used.add(number)
                if j in seen:
                    return None
                seen.add(j)
                links.append((j, i, side, first, count))
                waiting.append(j)
    return links[::-1]


@merged
def places(factor, M, k):
    """Where in values G, S, P, g, δu, s and the vector start."""
    n = len(factor.links)
    G = M * k * k
    S, P, g = G + n * k * k, G + 2 * n * k * k, G + 3 * n * k * k
    δu, s = g + M * k, g + 2 * M * k
    return G, S, P, g, δu, s, s + n * k


@merged
def factorise(factor, J, mass, inertia, frame):
    """Articulated inertias, from the leaves to the roots. Returns the smallest pivot, as ``cholesky``."""
    values, links = factor.values, factor.links
    M, k = len(mass), J.shape[2]
    G0, S0, P0, _, _, _, column = places(factor, M, k)
    fill_inertias(mass, inertia, frame, values, k)
    smallest = 1.0
    for link in range(len(links)):
        c, p, side, first, n = links[link, 0], links[link, 1], links[link, 2], links[link, 3], links[link, 4]
        H, G, S, P = c * k * k, G0 + link * k * k, S0 + link * k * k, P0 + link * k * k
        cholesky(values, H, k)
        for a in range(n):
            for x in range(k):
                values[G + a * k + x] = J[first + a, side, x]
            solve_cholesky(values, H, k, values, G + a * k)
        for a in range(n):
            for b in range(a + 1):
                values[S + a * n + b] = row_part_times(J, first + a, side, values, G + b * k)
        ratio = cholesky(values, S, n)
        smallest = ratio if not ratio >= smallest else smallest
        if p < 0:
            continue
        for x in range(k):
            for a in range(n):
                values[column + a] = J[first + a, 1 - side, x]
            solve_cholesky(values, S, n, values, column)
            for a in range(n):
                values[P + a * k + x] = values[column + a]
        for x in range(k):
            for y in range(x + 1):
                for a in range(n):
                    values[(p * k + x) * k + y] += J[first + a, 1 - side, x] * values[P + a * k + y]
    return smallest


@merged
def fill_inertias(mass, inertia, frame, H, k):
    """H = M of each body: mass, and R I Rᵀ; 1 for the turning of points, which have none."""
    d = 2 if k == 3 else 3
    for i in range(len(mass)):
        at = i * k * k
        for x in range(k * k):
            H[at + x] = 0.0
        for x in range(k):
            H[at + x * k + x] = mass[i] if x < d else 1.0
        if i >= len(inertia):
            continue
        if d == 2:
            H[at + 8] = inertia[i, 0]
            continue
        for a in range(3):
            for b in range(a + 1):
                total = 0.0
                for c in range(3):
                    total += frame[i, 3 * a + c] * inertia[i, c] * frame[i, 3 * b + c]
                H[at + (3 + a) * 6 + 3 + b] = total


@merged
def substitute(M, factor, J, right, λ):
    """λ of A λ = right, after ``factorise``: forces up to the roots, motion down to the leaves."""
    values, links = factor.values, factor.links
    k = J.shape[2]
    G0, S0, P0, g0, δu0, s0, _ = places(factor, M, k)
    for x in range(M * k):
        values[g0 + x] = 0.0
    for link in range(len(links)):
        c, p, first, n = links[link, 0], links[link, 1], links[link, 3], links[link, 4]
        G, P, g, s = G0 + link * k * k, P0 + link * k * k, g0 + p * k, s0 + link * k
        for a in range(n):
            total = right[first + a]
            for x in range(k):
                total -= values[G + a * k + x] * values[g0 + c * k + x]
            values[s + a] = total
        for a in range(n if p >= 0 else 0):
            for x in range(k):
                values[g + x] += values[P + a * k + x] * values[s + a]
    for link in range(len(links) - 1, -1, -1):
        c, p, side, first, n = links[link, 0], links[link, 1], links[link, 2], links[link, 3], links[link, 4]
        G, s, δu = G0 + link * k * k, s0 + link * k, δu0 + c * k
        for a in range(n if p >= 0 else 0):
            values[s + a] -= row_part_times(J, first + a, 1 - side, values, δu0 + p * k)
        solve_cholesky(values, S0 + link * k * k, n, values, s)
        for x in range(k):
            values[δu + x] = values[g0 + c * k + x]
        solve_cholesky(values, c * k * k, k, values, δu)
        for a in range(n):
            λ[first + a] = values[s + a]
            for x in range(k):
                values[δu + x] += values[G + a * k + x] * values[s + a]


@lean
def row_part_times(J, row, side, values, at):
    """Row of J, its part for one body, times the numbers from ``at`` on."""
    total = 0.0
    for x in range(J.shape[2]):
        total += J[row, side, x] * values[at + x]
    return total
