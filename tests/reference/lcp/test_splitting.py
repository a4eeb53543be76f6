"""Jacobi, SOR, symmetric, coloured and block Gauss–Seidel: known answers, and a sweep as S16, S17 say it."""

import numpy as np
import pytest
import scipy.sparse

from reference.bench_sweeps import c_loop
from reference.cases.lcp_lattice import lattice
from reference.cases.lcp_problems import LCP_PROBLEMS
from reference.compiled import plain
from reference.factored import Factored
from reference.lcp import (
    LCP,
    SOLVERS,
    block_gauss_seidel,
    block_jacobi,
    damped_jacobi,
    gauss_seidel,
    jacobi,
    red_black,
    sor,
    symmetric_gauss_seidel,
)
from reference.lcp.block import block_sweeps, blocks_at_once, gather_blocks, solve_block
from reference.lcp.gauss_seidel import sweeps
from reference.lcp.jacobi import all_at_once, safe_damping
from reference.lcp.operators import _FORMS, arrays, for_form
from reference.lcp.orders import coloured_order, colours, contacts, natural_order, there_and_back

METHODS = (
    jacobi, damped_jacobi, gauss_seidel, symmetric_gauss_seidel, sor, red_black, block_jacobi,
    block_gauss_seidel,
)  # fmt: skip
BOTH_SIDES = [method for method in METHODS if method not in (jacobi, block_jacobi)]  # converge where A is SPD
each = pytest.mark.parametrize("method", METHODS, ids=lambda method: method.__name__)
FRICTION = ([1, 2, 7, 11], [0, 0, 8, 10], 0.4)


def forms(A):
    """The same positive definite A as dense, sparse and factored."""
    return A, scipy.sparse.coo_array(A), Factored.from_matrices(np.linalg.cholesky(A), np.ones(len(A)))


@each
def test_all_are_among_the_solvers(method):
    assert SOLVERS[method.__name__] is method


CAN = {
    "easy": {}, "column": {"n": 8}, "tower": {"n": 1, "aspect": 3}, "heavy_on_light": {"ratio": 20},
    "degenerate": {}, "dragged_block": {"pull": 0.9}, "planted": {},
}  # fmt: skip


@each
@pytest.mark.parametrize("name", CAN)
def test_known_answers(method, name):
    known = LCP_PROBLEMS[name](**CAN[name])
    solution = method(known.problem, max_iterations=20000)
    assert solution.solved, solution.reason
    assert known.error(solution.lam) < 1e-7


@pytest.mark.parametrize(("kind", "tolerance"), [("pd", 1e-10), ("psd", 1e-3)])
@pytest.mark.parametrize("seed", range(6))
def test_what_converges_on_every_symmetric_positive_problem(kind, tolerance, seed):
    known = LCP_PROBLEMS["planted"](kind, seed=seed, n=24)
    for method in BOTH_SIDES:
        solution = method(known.problem, tolerance=tolerance, max_iterations=20_000)
        assert solution.solved, f"{method.__name__}: {solution.reason}"


@pytest.mark.parametrize("name", ["kostreva", "murty_2_8"])
def test_neither_symmetric_nor_dominant_and_all_but_damping_fail(name):
    problem = LCP_PROBLEMS[name]().problem
    for method in (jacobi, gauss_seidel, symmetric_gauss_seidel, sor, red_black, block_gauss_seidel):
        solution = method(problem)
        assert not solution.solved and solution.residual > 0.1 and len(solution.reason) > 30
    assert damped_jacobi(problem, max_iterations=5000).solved  # no theorem promises it


def test_jacobi_flips_where_all_overshoot():
    known = LCP_PROBLEMS["jacobi_fails"]()
    even, odd = (jacobi(known.problem, max_iterations=k) for k in (100, 101))
    assert np.array_equal(even.lam, np.zeros(3)) and np.array_equal(odd.lam, np.ones(3))
    for method in BOTH_SIDES:
        assert known.error(method(known.problem).lam) < 1e-7


@each
def test_unsuitable_and_blown_up(method):
    for name in ("zero_diagonal", "painleve", "sliding_contact"):
        assert method(LCP_PROBLEMS[name]().problem).status == "unsuitable"
    blown = method(LCP([[1, 3], [3, 1]], [-1, -2], lower=-np.inf), max_iterations=3000)
    assert blown.status == "diverged" and not blown.solved


