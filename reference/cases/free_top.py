"""The exact motion of a body that no torque acts on, by Jacobi's elliptic functions and Carlson's integrals.

**Rates.** In the body's principal frame I ω̇ = I ω × ω keeps the energy E and the momentum L. One axis d is
never left by the spin: the axis of largest moment if L² > 2 E I_mid, of smallest if L² < 2 E I_mid. With c
the other outer axis and s the middle one: ω_c = C cn u, ω_s = S sn u, ω_d = D dn u, with u = p t + u₀.

**Attitude.** Angular momentum is fixed in the world. Seen from it, the axis d has the Euler angles (z, x, z)
φ, θ, ψ: the last two follow from ℓ = Iω/L, which the body sees turn: ℓ = (sin θ sin ψ, sin θ cos ψ, cos θ).
The first obeys

    φ̇ = L (I_c ω_c² + I_s ω_s²) / (I_c² ω_c² + I_s² ω_s²) = L (α + β / (1 − n sn² u)),

the derivative of an elliptic integral of the third kind, Π(n; am u | m).

Slides S4, S9; lectures/02_equation_of_motion.md. Source: Landau & Lifshitz, Mechanics (1976), section 37; van
Zon & Schofield, J. Comput. Phys. 225 (2007) 145; DLMF 19.25 for Π by Carlson's forms.
"""

import numpy as np
from scipy.special import ellipj, ellipkinc, ellipkm1, elliprf, elliprj

from .. import inputs
from ..rotation import conjugate, multiply, over_arrays, rotate


def elliptic_pi(n, φ, m):
    """Legendre's integral of the third kind Π(n; φ | m) = ∫ dθ / ((1 − n sin²θ) √(1 − m sin²θ)), n < 1."""
    turns = np.round(φ / np.pi)  # whole half turns are complete integrals; the rest lies within ±π/2
    rest = φ - np.pi * turns
    return turns * 2 * _carlson(n, np.pi / 2, m) + _carlson(n, rest, m)


def _carlson(n, φ, m):
    s, c2 = np.sin(φ), np.cos(φ) ** 2
    k = 1 - m * s**2
    return s * elliprf(c2, k, 1) + n / 3 * s**3 * elliprj(c2, k, 1, 1 - n * s**2)


class FreeTop:
    """A torque-free top: ``inertia`` (3,) kg m², three different principal moments; ``rates`` (3,) rad/s, the
    angular velocity at t = 0 in the body's frame; ``attitude`` (4,) the quaternion body → world at t = 0.

    ``period``, s: after it the rates return (the attitude does not).
    """

    def __init__(self, inertia, rates, attitude=(1.0, 0.0, 0.0, 0.0)):
        I, ω = inputs.array("inertia", inertia, (3,)), inputs.array("rates", rates, (3,))
        self.start = inputs.unit_quaternion("attitude", attitude)
        low, mid, high = np.argsort(I)
        L2, E2 = np.sum((I * ω) ** 2), np.sum(I * ω**2)
        self.d, c = (high, low) if L2 > E2 * I[mid] else (low, high)
        s, d = mid, self.d
        across, along = E2 * I[d] - L2, L2 - E2 * I[c]  # both have the sign of I_d − I_c
        if min(I) <= 0 or len(set(I)) < 3 or across * along <= 0 or L2 == E2 * I[mid]:
            raise ValueError(
                "inertia and rates must be of a top that tumbles, with three different positive moments and "
                "a spin neither about a principal axis nor on the separatrix, but they are "
                f"{I.tolist()} and {ω.tolist()}"
            )
        C, S = np.sqrt(across / (I[c] * (I[d] - I[c]))), np.sqrt(across / (I[s] * (I[d] - I[s])))
        D = np.copysign(np.sqrt(along / (I[d] * (I[d] - I[c]))), ω[d])
        self.m1 = (I[d] - I[c]) * (L2 - E2 * I[s]) / ((I[d] - I[s]) * along)  # 1 − m, without cancellation
        self.m = 1 - self.m1
        self.p = np.sqrt((I[d] - I[s]) * along / I.prod())
        # Euler's equation of axis c settles the sense in which the spin goes round: ω̇_c = −C p sn u dn u.
        sense = 1.0 if (s - c) % 3 == 1 else -1.0  # whether c, s, d are right-handed
        S *= np.sign(-C * self.p * I[c] / (sense * (I[s] - I[d]) * D))
        self.amplitude, self.order = np.array([C, S, D]), np.array([c, s, d])
        self.u0 = float(ellipkinc(np.arctan2(ω[s] / S, ω[c] / C), self.m))
        self.I, self.L = I, np.sqrt(L2)
        self.period = 4 * float(ellipkm1(self.m1)) / self.p
        self.n = 1 - (I[s] * S / (I[c] * C)) ** 2
        self.α, self.β = 1 / I[d], 1 / I[c] - 1 / I[d]
        self._back = over_arrays(conjugate)(self._euler(0.0))

    def rates(self, time):
        """Angular velocity (…, 3) in the body's frame, rad/s, at the times (…,)."""
        sn, cn, dn, _ = ellipj(self.p * np.asarray(time, dtype=float) + self.u0, self.m)
        ω = np.empty((*np.shape(sn), 3))
        ω[..., self.order] = self.amplitude * np.stack([cn, sn, dn], axis=-1)
        return ω

    def attitude(self, time):
        """Quaternions (…, 4), body → world, at the times (…,)."""
        product = over_arrays(multiply)
        turned = product(self._back, self._euler(time))
        turn = np.empty_like(turned)  # from the frame whose third axis is d back to the body's own
        turn[..., 0] = turned[..., 0]
        turn[..., [1 + (self.d + k) % 3 for k in (1, 2, 3)]] = turned[..., 1:]
        return product(self.start, turn)

    def angular_velocity(self, time):
        """Angular velocity (…, 3) in the world's frame, rad/s."""
        return over_arrays(rotate)(self.attitude(time), self.rates(time))

    def _euler(self, time):
        """The attitude (…, 4) in a frame whose third axis is the angular momentum; third body axis d."""
        time = np.asarray(time, dtype=float)
        ℓ = self.I * self.rates(time) / self.L
        x, y, z = (ℓ[..., (self.d + k) % 3] for k in (1, 2, 3))
        θ, ψ = np.arctan2(np.hypot(x, y), z), np.arctan2(x, y)
        am = ellipj(self.p * time + self.u0, self.m)[3]
        third = elliptic_pi(self.n, am, self.m)
        φ = self.L * (self.α * time + self.β * third / self.p)
        return _product(_about(2, φ), _about(0, θ), _about(2, ψ))


def _about(axis, angle):
    """The quaternion (…, 4) of a turn about a coordinate axis."""
    q = np.zeros((*np.shape(angle), 4))
    q[..., 0], q[..., 1 + axis] = np.cos(angle / 2), np.sin(angle / 2)
    return q


def _product(*quaternions):
    """The product of quaternions (…, 4), from the left."""
    result, multiplied = quaternions[0], over_arrays(multiply)
    for q in quaternions[1:]:
        result = multiplied(result, q)
    return result
