"""The checks of exercise 08, Newton's methods for the LCP (slide S14). Grader's side only."""

import numpy as np

import exercises
from exercises.grader.check import Case, Check, cause, cause_like
from exercises.grader.judges import equal
from exercises.grader.replies import Given

right = exercises.part("08_newton_lcp", "answers")

ROUNDING = "Both sides do the same few operations, so only rounding, about 1e-15, may differ."


# --- the function and its slopes ----------------------------------------------------------------------------


def pairs(a, b, tau=0.9):
    return {"a": np.array(a, dtype=float), "b": np.array(b, dtype=float), "tau": tau}


def random_pairs(stream):
    for _ in range(5):
        a, b = np.round(stream.uniform(-3, 3, (2, 8)), 3)
        a[0], b[0], a[1], b[1] = abs(a[0]) + 0.5, abs(b[0]) + 0.5, -abs(a[1]) - 0.5, -abs(b[1]) - 0.5
        yield Case("pairs of all signs", pairs(a, b, round(stream.uniform(0.3, 0.9), 3)))


PENALISED = Check(
    name="penalised",
    title="the penalised Fischer–Burmeister function",
    points=10,
    visible=(
        Case("on the corner it is 0", pairs([0, 2, 0], [3, 0, 0])),
        Case("inside: both positive", pairs([3, 1], [4, 1])),
        Case("elsewhere: the penalty is 0", pairs([-1, 2, -3], [1, -1, -4], 0.5)),
    ),
    hidden=lambda stream: list(random_pairs(stream)),
    judge=equal(right.penalised, 1e-12),
    why=ROUNDING,
    form="an array as long as a",
    section="Another function for the same corner",
    causes=(
        cause_like("The penalty is subtracted: it is to be added.", lambda v: right.penalised(v, sign=-1)),
        cause_like(
            "The penalty is a b for all signs: where one of the two is not positive it must be 0.",
            lambda v: right.penalised(v, parts=False),
        ),
        cause_like("The root of a² + b² is missing.", lambda v: right.penalised(v, root=False)),
        cause_like(
            "τ and 1 − τ are swapped: τ is the share of Fischer–Burmeister.",
            lambda v: right.penalised(v, shares="swapped"),
        ),
    ),
    hint="tau (a + b − √(a² + b²)) + (1 − tau) max(a, 0) max(b, 0), element by element.",
)

SLOPES = Check(
    name="slopes",
    title="its derivatives, and a choice at the kink",
    points=15,
    visible=(
        Case("at the kink (0, 0): the limit along the diagonal", pairs([0.0], [0.0])),
        Case("on the two arms of the corner", pairs([2, 0], [0, 3])),
        Case("inside: the penalty's slope is the other factor", pairs([3, 1], [4, 2], 0.5)),
    ),
    hidden=lambda stream: list(random_pairs(stream)),
    judge=equal(right.slopes, 1e-12),
    why=ROUNDING,
    form="two arrays, the derivatives by a and by b",
    section="Another function for the same corner",
    causes=(
        cause_like(
            "The penalty has slopes, too: inside, (1 − τ) b by a and (1 − τ) a by b.",
            lambda v: right.slopes(v, penalty=False),
        ),
        cause_like(
            "The penalty's slopes are swapped: the derivative of a b by a is b.",
            lambda v: right.slopes(v, swapped=True),
        ),
        cause_like(
            "At (0, 0) the slopes are 0: so the row of Newton's matrix would be 0, and the matrix singular.",
            lambda v: right.slopes(v, corner=0.0),
        ),
    ),
    hint="By a: tau (1 − a/√(a² + b²)), and (1 − tau) b where both are positive. At (0, 0): tau (1 − 1/√2).",
)


# --- Newton's matrix and the line search --------------------------------------------------------------------


def p_matrix(stream, n, skew):
    """Positive definite plus skew: each principal minor is positive."""
    G, S = stream.normal(size=(2, n, n))
    return np.round(G @ G.T / n + skew * (S - S.T), 3) + 0.05 * np.eye(n)


def at(M, q, lam, tau=0.9):
    return dict(zip(("M", "q", "lam"), (np.array(x, dtype=float) for x in (M, q, lam)), strict=True)) | {
        "tau": tau
    }


