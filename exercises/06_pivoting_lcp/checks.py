"""The checks of exercise 06, pivoting methods for the LCP (slides S13, S14). Grader's side only."""

import numpy as np

import exercises
from exercises.grader.check import Case, Check, cause, cause_like
from exercises.grader.judges import equal, word
from exercises.grader.replies import Reply

right = exercises.part("06_pivoting_lcp", "answers")
given = exercises.part("06_pivoting_lcp", "given")

ROUNDING = "Some ten systems of a few well-conditioned equations: both sides differ by rounding, about 1e-13."
PLAIN = np.array([[2.0, 1], [1, 2]]), np.array([-5.0, -6])
HARD_B = np.array([-1.0, -0.9, -1.2])


def p_matrix(stream, n):
    """Positive definite plus a strong skew part: P, far from symmetric, and of three decimals."""
    G, S = stream.normal(size=(n, n)), stream.normal(size=(n, n))
    return np.round(G @ G.T / n + 0.5 * np.eye(n) + 1.5 * (S - S.T), 3)


def clear(v):
    """Whether each choice has an answer, and no number that decides is anywhere near 0."""
    n = len(v["b"])
    for code in range(2**n):
        inside = (code >> np.arange(n)) % 2 == 1
        if inside.any() and np.linalg.cond(v["A"][np.ix_(inside, inside)]) > 1e8:
            return False
        if np.abs(right.values_of(v["A"], v["b"], inside)).min() < 1e-4:
            return False
    return True


def drawn(stream, make, good, number):
    """So many cases from make(stream) for which good(values) holds."""
    found = []
    while len(found) < number:
        values = make(stream)
        if clear(values) and good(values):
            found.append(values)
    return found


# On a ring of five with 2.5: where all at once goes round, where Bard's rule does, where patience tells.
ROUND = np.array([-0.813, -2.126, -0.029, 0.634, 1.242]), np.array([0.381, -0.395, -0.61, -0.02, 0.672])
BARD_ROUND = np.array([0.304, -0.301, -0.282, 0.32, 0.318])
PATIENCE = (
    (3, np.array([0.768, 1.279, -0.119, -2.11, -0.359])),
    (1, np.array([0.401, -0.173, -1.093, 0.48, 0.332])),
)


def near(stream, b):
    """The ring with a b that is nearly this one, in other units."""
    moved = b * (1 + 0.03 * stream.uniform(-1, 1, len(b))) * stream.uniform(0.5, 2)
    return {"A": given.ring(len(b), 2.5), "b": np.round(moved, 4)}


def random_p(stream, low=3, high=6):
    n = int(stream.integers(low, high))
    return {"A": p_matrix(stream, n), "b": np.round(stream.normal(size=n) - 0.3, 3)}


def random_any(stream):
    n = int(stream.integers(2, 5))
    return {"A": np.round(stream.normal(size=(n, n)), 3), "b": np.round(stream.normal(size=n), 3)}


# --- cones and pivots ---------------------------------------------------------------------------------------


def hidden_cones(stream):
    some = drawn(stream, random_any, lambda v: True, 5)
    some += drawn(stream, random_any, lambda v: right.holding_cones(v) > 1, 2)
    rest = drawn(stream, random_any, lambda v: right.holding_cones(v) != right.holding_cones(v, False), 2)
    for v in rest[:1]:
        some.append({"A": v["A"], "b": np.abs(v["b"])})
    return [Case("a random matrix", v) for v in [*some, *rest] if clear(v)]


HOLDING_CONES = Check(
    name="holding_cones",
    title="in how many complementary cones b lies",
    points=15,
    visible=(
        Case("two boxes: one", {"A": PLAIN[0], "b": PLAIN[1]}),
        Case("a game of two: three", {"A": np.array([[1.0, 2], [2, 1]]), "b": np.array([-1.0, -1.5])}),
        Case("all part: only the cone of the w", {"A": PLAIN[0], "b": np.array([1.0, 2])}),
    ),
    hidden=hidden_cones,
    judge=word(right.holding_cones),
    why="A count has no tolerance; no number that decides is nearer to 0 than 1e-4.",
    form="a whole number",
    section="The problem, and 2ⁿ ways to solve it",
    causes=(
        cause_like("w ≥ 0 is not looked at.", lambda v: right.holding_cones(v, heed_w=False)),
        cause_like(
            "The choice in which no λ may be positive is left out.",
            lambda v: right.holding_cones(v, empty=False),
        ),
    ),
    hint="Count the choices, 2ⁿ of them, in which neither a λ nor a w is negative.",
)


