"""The classical Runge–Kutta method: four forces a step, order 4.

Slides S4, S9; lectures/02_equation_of_motion.md. Source: Kutta, Z. Math. Phys. 46 (1901) 435; Hairer, Nørsett
& Wanner, Solving Ordinary Differential Equations I (1993), section II.1.
"""

import numpy as np

from ..bodies import add_gyroscopic_torque, normalise_all, solve_mass, velocity_to_rate
from ..compiled import merged
from .parts import add_scaled, copy

RK4_WHEN = np.array([0, 1 / 2, 1 / 2, 1])  # in steps
RK4_WEIGHT = np.array([1 / 6, 1 / 3, 1 / 3, 1 / 6])


@merged
def rk4(force, system, t, h, state, work):
    """The classical Runge–Kutta method of order 4: a weighted mean of four rates. Source: Kutta (1901)."""
    rate, start, total = work.rate, work.start, work.total
    copy(state.y, start.y)
    copy(state.y, total.y)
    for stage in range(4):
        if stage > 0:
            copy(start.y, state.y)
            add_scaled(state.y, RK4_WHEN[stage] * h, rate.y)
        force(system, t + RK4_WHEN[stage] * h, state, rate.v, rate.ω)
        add_gyroscopic_torque(system, state, rate.ω)
        solve_mass(system, state.q, rate.v, rate.ω)
        velocity_to_rate(state, rate)
        add_scaled(total.y, RK4_WEIGHT[stage] * h, rate.y)
    copy(total.y, state.y)
    normalise_all(state)