def matrices(stream):
    for n in (2, 4, 5):
        q, lam = np.round(stream.normal(size=(2, n)), 3)
        yield Case("any λ", at(p_matrix(stream, n, 1.0), q, lam, round(stream.uniform(0.3, 0.9), 3)))


NEWTON_MATRIX = Check(
    name="newton_matrix",
    title="one Jacobian of the equation",
    points=15,
    visible=(
        Case("one row", at([[2]], [-3], [1])),
        Case("M not symmetric: rows and columns differ", at([[1, 2], [0, 1]], [-2, 1], [0.5, 1.5])),
    ),
    hidden=lambda stream: list(matrices(stream)),
    judge=equal(right.newton_matrix, 1e-11),
    why="A product M λ and a product of rows: rounding is about 1e-15.",
    form="an array (n, n)",
    section="Fischer–Burmeister: a corner rounded off",
    causes=(
        cause_like(
            "D_b multiplies the columns of M: the derivative of row i by w_i goes with the whole row i.",
            lambda v: right.newton_matrix(v, columns=True),
        ),
        cause_like(
            "The diagonal D_a is missing: λ_i stands in row i by itself, too.",
            lambda v: right.newton_matrix(v, own=False),
        ),
    ),
    hint="Row i: (derivative by b)_i times row i of M, plus (derivative by a)_i on the diagonal, at a = λ, "
    "b = M λ + q.",
)


def searched(M, q, lam, step, slope):
    values = {name: np.array(x, dtype=float) for name, x in (("lam", lam), ("step", step))}
    energy = Given("min_map_energy", M=np.array(M, dtype=float), q=np.array(q, dtype=float))
    return {"psi": energy, **values, "slope": float(slope)}


def searches(stream):
    for k in range(6):
        n = 4
        M, q = p_matrix(stream, n, 1.0), stream.normal(size=n)
        lam = stream.normal(size=n)
        w = M @ lam + q
        H = np.where((lam < w)[:, None], np.eye(n), M)
        gradient = H.T @ np.minimum(lam, w)
        length = 4.0**k * 0.3  # ever longer steps downhill need ever more halvings
        step = -length * gradient
        yield Case("a step against the gradient", searched(M, q, lam, step, gradient @ step))


STEP_LENGTH = Check(
    name="step_length",
    title="the line search",
    points=15,
    visible=(
        Case("a good step is taken whole", searched([[1]], [-2], [0], [2], -4)),
        Case("eight times too far", searched([[1]], [-2], [0], [16], -32)),
        Case(
            "just downhill, but not enough",
            searched([[1]], [0], [1], [-1.99995], -1.99995),
        ),
    ),
    hidden=lambda stream: list(searches(stream)),
    judge=equal(right.step_length, 1e-12),
    why="t is a power of ½, which is exact.",
    form="a number",
    section="The line search",
    causes=(
        cause_like(
            "Any decrease is taken: it must be at least 1e-4 t·slope, or steps could become ever smaller "
            "and never arrive.",
            lambda v: right.step_length(v, share=0.0),
        ),
        cause_like("The first step to try is 1, not ½.", lambda v: right.step_length(v, first=0.5)),
        cause_like(
            "One halving too many: return the t that passed the test.",
            lambda v: right.step_length(v, further=0.5),
        ),
        cause_like(
            "The whole slope is asked for: a share of 1e-4 of it is enough; a curved ψ never gives all.",
            lambda v: right.step_length(v, share=1.0),
        ),
    ),
    hint="Begin with t = 1. While psi(lam + t step) > psi(lam) + 1e-4 t slope, halve t.",
)


# --- the whole method ---------------------------------------------------------------------------------------


def lcp(M, q, start, tau=0.9):
    names = zip(("M", "q", "start"), (M, q, start), strict=True)
    return {name: np.array(x, dtype=float) for name, x in names} | {"tau": tau}


def planted(stream, n, skew, reach):
    """A random P-matrix, and q for which λ > 0 in about half of the rows and w > 0 in the others."""
    M = p_matrix(stream, n, skew)
    λ = np.where(stream.random(n) < 0.5, stream.random(n) + 0.5, 0)
    w = np.where(λ > 0, 0, stream.random(n) + 0.5)
    return lcp(M, w - M @ λ, reach * stream.normal(size=n))


def hard_problems(stream):
    for n in (3, 6, 8):
        yield Case("a random P-matrix", planted(stream, n, 1.0, 1.0))
        yield Case("far from symmetric, from far away", planted(stream, n, 30.0, 10.0))


