"""Split impulse: the error is taken back by velocities of its own, which are forgotten after the step (S13).

    u⁺    solves the contacts with w ≥ 0, as if there were no error
    ũ     begins at 0 and solves the same rows, without friction, with w̃ ≥ (fraction/Δt) depth
    x ← x + Δt (u⁺ + ũ)

The error decays as Baumgarte's does, but u⁺ knows nothing of it: no kinetic energy comes in. What is lifted
still gains height. The price is a second solve.

Slides S13; lectures/09_error_correction.md. Source: Guendelman, Bridson & Fedkiw, ACM TOG 22 (2003) 871
(positions apart from velocities); Bullet's ``m_splitImpulse``.
"""

import numpy as np


def pseudo_velocities(solve, rows, n):
    """ũ (n, k) that makes the rows right from rest; solve(rows, free, λ) → u, as a step's solver."""
    return solve(rows, np.zeros((n, rows.J.shape[2])), np.zeros(len(rows.c)))
