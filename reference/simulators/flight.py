"""The second half of a flight: impulses; with which velocity each body moves on; where it comes to rest.

Half way the velocities u become u⁺. A body that moves with u before and with u⁺ after has moved with the
*mean* ½ (u + u⁺): it flies as a thrown stone does, exactly, and what slides is as exact; a step changes then
the energy by just ½ λᵀ (w + w⁺), the work of the contacts. Where that would lead into another body (it
lands), the bodies move as if with the *end* velocity u⁺ from the start; the energy then changes by
λᵀ w⁺ − ½ |u⁺ − u|²_M, which isn't positive. Where the contacts' work is positive (a contact begins to stick
within the step), they move with as much of the end velocity as makes the energy stay; and where none does,
u⁺ is made slower. All bodies of an island, which touch each other, do the same. So contact never feeds
energy into a scene, whatever Δt is.

Slides S9, S12; lectures/05_contact.md.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled, compiled_apart, inner
from ..contacts import contact_rows, gather, keys, label_islands, look_up, owner, spread
from .held import join
from .middle import TOUCHES, add_bias
from .moving import move
from .paying import energies, pay
from .resting import leave_out_rest, put_back

REST, NOISE = 100, 3  # times the solver's tolerance, or its error: so slow is at rest, where contacts hold it
MOST_REST = 3e-3  # but no faster than this share of what forces would make of it in the step
NO_WORK = 1e-12  # of the terms that it is a sum of: what rolls, or slides without friction, does no work


class Speeds(NamedTuple):
    """What a step begins with: n bodies with k velocities each."""

    M: np.ndarray  # (n, k, k)
    before: np.ndarray  # (n, k): u
    free: np.ndarray  # (n, k): what u would become without contact
    f: np.ndarray  # (n, d): of the forces, room to compute in
    τ: np.ndarray  # (r, 3) or (r, 1)


class Limits(NamedTuple):
    """What a run goes by."""

    tolerance: float  # of the contacts' solver
    iterations: int
    closed: float  # m: a gap that counts as none
    bodies: int  # in the scene
    warm: bool  # whether a solve starts from the forces before


class Turning(NamedTuple):
    """Limits of the iteration by which a body turns (``splitting.drift_by_midpoint``); what it took; room."""

    max_iterations: int
    tolerance: float
    solve: np.ndarray  # (2,): iterations, residual
    L: np.ndarray  # (r, 3), or (0, 3) in the plane


@compiled_apart
def push(solve, system, state, work, speeds, middle, contacts, half, held, known, pushed, h, limits, worst):
    """From the middle of a flight of h s to its end: the impulses, and the second half of the way.

    speeds, contacts: of the start; middle, half: of the middle, where ``state`` is (see ``middle``); held:
    the joints' rows. solve(rows, M, free, λ, limits, worst) → u⁺, λ in place. known (c,), pushed (c, d): keys
    and forces of the contacts before, N. Returns the keys (m,) and the impulses (m, d) in the frames of
    ``half``, and λ of all rows.
    """
    M, before, free = middle.M, middle.before, middle.free
    rows, gap, key, λ = prepare(speeds, middle, contacts, half, held, known, pushed, h, limits)
    moving = leave_out_rest(rows, M, before, free, λ, limits.tolerance)
    here = worst.copy()
    here[:2] = 0.0
    found = solve(moving.rows, moving.M, moving.free, moving.λ, limits, here)
    worst[0], worst[1], worst[2] = max(worst[0], here[0]), max(worst[1], here[1]), here[2]
    after = put_back(moving, found, λ, free)
    finish(system, state, work, M, before, rows, gap, free, after, λ, h, limits, here[1])
    return key, spread(rows, λ, len(key), state.x.shape[1]), λ


@compiled_apart
def prepare(speeds, middle, contacts, half, held, known, pushed, h, limits):
    """The problem of a flight: its rows; their gaps at the start; the contacts' keys; and the λ that the
    forces before would make in h.
    """
    closing = closing_speeds(contacts, h, limits.closed)
    rows = join(contact_rows(half, closing, middle.before.shape[1]), held)
    gap = gaps(contacts, held)
    add_bias(rows, contacts, half, speeds.before, middle, gap, h, limits.closed)
    key = keys(contacts, limits.bodies)
    λ = gather(rows, look_up(known, pushed, key), held.force)
    for r in range(len(λ)):
        λ[r] *= h
    return rows, gap, key, λ


@compiled_apart
def finish(system, state, work, M, before, rows, gap, free, after, λ, h, limits, error):
    """Rest, and the new positions and velocities, once u⁺ = ``after`` is known, with this error."""
    label, room = label_islands(rows.bodies, len(after)), np.zeros((8, len(after)))
    slow = min(max(REST * limits.tolerance, NOISE * error), MOST_REST)
    let_rest(label, rows, λ, before, free, after, slow, room[:3])
    used, excess, slack = np.empty_like(after), np.zeros(len(after)), limits.closed
    if choose_velocities(rows, label, gap, M, before, free, after, λ, h, slack, used, excess, room[3:]):
        pay(label, excess, energies(M, after), after - free, M, after, np.zeros((4, len(after))))
    move(system, used, after, 0.5 * h, state, work)


@compiled(door=False)
def gaps(contacts, held):
    """The gaps of the contacts (m,), and then of the joints' limits."""
    m = contacts.count[0]
    gap = np.empty(m + len(held.gap))
    for q in range(m):
        gap[q] = contacts.gap[q]
    for q in range(len(held.gap)):
        gap[m + q] = held.gap[q]
    return gap


