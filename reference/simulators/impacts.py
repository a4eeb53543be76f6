"""Impacts: what velocities change to at the moment when bodies meet, in no time and with no force but the
contacts'.

    newton       all contacts at once: w⁺ ≥ −e w, and λ > 0 only where that is an equality (Newton; Moreau)
    poisson      all at once, in two phases: until nothing approaches, with impulse λ; then e λ is given back
    sequential   one contact after the other, the fastest first, until nothing approaches: what one sees in a
                 cradle; each blow by Newton's law

All three can raise the energy where there is friction (Newton's: Kane's paradox; so can each blow of a
sequence). Where no law is asked for, Newton's is used, with as much of the rebound as the energy before
allows.

Slides S3, S10; lectures/05_contact.md. Source: Moreau, Unilateral contact and dry friction in finite
freedom dynamics (1988); Glocker & Pfeiffer, Nonlinear Dynamics 7 (1995) 471 (Poisson's); Kane & Levinson,
Dynamics: Theory and Applications (1985), section 5.8 (the paradox); Ivanov, J. Appl. Math. Mech. 59
(1995) 887 (sequences of impacts).
"""

import numpy as np

from .paying import energies

MOST_BLOWS = 10_000


def rates(rows, u):
    """w = J u of each row: (m,). u (n, k)."""
    moving = rows.bodies >= 0
    of_bodies = np.where(moving[..., None], u[rows.bodies], 0.0)
    return np.einsum("msk,msk->m", rows.J, of_bodies)


def newton(rows, e, M, u, solve):
    """u⁺ (n, k) and λ (m,) by Newton's law; e (B,) of each contact; solve(rows, free) → u⁺, λ."""
    first = rows.block[:-1]
    rows.c[first] = e * np.minimum(rates(rows, u)[first], 0.0)
    return solve(rows, u)


def poisson(rows, e, M, u, solve):
    """u⁺ and λ by Poisson's law: compression, then the normal impulses times e, and what friction then
    does.
    """
    first = rows.block[:-1]
    rows.c[first] = 0.0
    compressed, λ = solve(rows, u)
    given = np.zeros_like(λ)
    given[first] = e * λ[first]
    after, more = solve(rows, compressed + change(rows, M, given))
    return after, λ + given + more


def sequential(rows, e, M, u, solve):
    """u⁺ and λ by blows of single contacts, the fastest first; ties: the first row. Then all at once, for
    what is left.
    """
    first, λ = rows.block[:-1], np.zeros(len(rows.c))
    slowest = 1e-12 * np.abs(rates(rows, u)).max()
    for _ in range(MOST_BLOWS):
        w = rates(rows, u)[first]
        q = int(np.argmin(w))
        if w[q] >= -slowest:
            return u, λ
        one = only(rows, q)
        u, blow = newton(one, e[q : q + 1], M, u, solve)
        λ[rows.block[q] : rows.block[q + 1]] += blow
    rows.c[first] = 0.0
    u, rest = solve(rows, u)
    return u, λ + rest


def within_energy(rows, e, M, u, solve):
    """u⁺ and λ by Newton's law, but with no more energy than before: what is too much is taken from the
    rebound.
    """
    after, λ = newton(rows, e, M, u, solve)
    most = energies(M, u).sum()
    if energies(M, after).sum() <= most * (1 + 1e-15):
        return after, λ
    plastic, λ0 = newton(rows, 0 * e, M, u, solve)
    # ½ |p + s (a − p)|²_M = most, a quadratic equation for the share s of the rebound
    back = after - plastic
    a, b = energies(M, back).sum(), np.einsum("ia,iab,ib->", plastic, M, back)
    c = min(energies(M, plastic).sum() - most, 0.0)
    s = (-b + np.sqrt(b * b - 4 * a * c)) / (2 * a)
    return plastic + s * back, λ0 + s * (λ - λ0)


IMPACTS = {None: within_energy, "newton": newton, "poisson": poisson, "sequential": sequential}


def change(rows, M, λ):
    """M⁻¹ Jᵀ λ (n, k)."""
    f = np.zeros(M.shape[:2])
    for side in range(2):
        moving = rows.bodies[:, side] >= 0
        np.add.at(f, rows.bodies[moving, side], rows.J[moving, side] * λ[moving, None])
    return np.linalg.solve(M, f[..., None])[..., 0]


def only(rows, q):
    """The rows of contact q alone."""
    part = slice(rows.block[q], rows.block[q + 1])
    return rows._replace(
        bodies=rows.bodies[part],
        J=rows.J[part],
        c=rows.c[part].copy(),
        block=rows.block[q : q + 2] - rows.block[q],
        μ=rows.μ[q : q + 1],
        lower=rows.lower[part],
        upper=rows.upper[part],
    )
