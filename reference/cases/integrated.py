"""Answers that no formula gives: an ordinary differential equation in minimal coordinates, by DOP853.

Order 8, tolerance 1e-13, no joint to drift from, no constraint force: what can go wrong in the reference's
own way of doing it is absent.

Slides S3, S9; lectures/04_embedding.md. Source: Hairer, Nørsett & Wanner, Solving Ordinary Differential
Equations I (1993), section II.5.
"""

import numpy as np
from scipy.integrate import solve_ivp

TOLERANCE = 1e-13


class Integrated:
    """y(t) of ẏ = rate(y) from y(0) = ``start``: called with times (T,), it gives (T, size).

    It is computed when it is first asked for, and kept; a later time than before lets it go on.
    """

    def __init__(self, rate, start, tolerance=TOLERANCE):
        self.rate, self.tolerance = rate, tolerance
        self.times, self.states = [0.0], [np.array(start, dtype=float)]
        self.pieces = []  # one for each stretch computed so far, valid between its times

    def __call__(self, time):
        time = np.asarray(time, dtype=float)
        if time.max() > self.times[-1]:
            self._go_on(float(time.max()))
        which = np.clip(np.searchsorted(self.times, time) - 1, 0, max(0, len(self.pieces) - 1))
        result = np.empty((*time.shape, len(self.states[0])))
        for k in np.unique(which):
            here = which == k
            result[here] = self.pieces[k](time[here]).T if self.pieces else self.states[0]
        return result

    def _go_on(self, end):
        done = solve_ivp(
            lambda _, y: self.rate(y),
            (self.times[-1], end),
            self.states[-1],
            method="DOP853",
            rtol=self.tolerance,
            atol=self.tolerance,
            dense_output=True,
        )
        if not done.success:
            raise ArithmeticError(f"the exact motion can't be computed up to t = {end:g} s: {done.message}")
        self.times.append(end)
        self.states.append(done.y[:, -1])
        self.pieces.append(done.sol)
