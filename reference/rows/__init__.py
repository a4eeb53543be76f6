"""Rows of J: for each row of a joint its position φ, its Jacobian J with w = J u, and J̇ u.

A row concerns two bodies, so J is kept as (m, 2, k): for each row k numbers for body i and k for body j,
those of v, then those of ω: k = 6 in space, 3 in the plane. Velocities and forces of bodies are in the world
frame, w and λ along the joint's own axes. φ̇ = J u holds off the constraint too (TURN: as long as the axes
agree), so that Newton's method on φ works with the same J.

    LINEAR    φ = e·Δ,   Δ = p_j − p_i;   w = e·(v_j + ω_j×r_j − v_i − ω_i×(r_i + Δ))
    ANGULAR   φ = a·c;                    w = (c×a)·(ω_j − ω_i)
    DISTANCE  φ = |Δ| − length;           w = n·(v_j + ω_j×r_j − v_i − ω_i×r_i),   n = Δ/|Δ|
    TURN      φ = angle about e3;         w = e3·(ω_j − ω_i)

r_i, r_j: from the centre of mass to the point. LINEAR: e turns with i, hence the arm r_i + Δ, which reaches
j's point.

Slides S5–S7; lectures/03_jacobian.md.
"""

from ..bodies import planar
from ..compiled import lean_apart
from .arrays import Jacobian, Rows, make_jacobian
from .both_ways import add_row, add_rows, dense, row_times
from .frames import fill_frames
from .plane import fill_rows_in_plane
from .space import fill_rows_in_space

__all__ = ["Jacobian", "Rows", "add_row", "add_rows", "dense", "fill_rows", "make_jacobian", "row_times"]


@lean_apart
def fill_rows(rows, state, out):
    """φ, J and J̇ u of all rows, for this state: fills a ``Jacobian`` made for these rows."""
    fill_frames(state, out.frame)
    if planar(state):
        fill_rows_in_plane(rows, state, out)
    else:
        fill_rows_in_space(rows, state, out)
