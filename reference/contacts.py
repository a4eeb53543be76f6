"""Contact points as rows of J: one along the normal and, where there is friction, one along each tangent.

A row is made as a joint's is: −(e, r_i × e) for body i and (e, r_j × e) for body j, so that w = J u is
how fast j leaves i along e. The normal row asks for w ≥ 0 and λ ≥ 0, of which one is 0; while there is
still a gap it asks for w ≥ −gap/Δt, so that the two may just meet. A contact without friction has no
tangential rows.

Slides S10–S12; lectures/05_contact.md. Source: Stewart & Trinkle, Int. J. Numer. Methods Eng. 39 (1996)
2673 (the gap in the velocity's condition: Anitescu & Potra, Nonlinear Dynamics 14 (1997) 231).
"""

import numpy as np

from .collision import ContactArrays
from .compiled import compiled, inner, lean
from .rotation import cross, quaternion, rotate


def part(contacts, which):
    """The ``ContactArrays`` of some: which, a slice or a mask (capacity,) or (m,)."""
    arrays = [array[which] for array in contacts[1:]]
    return ContactArrays(np.array([len(arrays[0])]), *arrays)


@compiled
def keys(contacts, n):
    """One number for each contact (m,), the same from step to step: which of n bodies, and what of them.

    Contacts come sorted by it.
    """
    key = np.empty(contacts.count[0], np.int64)
    for q in range(len(key)):
        key[q] = key_of(contacts, q, n)
    return key


@lean
def key_of(contacts, q, n):
    """The key of contact q."""
    return (contacts.bodies[q, 0] * n + contacts.bodies[q, 1]) * 2**32 + contacts.id[q]


@compiled
def look_up(known, values, key):
    """The values (c, d) that belong to these keys (m,), as (m, d); 0 for those that are not known (c,).

    Both are sorted, so one walk along them finds all.
    """
    found, k = np.zeros((len(key), values.shape[1])), 0
    for q in range(len(key)):
        while k < len(known) and known[k] < key[q]:
            k += 1
        if k < len(known) and known[k] == key[q]:
            for a in range(values.shape[1]):
                found[q, a] = values[k, a]
    return found


@compiled
def spread(rows, λ, m, d):
    """λ of the first m blocks, the contacts, as (m, d): normal and tangents, 0 where there is no row."""
    full = np.zeros((m, d))
    for q in range(m):
        first = rows.block[q]
        for r in range(first, rows.block[q + 1]):
            full[q, r - first] = λ[r]
    return full


@compiled
def gather(rows, full, others):
    """λ (r,) from what ``spread`` makes, (m, d), and the values of the rows after the contacts'."""
    λ, m = np.empty(len(rows.c)), len(full)
    for q in range(m):
        first = rows.block[q]
        for r in range(first, rows.block[q + 1]):
            λ[r] = full[q, r - first]
    for r in range(len(others)):
        λ[rows.block[m] + r] = others[r]
    return λ


@inner
def relative_velocity(contacts, q, u):
    """How fast j moves, seen from i, at contact q: three numbers, m/s; the third is 0 in the plane."""
    x, y, z = 0.0, 0.0, 0.0
    for side in range(2):
        i = contacts.slot[q, side]
        if i < 0:
            continue
        r, sign = contacts.arm[q, side], 2.0 * side - 1.0
        if len(r) == 2:
            x += sign * (u[i, 0] - u[i, 2] * r[1])
            y += sign * (u[i, 1] + u[i, 2] * r[0])
        else:
            turning = cross((u[i, 3], u[i, 4], u[i, 5]), (r[0], r[1], r[2]))
            x += sign * (u[i, 0] + turning[0])
            y += sign * (u[i, 1] + turning[1])
            z += sign * (u[i, 2] + turning[2])
    return x, y, z


@inner
def along(e, velocity):
    """e · velocity, for a direction e (d,) and three numbers."""
    total = e[0] * velocity[0] + e[1] * velocity[1]
    return total + e[2] * velocity[2] if len(e) == 3 else total


@inner
def parting_speed(contacts, q, u):
    """w_n = J u of contact q for the velocities u (n, k): how fast its two bodies part, m/s."""
    return along(contacts.frame[q, 0], relative_velocity(contacts, q, u))