@compiled(door=False)
def closing_speeds(contacts, h, closed):
    """How fast each contact may close, m/s (m,): gap/h; 0 where it touches, or nearly.

    Else what rests would creep; and in a heap, where more contacts hold than there are velocities, closing
    gaps that don't matter is most of the work (measured: two in three steps that were left short).
    """
    target = np.empty(contacts.count[0])
    for q in range(len(target)):
        target[q] = contacts.gap[q] / h if contacts.gap[q] > TOUCHES * closed else 0.0
    return target


@inner
def choose_velocities(rows, label, gap, M, before, free, after, λ, h, slack, used, excess, room):
    """Into used (n, k): with which velocity each body moves in the second half, so that it is u + θ (u⁺ − u)
    in the whole. gap (m,), m, of each contact; slack, m: a gap that counts as none; room (5, n), zeros.

    θ is ½, or as much more as keeps the energy from rising. Where none does (a solver stopped early; the
    weight brakes what moves) the energy that is too much is put into excess (n,), an island's at its label.
    Returns whether there is any.
    """
    n, k = before.shape
    work, size, lands, force, energy = room[0], room[1], room[2], room[3], room[4]
    for q in range(len(gap)):
        first = rows.block[q]
        if rows.lower[first] < 0 and rows.lower[first] > -np.inf:
            continue  # a motor's work is its own
        island = label[owner(rows.bodies, first)]
        for r in range(first, rows.block[q + 1]):
            twice, terms = 0.0, 0.0
            for side in range(2):
                b = rows.bodies[r, side]
                if b >= 0:
                    for a in range(k):
                        twice += rows.J[r, side, a] * (before[b, a] + after[b, a])
                        terms += abs(rows.J[r, side, a]) * (abs(before[b, a]) + abs(after[b, a]))
            work[island] += 0.5 * λ[r] * twice
            size[island] += 0.5 * abs(λ[r]) * terms
            if r == first and gap[q] + 0.5 * h * twice < -slack:
                lands[island] = 1.0
    for i in range(n):
        for a in range(k):
            for b in range(k):
                force[label[i]] += (free[i, a] - before[i, a]) * M[i, a, b] * (after[i, b] - before[i, b])
                energy[label[i]] += 0.5 * after[i, a] * M[i, a, b] * after[i, b]
    gained = False
    for i in range(n):
        island = label[i]
        gains = work[island] > NO_WORK * size[island]
        θ = 1.0 if lands[island] > 0 else 0.5
        if θ < 1 and gains and 2 * work[island] < force[island]:
            θ += work[island] / force[island]
        more = work[island] - (θ - 0.5) * force[island]
        if island == i and more > NO_WORK * (size[island] + energy[island]):
            excess[i], gained = more, True
        for a in range(k):
            used[i, a] = after[i, a] + (2 * θ - 1) * (after[i, a] - before[i, a])
    return gained


@inner
def let_rest(label, rows, λ, before, free, after, tolerance, room):
    """Set to 0 what the contacts hold still: islands as slow as the solver's tolerance, before and after.

    Their speed is measured by what the forces would make of it in this step. room (3, n), zeros. Returns how
    many bodies rest.
    """
    n, k = before.shape
    push, speed, held = room[0], room[1], room[2]
    for r in range(len(λ)):
        for side in range(2):
            if λ[r] != 0 and rows.bodies[r, side] >= 0:
                held[label[rows.bodies[r, side]]] = 1.0
    for i in range(n):
        island = label[i]
        for a in range(k):
            if not np.isfinite(free[i, a]):
                held[island] = 0.0  # nothing must hide that a force is not finite
            push[island] = max(push[island], abs(free[i, a] - before[i, a]))
            speed[island] = max(speed[island], abs(before[i, a]), abs(after[i, a]))
    resting = 0
    for i in range(n):
        island = label[i]
        if held[island] > 0 and speed[island] <= tolerance * push[island]:
            for a in range(k):
                after[i, a] = 0.0
            resting += 1
    return resting
