"""One problem of a step, by any method of ``reference.lcp``: from rows to a problem, λ, and velocities.

    friction "cone"     a ConeProblem with blocks (n, t1, t2): the same in all directions
             "box"      an LCP in which each tangent has its own bounds ±μ λ_n (S17): up to √2 of it
             "pyramid"  Stewart & Trinkle's LCP: ±t1, ±t2 with λ ≥ 0 each, and Σ λ ≤ μ λ_n: down to 1/√2

In the plane all three are the same. A = J M⁻¹ Jᵀ is handed over as its factors, except for the pyramid, whose
matrix is not of that form. The default method, ``cone_newton``, takes the rows as they are.

Slides S12–S14, S17; lectures/05_contact.md. Source: Stewart & Trinkle, Int. J. Numer. Methods Eng. 39 (1996)
2673; Anitescu & Potra, Nonlinear Dynamics 14 (1997) 231 (the pyramid's LCP).
"""

import numpy as np

from ..compiled import compiled, compiled_apart
from ..factored import Factored
from ..lcp import LCP, SOLVERS, ConeProblem
from ..lcp.cone_newton import NEAR, ContactRows, cone_newton_kernel
from ..lcp.contact_sweeps import fill_moves
from .impacts import rates

LARGE = 1000  # contacts: where Newton's method fails on more,
GOOD, PATIENCE = 1e-3, 30  # so many problems after that are left at this error, which sweeps reach
USABLE = 1e-6  # a residual with which a run goes on, though the method didn't come to its end
DEFAULT_SOLVERS = {"cone": "cone_newton", "box": "lemke", "pyramid": "lemke"}  # exact


class Unsolvable(Exception):
    """A step's problem has no usable λ; ``status`` is the solver's."""

    def __init__(self, status, reason):
        super().__init__(reason)
        self.status = status


@compiled
def newton_in_cones(rows, M, free, λ, limits, worst):
    """``StepSolver`` by ``cone_newton``, for ``flight``; limits: its tolerance and iterations."""
    rigid = np.zeros(len(rows.μ))
    return solve_patiently(rows, M, free, rigid, λ, limits.tolerance, limits.iterations, worst)


@compiled_apart
def solve_patiently(rows, M, free, softness, λ, tolerance, iterations, worst):
    """The velocities u⁺, and λ in place, by ``cone_newton``. worst (3,): (passes, error), and how many large
    problems more are left at an error of GOOD.

    In a large heap that moves, twelve digits take much longer than three, if they are found at all. So they
    are only asked for at times; a pyramid, however large, has them at the first try.
    """
    large = len(rows.μ) > LARGE
    waits, good, none = large and worst[2] > 0, max(tolerance, GOOD), np.zeros(0)
    after, passes, error = cone_newton_kernel(
        rows, M, free, softness, True, λ, good if waits else tolerance, iterations, none, NEAR, not large
    )
    if waits:
        worst[2] -= 1
    elif large and error > tolerance:
        worst[2] = PATIENCE
        if error > good:
            after, passes, error = cone_newton_kernel(
                rows, M, free, softness, True, λ, good, iterations, none, NEAR, False
            )
    worst[0], worst[1] = max(worst[0], passes), max(worst[1], error)
    return after