@compiled
def contact_rows(contacts, target, k):
    """The rows of these contacts, k = 3 or 6 velocities a body; w_n must be at least −target (m,), m/s.

    Returns bodies (r, 2), J (r, 2, k), c (r,), block (m + 1,), μ (m,), lower and upper (r,): the fields
    of ``lcp``'s ContactRows. Contact q has the rows block[q] … block[q + 1] − 1.
    """
    m, d = contacts.point[: contacts.count[0]].shape
    block = np.zeros(m + 1, np.int64)
    for q in range(m):
        block[q + 1] = block[q] + (d if contacts.friction[q] > 0 else 1)
    n = block[m]
    bodies, J, c, μ = np.full((n, 2), -1), np.zeros((n, 2, k)), np.zeros(n), np.full(m, -1.0)
    for q in range(m):
        c[block[q]] = target[q]
        if contacts.friction[q] > 0:
            μ[q] = contacts.friction[q]
        for a in range(block[q + 1] - block[q]):
            r = block[q] + a
            for side in range(2):
                i = contacts.slot[q, side]
                bodies[r, side] = i
                if i >= 0:
                    put_row(J[r, side], contacts.frame[q, a], contacts.arm[q, side], 2.0 * side - 1.0)
    return bodies, J, c, block, μ, np.zeros(n), np.full(n, np.inf)


@lean
def put_row(J, e, arm, sign):
    """sign · (e, r × e), for one body (S5)."""
    if len(e) == 2:
        J[0], J[1], J[2] = sign * e[0], sign * e[1], sign * (arm[0] * e[1] - arm[1] * e[0])
    else:
        moment = cross((arm[0], arm[1], arm[2]), (e[0], e[1], e[2]))
        for a in range(3):
            J[a], J[3 + a] = sign * e[a], sign * moment[a]


@lean
def fill_masses(system, state, M):
    """M (n, k, k), block by block: the mass, and R I Rᵀ in the world frame; 1 for the turning of points,
    which have none.
    """
    n, d = state.x.shape
    for i in range(n):
        for a in range(M.shape[1]):
            for b in range(M.shape[1]):
                M[i, a, b] = 0.0
            M[i, a, a] = system.mass[i] if a < d else 1.0
        if i >= len(state.q):
            continue
        if d == 2:
            M[i, 2, 2] = system.inertia[i, 0]
            continue
        q = quaternion(state.q, i)
        M[i, 3, 3], M[i, 4, 4], M[i, 5, 5] = 0.0, 0.0, 0.0
        add_axis(M[i], system.inertia[i, 0], rotate(q, (1.0, 0.0, 0.0)))
        add_axis(M[i], system.inertia[i, 1], rotate(q, (0.0, 1.0, 0.0)))
        add_axis(M[i], system.inertia[i, 2], rotate(q, (0.0, 0.0, 1.0)))


@inner
def add_axis(M, I, e):
    """Add I e ⊗ e to the turning part of one body's M (6, 6)."""
    for a, x in ((3, e[0]), (4, e[1]), (5, e[2])):
        M[a, 3] += I * x * e[0]
        M[a, 4] += I * x * e[1]
        M[a, 5] += I * x * e[2]


@compiled
def label_islands(bodies, n):
    """(n,): bodies that touch, directly or through others that move, have one label, the smallest number
    among them.
    """
    label = np.arange(n)
    for r in range(len(bodies)):
        i, j = bodies[r, 0], bodies[r, 1]
        if i >= 0 and j >= 0:
            i, j = root(label, i), root(label, j)
            if i != j:
                label[max(i, j)] = min(i, j)
    for i in range(n):
        label[i] = root(label, i)
    return label


@inner
def root(label, i):
    """The body whose label is its own, followed from i; paths are halved on the way."""
    while label[i] != i:
        label[i] = label[label[i]]
        i = label[i]
    return i


@inner
def owner(bodies, r):
    """A moving body of row or contact r; bodies (m, 2): −1: what doesn't move."""
    return bodies[r, 0] if bodies[r, 0] >= 0 else bodies[r, 1]
