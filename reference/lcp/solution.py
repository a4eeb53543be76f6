"""What a solver leaves behind, and the only place where it is decided whether that is a solution.

``finish`` measures the λ that a solver hands in from the problem itself. Whatever the solver believes, a λ
whose residual is above the tolerance is never called solved. Nor is one that is so large that rounding could
hide more than that: two rows that ask λ_1 + λ_2 = 0 and 3 λ_1 + 3 λ_2 = 1 may both look right at
λ = (−7e15, 7e15), where 3 λ is rounded to a multiple of 4.

Slides S13, S14; lectures/06_pivoting_lcp.md.
"""

from dataclasses import dataclass, field

import numpy as np

from .. import inputs

# A kernel returns one of these; their order is that of the words.
SOLVED, RAY, INFEASIBLE, CYCLE, MAX_ITERATIONS, DIVERGED, UNSUITABLE = range(7)
STATUSES = ("solved", "ray", "infeasible", "cycle", "max_iterations", "diverged", "unsuitable")
_REASONS = {
    "solved": "λ solves the problem: its residual of {residual:.2g} is within the tolerance {tolerance:.2g}.",
    "ray": "The method ran off along a ray: going on, λ grows for ever and no complementary λ comes.",
    "infeasible": "No λ within its bounds makes w what it must be: the problem has no solution.",
    "cycle": "The method came back to where it had been before, and would go round for ever.",
    "max_iterations": "All {iterations} iterations are done, and the residual is still {residual:.2g}, above "
    "the tolerance of {tolerance:.2g}: allow more of them, or take a method that needs fewer.",
    "diverged": "λ grows without limit or stopped being finite, after {iterations} iterations; the residual "
    "is {residual:.2g}.",
    "unsuitable": "This method can't treat this problem.",
}
HIDDEN = 1e-10  # a residual that rounding may always hide, however small the tolerance
_UNTRUE = (
    "The method came to its end, but rounding has left a residual of {residual:.2g}, above the tolerance of "
    "{tolerance:.2g}: the problem is ill-conditioned, or the tolerance too small for its numbers."
)
_UNSEEN = (
    "The residual looks like {residual:.2g}, but λ is as large as {largest:.2g}: rounding alone leaves w "
    "unsure by {rounding:.2g}, which could hide more than the tolerance of {tolerance:.2g}, so it proves "
    "nothing. The problem has no solution, or is ill-conditioned, or the method ran off along a line of them."
)


@dataclass(frozen=True)
class Solution:
    """What came out. ``lam`` and ``w`` (n,) are the last λ and its w = A λ + b, solved or not.

    status: one of ``STATUSES``; reason: a sentence about it. iterations: sweeps, steps or pivots done.
    residual: of this very λ. history (iterations + 1,): the residual of the start and after each iteration,
    the last being ``residual``; methods that have no iterate on the way (pivoting) give the two ends only.
    tolerance: what was asked for. certificate: for "ray" and "infeasible", arrays that prove it, by name.
    record: what the method was asked to write down on its way, such as the tableaux of a pivoting method.
    """

    lam: np.ndarray
    w: np.ndarray
    status: str
    reason: str
    iterations: int
    residual: float
    history: np.ndarray
    tolerance: float
    certificate: dict | None = None
    record: list = field(default_factory=list, repr=False)

    @property
    def solved(self):
        """True only if residual ≤ tolerance, and rounding can't hide much more than that."""
        return self.status == "solved"


def misplaced(problem, λ, tolerance):
    """(i, its bound): a row of zeros in A whose λ_i isn't where alone it may be; (None, 0) where none is.

    The residual doesn't see it: what w_i comes to has no unit there.
    """
    if len(problem.zero_rows):
        bound = problem.bounds_of_zero_rows(λ)
        off = np.flatnonzero(~(np.abs(λ[problem.zero_rows] - bound) <= tolerance * problem.scale))
        if len(off):
            return int(problem.zero_rows[off[0]]), bound[off[0]]
    return None, 0


def worst_merit(problem, λ, w):
    """The merit of λ if the rounding of w = A λ + b were all in one direction, and that the worse one."""
    off = problem.rounding(λ)
    return max(problem.merit(λ, w + off), problem.merit(λ, w - off))


def is_unseen(problem, λ, w, tolerance):
    """Whether rounding of w could hide that λ, whose residual is within the tolerance, is no solution.

    It may always hide what is small beside the merit of λ⁰, or what it hides there, since λ⁰ is given.
    """
    most = max(tolerance, HIDDEN) * problem.scale
    if problem.noise(λ) <= most:
        return False  # nearly always: then there is no need to ask in which rows it matters
    most += tolerance * problem.scale + 2 * problem.noise(problem.origin)
    return not worst_merit(problem, λ, w) <= most


def solves(problem, λ, tolerance):
    """Whether λ (n,) is what is called a solution."""
    w = problem.w(λ)
    seems = problem.residual(λ, w) <= tolerance and misplaced(problem, λ, tolerance)[0] is None
    return seems and not is_unseen(problem, λ, w, tolerance)


def finish(
    problem, λ, iterations, code, tolerance, *, reason=None, history=None, certificate=None, record=()
):
    """The Solution that λ (n,) is, measured afresh from the problem.

    code: what the method believes, a word of ``STATUSES`` or its number. It stands unless λ says otherwise:
    λ is "solved" if and only if its residual is at most the tolerance, rounding could not hide more than as
    much again (or ``HIDDEN``), and no row of zeros forbids it.
    reason: a sentence in place of the usual one, for that status only.
    history (iterations + 1,): residuals, of which the last is measured anew.
    """
    believed = code if isinstance(code, str) else STATUSES[code]
    inputs.choice("code", believed, STATUSES)
    λ = np.array(λ, dtype=float)
    w = problem.w(λ)
    residual = problem.residual(λ, w)
    if history is None:
        start = problem.residual(problem.origin)
        history = [start, residual] if iterations else [residual]
    history = np.array(history, dtype=float)
    history[-1] = residual
    status, words = believed, reason or _REASONS[believed]
    i, bound = misplaced(problem, λ, tolerance) if residual <= tolerance else (None, 0)
    if i is not None:
        words = f"Row {i} of A is 0, so w_{i} = {problem.b[i]:.3g} whatever λ is, "
        if np.isinf(bound):
            status, certificate = "infeasible", {"y": np.sign(-problem.b[i]) * (np.arange(problem.n) == i)}
            words += f"and no λ_{i} fits that."
        else:
            status = "diverged" if believed == "solved" else believed
            words += f"and λ_{i} must be at its bound {bound:.3g}, but is {λ[i]:.3g}."
    elif residual <= tolerance and is_unseen(problem, λ, w, tolerance):
        if believed not in ("ray", "infeasible"):
            status = "diverged" if believed == "solved" else believed
            words = _UNSEEN.format(
                residual=residual,
                largest=np.abs(λ).max(),
                rounding=problem.rounding(λ).max(),
                tolerance=tolerance,
            )
    elif residual <= tolerance:
        status, certificate = "solved", None
        words = reason if reason and believed == "solved" else _REASONS["solved"]
    elif believed == "solved":
        status, words = "diverged", _UNTRUE
    if words in (_UNTRUE, *_REASONS.values()):
        words = words.format(iterations=iterations, residual=residual, tolerance=tolerance)
    return Solution(
        λ, w, status, words, int(iterations), residual, history, tolerance, certificate, list(record)
    )
