"""A step's problem by any method, with cone, box and pyramid: against Coulomb's law, and pymunk."""

import numpy as np
import pytest

from contact_scenes import G, at, block, ground, pyramid, stack
from reference import BallJoint, Box, Disc, Plane, Scene, Sphere, Unsupported, simulate
from reference.lcp import SOLVERS
from reference.lcp.solution import finish

FRAME = 1 / 60
MODELS = "cone", "box", "pyramid"


def pulled(pull, angle, friction):
    """The speed after .1 s of a block of 1 kg, μ = ½, that is pulled along the ground, at an angle to t1."""
    scene = ground(3, friction=1.0)
    scene.add(Box((0.5,) * 3), position=(0, 0, 0.5), friction=0.5)
    t1, t2 = simulate(scene, FRAME, FRAME).contacts[-1].frame[0, 1:]
    along = pull * (np.cos(angle) * t1 + np.sin(angle) * t2)
    scene.force(lambda t, state: (np.array([0 * along, along]), np.zeros((2, 3))))
    run = simulate(scene, 0.1, 0.02, friction=friction)
    assert run.status == "ok" and "unsolved" not in run.reason
    return np.linalg.norm(run.velocity[-1, 1])


@pytest.mark.parametrize(("friction", "share"), [("cone", 1), ("pyramid", 0.5**0.5), ("box", 2**0.5)])
def test_a_diagonal_pull_shows_the_known_errors(friction, share):
    """Coulomb: μN. Σ|λ_t| ≤ μN is a square with its corners on the circle: μN/√2 between them; |λ_t| ≤ μN
    each one with the circle within: √2 μN.
    """
    holds = share * 0.5 * G
    assert pulled(holds * (1 - 1e-6), np.pi / 4, friction) < 1e-12
    assert (
        pulled(holds * (1 + 1e-6), np.pi / 4, friction) > 0.05 * 1e-6 * holds
    )  # in .1 s; it loses half at most
    assert pulled(0.5 * G * (1 - 1e-6), 0.0, friction) < 1e-12  # along a tangent all three are right
    assert pulled(0.5 * G * (1 + 1e-6), 0.0, friction) > 0.05 * 1e-6 * 0.5 * G


@pytest.mark.parametrize("friction", MODELS)
def test_in_the_plane_all_three_are_coulombs(friction):
    """A block slides down a slope by ½ g (sin θ − μ cos θ) t²."""
    slope = np.pi / 6
    run = simulate(block(2, slope, 0.9 * np.tan(slope)), 1, FRAME, friction=friction)
    way = 0.5 * G * np.sin(slope) * 0.1 * run.time**2
    np.testing.assert_allclose(run.position[:, 1, 0], way, atol=1e-9)


HERE = [("cone", "cone_gauss_seidel"), ("box", "lemke"), ("box", "gauss_seidel"), ("pyramid", "lemke")]


def stands(friction, solver):
    """Whether two boxes stand and weigh what they do, by this method."""
    run = simulate(stack(2, 2), 0.2, FRAME, friction=friction, solver=solver, record_every=6)
    contacts = run.contacts[-1]
    below = contacts.impulse[contacts.bodies[:, 0] == 0, 0].sum() / 0.1
    assert run.status == "ok" and run.settings["solver"] == solver and run.settings["friction"] == friction
    return np.abs(run.position - run.position[0]).max() < 1e-9 and abs(below - 2 * G) < 1e-7


@pytest.mark.parametrize(("friction", "solver"), HERE)
def test_two_boxes_stand_by_this_method(friction, solver):
    assert stands(friction, solver)


@pytest.mark.slow
@pytest.mark.parametrize("friction", MODELS)
@pytest.mark.parametrize("solver", SOLVERS)
def test_a_method_is_right_or_says_why_not(friction, solver):
    """Each method either can't treat the friction, and says so in a sentence, or is right. Plain Jacobi,
    whose matrix is not diagonally dominant here, and what stops at a kink, may also say that they failed.
    """
    try:
        run = simulate(stack(2, 2), 0.1, FRAME, friction=friction, solver=solver)
    except Unsupported as why:
        assert len(str(why)) > 60
        return
    if run.status == "ok" and not run.reason:
        assert stands(friction, solver)
    else:
        assert solver in run.reason and ("unsolved" in run.reason or "could not solve" in run.reason)


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"solver": "lemke"}, "friction cone"),
        ({"solver": "cone_newton", "friction": "box"}, "fixed bounds"),
        ({"solver": "cone_apgd", "friction": "box"}, "made for friction cones"),
        ({"solver": "gauss_seidel", "friction": "pyramid"}, "divides by A_ii"),
    ],
)
def test_a_method_that_does_not_fit_is_refused_in_its_own_words(settings, words):
    with pytest.raises(Unsupported, match=words):
        simulate(block(2, 0, 0.5), 0.1, 0.1, **settings)


def chain_on_the_ground():
    """A box, and one hung on it that lies on the ground."""
    scene = stack(3, 1)
    scene.add(Box((0.5,) * 3), position=(2, 0, 0.5))
    scene.join(BallJoint(1, 2, point=(1, 0, 0.5)))
    return scene


def test_joints_rows_are_no_cones():
    with pytest.raises(Unsupported, match="beside joints: a row with bounds is no friction cone"):
        simulate(chain_on_the_ground(), 0.1, 0.1, solver="cone_apgd")


