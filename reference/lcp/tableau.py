"""The tableau: n unknowns written in terms of n others, and the pivot, which lets two change places.

    y = T x + q        y: the basic unknowns, one a row;  x: the nonbasic ones, one a column

w = A λ + b is such a tableau: w is basic, λ nonbasic. A pivot on T_rs solves row r for x_s and puts that into
all others, so y_r and x_s change places. Each pivoting method is this, and a rule by which to choose r and s.
A tableau is kept dense, n columns and what stands beside them (n numbers a row and pivot: n² in all).

Slides S13, S14; lectures/06_pivoting_lcp.md. Source: Cottle, Pang & Stone, The Linear Complementarity Problem
(2009), section 2.3 (principal pivots).
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled_apart


@compiled_apart
def exchange(T, r, s):
    """Let the basic unknown of row r and the nonbasic one of column s change places, in place.

    T (m, k): the last columns may hold constants. T[r, s] must not be 0.
    """
    row, inverse = np.empty(T.shape[1]), 1.0 / T[r, s]  # a copy of the row: read from T, the loop over j
    for j in range(T.shape[1]):  # below could not be vectorised
        row[j] = T[r, j] * -inverse
    row[s] = inverse
    for i in range(T.shape[0]):
        factor = T[i, s]
        if i != r and factor != 0:
            T[i, s] = 0.0
            for j in range(T.shape[1]):
                T[i, j] += factor * row[j]
    T[r] = row


@compiled_apart
def exchange_pair(T, i, j):
    """Let rows i and j change places with columns i and j, where T_ii is 0: two rows pivoted at once."""
    exchange(T, i, j)
    exchange(T, j, i)
    for k in range(T.shape[1]):
        T[i, k], T[j, k] = T[j, k], T[i, k]
    for k in range(T.shape[0]):
        T[k, i], T[k, j] = T[k, j], T[k, i]


class Tableau(NamedTuple):
    """A tableau written down: ``rows`` names the basic unknowns, ``columns`` the nonbasic ones.

    values (m, k): T; constants (m,): q, the basic unknowns' values where the nonbasic are as they are.
    note: what has just been done.
    """

    rows: list
    columns: list
    values: np.ndarray
    constants: np.ndarray
    note: str

    def __str__(self):
        return as_text(self)


def as_text(tableau, digits=4):
    """The tableau as a table of text, one line a row: the basic unknown, its value, and its coefficients."""
    head = ["", "value", *tableau.columns]
    lines = [
        [name, *(f"{number:.{digits}g}" for number in (constant, *row))]
        for name, constant, row in zip(tableau.rows, tableau.constants, tableau.values, strict=True)
    ]
    widths = [max(len(line[k]) for line in [head, *lines]) for k in range(len(head))]
    table = ["  ".join(cell.rjust(width) for cell, width in zip(line, widths, strict=True))
             for line in [head, *lines]]  # fmt: skip
    return "\n".join([tableau.note, *table])
