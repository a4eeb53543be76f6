"""Solvers for λ of the joints, A λ = right with A = J M⁻¹ Jᵀ: each fit for its kind of scene.

``prepare(rows, system)`` finds once what depends on who is joined to whom, and makes room. ``factorise`` then
works on one state, and ``substitute`` solves for as many right-hand sides as there are.

Slides S8, S9; lectures/04_embedding.md.
"""

from collections.abc import Callable
from dataclasses import dataclass

from ..compiled import lean_apart
from . import cholesky, minimum_norm, sparse, tree
from .factor import Factor

CHOLESKY, SPARSE, TREE, MINIMUM_NORM = range(4)


@dataclass(frozen=True)
class Multipliers:
    """A solver: its number for ``factorise`` and ``substitute``, how it prepares, which scenes it is for."""

    number: int
    prepare: Callable
    fits: str


MULTIPLIERS = {
    "cholesky": Multipliers(CHOLESKY, cholesky.prepare, "few joints"),
    "sparse": Multipliers(SPARSE, sparse.prepare, "many joints, each body with few of them; loops allowed"),
    "tree": Multipliers(TREE, tree.prepare, "joints without loops, a body with many of them too"),
    "minimum_norm": Multipliers(MINIMUM_NORM, minimum_norm.prepare, "redundant joints, singular positions"),
}


@lean_apart
def factorise(solver, m, factor, J, B, mass, inertia, frame):
    """Make ready to solve for m rows J (m, 2, k), B = J M⁻¹; frame: see ``rows``; solver: a number.

    Returns the smallest pivot of the elimination relative to what was there before it: near 0 where the rows
    are nearly dependent. Where they are, λ will be nan, unless the solver is made for it.
    """
    if solver == TREE:
        return tree.factorise(factor, J, mass, inertia, frame)
    if solver == SPARSE:
        return sparse.factorise(m, factor, J, B)
    if solver == CHOLESKY:
        return cholesky.factorise(m, factor, J, B)
    return minimum_norm.factorise(m, factor, J, B)


@lean_apart
def substitute(solver, m, factor, J, mass, right, λ):
    """λ (m,) of A λ = right (m,), after ``factorise``."""
    if solver == TREE:
        tree.substitute(len(mass), factor, J, right, λ)
    elif solver == SPARSE:
        sparse.substitute(m, factor, right, λ)
    elif solver == CHOLESKY:
        cholesky.substitute(m, factor, right, λ)
    else:
        minimum_norm.substitute(m, factor, right, λ)


__all__ = ["MULTIPLIERS", "Factor", "Multipliers", "factorise", "substitute"]