def some_tableau(stream):
    n = int(stream.integers(3, 7))
    rows = np.sort(stream.choice(n, int(stream.integers(2, n)), replace=False))
    return {"T": p_matrix(stream, n), "q": np.round(stream.normal(size=n), 3), "rows": rows}


BLOCK_PIVOT = Check(
    name="block_pivot",
    title="the principal pivot of several rows at once",
    points=20,
    visible=(
        Case("one row alone: a pivot", {"T": PLAIN[0], "q": PLAIN[1], "rows": np.array([0])}),
        Case("all rows: the inverse", {"T": PLAIN[0], "q": PLAIN[1], "rows": np.array([0, 1])}),
        Case(
            "two of three rows",
            {"T": given.ring(3, 2.0), "q": HARD_B, "rows": np.array([0, 2])},
        ),
    ),
    hidden=lambda stream: [Case("some rows of a P-matrix", some_tableau(stream)) for _ in range(6)],
    judge=equal(right.block_pivot, 1e-9),
    why=ROUNDING,
    form="two arrays, (T, q), of the shapes that came",
    section="The pivot and the tableau",
    causes=(
        cause_like(
            "The constants of the rows pivoted have the wrong sign.",
            lambda v: right.block_pivot(v, constant=1),
        ),
        cause_like(
            "The sign is wrong beside the inverse: solving for x_α gives −T_αα⁻¹ T_αβ.",
            lambda v: right.block_pivot(v, beside=1),
        ),
    ),
    hint="Solve the rows α for x_α: x_α = T_αα⁻¹ (y_α − T_αβ x_β − q_α); put that into the other rows.",
)


def claims(stream):
    """Matrices [B, −B−C] by rows, so that y exists, and its typical near misses."""
    for _ in range(3):
        n = int(stream.integers(2, 5))
        y = np.round(0.2 + stream.random(n), 3)
        A = np.round(stream.normal(size=(n, n)), 3)
        A[-1] = np.round((-0.5 - stream.random(n) - y[:-1] @ A[:-1]) / y[-1], 3)
        b = np.round(stream.normal(size=n), 3)
        b[-1] = np.round((-1 - y[:-1] @ b[:-1]) / y[-1], 3)
        yield Case("a proof", {"A": A, "b": b, "y": y})
        yield Case("no proof: b is turned round", {"A": A, "b": -b, "y": y})
        yield Case("no proof: y has a negative number", {"A": -A, "b": -b, "y": -y})
        yield Case("a matrix and its transpose", {"A": np.ascontiguousarray(A.T), "b": b, "y": y})


PROVES = Check(
    name="proves",
    title="whether y proves that there is no solution",
    points=10,
    visible=(
        Case(
            "add the rows",
            {"A": np.array([[1.0, -1], [-1, 1]]), "b": np.array([-1.0, -1]), "y": np.array([1.0, 1])},
        ),
        Case("too large for a proof", {"A": PLAIN[0], "b": PLAIN[1], "y": np.array([1.0, 1])}),
        Case("y must not be negative", {"A": -PLAIN[0], "b": np.array([1.0, 1]), "y": np.array([-1.0, -1])}),
        Case("y = 0 proves nothing", {"A": PLAIN[0], "b": PLAIN[1], "y": np.zeros(2)}),
        Case(
            "Aᵀ, not A",
            {"A": np.array([[-1.0, 3], [-2, -1]]), "b": np.array([-1.0, -1]), "y": np.array([1.0, 1])},
        ),
    ),
    hidden=lambda stream: list(claims(stream)),
    judge=equal(right.proves, 1e-9),
    why="Aᵀ y is one product: only rounding, about 1e-16, may differ.",
    form="(status, Aᵀ y): 'proof' or 'no proof', and an array of n",
    reply=Reply(words=("proof", "no proof")),
    section="The problem, and 2ⁿ ways to solve it",
    causes=(
        cause_like("y ≥ 0 is not asked for.", lambda v: right.proves(v, sign=False)),
        cause_like(
            "It must be Aᵀ y ≤ 0: A is not symmetric here.", lambda v: right.proves(v, transposed=False)
        ),
        cause_like("y · b must be less than 0, not just 0.", lambda v: right.proves(v, strict=False)),
    ),
    hint="Three conditions: y ≥ 0, Aᵀ y ≤ 0, y · b < 0. Then y · w < 0 for every λ ≥ 0.",
)


# --- rules --------------------------------------------------------------------------------------------------


def with_most(v, most=40):
    return {**v, "most": most}


def bards(stream):
    other = drawn(
        stream, random_p, lambda v: right.bard(with_most(v))[1] != right.least_index(with_most(v))[1], 3
    )
    return [*other, *drawn(stream, random_p, lambda v: True, 3)]


