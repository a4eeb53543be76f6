"""Which rows of A = J M⁻¹ Jᵀ meet: those that share a body that moves. Found once for a scene.

Slide S8; lectures/04_embedding.md.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled


class Pairs(NamedTuple):
    """Each pair of rows p ≥ q that share a body, at each of their sides where they do; s of them."""

    rows: np.ndarray  # (s, 2) int: p, q
    sides: np.ndarray  # (s, 2) int: which of the two bodies of p, of q
    entry: np.ndarray  # (s,) int: where in the solver's own array the product belongs


def meeting_rows(rows):
    """(p, q, side of p, side of q) of all pairs p ≥ q that share a moving body."""
    on_body = {}
    for k, bodies in enumerate(rows.bodies.tolist()):
        for side, i in enumerate(bodies):
            if i >= 0:
                on_body.setdefault(i, []).append((k, side))
    return sorted(
        (p, q, side_p, side_q)
        for ends in on_body.values()
        for p, side_p in ends
        for q, side_q in ends
        if p >= q
    )


def make_pairs(meeting, entry_of):
    """The ``Pairs`` of ``meeting_rows``; entry_of(p, q): where the product belongs."""
    table = np.array(meeting, dtype=int).reshape(-1, 4)
    entries = np.array([entry_of(p, q) for p, q, _, _ in meeting], dtype=int)
    return Pairs(np.ascontiguousarray(table[:, :2]), np.ascontiguousarray(table[:, 2:]), entries)


@compiled
def assemble(pairs, J, B, values):
    """The entries of A = B Jᵀ on and below its diagonal, added up in ``values``, a flat array."""
    values[:] = 0
    for s in range(len(pairs.entry)):
        p, q = pairs.rows[s, 0], pairs.rows[s, 1]
        side_p, side_q = pairs.sides[s, 0], pairs.sides[s, 1]
        total = 0.0
        for c in range(J.shape[2]):
            total += B[p, side_p, c] * J[q, side_q, c]
        values[pairs.entry[s]] += total
