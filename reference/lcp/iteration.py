"""From a kernel to a solver: what every method that goes row by row does before and after its loop.

Slides S14, S16; lectures/07_iterative_lcp.md.
"""

import numpy as np

from .. import inputs
from .operators import arrays, for_form
from .problem import LCP, ConeProblem
from .solution import MAX_ITERATIONS, SOLVED, UNSUITABLE, finish, is_unseen

BLOWN_UP = 1e12  # times what the residual was at first: then a method has diverged
_MOST = 10**8  # iterations: their history must fit into memory


def checked(problem, start, tolerance, max_iterations):
    """(λ, tolerance, max_iterations) as a solver may use them; λ a new array, λ⁰ where start is None.

    Where a row of A is 0 only one λ_i is right, and λ starts with that.
    Raises ValueError or TypeError, which name the argument.
    """
    if not isinstance(problem, (LCP, ConeProblem)):
        raise TypeError(f"problem must be an LCP or a ConeProblem, but is of type {type(problem).__name__}")
    λ = problem.origin.copy() if start is None else inputs.array("start", start, (problem.n,))
    if len(problem.zero_rows):
        bound = problem.bounds_of_zero_rows(λ)
        λ[problem.zero_rows] = np.where(np.isfinite(bound), bound, λ[problem.zero_rows])
    tolerance = inputs.number("tolerance", tolerance, above=0)
    max_iterations = inputs.whole("max_iterations", max_iterations)
    if max_iterations > _MOST:
        raise ValueError(f"max_iterations must be at most {_MOST:g}, but is {max_iterations}")
    return λ, tolerance, max_iterations


def solved_already(problem, λ, tolerance):
    """The Solution where nothing is left to do, else None: the start λ solves the problem, or λ⁰ does exactly
    (any other λ then has an infinite residual, so there is nothing to come near to).
    """
    for guess in (λ, problem.origin):
        w = problem.w(guess)
        seems = problem.residual(guess, w) <= (tolerance if guess is λ else 0)
        if seems and not is_unseen(problem, guess, w, tolerance):
            return finish(problem, guess, 0, SOLVED, tolerance)
    return None


def unsuitable(problem, λ, tolerance, reason):
    """The Solution of a method that can't treat this problem, and says why."""
    return finish(problem, λ, 0, UNSUITABLE, tolerance, reason=reason)


def why_unsuitable(problem):
    """Why a method that divides by A_ii, row by row, can't treat a problem; "" where it can."""
    if not isinstance(problem, LCP):
        return "This method clips row by row, and can't treat the exact friction cone: take a cone method."
    if problem.scale == np.inf:
        return "b/A_ii overflows: the numbers of this problem are too far apart."
    diagonal = problem.A.diagonal()
    bad = np.flatnonzero(~(diagonal > 0))
    if len(bad):
        i = bad[0]
        return f"This method divides by A_ii, which must be positive, but is {diagonal[i]:g} in row {i}."
    return ""


def iterate(
    method, problem, start, tolerance, max_iterations, *, options=(), functions=(), why_not=why_unsuitable
):
    """Run a method and return its Solution.

    method(follow, row, rows, change, A, terms, λ, scale, tolerance, history, *options) -> (iterations, code),
    see ``operators`` and ``gauss_seidel.sweeps``; functions: what it takes after ``change``.
    options: values, or functions of the problem giving them.
    why_not(problem): a sentence if the method can't treat it, else "".
    """
    λ, tolerance, most = checked(problem, start, tolerance, max_iterations)
    done_already = solved_already(problem, λ, tolerance)
    if done_already:
        return done_already
    reason = why_not(problem)
    if reason:
        return unsuitable(problem, λ, tolerance, reason)
    A = arrays(problem.A)
    kernel = for_form(method, type(A), *functions)
    given = tuple(option(problem) if callable(option) else option for option in options)
    history, done, aim = np.empty(most + 1), 0, tolerance
    with np.errstate(all="ignore"):  # the compiled form can't warn; the status will tell
        while True:
            count, code = kernel(A, problem.terms, λ, problem.scale, aim, history[done:], *given)
            done += count
            # the kernel measured its own running sums; measured afresh, λ may still be a little off
            if code != SOLVED or done == most or aim == 0 or problem.residual(λ) <= tolerance:
                break
            aim /= 16
    code = MAX_ITERATIONS if code == SOLVED and done == most else code
    return finish(problem, λ, done, code, tolerance, history=history[: done + 1])