class StepSolver:
    """A run's way from rows to velocities; it counts what stays unsolved. ``worst``: (passes, residual) since
    somebody set them to 0, and what ``solve_patiently`` counts.
    """

    def __init__(self, solver, friction, tolerance, iterations):
        self.name, self.friction, self.limits = solver, friction, (tolerance, iterations)
        self.worst, self.solved, self.unsolved = np.zeros(3), 0, {}

    def __call__(self, rows, M, free, λ, softness=None, time=0.0):
        """The velocities u⁺ (n, k) nearest to the free ones (n, k) that the rows allow; λ (m,), the start,
        becomes the answer. softness (m,): γ of rows that give way, w + γ λ. Raises Unsolvable.
        """
        if not len(rows.c):
            return free.copy()
        if self.name == "cone_newton":
            gives = np.zeros(len(rows.μ)) if softness is None else softness[rows.block[:-1]]
            return solve_patiently(rows, M, free, gives, λ, *self.limits, self.worst)
        if not np.isfinite(free).all():
            raise Unsolvable("diverged", f"velocities stopped being finite under {self.name} in")
        A = factors(rows, M, softness)
        problem, start, lam = PROBLEMS[self.friction](rows, A, free, λ)
        solution = SOLVERS[self.name](problem, start, *self.limits)
        self.note(solution.iterations, solution.residual)
        self.judge(solution, time)
        λ[:] = lam(solution.lam)
        return free + A.velocities(λ)[: len(free)]

    def note(self, passes, error):
        """Keep the worst."""
        self.worst[:2] = max(self.worst[0], passes), max(self.worst[1], error)

    def judge(self, solution, time):
        """Count what is unsolved; Unsolvable where its λ is of no use."""
        self.solved += solution.solved
        if solution.solved:
            return
        count, first, reason = self.unsolved.get(solution.status, (0, time, solution.reason))
        self.unsolved[solution.status] = count + 1, first, reason
        if solution.status != "max_iterations" and not solution.residual <= USABLE:
            raise Unsolvable(
                solution.status, f"{self.name} could not solve the contacts ({solution.reason}) in"
            )

    def told(self):
        """What must be said of unsolved problems, or ""."""
        total = self.solved + sum(count for count, _, _ in self.unsolved.values())
        return "; ".join(
            f"{self.name} left {count} of {total} problems unsolved ({status}), the first in the step from "
            f"t = {first:.4g} s: {reason}"
            for status, (count, first, reason) in self.unsolved.items()
        )


def factors(rows, M, softness=None):
    """A = J M⁻¹ Jᵀ + diag(softness) as ``Factored``."""
    there = rows.bodies >= 0
    of_bodies = np.where(there[..., None, None], M[rows.bodies], np.eye(M.shape[1]))
    B = np.linalg.solve(of_bodies, np.where(there[..., None], rows.J, 0.0)[..., None])[..., 0]
    return Factored(rows.bodies, rows.J, B, len(M), softness, M)


def moves_and_diagonal(rows, M):
    """(M⁻¹ Jᵀ (m, 2, k), how λ = 1 moves its bodies; A_ii (m,)), where A itself isn't needed."""
    moves = np.zeros_like(rows.J)
    fill_moves(rows, M, moves)
    return moves, np.einsum("rsk,rsk->r", rows.J, moves)


def cone_problem(rows, A, free, λ):
    """(ConeProblem, start, back), where back(λ of the problem) is λ (m,). A contact without friction becomes
    a cone of μ = 0, whose tangents push a body of its own, which nothing else touches.
    """
    d = 2 if A.J.shape[2] == 3 else 3
    first, size = rows.block[:-1], np.diff(rows.block)
    short = np.flatnonzero(size == 1)
    if np.any(rows.lower[first[short]] != 0) or np.any(rows.upper[first[short]] != np.inf):
        raise Unsolvable(
            "unsuitable", "a row with bounds is no friction cone, so cone methods can't treat it, in"
        )
    place = np.repeat(d * np.arange(len(first)) - first, size) + np.arange(len(rows.c))
    m, k, n = d * len(first), A.J.shape[2], A.count
    bodies, J, B = np.full((m, 2), -1), np.zeros((m, 2, k)), np.zeros((m, 2, k))
    bodies[place], J[place], B[place] = A.bodies, A.J, A.B
    softness, diagonal = np.zeros(m), A.diagonal()[first[short]]
    softness[place] = A.softness
    for a in range(1, d):
        row = d * short + a
        bodies[row, 0], J[row, 0, a], B[row, 0, a] = n + np.arange(len(short)), 1.0, diagonal
    own = np.eye(k) / diagonal[:, None, None]
    whole = Factored(bodies, J, B, n + len(short), softness, np.concatenate([A.mass, own]))
    b, start = np.zeros(m), np.zeros(m)
    b[place], start[place] = rates(rows, free) + rows.c, λ
    return ConeProblem(whole, b, np.maximum(rows.μ, 0.0), dimension=d), start, lambda lam: lam[place]


