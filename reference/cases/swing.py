"""The pendulum equation θ̈ = −ω₀² sin θ, solved for swinging and for going round, by elliptic functions.

With k² = sin²(θ₀/2) + (θ̇₀/2ω₀)², and am the amplitude, so that sn = sin am:

    k < 1, swinging:      sin(θ/2) = k sn(ω₀ t + u₀, k),    θ̇ = 2 ω₀ k cn(ω₀ t + u₀, k)
    k > 1, going round:   θ/2 = ± am(k ω₀ t + u₀, 1/k),     θ̇ = ± 2 ω₀ k dn(k ω₀ t + u₀, 1/k)

Slides S5, S9; lectures/04_embedding.md. Source: Whittaker, Analytical Dynamics (1937), chapter
IV; Digital Library of Mathematical Functions, 22.19.
"""

import numpy as np
from scipy.special import ellipj, ellipk, ellipkinc


class Swing:
    """θ(t) of a pendulum with ω₀ = ``rate``, rad/s, from the angle and speed at t = 0; θ = 0 hangs at rest.

    ``period``, s: of a whole swing, or of a turn.
    """

    def __init__(self, rate, angle, speed=0.0):
        self.rate, self.turns = rate, round(angle / (2 * np.pi))
        half, s = (angle - 2 * np.pi * self.turns) / 2, speed / (2 * rate)
        self.k = np.hypot(np.sin(half), s)
        if self.k == 1:
            raise ValueError(
                f"angle and speed must not lead exactly to the top, which takes for ever, but are {angle!r} "
                f"and {speed!r}"
            )
        self.sense = 1.0 if speed >= 0 else -1.0
        if self.k < 1:
            phase = np.arctan2(np.sin(half) / self.k, s / self.k)
            self.start, self.m = float(ellipkinc(phase, self.k**2)), self.k**2
            self.period = 4 * float(ellipk(self.m)) / rate
        else:
            self.m = 1 / self.k**2
            self.start = float(ellipkinc(self.sense * half, self.m))
            self.period = 2 * float(ellipk(self.m)) / (self.k * rate)

    def __call__(self, time):
        """θ and θ̇ at the times (…,)."""
        time = np.asarray(time, dtype=float)
        if self.k < 1:
            sn, cn, _, _ = ellipj(self.rate * time + self.start, self.m)
            θ, speed = 2 * np.arcsin(self.k * sn), 2 * self.rate * self.k * cn
        else:
            _, _, dn, am = ellipj(self.k * self.rate * time + self.start, self.m)
            θ, speed = 2 * self.sense * am, 2 * self.sense * self.rate * self.k * dn
        return θ + 2 * np.pi * self.turns, speed

    def acceleration(self, time):
        """θ̈ at the times (…,)."""
        return -(self.rate**2) * np.sin(self(time)[0])
