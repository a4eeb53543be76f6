"""Soft constraints: a spring and damper in place of the rigid row, by the implicit Euler method (S13).

    force  f = −k φ − c w,    taken at the end of the step:  λ = −Δt (k (φ + Δt w) + c w)

is the row  w + γ λ + (β/Δt) φ = 0  with

    γ = 1 / (Δt (c + Δt k))          softness, added to the diagonal of A
    β = Δt k / (c + Δt k)            how much of φ is taken back in a step

for any k and c, however stiff. Frequency and damping ratio say the same without knowing the masses:
k = m ω², c = 2 m ζ ω, with m = 1/A_ii, what the row feels of the bodies' masses. γ → 0 is Baumgarte.

Slides S13; lectures/09_error_correction.md. Source: Catto, Soft constraints (2011); Lacoursière, Ghosts and
Machines (2007), for the implicit spring as a regularised constraint.
"""

import numpy as np


def soft_coefficients(mass, h, frequency, ratio):
    """(γ, β): softness, 1/kg, and the share of φ taken back in a step of h s. mass (m,): the rows' effective
    masses, kg (kg m²); frequency, Hz, above 0; ratio: of damping, at least 0.
    """
    ω = 2 * np.pi * frequency
    k, c = mass * ω**2, 2 * mass * ratio * ω
    return 1 / (h * (c + h * k)), h * k / (c + h * k)


def soft_velocity(error, h, share):
    """The w + γ λ (m,) that is asked for: −(β/Δt) φ. error (m,): φ, or min(gap, 0); share: β."""
    return -share / h * error
