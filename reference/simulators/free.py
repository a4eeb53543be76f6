"""What a step begins with: the mass matrices, the velocities, and what they would become without contact.

Slides S4, S9, S12; lectures/05_contact.md.
"""

import numpy as np

from ..bodies import solve_mass
from ..compiled import lean_apart
from ..contacts import fill_masses
from .flight import Speeds
from .moving import gather_velocities


def make_speeds(n, d, k, ω):
    """``Speeds`` of n bodies in d dimensions with k velocities each; ω as in their State."""
    return Speeds(np.zeros((n, k, k)), np.zeros((n, k)), np.zeros((n, k)), np.zeros((n, d)), np.zeros_like(ω))


@lean_apart
def fill_free(force, system, t, h, state, speeds):
    """The velocities after h without contact: u + Δt M⁻¹ f_e, into speeds.free; all other ``Speeds`` too."""
    f, τ, before, free = speeds.f, speeds.τ, speeds.before, speeds.free
    fill_masses(system, state, speeds.M)
    gather_velocities(state, before)
    force(system, t, state, f, τ)
    solve_mass(system, state.q, f, τ)
    d = f.shape[1]
    for i in range(len(f)):
        for a in range(before.shape[1]):
            free[i, a] = before[i, a]
        for a in range(d):
            free[i, a] += h * f[i, a]
        if i < len(τ):
            for a in range(τ.shape[1]):
                free[i, d + a] += h * τ[i, a]
