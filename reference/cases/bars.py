"""A mechanism of bars in a plane with one degree of freedom: its motion from the angles alone.

The user says how the angles φ of the bars follow from one coordinate q, with first and second derivatives:
the loop equation solved. The centres are x₀ + C e^{iφ}, complex numbers for points of the plane. Then
d'Alembert's principle along the only possible motion, x' = dx/dq, is one equation for q̈,

    (Σ m |x'|² + I φ'²) q̈ = Σ m Re(x̄' (−i g − x'' q̇²)) − I φ' φ'' q̇².

No constraint force, no Jacobian of joints.

Slides S3, S9; lectures/04_embedding.md. Source: Lanczos, The Variational Principles of Mechanics (1970),
chapter IV.
"""

from typing import NamedTuple

import numpy as np

from .case import GRAVITY
from .integrated import Integrated


class Bars(NamedTuple):
    """n bars: masses (n,) kg; moments (n,) kg m² about their centres; x₀ (n,) complex, m; C (n, n) m."""

    masses: np.ndarray
    moments: np.ndarray
    origin: np.ndarray
    C: np.ndarray


class BarMotion:
    """The Motion of Bars from q and q̇ at t = 0. angles(q): φ, φ', φ'', each (…, n), for q (…,)."""

    def __init__(self, plane, bars, angles, q, speed):
        self.plane, self.bars, self.angles = plane, bars, angles
        self.solution = Integrated(self.rate, (q, speed))

    def rate(self, y):
        """Of y = (q, q̇)."""
        q, speed = y
        bars = self.bars
        φ, dφ, ddφ = self.angles(q)
        direction = np.exp(1j * φ)
        dx = bars.C @ (1j * dφ * direction)
        ddx = bars.C @ ((1j * ddφ - dφ**2) * direction)
        inertia = bars.masses @ np.abs(dx) ** 2 + bars.moments @ dφ**2
        gained = np.real(np.conj(dx) * (-1j * GRAVITY - ddx * speed**2))
        return speed, (bars.masses @ gained - bars.moments @ (dφ * ddφ) * speed**2) / inertia

    def state(self, q, speed):
        """Centres (…, n, 2), angles (…, n), and their rates, for q and q̇ (…,)."""
        φ, dφ, _ = self.angles(q)
        direction, rate = np.exp(1j * φ), np.asarray(speed)[..., None]
        x = self.bars.origin + direction @ self.bars.C.T
        v = rate * ((1j * dφ * direction) @ self.bars.C.T)
        return _pair(x), φ, _pair(v), rate * dφ

    def __call__(self, time):
        q, speed = np.moveaxis(self.solution(time), -1, 0)
        return self.plane.motion(*self.state(q, speed))


def _pair(z):
    return np.stack([z.real, z.imag], axis=-1)
