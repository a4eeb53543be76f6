"""Baumgarte's stabilisation: the velocities are asked to take back a share of the error in each step (S13).

    w = −(fraction/Δt) φ        so that φ ← φ + Δt w = (1 − fraction) φ

The drift decays by 1 − fraction a step. But w is a real velocity: it stays in the bodies, and a deep overlap
is thrown apart with fraction · depth/Δt.

Slides S13; lectures/09_error_correction.md. Source: Baumgarte, CMAME 1 (1972) 1; for a step of velocities:
Catto, Iterative dynamics with temporal coherence (2005).
"""

import numpy as np


def baumgarte_velocity(error, h, fraction, slop=0.0):
    """The w (m,), m/s (rad/s), that takes back a fraction of the error (m,), m (rad), in a step of h s.

    error: φ of a joint; min(gap, 0) of a contact. slop: how much of it is left alone.
    """
    return -fraction / h * np.sign(error) * np.maximum(np.abs(error) - slop, 0.0)
