"""The LCP and its solvers: one problem, one measure of error, one file a method.

    problem = LCP(A, b)
    solution = gauss_seidel(problem, start=None, tolerance=1e-10, max_iterations=1000)
    solution.solved, solution.lam, solution.reason

``problem`` says what is asked, ``merit`` how wrong a λ is, ``solution`` decides whether it is one.

**A method** is a file of its own with one public function, ``solver(problem, start=None, tolerance=1e-10,
max_iterations=1000, *, …)``, which is named in ``_METHODS`` below. Its loop is a compiled kernel over flat
arrays; around it there is only

    λ, tolerance, max_iterations = checked(problem, start, tolerance, max_iterations)   # bad arguments raise
    already = solved_already(problem, λ, tolerance)                                     # a Solution, or None
    unsuitable(problem, λ, tolerance, "why, in a sentence")                             # a Solution
    finish(problem, λ, iterations, code, tolerance, history=…, certificate=…, record=…) # a Solution

A solver raises for bad arguments only. What goes wrong afterwards is a status with a reason, and ``finish``
measures every λ anew, so that no kernel can call a wrong answer solved.

**Row by row** (splitting, unit 07): ``iterate(kernel, problem, start, tolerance, max_iterations, options=…)``
is the whole solver. The kernel is written once for every form of A,

    kernel(follow, row, rows, change, A, terms, λ, scale, tolerance, history, *options) -> (iterations, code)

For example, all of ``sor`` but its docstring:

    def sor(problem, start=None, tolerance=1e-10, max_iterations=1000, *, omega=1.6, every=None):
        options = natural_order, relaxation(omega), how_often(every)
        return iterate(sweeps, problem, start, tolerance, max_iterations, options=options)

The first four of the kernel come from ``operators``, ``terms`` is what stands beside A, λ is start and
answer, and history[k] is the residual (merit over ``scale``) after k iterations; the last is for ``finish``.
A step of a simulation takes the same kernel, ``for_form(kernel, Factors)``, by ``bind``, and calls it on
arrays of its own.

**Whole vectors** (Newton, unit 08): ``problem.w(λ)`` takes every form of A; what is left is one linear system
an iteration, dense or sparse (``direct``). Gradients (``apgd``) are compiled as the sweeps are.

**The exact cone** (unit 08): ``cone_gauss_seidel``, ``cone_apgd``, ``cone_newton``, for a ``ConeProblem``;
a step takes ``cone_newton_kernel`` on arrays of its own.

**Pivoting** (unit 06): a rule of principal pivots is ``kernel(state, most, *options) -> (pivots, code)``, and
``rounds.by_principal_pivots`` the rest; ``lemke`` and ``enumeration`` take the plain form (``standard``).

Slides S11–S17; lectures/06_pivoting_lcp.md, lectures/07_iterative_lcp.md, lectures/08_newton_lcp.md.
"""

from .apgd import apgd
from .block import block_gauss_seidel, block_jacobi
from .cone_apgd import cone_apgd
from .cone_gauss_seidel import cone_gauss_seidel
from .cone_newton import cone_newton
from .dantzig import dantzig
from .enumeration import enumeration
from .fischer import fischer_newton
from .gauss_seidel import gauss_seidel
from .interior_point import interior_point
from .jacobi import damped_jacobi, jacobi
from .lemke import lemke
from .min_map import min_map_newton
from .murty import murty
from .nncg import nncg
from .problem import LCP, ConeProblem
from .solution import STATUSES, Solution
from .sor import red_black, sor, symmetric_gauss_seidel

_METHODS = (
    *(enumeration, murty, dantzig, lemke),  # pivoting
    *(jacobi, damped_jacobi, gauss_seidel, symmetric_gauss_seidel, sor, red_black),  # splitting
    *(block_jacobi, block_gauss_seidel),
    *(min_map_newton, fischer_newton, interior_point, nncg, apgd),
    *(cone_gauss_seidel, cone_apgd, cone_newton),
)
SOLVERS = {method.__name__: method for method in _METHODS}

__all__ = ["LCP", "SOLVERS", "STATUSES", "ConeProblem", "Solution", *SOLVERS]
