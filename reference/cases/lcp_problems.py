"""LCPs with known answers: ``LCP_PROBLEMS["kostreva"]()`` has problem, answer, source, what_is_hard.

Each entry is a function of its parameters, all with defaults, that returns a Known. Random ones take a seed.

Slides S13–S17; lectures/06_pivoting_lcp.md.
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse

from .. import inputs
from ..factored import Factored
from ..lcp import LCP, ConeProblem
from .case import Catalogue

CPS = "Cottle, Pang & Stone, The Linear Complementarity Problem (2009)"


@dataclass(frozen=True)
class Known:
    """A problem, and its answer λ (n,) where it is known and unique; None where there is none or several.

    solvable: whether there is any answer. w (n,): that of all answers, where only that is known and unique.
    ``error(λ)`` is the largest error of λ relative to the largest λ_i, or, where λ isn't unique, of w
    relative to the largest b_i.
    """

    problem: LCP | ConeProblem
    answer: np.ndarray | None
    source: str
    what_is_hard: str
    solvable: bool = True
    w: np.ndarray | None = None

    def error(self, λ):
        """max |λ − answer| / max |answer|, the plain error where that is 0; or that of w over max |b|."""
        if self.answer is None:
            return np.abs(self.problem.w(λ) - self.w).max() / np.abs(self.problem.b).max()
        size = np.abs(self.answer).max(initial=0)
        return np.abs(np.asarray(λ) - self.answer).max(initial=0) / (size if size > 0 else 1)


def easy():
    """Two rows, both active."""
    answer = np.array([4 / 3, 7 / 3])
    return Known(LCP([[2, 1], [1, 2]], (-5, -6)), answer, CPS, "nothing")


def kostreva():
    """A P-matrix on which much goes round in circles."""
    problem = LCP([[1, 2, 0], [0, 1, 2], [2, 0, 1]], -np.ones(3))
    hard = "P, but not symmetric: Lemke with first-index ties, Gauss–Seidel and min-map Newton all cycle"
    return Known(problem, np.full(3, 1 / 3), "Kostreva, Math. Programming 16 (1979) 129", hard)


def murty_2_8():
    """Murty's example 2.8."""
    M = [[1, -1, -1, -1], [-1, 1, -1, -1], [1, 1, 2, 0], [1, 1, 0, 2]]
    source = "Murty, Linear Complementarity, Linear and Nonlinear Programming (1988), example 2.8"
    hard = "neither symmetric nor P: methods of splitting fail, Lemke takes 5 pivots"
    return Known(LCP(M, (3, 5, -9, -5)), np.array([2.0, 1, 3, 1]), source, hard)


def lemke_exponential(n=8):
    """2s below a unit diagonal: Lemke needs 2ⁿ pivots."""
    n = inputs.whole("n", n, least=1)
    b = -(2.0 ** (n + 1) - 2.0 ** (n - np.arange(n)))
    answer = np.zeros(n)
    answer[0] = 2.0**n
    return Known(
        LCP(_twos(n), b), answer, f"after {CPS}, section 4.10", "Lemke takes 2ⁿ pivots, least index 1"
    )


def murty_exponential(n=8):
    """2s above a unit diagonal: least index needs 2ⁿ − 1 pivots."""
    n = inputs.whole("n", n, least=1)
    answer = np.zeros(n)
    answer[-1] = 1
    hard = "least index takes 2ⁿ − 1 pivots, Lemke 2n or 2"
    return Known(LCP(_twos(n).T, -np.ones(n)), answer, "Murty, Math. Programming Study 7 (1978) 138", hard)


def _twos(n):
    return np.eye(n) + 2 * np.tril(np.ones((n, n)), -1)


def jacobi_fails(n=3, coupling=0.9):
    """Equal rows, so coupled that renewing all at once overshoots: Jacobi flips between e and 0."""
    n, c = inputs.whole("n", n, least=1), inputs.number("coupling", coupling, least=0)
    A = (1 - c) * np.eye(n) + c * np.ones((n, n))
    answer = np.full(n, 1 / (1 + c * (n - 1)))
    return Known(LCP(A, -np.ones(n)), answer, "by symmetry", "positive definite, and Jacobi diverges")