# --- one sweep ----------------------------------------------------------------------------------------------


def clip(problem, λ, i, value):
    """The value within the bounds of row i, a friction row's by this λ."""
    low, high = problem.bounds(λ)
    return np.clip(value, low[i], high[i])


def sweep_by_rows(problem, λ, order, ω):
    """S16, S17: each row from the newest λ."""
    A, b = problem.A, problem.b
    for i in order:
        λ[i] = clip(problem, λ, i, λ[i] - ω * (A[i] @ λ + b[i]) / A[i, i])


def sweep_at_once(problem, λ, order, ω):
    """S15, S17: each row from the λ before; friction by the λ_n just renewed."""
    w = problem.A @ λ + problem.b
    for i in order:
        λ[i] = clip(problem, λ, i, λ[i] - ω * w[i] / problem.A[i, i])


def with_friction(n=12, seed=3):
    A = LCP_PROBLEMS["planted"](n=n, seed=seed).problem.A
    return LCP(A, np.random.default_rng(seed).normal(size=n) - 0.7, friction=FRICTION)


NORMALS_FIRST = [0, 1, 2, 3, 4, 5, 6, 8, 7, 9, 10, 11]
BACK = [10, 11, 9, 8, 7, 6, 5, 4, 3, 0, 1, 2]


@pytest.mark.parametrize(
    ("method", "options", "sweep", "orders", "ω"),
    [
        (jacobi, {}, sweep_at_once, [NORMALS_FIRST], 1),
        (damped_jacobi, {"omega": 0.6}, sweep_at_once, [NORMALS_FIRST], 0.6),
        (gauss_seidel, {}, sweep_by_rows, [NORMALS_FIRST], 1),
        (sor, {}, sweep_by_rows, [NORMALS_FIRST], 1.6),
        (sor, {"omega": 0.7}, sweep_by_rows, [NORMALS_FIRST], 0.7),
        (symmetric_gauss_seidel, {}, sweep_by_rows, [NORMALS_FIRST, BACK], 1),
        (red_black, {"omega": 1.2}, sweep_by_rows, [NORMALS_FIRST], 1.2),  # dense: each has its own colour
    ],
)
def test_a_sweep_is_what_the_slides_say(method, options, sweep, orders, ω):
    problem = with_friction()
    λ = np.zeros(12)
    for k in range(1, 4):
        for order in orders:
            sweep(problem, λ, order, ω)
        got = method(problem, max_iterations=k, tolerance=1e-30, **options)
        assert np.allclose(got.lam, λ, rtol=1e-12, atol=1e-14)
        assert got.history[k] == problem.residual(got.lam)


@each
def test_every_form_of_A_does_the_same(method):
    problem = with_friction()
    options = {"omega": 0.5} if method is damped_jacobi else {}
    results = [
        method(LCP(A, problem.b, friction=FRICTION), max_iterations=7, tolerance=1e-30, **options)
        for A in forms(problem.A)
    ]
    for result in results[1:]:
        assert np.allclose(result.lam, results[0].lam, rtol=1e-10, atol=1e-12)
        assert np.allclose(result.history, results[0].history, rtol=1e-8, atol=1e-12)


@pytest.mark.parametrize("kernel", [sweeps, all_at_once, block_sweeps, blocks_at_once])
def test_compiled_equals_plain(kernel):
    problem = with_friction()
    blocks = gather_blocks(problem)
    options = {
        sweeps: (natural_order(problem), 1.3, 2), all_at_once: (natural_order(problem), 0.5),
        block_sweeps: (blocks, 5, 2), blocks_at_once: (blocks, 5, 0.5),
    }[kernel]  # fmt: skip
    for A in forms(problem.A)[1:]:
        λ, λ_2, history, history_2 = np.zeros(12), np.zeros(12), np.empty(6), np.empty(6)
        A = arrays(LCP(A, problem.b).A)
        rest = problem.terms, problem.scale, 1e-30
        plain(kernel)(*map(plain, _FORMS[type(A)]), A, rest[0], λ, *rest[1:], history, *options)
        for_form(kernel, type(A))(A, rest[0], λ_2, *rest[1:], history_2, *options)
        assert np.allclose(λ, λ_2, rtol=1e-12, atol=1e-15)
        assert np.allclose(history[:5], history_2[:5], rtol=1e-12, atol=1e-15, equal_nan=True)