BARD = Check(
    name="bard",
    title="Bard's rule: pivot the row that is most wrong",
    points=15,
    visible=(
        Case("two boxes", {"A": PLAIN[0], "b": PLAIN[1], "most": 20}),
        Case("nothing to do", {"A": PLAIN[0], "b": np.array([1.0, 2]), "most": 20}),
        Case("it need not end: stop after `most`", {"A": given.ring(5, 2.5), "b": BARD_ROUND, "most": 7}),
    ),
    hidden=lambda stream: [Case("a random P-matrix", with_most(v)) for v in bards(stream)],
    judge=equal(right.bard, 1e-9),
    why=ROUNDING,
    form="(λ, pivots): an array of n and a whole number",
    section="Least index",
    causes=(
        cause_like("This is the least-index rule: Bard's takes the most negative number.", right.least_index),
        cause_like("One pivot too many is counted.", lambda v: right.bard(v, count=1)),
        cause(
            "The pivots are right, λ is not: it is 0 in the rows that are not inside.",
            lambda v, verdict: verdict.got[1] == verdict.expected[1],
        ),
    ),
    hint="Each round: the basic unknowns for this choice, the lowest of them; if it is not negative, stop.",
)


def both_ways(stream):
    hard = [
        drawn(stream, lambda s, b=b: near(s, b), lambda v: right.all_at_once(v)[0] == "cycle", 1)[0]
        for b in ROUND
    ]
    return [*hard, *drawn(stream, random_p, lambda v: right.all_at_once(v)[1] > 1, 3)]


ALL_AT_ONCE = Check(
    name="all_at_once",
    title="pivot all wrong rows at once, and notice when it goes round",
    points=15,
    visible=(
        Case("two boxes: one round", {"A": PLAIN[0], "b": PLAIN[1]}),
        Case("nothing to do", {"A": PLAIN[0], "b": np.array([1.0, 2])}),
        Case("a P-matrix on which it goes round", {"A": given.ring(5, 2.5), "b": ROUND[0]}),
    ),
    hidden=lambda stream: [Case("a random P-matrix", v) for v in both_ways(stream)],
    judge=equal(right.all_at_once, 1e-9),
    why=ROUNDING,
    form="(status, rounds, λ): 'solved' or 'cycle', a whole number, an array of n",
    reply=Reply(words=("solved", "cycle")),
    section="Least index",
    causes=(
        cause_like("Only the first wrong row is pivoted.", lambda v: right.all_at_once(v, alone=True)),
        cause(
            "It stops too early or too late: stop when no row is wrong, or when this very choice was there "
            "before (any time before), and count each round of pivots.",
            lambda v, verdict: verdict.got[1] != verdict.expected[1],
        ),
    ),
    hint="Keep every choice of rows that there has been; λ is that of the choice where it stops.",
)


def telling(v):
    """Whether both typical mistakes would show."""
    rounds = right.safeguarded(v)[1]
    return rounds not in (right.safeguarded(v, last=False)[1], right.safeguarded(v, reset=False)[1])


def hard_ones(stream):
    found = []
    for patience, b in PATIENCE:
        make = lambda s, p=patience, b=b: {**near(s, b), "patience": p}
        found += drawn(stream, make, telling, 1)
    return [*found, *({**v, "patience": 3} for v in drawn(stream, random_p, lambda v: True, 3))]


SAFEGUARDED = Check(
    name="safeguarded",
    title="all at once while it gets better, one alone where it doesn't",
    points=25,
    visible=(
        Case("two boxes", {"A": PLAIN[0], "b": PLAIN[1], "patience": 3}),
        Case(
            "where all at once goes round",
            {"A": given.ring(5, 2.5), "b": PATIENCE[0][1], "patience": 3},
        ),
    ),
    hidden=lambda stream: [Case("a P-matrix", v) for v in hard_ones(stream)],
    judge=equal(right.safeguarded, 1e-9),
    why=ROUNDING,
    form="(λ, rounds): an array of n and a whole number",
    section="Least index",
    causes=(
        cause_like(
            "Where patience is used up, pivot the last wrong row, not the first.",
            lambda v: right.safeguarded(v, last=False),
        ),
        cause_like(
            "A new lowest number of wrong rows gives back the whole patience.",
            lambda v: right.safeguarded(v, reset=False),
        ),
    ),
    hint="Fewer wrong rows than ever: patience is full again, pivot all. Not fewer, and patience left: one "
    "less, pivot all. None left: pivot the last wrong row alone.",
)

CHECKS = (HOLDING_CONES, BLOCK_PIVOT, PROVES, BARD, ALL_AT_ONCE, SAFEGUARDED)