def box_problem(rows, A, free, λ):
    """(LCP, start, back): each tangent bounded by itself, by ±μ λ_n."""
    tangent, contact = tangent_rows(rows)
    friction = (tangent, rows.block[contact], rows.μ[contact]) if len(tangent) else None
    b = rates(rows, free) + rows.c
    return LCP(A, b, rows.lower, rows.upper, friction), λ, lambda lam: lam


def pyramid_problem(rows, A, free, λ):
    """(LCP, start, back): the rows, each tangent backwards, and a slack σ for each contact with friction.

        w_t = ±t·w + σ ≥ 0  ⊥  λ_t ≥ 0        σ becomes the speed at which the contact slides
        w_σ = μ λ_n − Σ λ_t ≥ 0  ⊥  σ ≥ 0     0 unless friction is at its limit

    σ is counted in units of λ, times A_nn, so that no row is larger than the others because of its unit.
    """
    tangent, contact = tangent_rows(rows)
    sliding, which = np.unique(contact, return_inverse=True)
    m, t, s = len(rows.c), len(tangent), len(sliding)
    C = np.hstack([np.eye(m), -np.eye(m)[:, tangent], np.zeros((m, s))])  # λ of the rows = C λ
    whole, slack, normal = C.T @ A.toarray() @ C, m + t + np.arange(s), rows.block[sliding]
    unit = A.diagonal()[normal]
    for both in (tangent, m + np.arange(t)):
        whole[both, slack[which]] += unit[which]
        whole[slack[which], both] -= unit[which]
    whole[slack, normal] = unit * rows.μ[sliding]
    lower, upper = np.append(rows.lower, np.zeros(t + s)), np.append(rows.upper, np.full(t + s, np.inf))
    start = np.concatenate([λ, np.maximum(-λ[tangent], 0), np.zeros(s)])
    start[tangent] = np.maximum(λ[tangent], 0)
    return LCP(whole, C.T @ (rates(rows, free) + rows.c), lower, upper), start, lambda lam: C @ lam


def tangent_rows(rows):
    """(rows that are tangents (T,), the contact of each (T,))."""
    of_row = np.repeat(np.arange(len(rows.μ)), np.diff(rows.block))
    tangent = np.flatnonzero(np.arange(len(of_row)) != rows.block[of_row])
    return tangent, of_row[tangent]


PROBLEMS = {"cone": cone_problem, "box": box_problem, "pyramid": pyramid_problem}


def why_unfit(solver, friction, joints):
    """Why a solver can't treat contact with this friction, in its own words; "" where it can: it is asked to
    hold a block of 1 kg in the plane, on a joint's row if there are joints.
    """
    bodies, J = np.array([[-1, 0]] * (3 if joints else 2)), np.zeros((3 if joints else 2, 2, 3))
    J[0, 1, 1] = J[1, 1, 0] = J[-1, 1, 2 if joints else 0] = 1.0
    block, μ = np.array([0, 2, 3] if joints else [0, 2]), np.array([0.5, -1.0] if joints else [0.5])
    lower, upper = np.zeros(len(J)), np.full(len(J), np.inf)
    lower[2:] = -np.inf
    rows = ContactRows(bodies, J, np.zeros(len(J)), block, μ, lower, upper)
    try:
        problem, start, _ = PROBLEMS[friction](
            rows, factors(rows, np.eye(3)[None]), np.array([[0.1, -1.0, 0.1]]), np.zeros(len(J))
        )
    except Unsolvable as why:
        return str(why).removesuffix(", in")
    solution = SOLVERS[solver](problem, start)
    return solution.reason if solution.status == "unsuitable" else ""
