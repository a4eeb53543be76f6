"""Velocities into the state, and positions moved by them.

Slides S9, S12; lectures/05_contact.md.
"""

import numpy as np

from ..bodies import planar, times
from ..compiled import inner, lean
from ..integrators.splitting import drift_by_midpoint, finish_free_rotation
from ..rotation import quaternion, rotate, rotate_back, store, vector


@lean
def gather_velocities(state, u):
    """u (n, k): v and ω of each body side by side; 0 for the turning of points."""
    d = state.x.shape[1]
    for i in range(len(u)):
        for a in range(d):
            u[i, a] = state.v[i, a]
        for a in range(d, u.shape[1]):
            u[i, a] = 0.0
        if i < len(state.ω):
            for a in range(state.ω.shape[1]):
                u[i, d + a] = state.ω[i, a]


@lean
def scatter_velocities(system, u, state):
    """v, ω and L from u (n, k)."""
    d = state.x.shape[1]
    for i in range(len(u)):
        for a in range(d):
            state.v[i, a] = u[i, a]
        if i < len(state.ω):
            for a in range(state.ω.shape[1]):
                state.ω[i, a] = u[i, d + a]
            if not planar(state):
                q = quaternion(state.q, i)
                ω = vector(state.ω, i)
                store(state.L, i, rotate(q, times(vector(system.inertia, i), rotate_back(q, ω))))


@lean
def move(system, used, after, h, state, work):
    """Positions and attitudes with the velocities ``used``; then the velocities are those ``after``.

    In space a body turns as a free one does, with the momentum that goes with ``used``; its momentum after
    is kept, so that ω follows the axes, but for its length, by which the energy is kept.
    """
    scatter_velocities(system, after, state)
    for i in range(len(state.L)):
        for a in range(3):
            work.L[i, a] = state.L[i, a]
    scatter_velocities(system, used, state)
    drift_by_midpoint(system, h, state, work)
    scatter_velocities_kept(system, used, after, work.L, state)


@inner
def scatter_velocities_kept(system, used, after, L, state):
    """v (and ω in the plane) from ``after``; in space ω from the momentum L, at the new attitude."""
    d = state.x.shape[1]
    for i in range(len(after)):
        for a in range(d):
            state.v[i, a] = after[i, a]
        if i >= len(state.ω):
            continue
        if planar(state):
            state.ω[i, 0] = after[i, d]
        else:
            for a in range(3):
                state.L[i, a] = L[i, a]
            finish_free_rotation(state, i, quaternion(state.q, i), vector(system.inertia, i))
            if differ(used[i], after[i], d):
                keep_energy(state.L[i], state.ω[i], after[i], d)


@inner
def differ(u, other, d):
    """Whether a body's angular velocities are not the same in both; d: where they begin."""
    return u[d] != other[d] or u[d + 1] != other[d + 1] or u[d + 2] != other[d + 2]


@inner
def keep_energy(L, ω, after, d):
    """Make L and ω as much shorter or longer as leaves ½ L·ω what it was before the body turned.

    A free body that turns by its own ω keeps its energy. Turned by another, the mean, it would win or lose
    some, of order h² in a step (measured: up to 4e-4 of a box that tumbles over its corner at h = 1/30 s).
    """
    before, now = 0.0, 0.0
    for a in range(3):
        before += L[a] * after[d + a]
        now += L[a] * ω[a]
    share = np.sqrt(before / now) if before > 0 and now > 0 else 1.0
    for a in range(3):
        L[a] *= share
        ω[a] *= share
