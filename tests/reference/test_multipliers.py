"""The solvers for λ against NumPy's dense algebra, with A formed apart, from J and M as matrices."""

import numpy as np
import pytest

import jointed
from reference.cases import CASES
from reference.choice import choose_solver, scaled_rows, short_combinations
from reference.embedding import factorise_rows, fill_mass_rows, solve_rows
from reference.layout import Bodies
from reference.mechanism import make_mechanism, rigid_rows, soft_rows
from reference.multipliers import MULTIPLIERS
from reference.rows import dense, fill_rows

TREES = [
    jointed.chain(7, end=300),
    jointed.chain(5, end=40, planar=False),
    jointed.hinged_chain(4),
    jointed.star(9),
]
LOOPS = [jointed.four_bar(0.8), jointed.net()]
REDUNDANT = [jointed.door(), jointed.parallelogram(), jointed.doubled_distance()]


def made(scene, solver):
    """The system and mechanism of a scene at its start, with rows filled in; A by dense algebra."""
    bodies = Bodies(scene)
    rows = rigid_rows(bodies)
    method = MULTIPLIERS[solver]
    factor = method.prepare(rows, bodies.system)
    mechanism = make_mechanism(bodies, rows, soft_rows(bodies), method.number, factor)
    jacobian, system = mechanism.jacobian, bodies.system
    fill_rows(mechanism.rows, bodies.state(), jacobian)
    fill_mass_rows(rows.bodies, jacobian.J, system.mass, system.inertia, jacobian.frame, mechanism.B)
    J = dense(jacobian.J, rows.bodies, len(bodies.moving), len(bodies.rotating))
    return system, mechanism, J, J @ np.linalg.solve(jointed.mass_matrix(scene, bodies), J.T)


def solved(system, mechanism, right):
    """λ by the mechanism's solver."""
    factorise_rows(system, mechanism)
    mechanism.right[:] = right
    solve_rows(system, mechanism, mechanism.λ)
    return mechanism.λ.copy()


@pytest.mark.parametrize("solver", ["cholesky", "sparse", "tree", "minimum_norm"])
@pytest.mark.parametrize("k", range(len(TREES)))
def test_trees_by_all_solvers(k, solver):
    system, mechanism, _, A = made(TREES[k], solver)
    right = np.random.default_rng(3).normal(size=len(A))
    expected = np.linalg.solve(A, right)
    bound = 1e-15 * np.linalg.cond(A) * np.abs(expected).max()
    for _ in range(2):  # the room is used again
        assert np.abs(solved(system, mechanism, right) - expected).max() < 30 * bound
    assert 0 < mechanism.watch[0] <= 1


@pytest.mark.parametrize("solver", ["cholesky", "sparse", "minimum_norm"])
@pytest.mark.parametrize("k", range(len(LOOPS)))
def test_loops(k, solver):
    system, mechanism, _, A = made(LOOPS[k], solver)
    right = np.random.default_rng(4).normal(size=len(A))
    expected = np.linalg.solve(A, right)
    bound = 1e-15 * np.linalg.cond(A) * np.abs(expected).max()
    assert np.abs(solved(system, mechanism, right) - expected).max() < 30 * bound


@pytest.mark.parametrize("k", range(len(REDUNDANT)))
def test_redundant_joints_get_the_pseudo_inverse(k):
    system, mechanism, J, A = made(REDUNDANT[k], "minimum_norm")
    right = A @ np.random.default_rng(5).normal(size=len(A))
    λ = solved(system, mechanism, right)
    expected = np.linalg.pinv(A, rcond=1e-10, hermitian=True) @ right
    assert np.abs(λ - expected).max() < 1e-9 * np.abs(expected).max()
    assert int(mechanism.watch[2]) == np.linalg.matrix_rank(J, tol=1e-9) < len(A)
    # and it is the shortest λ of all that give the same force on the bodies, whatever the masses
    assert np.allclose(λ, np.linalg.pinv(J.T, rcond=1e-9) @ (J.T @ λ), atol=1e-9 * np.abs(λ).max())


@pytest.mark.parametrize("solver", ["cholesky", "sparse"])
def test_a_singular_matrix_gives_nan_not_a_wrong_answer(solver):
    system, mechanism, _, A = made(jointed.doubled_distance(), solver)
    assert np.isnan(solved(system, mechanism, np.ones(len(A)))).any()
    assert mechanism.watch[0] < 1e-14


def test_the_tree_refuses_loops():
    with pytest.raises(ValueError, match="close a loop"):
        made(jointed.four_bar(0.8), "tree")


@pytest.mark.parametrize(
    ("scene", "solver", "redundant"),
    [
        (jointed.chain(3), "cholesky", 0),
        (jointed.chain(50), "sparse", 0),
        (jointed.star(40), "tree", 0),
        (jointed.four_bar(0.8), "minimum_norm", 0),
        (jointed.net(), "minimum_norm", 0),
        (CASES["n_four_bars"](n=20).scene, "sparse", 0),
        (jointed.door(), "minimum_norm", 5),
        (jointed.parallelogram(), "minimum_norm", 1),
    ],
)
def test_what_is_chosen(scene, solver, redundant):
    bodies = Bodies(scene)
    choice = choose_solver(bodies, rigid_rows(bodies))
    assert (choice.solver, choice.redundant) == (solver, redundant)


@pytest.mark.parametrize("n", [3, 40])
def test_redundant_rows_are_counted_as_by_singular_values(n):
    bodies = Bodies(CASES["n_four_bars"](n=n, dimension=3).scene)
    J = scaled_rows(bodies, rigid_rows(bodies))
    values = np.linalg.svd(J.toarray(), compute_uv=False)
    assert J.shape[0] > 500 or n < 40
    assert short_combinations(J, 1e-6) == np.sum(values < 1e-9) + max(0, J.shape[0] - J.shape[1]) == 3 * n
    assert short_combinations(J, 0.5) == np.sum(values < 0.5) + max(0, J.shape[0] - J.shape[1])


@pytest.mark.parametrize("planar", [True, False])
def test_room_of_sparse_and_tree_grows_linearly(planar):
    for solver in ("sparse", "tree"):
        sizes = []
        for n in (50, 100, 200):
            bodies = Bodies(jointed.chain(n, planar=planar))
            factor = MULTIPLIERS[solver].prepare(rigid_rows(bodies), bodies.system)
            sizes.append(factor.values.size + factor.links.size)
        assert sizes[2] - sizes[1] == 2 * (sizes[1] - sizes[0])
