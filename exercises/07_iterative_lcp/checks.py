"""The checks of exercise 07, iterative methods (slides S14–S17). Grader's side only."""

import numpy as np

import exercises
from exercises.grader.check import Case, Check, cause, cause_like
from exercises.grader.judges import an_array, equal

right = exercises.part("07_iterative_lcp", "answers")
engines = exercises.part("07_iterative_lcp", "engines")
given = exercises.part("07_iterative_lcp", "given")

ROUNDING = "Both sides do the same few dozen operations, so only rounding, about 1e-15, may differ."


def number(stream, low, high):
    return round(stream.uniform(low, high), 3)


def definite(stream, n, coupling=1.0):
    """A symmetric positive definite A with three decimals."""
    G = stream.normal(size=(n, n))
    A = np.round(coupling * G @ G.T / n, 3)
    return (A + A.T) / 2 + np.diag(np.round(stream.uniform(0.6, 1.6, n), 3))


# --- one sweep ----------------------------------------------------------------------------------------------


def once(A, b, lam, omega, r):
    return {"A": np.array(A), "b": np.array(b), "lam": np.array(lam), "omega": omega, "r": r}


def sweeps(stream):
    for _ in range(8):
        A, b = definite(stream, 5), np.round(stream.normal(size=5) - 0.5, 3)
        lam = np.round(stream.uniform(0, 1.5, 5), 3)
        ω = number(stream, 0.6, 1.4)
        yield Case("any λ, ω and r", once(A, b, lam, ω, round(ω + number(stream, 0.2, 0.5), 3)))


COLUMN = given.column(4)
START = [3.5, 2.0, 2.5, 0.5]
LIFT = [[2.0, 1.0, 0.5], [1.0, 3.0, 1.5], [0.5, 1.5, 2.0]]
AOR_SWEEP = Check(
    name="aor_sweep",
    title="one sweep of projected AOR",
    points=20,
    visible=(
        Case("ω = 1, r = 0: Jacobi", once(*COLUMN, START, 1.0, 0.0)),
        Case("ω = 1, r = 1: Gauss–Seidel", once(*COLUMN, START, 1.0, 1.0)),
        Case("ω = r = 1.6: SOR, as in the lecture", once(*COLUMN, START, 1.6, 1.6)),
        Case("at the answer nothing moves", once(*COLUMN, [4.0, 3.0, 2.0, 1.0], 0.8, 1.3)),
        Case(
            "a row that would pull is clipped to 0", once(LIFT, [-1.0, 0.9, 0.4], [0.4, 0.2, 0.3], 0.9, 1.4)
        ),
    ),
    hidden=lambda stream: list(sweeps(stream)),
    judge=an_array(equal(right.sweep, 1e-11)),
    why=ROUNDING,
    form="an array of n numbers, the new λ",
    section="Splitting a linear system",
    causes=(
        cause_like(
            "r is not used: this is SOR. ω goes with the old w_i, r with what has changed in this sweep.",
            lambda v: right.sweep(v, r=v["omega"]),
        ),
        cause_like(
            "What has changed in this sweep is left out: this is damped Jacobi.",
            lambda v: right.sweep(v, newest=False),
        ),
        cause_like("ω is left out.", lambda v: right.sweep(v, relaxed=False)),
        cause_like(
            "λ is clipped after the sweep. Clip each row right away, so that the next rows see it (S17).",
            lambda v: right.sweep(v, clipped="after"),
        ),
        cause_like("λ is not clipped: a contact can't pull.", lambda v: right.sweep(v, clipped="no")),
    ),
    hint="λ'_i = clip(λ_i − (ω w_i + r Σ_{j<i} A_ij (λ'_j − λ_j)) / A_ii), with w = A λ + b of the old λ.",
)


# --- friction -----------------------------------------------------------------------------------------------


def rubbing(A, b, lam, normal, mu, omega, r):
    start = {"A": np.array(A), "b": np.array(b), "lam": np.array(lam)}
    return {**start, "normal": np.array(normal), "mu": mu, "omega": omega, "r": r}


def rubbings(stream):
    normal = [-1, 0, -1, 2, 2]
    for _ in range(8):
        A, b = definite(stream, 5, 0.5), np.round(stream.normal(size=5), 3)
        b[[0, 2]] -= 1.5
        lam = np.round(stream.uniform(0, 1, 5), 3)
        ω, μ = number(stream, 0.6, 1.4), number(stream, 0.05, 0.4)
        yield Case("two contacts with friction", rubbing(A, b, lam, normal, μ, ω, number(stream, 0.8, 1.6)))


