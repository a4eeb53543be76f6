"""What all solvers for λ share: room for numbers, and A = J M⁻¹ Jᵀ put together from rows that meet.

Two rows meet where they share a body that moves; all other entries of A are 0. Who meets whom is found once
for a scene.

Slide S8; lectures/04_embedding.md.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import lean

SINGULAR = 1e-14  # a pivot, over what was there before the elimination, that is rounding


class Factor(NamedTuple):
    """A solver's own room; each solver says what it keeps where."""

    meeting: (
        np.ndarray
    )  # (s, 5) int: rows p ≥ q, which of its bodies p and q share (0: i, 1: j), place in values
    pattern: np.ndarray  # (·, ·) int
    links: np.ndarray  # (·, ·) int
    values: np.ndarray  # (·,)


def make_factor(meeting=(), pattern=(), links=(), values=0):
    """Room for these tables of whole numbers and so many values."""
    tables = (np.array(table, dtype=int) for table in (meeting, pattern, links))
    tables = (
        np.ascontiguousarray(t if t.ndim == 2 else t.reshape(len(t), -1 if t.size else 1)) for t in tables
    )
    return Factor(*tables, np.zeros(values))


def meeting_rows(rows, place):
    """The table ``meeting`` of a Factor; place(p, q): where the entry of A belongs."""
    on_body = {}
    for k, bodies in enumerate(rows.bodies.tolist()):
        for side, i in enumerate(bodies):
            if i >= 0:
                on_body.setdefault(i, []).append((k, side))
    return [
        (p, q, side_p, side_q, place(p, q))
        for ends in on_body.values()
        for p, side_p in ends
        for q, side_q in ends
        if p >= q
    ]


@lean
def assemble(meeting, J, B, values):
    """The entries of A = B Jᵀ on and below its diagonal, added up in ``values``.

    The sums are written out: a loop over so few numbers costs several times their arithmetic.
    """
    values[:] = 0
    planar = J.shape[2] == 3
    for s in range(len(meeting)):
        p, q, i, j = meeting[s, 0], meeting[s, 1], meeting[s, 2], meeting[s, 3]
        total = B[p, i, 0] * J[q, j, 0] + B[p, i, 1] * J[q, j, 1] + B[p, i, 2] * J[q, j, 2]
        if not planar:
            total += B[p, i, 3] * J[q, j, 3] + B[p, i, 4] * J[q, j, 4] + B[p, i, 5] * J[q, j, 5]
        values[meeting[s, 4]] += total
