"""Where Lemke's path ends: λ of the vertex, made accurate; or a ray, and what its direction proves.

The tableau gathers rounding with each pivot. But it holds the inverse of the very equations that λ must
solve: its numbers in the rows of the z that are basic and the columns of the w that are not say how z moves
with w. So what w is still off by, measured from A and b themselves, tells how to mend λ, in n² operations
and not the n³ of a fresh solve (iterative refinement). Where that isn't enough, they are solved afresh.

Slides S13, S14; lectures/06_pivoting_lcp.md. Source: Wilkinson, Rounding Errors in Algebraic Processes
(1963), chapter 3, for iterative refinement.
"""

import numpy as np

from ..compiled import compiled
from .pivoting import proves_infeasible, refined

_TINY, _ENOUGH = 1e-11, 1e-13


@compiled
def vertex(T, basic, nonbasic, A, b, unit, weight):
    """λ (n,) of a plain problem's tableau, mended by what its w = A λ + b, dense, is off by.

    T (n, n + 2), basic (n,), nonbasic (n + 1,): as in ``follow_path``; unit, weight (n,): as in ``Scaled``.
    """
    n = len(b)
    λ, off = np.zeros(n), np.zeros(n + 2)
    for k in range(n):
        if n <= basic[k] < 2 * n:
            λ[basic[k] - n] = max(T[k, n + 1], 0.0) * unit[basic[k] - n]
    for _ in range(2):
        w, changed, largest = np.dot(A, λ) + b, 0.0, 0.0
        for j in range(n + 1):
            off[j] = weight[nonbasic[j]] * w[nonbasic[j]] if nonbasic[j] < n else 0.0
        change = np.dot(T, off)
        for k in range(n):
            i = basic[k] - n
            if 0 <= i < n:
                λ[i] = max(λ[i] - unit[i] * change[k], 0.0)
                changed, largest = max(changed, abs(unit[i] * change[k])), max(largest, λ[i])
        if changed <= 1e-9 * largest:  # what is left of an error shrinks by as much again: 1e-18
            break
    return λ


def answer(problem, form, parts, T, basic, nonbasic):
    """λ (n,) of the vertex where the path is."""
    m = len(basic)
    if parts.change is None and isinstance(problem.A, np.ndarray):
        λ = vertex(T, basic, nonbasic, problem.A, problem.b, form.unit, form.weight)
        if problem.residual(λ) <= _ENOUGH:
            return λ
    z = np.zeros(2 * m + 1)
    z[basic] = T[:, -1]
    on = np.isin(np.arange(m, 2 * m), basic)
    return refined(problem, parts.lam(z[m : 2 * m]) * form.unit, parts.place(on))


def proof(problem, form, parts, T, basic, nonbasic, entering):
    """What proves that there is no solution, from the direction of the ray; None where it doesn't."""
    m, s = len(basic), entering
    along = np.zeros(2 * m + 1)
    along[basic], along[nonbasic[s]] = T[:, s], 1.0
    z = along[m : 2 * m]
    z[np.abs(z) <= _TINY * np.abs(along).max()] = 0
    y = parts.multipliers(z)
    rows, columns = parts.solved
    if len(rows):  # those of the rows solved for follow: they make yᵀA vanish there
        y[rows] = 0
        y[rows] = np.linalg.solve(form.A[np.ix_(rows, columns)].T, -(y @ form.A)[columns])
    y = y * form.weight
    return {"y": y / np.abs(y).max()} if proves_infeasible(problem, y) else None