FRICTION_SWEEP = Check(
    name="friction_sweep",
    title="the same sweep, with friction",
    points=20,
    visible=(
        Case(
            "the first sweep: μ times the λ_n just renewed, not the old one",
            rubbing(np.eye(2), [-1.0, 0.9], [0.0, 0.0], [-1, 0], 0.5, 1.0, 1.0),
        ),
        Case(
            "friction may push either way",
            rubbing(np.eye(2), [-1.0, -0.9], [0.2, 0.0], [-1, 0], 0.3, 1.0, 1.0),
        ),
        Case(
            "it sticks: the bound doesn't matter",
            rubbing([[2.0, 0.5], [0.5, 1.0]], [-1.0, 0.1], [0.5, 0.1], [-1, 0], 0.8, 0.9, 1.2),
        ),
    ),
    hidden=lambda stream: list(rubbings(stream)),
    judge=an_array(equal(right.friction_sweep, 1e-11)),
    why=ROUNDING,
    form="an array of n numbers, the new λ",
    section="Clipping, within the iteration",
    causes=(
        cause_like(
            "Friction is clipped by the λ_n of before the sweep: take the one just renewed (S17).",
            lambda v: right.friction_sweep(v, bound="old"),
        ),
        cause_like(
            "Friction is clipped to 0 … μ λ_n: it may push either way, from −μ λ_n.",
            lambda v: right.friction_sweep(v, sides=1),
        ),
        cause_like("Friction is not clipped.", lambda v: right.friction_sweep(v, bound="none")),
        cause_like(
            "Friction is clipped to ±λ_n: μ is left out.",
            lambda v: right.friction_sweep(v, factor=1 / v["mu"]),
        ),
    ),
    hint="Where normal[i] is −1 clip below at 0. Else clip to ±μ times the new λ of row normal[i].",
)


# --- sweeps until it is right -------------------------------------------------------------------------------


def asked(A, b, omega, r, tolerance=1e-11, most=5000):
    return {"A": np.array(A), "b": np.array(b), "omega": omega, "r": r, "tolerance": tolerance, "most": most}


def solvable(stream):
    for _ in range(4):
        A, b = definite(stream, 6, 0.6), np.round(stream.normal(size=6) - 0.3, 3)
        b[0] = -1.5
        yield Case("a random problem", asked(A, b, number(stream, 0.5, 0.8), number(stream, 0.8, 1.1)))


SOLVE_AOR = Check(
    name="solve_aor",
    title="sweeps until the residual is small",
    points=15,
    visible=(
        Case("ten boxes", asked(*given.column(10), 1.2, 1.7)),
        Case("three coupled rows, where Jacobi fails", asked(*given.coupled(), 1.0, 1.0)),
        Case("no more than three sweeps are allowed", asked(*given.column(6), 1.0, 1.0, 1e-9, 3)),
        Case("0 is right already: nothing pushes", asked(np.eye(2), [1.0, 2.0], 1.0, 1.0)),
    ),
    hidden=lambda stream: list(solvable(stream)),
    judge=an_array(equal(right.solve, 1e-7)),
    why="A residual of 1e-11 leaves λ right to about 1e-9 on these problems, whose condition is below 200.",
    form="an array of n numbers, λ",
    section="When it must converge, and when not",
    causes=(
        cause_like(
            "λ is not clipped within the sweeps: rows that would pull disturb their neighbours.",
            lambda v: right.solve(v, lambda u: right.sweep(u, clipped="no")),
        ),
        cause_like(
            "More sweeps are done than `most` allows.",
            lambda v: right.solve(v, most=5000),
        ),
        cause(
            "λ doesn't solve the problem, nor are all sweeps done: look at what ends the loop.",
            lambda v, verdict: (
                v["most"] > 3 and given.residual(v["A"], v["b"], np.asarray(verdict.got, dtype=float)) > 1e-6
            ),
        ),
    ),
    hint="Start from zeros. Before each sweep look whether given.residual(A, b, lam) ≤ tolerance; stop after "
    "`most` sweeps in any case.",
    after=("aor_sweep",),
)


# --- the spectrum -------------------------------------------------------------------------------------------


def split(A, omega, r, free):
    return {"A": np.array(A), "omega": omega, "r": r, "free": np.array(free)}


def splits(stream):
    for _ in range(5):
        free = np.array([True, True, False, True, False])[stream.permutation(5)]
        yield Case(
            "some rows free",
            split(definite(stream, 5), number(stream, 0.6, 1.4), number(stream, 0.2, 0.5), free),
        )


