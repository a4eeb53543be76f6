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

from typing import NamedTuple

import numpy as np

from ..compiled import compiled
from .cholesky import cholesky, solve_cholesky


class TreeFactor(NamedTuple):
    """n links, from the leaves to the roots. A link is a body and the joint to its parent, or none.

    k = 6 velocities a body in space, 3 in the plane.
    """

    body: np.ndarray  # (n,)
    parent: np.ndarray  # (n,): −1: none that moves
    side: np.ndarray  # (n,): at which side of its joint's rows the body is
    first: np.ndarray  # (n,): its joint's first row
    count: np.ndarray  # (n,): and how many: 0 for a free root
    H: np.ndarray  # (M, k, k): articulated inertia of each body, then its L
    G: np.ndarray  # (n, k, k): H_c⁻¹ J_cᵀ, column by column: row a belongs to the joint's row a
    S: np.ndarray  # (n, k, k), then its L
    P: np.ndarray  # (n, k, k): S⁻¹ J_p, row a for the joint's row a
    g: np.ndarray  # (M, k)
    δu: np.ndarray  # (M, k)
    s: np.ndarray  # (n, k)
    work: np.ndarray  # (k,)


def prepare(rows, system):
    """The links, from the leaves to the roots. Raises ValueError where the joints close a loop."""
    M, k = len(system.mass), 6 if len(system.gravity) == 3 else 3
    links = links_of_tree(rows, M)
    if links is None:
        raise ValueError("solver must be another one than 'tree' here: the joints close a loop")
    n = len(links)
    arrays = (
        (np.array(column, dtype=int) for column in zip(*links, strict=True)) if n else [np.zeros(0, int)] * 5
    )
    return TreeFactor(
        *arrays,
        *(np.zeros((size, k, k)) for size in (M, n, n, n)),
        *(np.zeros((size, k)) for size in (M, M, n)),
        work=np.zeros(k),
    )


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


@compiled
def factorise(system, mechanism):
    """Articulated inertias, from the leaves to the roots."""
    factor, J = mechanism.factor, mechanism.jacobian.J
    fill_inertias(system, mechanism.jacobian.frame, factor.H)
    for link in range(len(factor.body)):
        c, p, n = factor.body[link], factor.parent[link], factor.count[link]
        side, first = factor.side[link], factor.first[link]
        cholesky(factor.H[c])
        S, P = factor.S[link, :n, :n], factor.P[link]
        for a in range(n):
            solve_cholesky(factor.H[c], J[first + a, side], factor.G[link, a])
        for a in range(n):
            for b in range(a + 1):
                S[a, b] = inner(J[first + a, side], factor.G[link, b])
        cholesky(S)
        if p < 0:
            continue
        for column in range(P.shape[1]):
            for a in range(n):
                factor.work[a] = J[first + a, 1 - side, column]
            solve_cholesky(S, factor.work[:n], factor.work[:n])
            for a in range(n):
                P[a, column] = factor.work[a]
        for row in range(P.shape[1]):
            for column in range(row + 1):
                for a in range(n):
                    factor.H[p, row, column] += J[first + a, 1 - side, row] * P[a, column]


@compiled
def fill_inertias(system, frame, H):
    """H = M of each body: mass, and R I Rᵀ; 1 for the turning of points, which have none."""
    H[:] = 0
    d = len(system.gravity)
    for i in range(len(H)):
        for c in range(H.shape[1]):
            H[i, c, c] = system.mass[i] if c < d else 1.0
        if i >= len(frame):
            continue
        if d == 2:
            H[i, 2, 2] = system.inertia[i, 0]
            continue
        for a in range(3):
            for b in range(a + 1):
                total = 0.0
                for c in range(3):
                    total += frame[i, 3 * a + c] * system.inertia[i, c] * frame[i, 3 * b + c]
                H[i, 3 + a, 3 + b] = total


@compiled
def substitute(mechanism, right, λ):
    """λ of A λ = right, after ``factorise``: forces up to the roots, motion down to the leaves."""
    factor, J = mechanism.factor, mechanism.jacobian.J
    factor.g[:] = 0
    for link in range(len(factor.body)):
        c, p, n = factor.body[link], factor.parent[link], factor.count[link]
        side, first, s = factor.side[link], factor.first[link], factor.s[link]
        for a in range(n):
            s[a] = right[first + a] - inner(factor.G[link, a], factor.g[c])
        if p >= 0:
            for a in range(n):
                for column in range(len(factor.work)):
                    factor.g[p, column] += factor.P[link, a, column] * s[a]
    for link in range(len(factor.body) - 1, -1, -1):
        c, p, n = factor.body[link], factor.parent[link], factor.count[link]
        side, first, s = factor.side[link], factor.first[link], factor.s[link]
        if p >= 0:
            for a in range(n):
                s[a] -= inner(J[first + a, 1 - side], factor.δu[p])
        solve_cholesky(factor.S[link, :n, :n], s[:n], s[:n])
        solve_cholesky(factor.H[c], factor.g[c], factor.δu[c])
        for a in range(n):
            λ[first + a] = s[a]
            for column in range(len(factor.work)):
                factor.δu[c, column] += factor.G[link, a, column] * s[a]


@compiled
def inner(a, b):
    """Σ a_k b_k."""
    total = 0.0
    for k in range(len(b)):
        total += a[k] * b[k]
    return total