@each
def test_history_is_the_residual_of_each_iterate(method):
    problem = with_friction()
    whole = method(problem, max_iterations=5, tolerance=1e-30)
    for k in range(6):
        part = method(problem, max_iterations=k, tolerance=1e-30)
        assert whole.history[k] == pytest.approx(part.residual, rel=1e-9)
    assert whole.history[0] == pytest.approx(1) and len(whole.history) == 6


def test_many_rows_are_looked_at_seldom():
    known = LCP_PROBLEMS["planted"](n=2000, density=0.001, seed=1)
    solution, each_time = gauss_seidel(known.problem), gauss_seidel(known.problem, every=1)
    assert solution.solved and each_time.solved and solution.iterations % 8 == 0
    assert 0 <= solution.iterations - each_time.iterations < 8
    assert np.isfinite(solution.history[::8]).all() and np.isfinite(each_time.history).all()


# --- order, colours, blocks ---------------------------------------------------------------------------------


def test_orders():
    problem = with_friction()
    assert list(natural_order(problem)) == NORMALS_FIRST
    assert list(there_and_back(problem)) == NORMALS_FIRST + BACK
    assert list(contacts(problem)) == [0, 0, 0, 3, 4, 5, 6, 8, 8, 9, 10, 10]


@pytest.mark.parametrize("factored", [False, True])
def test_a_column_is_red_and_black(factored):
    problem = LCP_PROBLEMS["column"](7, factored=factored).problem
    assert list(colours(problem)) == [0, 1, 0, 1, 0, 1, 0]
    assert list(coloured_order(problem)) == [0, 2, 4, 6, 1, 3, 5]


def pile(contacts=60, bodies=20, seed=0):
    """Random contacts (n, t) between random bodies or the ground: factored, and the same sparse."""
    random = np.random.default_rng(seed)
    pair = np.stack([random.permuted(np.arange(-1, bodies))[:2] for _ in range(contacts)])
    J = random.normal(size=(2 * contacts, 2, 3))
    return Factored(np.repeat(pair, 2, axis=0), J, J, bodies, np.full(2 * contacts, 0.1))


@pytest.mark.parametrize("seed", range(5))
def test_rows_of_one_colour_have_nothing_in_common(seed):
    A = pile(seed=seed)
    friction = (np.arange(1, 120, 2), np.arange(0, 120, 2), 0.5)
    b = np.random.default_rng(seed).normal(size=120) - 1
    dense, found = A.toarray(), []
    for form in (A, A.tosparse()):
        problem = LCP(form, b, friction=friction)
        colour = colours(problem)
        apart = (colour[:, None] == colour) & (contacts(problem)[:, None] != contacts(problem))
        assert not dense[apart].any()
        assert np.array_equal(colour[::2], colour[1::2])  # a contact stays together
        neighbours = ((dense[::2, ::2] != 0).sum(axis=1) - 1).max()
        assert colour.max() <= neighbours
        found.append(colour)
    assert np.array_equal(*found)
    solutions = [method(problem, max_iterations=5000) for method in (red_black, gauss_seidel)]
    assert all(solution.solved for solution in solutions)
    assert np.allclose(solutions[0].lam, solutions[1].lam, atol=1e-6)


@pytest.mark.parametrize("seed", range(3))
def test_blocks_hold_what_A_has_between_their_rows(seed):
    A = pile(seed=seed)
    label = np.random.default_rng(seed).integers(0, 9, 60).repeat(2)
    friction = (np.arange(1, 120, 2), np.arange(0, 120, 2), 0.5)
    for form in (A, A.tosparse(), A.toarray()):
        blocks = gather_blocks(LCP(form, np.ones(120), friction=friction), label)
        assert sorted(blocks.order) == list(range(120)) and len(blocks.begin) == len(np.unique(label)) + 1
        for k in range(len(blocks.begin) - 1):
            rows = blocks.order[blocks.begin[k] : blocks.begin[k + 1]]
            local = blocks.local[blocks.offset[k] : blocks.offset[k + 1]].reshape(len(rows), -1)
            assert len(set(label[rows])) == 1 and np.allclose(local, A.toarray()[np.ix_(rows, rows)])


