"""Solvers for λ of the joints, A λ = right with A = J M⁻¹ Jᵀ: each fit for its kind of scene.

``prepare(rows, system)`` finds once what depends on who is joined to whom; ``factorise(system, mechanism)``
works on one state; ``substitute(mechanism, right, λ)`` solves.

Slides S8, S9; lectures/04_embedding.md.
"""

from collections.abc import Callable
from dataclasses import dataclass

from . import cholesky, minimum_norm, sparse, tree


@dataclass(frozen=True)
class Multipliers:
    """A solver's three functions, and for which scenes it is."""

    prepare: Callable
    factorise: Callable
    substitute: Callable
    fits: str


MULTIPLIERS = {
    name: Multipliers(module.prepare, module.factorise, module.substitute, fits)
    for name, module, fits in (
        ("cholesky", cholesky, "few joints"),
        ("sparse", sparse, "many joints, each body with few of them; loops allowed"),
        ("tree", tree, "many joints without loops, a body with many of them too"),
        ("minimum_norm", minimum_norm, "redundant joints"),
    )
}

__all__ = ["MULTIPLIERS", "Multipliers"]
