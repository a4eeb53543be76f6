"""Energy that a move has given, taken back from the speeds: first along the way on which it was given.

Contacts push bodies apart by what is within J's rows: momentum is kept, and what no contact touches stays as
it is. So does a change of the velocities along such a push, u − s way. Where that isn't enough, all speeds of
the island are made smaller alike.

Slides S12, S13; lectures/05_contact.md.
"""

import numpy as np

from ..compiled import compiled, inner


@compiled
def energies(M, u):
    """½ uᵀ M u of each body, J (n,)."""
    energy = np.empty(len(u))
    for i in range(len(u)):
        energy[i] = kinetic(M, u, i)
    return energy


@inner
def kinetic(M, u, i):
    """½ uᵀ M u of body i, J."""
    energy = 0.0
    for a in range(u.shape[1]):
        for b in range(u.shape[1]):
            energy += 0.5 * u[i, a] * M[i, a, b] * u[i, b]
    return energy


@inner
def pay(label, gain, energy, way, M, u, room):
    """Slow each island's bodies, which have these energies (n,), until they have lost what they gained (n,);
    returns what could not be paid, J. way, u (n, k); room (4, n), zeros.

    ½ |u − s way|²_M = ½ |u|²_M − gain, an equation for s; where it has no solution, the s that takes most.
    """
    n, k = u.shape
    gained, has, slope, square = room[0], room[1], room[2], room[3]
    for i in range(n):
        gained[label[i]] += gain[i]
        has[label[i]] += energy[i]
        for a in range(k):
            for b in range(k):
                slope[label[i]] += u[i, a] * M[i, a, b] * way[i, b]
                square[label[i]] += 0.5 * way[i, a] * M[i, a, b] * way[i, b]
    unpaid = 0.0
    for i in range(n):
        island, s, share = label[i], 0.0, 1.0
        if not gained[island] > 0:
            continue
        if square[island] > 0:
            root = np.sqrt(max(slope[island] ** 2 - 4 * square[island] * gained[island], 0.0))
            s = (slope[island] - np.copysign(root, slope[island])) / (2 * square[island])
        taken = s * (slope[island] - s * square[island])
        left, rest = gained[island] - taken, has[island] - taken
        if left > 1e-12 * gained[island]:
            share = np.sqrt(max(0.0, 1 - left / rest)) if rest > 0 else 0.0
        if island == i:
            unpaid += max(0.0, left - max(rest, 0.0))
        for a in range(k):
            u[i, a] = share * (u[i, a] - s * way[i, a])
    return unpaid