def column(n=10, heavy=1.0, factored=False, chain=False):
    """A column of n boxes of 1 kg, the top one ``heavy`` times that, λ as n impulses from below, g h = 1.

    Row i is between box i − 1 (or the ground) and box i; λ_i carries all that lies above. chain: the same
    upside down, n links that hang from one another, a linear system: rows without bounds.
    """
    n, heavy = inputs.whole("n", n, least=1), inputs.number("heavy", heavy, above=0)
    mass = np.ones(n)
    mass[-1] *= heavy
    bodies = np.stack([np.arange(n) - 1, np.arange(n)], axis=1)
    J = np.broadcast_to([[-1.0], [1.0]], (n, 2, 1))
    A = Factored(bodies, J, J / np.where(bodies < 0, np.inf, mass[bodies])[:, :, None], n)
    b = np.zeros(n)
    b[0] = -1  # all boxes fall alike, only the lowest towards something that doesn't
    answer = np.cumsum(mass[::-1])[::-1].copy()
    hard = "what the ground does reaches the top in n sweeps at best; with a heavy top in ever more (S15)"
    lower = -np.inf if chain else 0
    return Known(LCP(A if factored else A.tosparse(), b, lower), answer, "statics", hard)


def tower(n=10, aspect=1.0, inertia=1.0):
    """A column of n boxes in the plane that touch at both ends of their width, 1 kg, g h = 1, no friction.

    aspect: a box's height over its width. inertia: times that of a box filled evenly. Only κ = m r²/I of a
    contact counts, r half the width: 3/(1 + aspect²)/inertia. Rows 2i, 2i + 1 are the left and right contact
    below box i; each carries half of what lies above.
    """
    n = inputs.whole("n", n, least=1)
    aspect, inertia = inputs.number("aspect", aspect, above=0), inputs.number("inertia", inertia, above=0)
    κ = 3 / (1 + aspect**2) / inertia
    lower = np.repeat(np.arange(n) - 1, 2)
    bodies = np.stack([lower, lower + 1], axis=1)
    lever = np.tile([-1.0, 1.0], n)
    J = np.stack([np.ones(2 * n), lever], axis=1)[:, None, :] * [[[-1.0], [1.0]]]  # velocity, and r ω
    A = Factored(bodies, J, J * (1, κ), n)
    b = np.zeros(2 * n)
    b[:2] = -1
    answer = np.repeat((n - np.arange(n)) / 2.0, 2)
    hard = "long narrow boxes (κ small) and small inertia (κ large) converge slowly, and Jacobi fails (S15)"
    return Known(LCP(A.tosparse(), b), answer, "statics", hard)


def heavy_on_light(ratio=100.0):
    """A box of mass ``ratio`` on one of mass 1 (a column of two)."""
    return column(2, ratio)


def no_solution():
    """w_1 + w_2 = −2, whatever λ is."""
    problem = LCP([[1, -1], [-1, 1]], (-1, -1))
    return Known(
        problem, None, "add the rows", "positive semidefinite and singular: infeasible", solvable=False
    )


def several_solutions():
    """λ = (1, 0), (0, 1), (1/3, 1/3): a game of two who want to differ."""
    return Known(
        LCP([[1, 2], [2, 1]], (-1, -1)), None, "enumeration", "three solutions, none the limit of all"
    )


def redundant(n=4):
    """A table on n legs above one point: A = eeᵀ, so only the sum of λ is known (1)."""
    n = inputs.whole("n", n, least=1)
    return Known(LCP(np.ones((n, n)), -np.ones(n)), None, "statics", "singular: any λ ≥ 0 of sum 1 will do")


def zero_diagonal():
    """A game of two rows: A_ii = 0, so nothing can be divided by it."""
    answer = np.array([2.0, 1.0])
    return Known(LCP([[0, 1], [1, 0]], (-1, -2)), answer, "by hand", "zero diagonal: λ_1 is set by row 2")


def degenerate(n=6):
    """b = 0 in every other row: λ and w are both 0 there."""
    n = inputs.whole("n", n, least=1)
    A = 2 * np.eye(n) + np.eye(n, k=1) + np.eye(n, k=-1)
    answer = (np.arange(n) % 2 == 0).astype(float)
    return Known(LCP(A, -A @ answer), answer, "planted", "λ_i = w_i = 0 in half of the rows")


