"""What the integrators are made of: room to work in, sums of flat arrays, and motion at constant velocity.

Slides S4, S9; lectures/02_equation_of_motion.md.
"""

from typing import NamedTuple

import numpy as np

from ..bodies import State, make_state, planar
from ..compiled import compiled, lean
from ..rotation import exponential, multiply, quaternion, store_quaternion


class Work(NamedTuple):
    """Room to compute in, shaped like the state; ``before``: y at the start of a step, to go back to.

    ``solve``: [iterations, residual] of an implicit step.
    """

    rate: State
    start: State
    total: State
    before: np.ndarray
    solve: np.ndarray
    max_iterations: int
    tolerance: float


@compiled
def make_work(m, r, d, max_iterations, tolerance):
    """Work for m bodies in d dimensions, of which r rotate."""
    rate, start, total = make_state(m, r, d), make_state(m, r, d), make_state(m, r, d)
    return Work(rate, start, total, np.zeros(len(rate.y)), np.zeros(2), max_iterations, tolerance)


@lean
def add_scaled(y, h, rate):
    """y += h · rate, for flat arrays."""
    for k in range(len(y)):
        y[k] += h * rate[k]


@lean
def copy(y, to):
    """Copy a flat array."""
    for k in range(len(y)):
        to[k] = y[k]


@lean
def drift(state, h):
    """Motion for the time h at constant velocities: x += h v; each q turns by h ω, which keeps its norm."""
    for i in range(len(state.x)):
        for k in range(state.x.shape[1]):
            state.x[i, k] += h * state.v[i, k]
    for i in range(len(state.q)):
        if planar(state):
            state.q[i, 0] += h * state.ω[i, 0]
        else:
            turned = exponential((h * state.ω[i, 0], h * state.ω[i, 1], h * state.ω[i, 2]))
            store_quaternion(state.q, i, multiply(turned, quaternion(state.q, i)))