ERROR_MATRIX = Check(
    name="error_matrix",
    title="what a sweep makes of an error",
    points=15,
    visible=(
        Case("ω = 1, r = 0: Jacobi", split(given.column(3)[0], 1.0, 0.0, [True] * 3)),
        Case("ω = r = 1.5: SOR", split(given.column(3)[0], 1.5, 1.5, [True] * 3)),
        Case("the second row is at its bound", split(LIFT, 0.9, 1.3, [True, False, True])),
    ),
    hidden=lambda stream: list(splits(stream)),
    judge=an_array(equal(right.matrix, 1e-10)),
    why="Solving with a triangular matrix of this size costs a digit or two of rounding.",
    form="an array (m, m) for the m free rows: rows at a bound have no error",
    section="How fast: the spectrum",
    causes=(
        cause_like(
            "r is not used: what is below the diagonal goes into D with r.",
            lambda v: right.matrix(v, r=v["omega"]),
        ),
        cause_like("What is below the diagonal is missing.", lambda v: right.matrix(v, r=0)),
    ),
    hint="From (diagonal + r·lower)(λ' − λ) = −ω w follows e' = (1 − ω (diagonal + r·lower)⁻¹ A) e. A column "
    "of it is what aor_sweep, unclipped and with b = 0, makes of a unit vector.",
)


def links(n, omega, r):
    return {"n": n, "omega": omega, "r": r}


CHAIN_RATE = Check(
    name="chain_rate",
    title="AOR's rate on a column of equal boxes",
    points=15,
    visible=(
        Case("Jacobi: cos(π/2n)", links(10, 1.0, 0.0)),
        Case("Gauss–Seidel: cos²(π/2n)", links(10, 1.0, 1.0)),
        Case("SOR with 1.9: ω − 1", links(10, 1.9, 1.9)),
        Case("neither", links(6, 1.1, 1.4)),
    ),
    hidden=lambda stream: [
        Case("any n, ω and r", links(int(stream.integers(2, 30)), number(stream, 0.5, 1.3), r))
        for r in np.round([*stream.uniform(0, 0.4, 3), *stream.uniform(1.6, 1.9, 5)], 3).tolist()
    ],
    judge=equal(right.chain_rate, 1e-7, floor=0.1),
    why="Near a double root the quadratic formula loses half of the digits: 1e-8.",
    form="a number",
    section="How fast: the spectrum",
    causes=(
        cause_like(
            "Where the root is of a negative number, η is complex: take the absolute value of that.",
            lambda v: right.chain_rate(v, real=True),
        ),
        cause_like(
            "These are the eigenvalues of a chain held at both ends, cos(kπ/(n+1)). On the ground it is "
            "free: cos((2k − 1)π/2n).",
            lambda v: right.chain_rate(v, ends="held"),
        ),
        cause_like(
            "r is not used: this is Young's formula, for SOR.",
            lambda v: right.chain_rate(v, largest=False),
        ),
    ),
    hint="For each μ_k solve η² + (2(ω−1) − ω r μ²) η + (ω−1)² − ω(ω−r) μ² = 0, and take the largest |η| "
    "of all. np.roots does it, too.",
)


# --- an engine ----------------------------------------------------------------------------------------------


def stacks(stream):
    for _ in range(4):
        count, mass, dt = int(stream.integers(2, 9)), number(stream, 0.5, 5), number(stream, 0.002, 0.05)
        yield Case("a stack", engines.stack(count, mass, dt))


STACK_FORCES = Check(
    name="stack_forces",
    title="the forces in a stack at rest",
    points=15,
    visible=tuple(Case(label, inputs) for label, inputs in engines.STACKS.items()),
    hidden=lambda stream: list(stacks(stream)),
    judge=an_array(equal(engines.STACK, 1e-4)),
    source=engines.STACK.source,
    why="pymunk's forces in a stack of up to 20 equal boxes are right to 1e-5 at 1 kHz and 100 iterations.",
    form="an array of `count` forces in N, from the ground up",
    section="How fast: the spectrum",
    causes=(
        cause_like("These are impulses: divide by dt.", lambda v: right.stack_forces(v, force=False)),
        cause_like(
            "The ground doesn't move: A of the lowest row is 1/m, not 2/m.",
            lambda v: right.stack_forces(v, ground="free"),
        ),
        cause_like(
            "All boxes fall alike, so only the lowest falls towards something: b is −g dt there, 0 above.",
            lambda v: right.stack_forces(v, pushed="all"),
        ),
        cause(
            "The forces are too small above, or all over: the sweeps ended too early.",
            lambda v, verdict: np.all(np.asarray(verdict.got) <= np.asarray(verdict.expected)),
        ),
    ),
    hint="A = tri/m with 2 on the diagonal (1 in the first row) and −1 beside it, b = (−g dt, 0, 0, …): "
    "solve_aor gives impulses.",
    after=("solve_aor",),
)


CHECKS = (AOR_SWEEP, FRICTION_SWEEP, SOLVE_AOR, ERROR_MATRIX, CHAIN_RATE, STACK_FORCES)
