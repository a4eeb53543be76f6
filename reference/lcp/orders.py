"""In which order to sweep: as the rows come, there and back, or colour by colour.

Whatever the order, a normal row comes before its friction rows, since they are clipped by its λ (S17). A
normal row with its friction rows is one **contact**, and never torn apart by a colour.

Rows of one colour have nothing in common, so they may be renewed all at once without a change: Gauss–Seidel
made parallel. On a column of boxes two colours do (red and black); on a graph of contacts the greedy rule
needs a few more, at most one more than a contact has neighbours.

Slides S16, S17; lectures/07_iterative_lcp.md.
"""

import numpy as np
import scipy.sparse

from ..compiled import compiled
from ..factored import Factored


def natural_order(problem):
    """The rows (n,) in which to sweep: as they come, but friction rows that would come before their normal
    row follow right after it.
    """
    row, normal = np.arange(problem.n), problem.terms.normal
    return np.lexsort((row, normal > row, np.maximum(row, normal))).astype(np.uint32)


def there_and_back(problem):
    """All rows in their natural order, then contact by contact back again (2n,)."""
    there, contact = natural_order(problem), contacts(problem)
    place = np.empty(problem.n, dtype=int)
    place[there] = np.arange(problem.n)
    back = there[np.lexsort((place[there], -place[contact[there]]))]
    return np.concatenate([there, back])


def coloured_order(problem):
    """The rows (n,) sorted by the colour of their contact, the lowest colour first."""
    order = natural_order(problem)
    return order[np.argsort(colours(problem)[order], kind="stable")]


def contacts(problem):
    """Of each row (n,) the normal row of its contact: its own number where it isn't a friction row."""
    normal = problem.terms.normal
    return np.where(normal >= 0, normal, np.arange(problem.n))


def colours(problem):
    """A colour, 0, 1, 2 …, for each row (n,): contacts that A couples, or that share a body, differ in it.

    Greedy: contact after contact takes the lowest colour that no neighbour has yet. For a factored A the
    bodies remember which colours they have met, and A isn't formed.
    """
    names, contact = np.unique(contacts(problem), return_inverse=True)
    A, count, row = problem.A, len(names), np.arange(problem.n)
    gather = scipy.sparse.csr_array((np.ones(problem.n), (contact, row)), shape=(count, problem.n))
    if isinstance(A, Factored):
        used = scipy.sparse.csr_array(gather @ _meets(A))
        found = _colours_by_bodies(used.indptr, used.indices, A.count)
    else:
        pattern = scipy.sparse.csr_array(A)
        pattern.data = (pattern.data != 0).astype(float)
        near = gather @ (pattern + pattern.T) @ gather.T
        near = scipy.sparse.csr_array(near)
        near.eliminate_zeros()
        found = _colours_by_neighbours(near.indptr, near.indices)
    return found[contact]


def _meets(A):
    """(n, count): which bodies each row of a Factored meets."""
    row = np.broadcast_to(np.arange(A.shape[0])[:, None], A.bodies.shape)
    there = A.bodies >= 0
    return scipy.sparse.csr_array(
        (np.ones(there.sum()), (row[there], A.bodies[there])), shape=(A.shape[0], A.count)
    )


@compiled
def _colours_by_neighbours(start, near):
    """Greedy colours (m,); near[start[i]:start[i + 1]] are the neighbours of i."""
    m = len(start) - 1
    colour, met = np.full(m, -1), np.full(m + 1, -1)
    for i in range(m):
        for j in near[start[i] : start[i + 1]]:
            if j != i and colour[j] >= 0:
                met[colour[j]] = i
        c = 0
        while met[c] == i:
            c += 1
        colour[i] = c
    return colour


@compiled
def _colours_by_bodies(start, body, count):
    """The same, where all that meet a body are neighbours: each body keeps the colours it has met."""
    m = len(start) - 1
    most = 1
    colour = np.full(m, -1)
    met = np.zeros((count, 1), dtype=np.bool_)
    for i in range(m):
        c = 0
        while True:
            if c == most:  # room for twice as many colours
                wider = np.zeros((count, 2 * most), dtype=np.bool_)
                wider[:, :most] = met
                met, most = wider, 2 * most
            free = True
            for b in body[start[i] : start[i + 1]]:
                free = free and not met[b, c]
            if free:
                break
            c += 1
        colour[i] = c
        for b in body[start[i] : start[i + 1]]:
            met[b, c] = True
    return colour
