"""Nonlinear Gauss–Seidel: after the step, positions are corrected row by row, as if by impulses (S13).

Each row moves its two bodies by δ = M⁻¹ Jᵀ p with p = −(share of φ)/A_ii, of the error φ that is there *now*,
after the rows before it: a projection (``projection``) in which A is never solved, only swept over. A contact
only pushes. Between sweeps the rows are made anew at the new positions, which makes it nonlinear; Box2D
renews the geometry of each contact before it is its turn.

Velocities are not touched. The error left after a few sweeps is the next step's.

Slides S13; lectures/09_error_correction.md. Source: Box2D 2.4, ``b2ContactSolver::SolvePositionConstraints``;
Müller et al., J. Vis. Commun. Image Represent. 18 (2007) 109, for the same in position-based dynamics.
"""

from ..compiled import compiled
from ..factored import add_row, row_times


@compiled
def position_error(φ, pushes, fraction, slop, most):
    """What a row takes back of an error φ, m: a fraction of it, and at most ``most``. A row that may only
    push takes what is deeper than slop.
    """
    if pushes:
        return max(min(fraction * (φ + slop), 0.0), -most)
    return max(min(fraction * φ, most), -most)


@compiled
def position_sweep(bodies, J, B, diagonal, φ, pushes, fraction, slop, most, δ):
    """One sweep: into δ (n, k), which begins at 0, how the bodies move, m and rad.

    bodies (m, 2), J and B = J M⁻¹ (m, 2, k), diagonal (m,): A_ii. φ (m,): gaps and joints' errors where
    δ = 0; pushes (m,): whether the row may only push (a contact, a limit). The rest as for
    ``position_error``.
    """
    for r in range(len(φ)):
        now = φ[r] + row_times(bodies, J, r, δ)
        p = -position_error(now, pushes[r], fraction, slop, most) / diagonal[r]
        add_row(bodies, B, r, p, δ)
