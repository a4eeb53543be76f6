"""Try everything: one of the two unknowns of each row is 0, so there are 2ⁿ systems of equations.

    (−M_α, I_β) (z_α, w_β) = q     z_α ≥ 0, w_β ≥ 0      α: the rows whose z may be positive

The columns span a **complementary cone**, and the question is in which of the 2ⁿ cones q lies. If they fill
space without overlap (M is a P-matrix) it is in just one, whatever q is. Where q lies in none there is a
plane between it and each cone, and these planes are the certificate.

A row with two bounds has 3 places rather than 2, and a system that is singular spans a flat cone, in which
the nearest point to q is sought (non-negative least squares). Friction and bounds by way of ``standard``.

Slides S11, S13; lectures/06_pivoting_lcp.md. Sources: Cottle, Pang & Stone, The Linear Complementarity
Problem (2009), section 1.3; Samelson, Thrall & Wesler, Proc. AMS 9 (1958) 805.
"""

import itertools

import numpy as np
import scipy.optimize

from .iteration import unsuitable
from .pivoting import begun, refined, scaled
from .solution import finish, solves
from .standard import plain, why_no_plain

_MOST = 2**16  # cones
_OFF, _NEAR, _SAME = 1e-9, 1e-6, 1e-8  # surely apart; worth a look; the same solution
_NOISE = 4e-15  # what is left of numbers that should cancel, beside the largest of them
_SURE = 1e6  # times q: rounding of y must not matter to any z up to that
_FLAT = 1e10  # what the inverse may grow to before a cone is taken for flat
_FOUND = "λ solves the problem. All {cones} cones were tried: {words}"
_NONE = (
    "None of the {cones} complementary cones holds q: there is no solution. ``certificate`` has a plane "
    "between q and each of them."
)
_DOUBT = (
    "No solution was found, but q lies so near to one of the complementary cones that rounding hides on "
    "which side: nothing is proved."
)


def enumeration(problem, start=None, tolerance=1e-10, max_iterations=1000):
    """Solve an LCP by trying all of its 2ⁿ complementary cones (3ⁿ with two bounds a row), at most 65536.

    Finds a solution if there is one. The first found is ``lam``; ``record`` lists all that differ, as λ (n,),
    one for each cone: of solutions that fill a line or more, some points. One iteration is one cone, and
    max_iterations is not heeded: where it would be too many the problem is ``unsuitable``. start is not used.
    certificate, of an infeasible problem, in scaled units: M, q, and for each cone z_may_be_positive (k, m)
    and y (k, m), with y · column ≥ 0 for all columns of the cone and y · q < 0.
    Returns a ``Solution``. Raises ValueError or TypeError for bad arguments.
    """
    λ, tolerance, _, solution = begun(problem, start, tolerance, max_iterations, 2**10)
    if solution and (solution.status == "unsuitable" or problem.scale == 0):
        return solution
    form = scaled(problem)
    reason = why_no_plain(form)
    if reason:
        return unsuitable(problem, λ, tolerance, reason)
    parts = plain(form)
    groups = _groups(parts)
    cones = np.prod([len(choices) for _, choices in groups], dtype=float)
    if cones > _MOST:
        words = f"There are {cones:.3g} complementary cones, more than the {_MOST} that are tried at most."
        return unsuitable(problem, λ, tolerance, words + " Take another pivoting method.")
    return _search(problem, form, parts, groups, int(cones), tolerance)


def _groups(parts):
    """For each row of the problem: its places in z, and which of them may be positive together."""
    first = np.flatnonzero(parts.kind != 1)
    second = {parts.row[k]: k for k in np.flatnonzero(parts.kind == 1)}
    groups = []
    for k in first:
        if parts.kind[k] == 0 and parts.row[k] in second:
            groups.append(([k, second[parts.row[k]]], [(0, 0), (1, 0), (1, 1)]))
        else:
            groups.append(([k], [(0,), (1,)]))
    return groups


def _search(problem, form, parts, groups, cones, tolerance):
    found, tried, planes, nearest = [], [], [], problem.origin
    for choice in itertools.product(*(choices for _, choices in groups)):
        positive = np.zeros(len(parts.q), dtype=bool)
        for (places, _), on in zip(groups, choice, strict=True):
            positive[places] = on
        z, plane = in_cone(parts.M, parts.q, positive)
        tried.append(positive)
        planes.append(plane)
        if z is None:
            continue
        λ = refined(problem, parts.lam(z) * form.unit, parts.place(positive))
        known = (np.abs(λ - other).max(initial=0) <= _SAME * np.abs(λ).max(initial=0) for other in found)
        if solves(problem, λ, tolerance) and not any(known):
            found.append(λ)
        nearest = λ if problem.residual(λ) < problem.residual(nearest) else nearest
    if found:
        words = (
            "it is the only one." if len(found) == 1 else f"there are {len(found)} that differ, see record."
        )
        reason = _FOUND.format(cones=cones, words=words)
        return finish(problem, found[0], cones, "solved", tolerance, reason=reason, record=found)
    if all(plane is not None for plane in planes):
        proof = {"M": parts.M, "q": parts.q, "z_may_be_positive": np.array(tried), "y": np.array(planes)}
        reason = _NONE.format(cones=cones)
        return finish(problem, nearest, cones, "infeasible", tolerance, reason=reason, certificate=proof)
    return finish(problem, nearest, cones, "unsuitable", tolerance, reason=_DOUBT)


def in_cone(M, q, positive):
    """(z, y): z (m,) if q lies in or near the cone where z may be ``positive``; y (m,) if a plane parts them.

    The plane: y · column ≥ 0 for all columns of the cone, and y · q < 0. Either is None where it isn't so.
    Where rounding leaves y · column at −ε, a combination x ≥ 0 of columns is shut out while ε Σx < −y · q.
    """
    C = np.where(positive, -M, np.eye(len(q)))
    if not len(q):
        return np.zeros(0), None
    try:
        inverse = np.linalg.inv(C)
    except np.linalg.LinAlgError:
        inverse = np.full(C.shape, np.inf)
    if np.isfinite(inverse).all() and np.abs(inverse).max() * np.abs(C).max() < _FLAT:
        sides = inverse @ q
        k = sides.argmin()
        y = inverse[k]
    else:
        try:
            sides, _ = scipy.optimize.nnls(C, q)
        except RuntimeError:  # it found no end
            return None, None
        y = C @ sides - q
        y[np.abs(y) <= _NOISE * (np.abs(C) @ sides + np.abs(q)).max()] = 0
    off, below = np.abs(y) @ np.abs(q) + 1e-300, max(0.0, -(y @ C).min())
    apart = y @ q < -_OFF * off and -(y @ q) > _SURE * below * np.abs(q).max()
    near = (
        sides.min() >= -_NEAR * np.abs(sides).max() and np.abs(C @ sides - q).max() <= _NEAR * np.abs(q).max()
    )
    return np.where(positive, np.maximum(sides, 0), 0) if near else None, y if apart else None
