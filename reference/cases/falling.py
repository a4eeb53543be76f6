"""The exact motion of a planar chain: its angles integrated, its accelerations by the pulls in its joints.

Angles have no joint to drift from. Their accelerations could come from Lagrange's mass matrix of the angles;
with a heavy end that is so badly conditioned that rounding spoils the answer. The pulls at the joints make a
banded system instead, well conditioned whatever the masses, and linear in the number of links.

Rods: link k has the force F_k at its upper end, −F_{k+1} at its lower; r leads from its centre to the lower
end, t = r turned by a right angle. With W = 1/m and S = t tᵀ/I the ends accelerate by

    upper:    (W + S) F_k − (W − S) F_{k+1} + ω² r + g,
    lower:    (W − S) F_k − (W + S) F_{k+1} − ω² r + g,

and each upper end goes with the lower end before it. Points on massless rods: only the pull along each rod.

Slides S5, S9, S15; lectures/04_embedding.md.
"""

import numpy as np
from scipy.linalg import solveh_banded

from .case import GRAVITY
from .integrated import Integrated

TOLERANCE = 1e-12  # of DOP853: below, light links that whip under a heavy load only gather rounding


def rod_accelerations(θ, ω, masses, moments, link):
    """θ̈ (n,) of n rods of length ``link``, hung from a fixed point; angles θ from the horizontal."""
    n, r = len(θ), link / 2 * np.stack([np.cos(θ), np.sin(θ)], axis=1)
    t = np.stack([-r[:, 1], r[:, 0]], axis=1)
    W, S = np.eye(2) / masses[:, None, None], t[:, :, None] * t[:, None, :] / moments[:, None, None]
    near, off = W + S, S - W
    near[1:] += (W + S)[:-1]  # joint k lies between links k − 1 and k
    right = -(ω**2)[:, None] * r
    right[1:] += right[:-1].copy()
    right[0, 1] += GRAVITY
    band = np.zeros((4, n, 2))  # the lower triangle: band[p, k, c] is p below the diagonal's entry (k, c)
    band[0, :, 0], band[0, :, 1], band[1, :, 0] = near[:, 0, 0], near[:, 1, 1], near[:, 1, 0]
    band[1, :-1, 1], band[3, :-1, 0] = off[:-1, 0, 1], off[:-1, 1, 0]
    band[2, :-1, 0], band[2, :-1, 1] = off[:-1, 0, 0], off[:-1, 1, 1]
    F = solveh_banded(band.reshape(4, 2 * n), right.ravel(), lower=True, check_finite=False).reshape(n, 2)
    both = F.copy()
    both[:-1] += F[1:]
    return -np.sum(t * both, axis=1) / moments


def point_accelerations(θ, ω, masses, link):
    """θ̈ (n,) of massless rods with a point mass at the end of each, hung from a fixed point."""
    e = np.stack([np.cos(θ), np.sin(θ)], axis=1)
    across = np.stack([-e[:, 1], e[:, 0]], axis=1)
    band = np.zeros((3, len(θ)))  # the last row stays 0: SciPy's routine for two refuses a single equation
    band[0] = 1 / masses
    band[0, 1:] += 1 / masses[:-1]
    band[1, :-1] = -np.sum(e[1:] * e[:-1], axis=1) / masses[:-1]
    right = link * ω**2
    right[0] -= GRAVITY * e[0, 1]
    pull = solveh_banded(band, right, lower=True, check_finite=False)[:, None] * e
    a = -pull / masses[:, None]
    a[:-1] += pull[1:] / masses[:-1, None]
    relative = np.diff(
        a, axis=0, prepend=np.array([[0.0, GRAVITY]])
    )  # gravity is the same for all but the wall
    return np.sum(relative * across, axis=1) / link


class Falling:
    """The Motion of a chain let go level from the origin. moments: (n,) kg m², or None for points on rods."""

    def __init__(self, plane, masses, moments, link):
        self.plane, self.masses, self.moments, self.link = plane, masses, moments, link
        self.beyond = 0.0 if moments is None else link / 2  # of each link, past its centre
        self.solution = Integrated(self.rate, np.zeros(2 * len(masses)), TOLERANCE)

    def rate(self, y):
        """Of y = (θ, θ̇)."""
        θ, ω = np.split(y, 2)
        if self.moments is None:
            return np.concatenate([ω, point_accelerations(θ, ω, self.masses, self.link)])
        return np.concatenate([ω, rod_accelerations(θ, ω, self.masses, self.moments, self.link)])

    def __call__(self, time):
        θ, ω = np.split(self.solution(time), 2, axis=-1)
        along = np.stack([np.cos(θ), np.sin(θ)], axis=-1)
        across = ω[..., None] * np.stack([-np.sin(θ), np.cos(θ)], axis=-1)
        turning = self.moments is not None
        return self.plane.motion(self._centres(along), turning * θ, self._centres(across), turning * ω)

    def _centres(self, steps):
        """Sums of what each link adds: of its direction for places, of that one's rate for velocities."""
        return self.link * np.cumsum(steps, axis=-2) - self.beyond * steps
