"""Accelerated projected gradients on friction cones, and De Saxcé's change of variable for Coulomb's law.

With the convex law (CCP) the contact problem asks for the smallest ½ λᵀAλ + bᵀλ over the product of all
cones, and ``apgd`` serves with the projection on the cones in place of the clip. Coulomb's law (NCP) is no
minimum of anything. But it is the convex law for w + shift, with a shift of μ‖w_t‖ added to each w_n (De
Saxcé & Feng). So hold the shift, solve the convex problem a good part of the way, renew the shift from the
w_t found, and go on: a fixed point in the shift alone.

Slides S10, S14; lectures/08_newton_lcp.md. Source: Mazhar, Heyn, Negrut & Tasora, ACM TOG 34 (2015) 32, for
APGD on cones; De Saxcé & Feng, Math. Comput. Modelling 28 (1998) 225; Acary, Cadoux, Lemaréchal & Malick,
ZAMM 91 (2011) 155, for the fixed point.
"""

import numpy as np

from ..compiled import compiled
from .apgd import accelerate, weights
from .iteration import iterate
from .merit import ConeTerms, cone_gap, cone_merit, larger, project_on_cone
from .symmetry import why_no_cone

_WELL = 0.2  # how far to solve the convex problem before the shift is renewed


@compiled
def project_all(terms, λ):
    """Each block of λ (n,) brought to the nearest point of its cone, in place."""
    for k in range(len(terms.mu)):
        i = k * terms.size
        n, t1, t2 = project_on_cone(terms.mu[k], λ[i], λ[i + 1], λ[i + 2] if terms.size == 3 else 0.0)
        λ[i], λ[i + 1] = n, t1
        if terms.size == 3:
            λ[i + 2] = t2


@compiled
def renew_shift(terms, λ, w, shift):
    """Coulomb's law: where the convex problem with this shift is solved well enough, the shift ← μ‖w_t‖.

    Returns whether it was. Well enough: to a fifth of how far λ is from Coulomb's law.
    """
    if not terms.coulomb:
        return False
    convex, rest, off = ConeTerms(terms.b, terms.d, terms.mu, terms.size, False), 0.0, 0.0
    for k in range(len(terms.mu)):
        i = k * terms.size
        w_2 = w[i + 2] if terms.size == 3 else 0.0
        for r in cone_gap(convex, λ, k, w[i] + shift[i], w[i + 1], w_2):
            rest = larger(rest, abs(r))
        for r in cone_gap(terms, λ, k, w[i], w[i + 1], w_2):
            off = larger(off, abs(r))
    if rest > _WELL * off:
        return False
    for k in range(len(terms.mu)):
        i = k * terms.size
        shift[i] = terms.mu[k] * np.hypot(w[i + 1], w[i + 2] if terms.size == 3 else 0.0)
    return True


def cone_apgd(problem, start=None, tolerance=1e-10, max_iterations=1000):
    """Solve a ConeProblem by accelerated projected gradients: A dense, sparse or factored.

    start (n,): λ to begin with, projected on the cones first; None: 0. law "ccp": the convex problem;
    "ncp": with De Saxcé's fixed point around it. Needs a symmetric A, positive on the diagonal;
    semidefinite will do (redundant contacts). One iteration is a product A λ, sometimes more. Returns a
    ``Solution``. Raises ValueError or TypeError for bad arguments.
    """
    functions = project_all, cone_merit, renew_shift
    return iterate(
        accelerate, problem, start, tolerance, max_iterations,
        options=(weights,), functions=functions, why_not=why_no_cone,
    )  # fmt: skip