@pytest.mark.parametrize("friction", ["box", "pyramid"])
def test_joints_go_in_as_rows_without_bounds(friction):
    """Two boxes at rest, joined: nothing moves, and the ground carries both."""
    run = simulate(chain_on_the_ground(), 0.2, FRAME, friction=friction, record_every=12)
    assert run.status == "ok" and np.abs(run.position - run.position[0]).max() < 1e-9
    assert run.contacts[-1].impulse[:, 0].sum() / 0.2 == pytest.approx(2 * G, rel=1e-8)


def test_a_contact_without_friction_among_cones():
    """Ice under one box, none under the other: the first slides on with its speed, the other stops."""
    scene = ground(3, friction=1.0)
    for y, μ in ((0, 0.0), (3, 0.5)):
        scene.add(Box((0.5,) * 3), position=(0, y, 0.5), velocity=(1, 0, 0), friction=μ)
    run = simulate(scene, 0.5, FRAME, solver="cone_gauss_seidel")
    np.testing.assert_allclose(run.velocity[-1, 1:, 0], [1, 0], atol=1e-8)


def test_steps_left_unsolved_are_told():
    run = simulate(stack(2, 10), 0.1, FRAME, friction="box", solver="gauss_seidel", iterations=3)
    assert run.status == "ok" and run.iterations[1:].max() == 3 and run.residual[1:].max() > 1e-10
    assert (
        "gauss_seidel left " in run.reason
        and "(max_iterations), the first in the step from t = 0 s" in run.reason
    )


def test_a_ray_ends_the_run(monkeypatch):
    """A λ of no use is not stepped with."""

    def runs_off(problem, start, *limits):
        return finish(problem, start - 1.0, 3, "ray", 1e-10)

    monkeypatch.setitem(SOLVERS, "runs_off", runs_off)
    scene = stack(2, 2)
    run = simulate(scene, 0.2, FRAME, friction="box", solver="runs_off")
    assert (
        run.status == "ray" and "runs_off could not solve the contacts" in run.reason and len(run.time) == 1
    )


def test_a_pyramid_stands_on_box_friction():
    run = simulate(pyramid(4), 0.2, FRAME, friction="box")
    assert run.status == "ok" and np.abs(run.position - run.position[0]).max() < 1e-9


def column_in_pymunk(n, sweeps, slop=0.1, steps=1, dt=1e-3, gravity=1.0):
    """Heights (steps + 1, n) and last velocities (n,) of n balls on one another, overlapping by 1 mm."""
    pymunk = pytest.importorskip("pymunk")
    space = pymunk.Space()
    space.gravity, space.iterations, space.collision_slop = (0, -gravity), sweeps, slop
    space.add(pymunk.Segment(space.static_body, (-5, 0), (5, 0), 0))
    balls = [pymunk.Body(1, 1) for _ in range(n)]
    for i, ball in enumerate(balls):
        ball.position = (0, 0.499 + 0.999 * i)
        space.add(ball, pymunk.Circle(ball, 0.5))
    heights = [[ball.position.y for ball in balls]]
    for _ in range(steps):
        space.step(dt)
        heights.append([ball.position.y for ball in balls])
    return np.array(heights), np.array([ball.velocity.y for ball in balls])


def column(n, gravity=1.0):
    """The same, numbered from the top down, as pymunk goes through the contacts; the ground comes last."""
    scene = Scene(gravity=(0, -gravity))
    for i in reversed(range(n)):
        scene.add(Disc(0.5), mass=1, inertia=1, position=(0, 0.499 + 0.999 * i), friction=0.0)
    scene.add(Plane((0, 1)), friction=0.0)
    return scene


@pytest.mark.parametrize("sweeps", [1, 2, 7, 40])
def test_pymunk_does_the_same_sweeps(sweeps):
    """One step of .001 s from rest. pymunk leaves overlaps within its slop alone, as "none" does."""
    settings = {"friction": "box", "solver": "gauss_seidel", "correction": "none", "warm_start": False}
    run = simulate(column(5), 1e-3, 1e-3, iterations=sweeps, tolerance=1e-300, **settings)
    np.testing.assert_allclose(run.velocity[-1, 4::-1, 1], column_in_pymunk(5, sweeps)[1], rtol=0, atol=1e-14)


def test_pymunk_corrects_by_split_impulse():
    """Chipmunk takes back 1 − bias^Δt of the overlap, by velocities that it forgets. It moves the bodies
    before it solves, and so is one step late.
    """
    fraction = 1 - ((1 - 0.1) ** 60) ** FRAME  # ``collision_bias`` as it comes
    theirs, _ = column_in_pymunk(3, 3000, slop=0.0, steps=31, dt=FRAME, gravity=G)
    run = simulate(column(3, G), 0.5, FRAME, correction=("split_impulse", {"fraction": fraction}))
    np.testing.assert_allclose(run.position[:, 2::-1, 1], theirs[1:], rtol=0, atol=1e-9)


def test_a_ball_rolls_the_same_by_all_cones():
    """What slides comes to roll with 5/7 of its speed, by each of the cone's methods."""
    for solver in ("cone_newton", "cone_gauss_seidel"):
        scene = ground(3, friction=1.0)
        scene.add(Sphere(0.3), position=at(3, 0, 0.3), velocity=at(3, 2, 0, 1), friction=0.3)
        run = simulate(scene, 1, FRAME, solver=solver, record_every=60)
        np.testing.assert_allclose(run.velocity[-1, 1, :2], [10 / 7, 5 / 7], rtol=1e-7)
