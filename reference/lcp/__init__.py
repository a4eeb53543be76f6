"""LCP"""

from .gauss_seidel import gauss_seidel
from .problem import LCP, ConeProblem
from .solution import STATUSES, Solution

SOLVERS = {solver.__name__: solver for solver in (gauss_seidel,)}

__all__ = ["LCP", "SOLVERS", "STATUSES", "ConeProblem", "Solution", *SOLVERS]