def wild(seed):
    """One on which full steps alone don't arrive."""
    return planted(np.random.default_rng(seed), 6, 30.0, 10.0)


KOSTREVA = [[1, 2, 0], [0, 1, 2], [2, 0, 1]]
TWOS = np.eye(6) + 2 * np.tril(np.ones((6, 6)), -1)
SOLVE = Check(
    name="solve",
    title="the LCP solved, on problems that are hard for others",
    points=25,
    visible=(
        Case("easy", lcp([[2, 1], [1, 2]], [-5, -6], [0, 0])),
        Case("Kostreva's, from where min-map Newton goes round", lcp(KOSTREVA, [-1, -1, -1], [1, 0, 0])),
        Case(
            "on which Lemke's method takes 64 pivots",
            lcp(TWOS, -(2.0**7 - 2.0 ** (6 - np.arange(6))), np.zeros(6)),
        ),
        Case("λ and w both 0 in a row", lcp([[2, 1], [1, 2]], [-2, -1], [3, 3])),
        Case("far from symmetric: full steps alone don't arrive", wild(43)),
    ),
    hidden=lambda stream: list(hard_problems(stream)),
    judge=equal(right.solve, 1e-6),
    why="M is a P-matrix, so there is one λ. Newton's method doubles the right digits in each step near it: "
    "1e-12 costs no more than one step beyond 1e-6.",
    form="an array (n,)",
    section="The line search",
    causes=(
        cause_like(
            "It is Newton's method with full steps: it doesn't arrive. Shorten each step by step_length.",
            lambda v: right.solve(v, search=False, most=200),
        ),
        cause(
            "The iteration ends too early: go on until the largest |φ_i| is below 1e-12.",
            lambda v, verdict: 1e-6 < verdict.error < 1e-1,
        ),
        cause(
            "λ has negative numbers: it is not even within its bounds.",
            lambda v, verdict: np.min(np.array(verdict.got, dtype=float), initial=0) < -1e-6,
        ),
    ),
    hint="φ = penalised(λ, w, tau), ψ = ½ Σ φ². Solve H Δ = −φ, then λ ← λ + t Δ with "
    "t = step_length(ψ, λ, Δ, −Σ φ²): H Δ = −φ makes that the slope of ψ.",
)


def smooth(M, q, mu):
    return {"M": np.array(M, dtype=float), "q": np.array(q, dtype=float), "mu": mu}


def smooth_problems(stream):
    for n in (2, 4, 6):
        values = planted(stream, n, 1.0, 0.0)
        yield Case("a random P-matrix", smooth(values["M"], values["q"], round(stream.uniform(0.05, 2), 3)))


ON_PATH = Check(
    name="on_path",
    title="a point of the central path",
    points=20,
    visible=(
        Case("one row: λ² − λ = 0.25", smooth([[1]], [-1], 0.5)),
        Case("two rows", smooth([[2, 1], [1, 2]], [-5, -6], 1.0)),
        Case("Kostreva's, near the end of the path", smooth(KOSTREVA, [-1, -1, -1], 0.01)),
    ),
    hidden=lambda stream: list(smooth_problems(stream)),
    judge=equal(right.on_path, 1e-7),
    why="For a P-matrix there is one such λ, and Newton's method on a smooth function finds it to rounding.",
    form="an array (n,)",
    section="Interior points: the corner as the end of a path",
    causes=(
        cause_like(
            "λ_i w_i is μ, not μ²: under the root stands 4 μ².", lambda v: right.on_path(v, np.sqrt(v["mu"]))
        ),
        cause_like(
            "λ_i w_i is μ²/4: under the root stands 4 μ², not μ².", lambda v: right.on_path(v, v["mu"] / 2)
        ),
        cause_like(
            "That is the solution of the LCP, with μ = 0: the smoothing is left out.",
            lambda v: right.on_path(v, 1e-9),
        ),
    ),
    hint="Newton's method on λ + w − √((λ − w)² + 4 μ²) = 0, with your step_length. With s = (λ − w)/√(…), "
    "the matrix is (1 − s) on the diagonal, plus (1 + s) times the rows of M.",
)

CHECKS = (PENALISED, SLOPES, NEWTON_MATRIX, STEP_LENGTH, SOLVE, ON_PATH)
