"""A and b in three forms, against M and J made apart; the KKT system beside its Schur complement."""

import numpy as np
import pytest
import scipy.sparse

import jointed
from reference import Box, Hinge, Scene, simulate
from reference.equation import FORMS, equation, solve_kkt, solve_schur
from reference.factored import Factored
from reference.layout import Bodies

SCENES = {
    "chain": jointed.chain(5, end=20),
    "chain in space": jointed.chain(4, end=5, planar=False),
    "hinges": jointed.hinged_chain(3),
    "star": jointed.star(6),
    "loop": jointed.four_bar(0.8),
    "net": jointed.net(),
}


def moving(scene):
    """A state of the scene in motion."""
    return simulate(scene, 0.2, 0.01).state()


def matrix(a):
    return a if isinstance(a, np.ndarray) else a.toarray()


@pytest.mark.parametrize("step", [None, 0.02])
@pytest.mark.parametrize("name", SCENES)
def test_three_forms_agree(name, step):
    scene = SCENES[name]
    state = moving(scene)
    forms = [equation(scene, state, form=form, step=step) for form in FORMS]
    assert [type(e.A) for e in forms] == [np.ndarray, scipy.sparse.csr_array, Factored]
    A, b = forms[0].A, forms[0].b
    for other in forms[1:]:
        assert np.abs(matrix(other.A) - A).max() < 1e-13 * np.abs(A).max()
        assert np.abs(other.b - b).max() < 1e-12 * max(1, np.abs(b).max())
    λ = np.random.default_rng(1).normal(size=len(b))
    assert np.allclose(forms[2].A @ λ, A @ λ, rtol=0, atol=1e-13 * np.abs(A).max() * len(b))


@pytest.mark.parametrize("name", SCENES)
def test_mass_matrix_and_force_at_the_start(name):
    scene = SCENES[name]
    made = equation(scene)
    assert np.allclose(made.M, jointed.mass_matrix(scene, Bodies(scene)), rtol=0, atol=1e-13)
    weight = [scene.bodies[i].mass * scene.gravity for i in Bodies(scene).moving]
    expected = np.zeros(len(made.right))
    expected[: np.size(weight)] = np.ravel(weight)
    assert np.allclose(made.right, expected, rtol=0, atol=1e-12)  # at rest: no gyroscopic torque
    assert np.abs(made.φ).max() < 1e-12


@pytest.mark.parametrize("name", SCENES)
def test_schur_complement_and_whole_system_give_the_same(name):
    scene = SCENES[name]
    state = moving(scene)
    for step in (None, 0.02):
        forms = [equation(scene, state, form=form, step=step) for form in FORMS]
        x, λ = solve_kkt(forms[0])
        size = max(1, np.abs(λ).max())
        for made in forms:
            other_x, other = solve_schur(made)
            assert np.abs(other - λ).max() < 1e-8 * size
            assert np.abs(other_x - x).max() < 1e-8 * max(1, np.abs(x).max())
        assert np.abs(forms[0].M @ x - forms[0].h * forms[0].J.T @ λ - forms[0].right).max() < 1e-9 * size
        assert np.abs(forms[0].J @ x - forms[0].wanted).max() < 1e-9 * max(1, np.abs(x).max())


def test_accelerations_and_forces_are_those_of_the_simulation():
    scene = jointed.hinged_chain(3)
    run = simulate(scene, 0.2, 0.01)
    _, λ = solve_schur(equation(scene, run.state()))
    assert np.abs(run.joint_forces().λ[-1] - λ).max() < 1e-8 * np.abs(λ).max()


def test_a_rod_pendulum_by_hand():
    """A rod of mass m and length l hinged at its end, level: ω̇ = −3g/2l, and the hinge carries m g/4."""
    scene = Scene(gravity=(0, -9.81))
    rod = scene.add(Box((0.5, 1e-9)), mass=3, position=(0.5, 0))
    scene.join(Hinge(rod, point=(0, 0)))
    made = equation(scene)
    u_rate, λ = solve_schur(made)
    assert u_rate == pytest.approx([0, -1.5 * 9.81 / 2, -1.5 * 9.81], abs=1e-12)
    assert λ == pytest.approx([0, 3 * 9.81 / 4], abs=1e-12)
    assert made.A == pytest.approx(np.array([[1 / 3, 0], [0, 4 / 3]]), abs=1e-12)
    # and a step of velocities, from rest: the same times Δt, with the same force
    u, force = solve_schur(equation(scene, step=0.01))
    assert u == pytest.approx(0.01 * u_rate, abs=1e-14) and force == pytest.approx(λ, abs=1e-12)


def test_the_centripetal_force_is_in_the_bias():
    """A turning rod without gravity: J̇ u gives the whole of λ; a step of velocities sees it in J only."""
    scene = Scene(gravity=(0, 0))
    rod = scene.add(Box((0.5, 0.1)), mass=2, position=(0.5, 0), velocity=(0, 1.5), angular_velocity=3)
    scene.join(Hinge(rod, point=(0, 0)))
    _, λ = solve_schur(equation(scene))
    assert λ == pytest.approx([-2 * 0.5 * 9, 0], abs=1e-12)
    _, none = solve_schur(equation(scene, step=0.01))
    assert none == pytest.approx([0, 0], abs=1e-10)


def test_the_share_of_the_gap_taken_back():
    scene = Scene(gravity=(0, 0))
    rod = scene.add(Box((0.5, 0.1)), mass=2, position=(0.5, 0))
    scene.join(Hinge(rod, point=(0, 0)))
    state = simulate(scene, 0.1, 0.1).state()
    state.position[0] += (0.003, 0)
    made = equation(scene, state, step=0.01, share=0.2)
    u, _ = solve_schur(made)
    assert made.φ == pytest.approx([0.003, 0], abs=1e-15)
    assert made.J @ u == pytest.approx([-0.2 * 0.003 / 0.01, 0], abs=1e-14)


def test_redundant_joints():
    scene = jointed.door()
    made = equation(scene)
    x, λ = solve_schur(made)
    assert x == pytest.approx(np.zeros(6), abs=1e-12)
    assert np.allclose(λ, np.linalg.pinv(made.J.T, rcond=1e-9) @ (made.J.T @ λ), atol=1e-9)
    for solve, form in ((solve_kkt, "dense"), (solve_schur, "sparse")):
        with pytest.raises(ValueError, match="is singular: joints are redundant"):
            solve(equation(scene, form=form))


def test_forces_that_depend_on_time_and_state_come_in():
    scene = jointed.chain(2)
    scene.drag(1, 0.7)
    scene.force(lambda t, state: (np.array([[t, 0], [0, 2.0]]), np.array([0, 5.0])))
    plain_scene = jointed.chain(2)
    difference = equation(scene, time=4.0).right - equation(plain_scene).right
    assert difference == pytest.approx([4, 0, 0, 2, 0, 5])


def test_bad_input():
    scene = jointed.chain(2)
    with pytest.raises(ValueError, match="form must be one of"):
        equation(scene, form="banded")
    with pytest.raises(ValueError, match="step"):
        equation(scene, step=0)
    with pytest.raises(ValueError, match="share must be 0 where step is None"):
        equation(scene, share=0.1)