def test_one_block_of_all_rows_is_solved_at_once():
    known = LCP_PROBLEMS["planted"](n=10)
    for method in (block_gauss_seidel, block_jacobi):
        solution = method(known.problem, blocks=np.zeros(10), inner=1000)
        assert solution.solved and solution.iterations == 1 and known.error(solution.lam) < 1e-9


def test_a_block_is_solved_in_place():
    problem = with_friction()
    blocks, λ = gather_blocks(problem), np.zeros(12)
    w = problem.b[:3].copy()
    solve_block(problem.terms, blocks, 0, λ, w, 500)
    local = LCP(problem.A[:3, :3], problem.b[:3], friction=([1, 2], [0, 0], 0.4))
    assert local.residual(λ[:3]) < 1e-12 and np.allclose(w, local.w(λ[:3])) and not λ[3:].any()


@pytest.mark.parametrize("factored", [False, True])
def test_safe_damping_is_below_the_limit(factored):
    for seed in range(5):
        A = pile(seed=seed)
        problem = LCP(A if factored else A.tosparse(), np.ones(120))
        largest = np.linalg.eigvals(A.toarray() / A.diagonal()[:, None]).real.max()
        assert 0 < safe_damping(problem) * largest < 2
    assert safe_damping(LCP(np.eye(3), np.ones(3))) == 1


@pytest.mark.parametrize(
    ("method", "options", "error", "words"),
    [
        (sor, {"omega": 2}, ValueError, "omega must be below 2"),
        (sor, {"omega": 0}, ValueError, "omega must be"),
        (sor, {"omega": "much"}, TypeError, "omega must be a number"),
        (red_black, {"omega": 2.5}, ValueError, "omega must be below 2"),
        (damped_jacobi, {"omega": -1}, ValueError, "omega must be"),
        (block_jacobi, {"omega": 1.5}, ValueError, "omega must be at most 1"),
        (block_jacobi, {"inner": 0}, ValueError, "inner must be"),
        (block_gauss_seidel, {"blocks": [1, 2]}, ValueError, "blocks must have shape"),
        (block_gauss_seidel, {"blocks": np.arange(12)}, ValueError, "keep a friction row with its normal"),
        (symmetric_gauss_seidel, {"every": 0}, ValueError, "every must be"),
    ],
)
def test_bad_arguments(method, options, error, words):
    with pytest.raises(error, match=words):
        method(with_friction(), **options)


# --- beside an engine, and beside C -------------------------------------------------------------------------


def balls_in_pymunk(n, sweeps):
    """The velocities of n balls on one another that would fall with 1, after so many sweeps of pymunk's."""
    pymunk = pytest.importorskip("pymunk")
    space = pymunk.Space()
    space.gravity, space.iterations, space.collision_slop = (0, -1), sweeps, 0.1
    space.add(pymunk.Segment(space.static_body, (-5, 0), (5, 0), 0))
    balls = [pymunk.Body(1, 1) for _ in range(n)]
    for i, ball in enumerate(balls):
        ball.position = (0, 0.499 + 0.999 * i)  # they overlap, by less than the slop
        space.add(ball, pymunk.Circle(ball, 0.5))
    space.step(1e-3)
    return np.array([ball.velocity.y for ball in balls]) * 1e3


@pytest.mark.parametrize("n", [3, 8])
@pytest.mark.parametrize("sweeps", [1, 2, 7, 40])
def test_pymunk_does_the_same_sweeps(n, sweeps):
    """pymunk goes through these contacts from the top down."""
    known = LCP_PROBLEMS["column"](n)
    down = np.arange(n)[::-1]
    A = known.problem.A.toarray()[np.ix_(down, down)]
    λ = gauss_seidel(LCP(A, known.problem.b[down]), max_iterations=sweeps, tolerance=1e-300).lam[down]
    above = np.append(λ[1:], 0)
    assert np.allclose(-1 + λ - above, balls_in_pymunk(n, sweeps), rtol=0, atol=1e-12)


@pytest.mark.parametrize("frictionless", [True, False])
def test_the_loop_in_c_gets_the_same(frictionless):
    loop = c_loop()
    if loop is None:
        pytest.skip("there is no C compiler here")
    problem = lattice(60, frictionless=frictionless).problem
    for count in (1, 5):
        λ = gauss_seidel(problem, tolerance=1e-300, max_iterations=count).lam
        assert np.allclose(loop(problem, count), λ, rtol=1e-12, atol=1e-13)