def painleve():
    """The sliding rod that jams (μ = 2, beyond 4/3), at velocity level; (n, t+, t−, σ), λ is not unique."""
    M = [[1.6, -1.2, 1.2, 0], [-1.2, 3.4, -3.4, 1], [1.2, -3.4, 3.4, 1], [2, -1, -1, 0]]
    source = "Stewart, SIAM Review 42 (2000) 3; Painlevé 1895"
    return Known(LCP(M, (-0.1, -1, 1, 0)), None, source, "copositive only, zero diagonal, degenerate")


def sliding_contact(law="ncp"):
    """One contact whose two laws differ: Coulomb's, and the convex one, which lifts it off."""
    answer = {"ncp": (0.1, -0.05, 0), "ccp": (0.48, -0.24, 0)}
    problem = ConeProblem(np.eye(3), (-0.1, 1, 0), 0.5, law=law)
    return Known(problem, np.array(answer[law]), "by hand", "ncp is no minimum of anything")


def dragged_block(pull=0.3, mu=0.5):
    """A block pressed down by 1 and pulled by ``pull``, rows (n, t), friction bounds; slips past μ."""
    pull, mu = inputs.number("pull", pull), inputs.number("mu", mu, least=0)
    problem = LCP(np.eye(2), (-1, pull), friction=([1], [0], mu))
    return Known(problem, np.array([1.0, -np.clip(pull, -mu, mu)]), "by hand", "the bound is an unknown, too")


def planted(kind="pd", n=20, seed=0, density=1.0, active=0.5, scale=1.0):
    """A random problem with a planted answer: λ > 0 in a share ``active`` of the rows, w > 0 in the others.

    kind: "pd" symmetric positive definite, "psd" of half rank, "p" a P-matrix that is not symmetric,
    "copositive" with no negative number but an indefinite symmetric part. Only "pd" and "p" have no other
    answer. density: of the factor that A is made of; below 1, A is sparse. scale: λ is so much larger.
    """
    inputs.choice("kind", kind, _MATRICES)
    random = np.random.default_rng(seed)
    A = _MATRICES[kind](random, inputs.whole("n", n), density)
    on = random.random(n) < active
    answer = scale * np.where(on, 0.5 + random.random(n), 0)
    w = scale * np.where(on, 0, 0.5 + random.random(n))
    if density < 1:
        A = scipy.sparse.csr_array(A)
    unique = kind in ("pd", "p")
    hard = {"psd": "singular", "copositive": "indefinite"}.get(kind, "nothing")
    return Known(LCP(A, w - A @ answer), answer if unique else None, f"planted, {kind}", hard)


def _factor(random, rows, columns, density):
    G = random.normal(size=(rows, columns))
    return G if density >= 1 else G * (random.random(G.shape) < density)


def _positive_definite(random, n, density):
    G = _factor(random, n, n, density)
    return G @ G.T / max(n * density, 1) + 0.1 * np.eye(n)


def _semidefinite(random, n, density):
    G = _factor(random, n, n // 2, density)
    return G @ G.T / max(n * density, 1)


def _p_matrix(random, n, density):
    """Positive definite plus skew: xᵀAx > 0 for all x ≠ 0, so every principal minor is positive."""
    G = _factor(random, n, n, density)
    return _positive_definite(random, n, density) + (G - G.T) / np.sqrt(max(n * density, 1))


def _copositive(random, n, density):
    return np.abs(_factor(random, n, n, density)) + 0.1 * np.eye(n)


_MATRICES = {"pd": _positive_definite, "psd": _semidefinite, "p": _p_matrix, "copositive": _copositive}

LCP_PROBLEMS = Catalogue(
    "problem",
    {
        function.__name__: function
        for function in (
            easy, kostreva, murty_2_8, lemke_exponential, murty_exponential, jacobi_fails, column, tower,
            heavy_on_light, no_solution, several_solutions, redundant, zero_diagonal, degenerate, painleve,
            sliding_contact, dragged_block, planted,
        )
    },
)  # fmt: skip
