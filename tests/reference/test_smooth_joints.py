"""Scenes of joints under ``smooth``, against minimal coordinates solved by DOP853, and statics."""

import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipk

import jointed
from reference import (
    BallJoint,
    Box,
    Distance,
    Fixed,
    Hinge,
    Point,
    Scene,
    Simulation,
    Slider,
    Unsupported,
    model,
    simulate,
)
from reference.cases import CASES

ROOT = Path(__file__).parents[2]
pytestmark = pytest.mark.xdist_group("joints")  # what one test compiles, the next needs


def tip_of(run, length=1.0):
    """Where the far end of the last rod of a planar chain is at the end."""
    angle = run.orientation[-1, -1]
    return run.position[-1, -1] + length / 2 * np.array([np.cos(angle), np.sin(angle)])


def exact_tip(n, end, duration, length=1.0):
    rates = jointed.chain_rates(n, end, length)
    θ = solve_ivp(rates, (0, duration), np.zeros(2 * n), method="DOP853", rtol=1e-12, atol=1e-13).y[:n, -1]
    return length * np.array([np.cos(θ).sum(), np.sin(θ).sum()])


def test_a_double_pendulum_from_level_converges_to_dop853():
    exact = exact_tip(2, 1, 2)
    errors = [
        np.linalg.norm(tip_of(simulate(jointed.chain(2), 2, 1 / n)) - exact) for n in (50, 100, 200, 800)
    ]
    orders = np.log2(np.array(errors[:-2]) / errors[1:-1])
    assert orders == pytest.approx([4, 4], abs=0.4)
    assert errors[-1] < 1e-8


@pytest.mark.parametrize("planar", [True, False])
def test_a_chain_with_a_heavy_end(planar):
    n, end = 20, 1000.0
    exact = exact_tip(n, end, 1, length=0.1)
    scene = jointed.chain(n, end, planar=True, length=0.1)
    if not planar:  # the same rods in space: their slenderness differs, so give them the inertia of the plane
        scene = in_space(scene)
    run = simulate(scene, 1, 1 / 1000)
    if planar:
        tip = tip_of(run, 0.1)
        assert np.linalg.norm(tip - exact) < 1e-5 * n * 0.1
    else:
        assert np.linalg.norm(run.position[-1, -1][[0, 2]] - exact) < 0.06  # half a rod from the tip
        flat = simulate(jointed.chain(n, end, length=0.1), 1, 1 / 1000)
        # the same motion, with attitudes stepped as quaternions instead of angles
        assert np.abs(run.position[:, :, [0, 2]] - flat.position).max() < 1e-6
    assert run.joint_error().max() < 1e-9 * 0.1
    E = run.energy()
    assert np.abs(E - E[0]).max() < 1e-3 * end * 9.81 * n * 0.1


def in_space(flat):
    """A planar chain as a chain of ball joints in space, in the plane of x and z."""
    scene = Scene(gravity=(0, 0, -9.81))
    for body in flat.bodies:
        x, y = body.position
        i = body.inertia
        scene.add(
            Box((0.05, 0.05, 0.05)), mass=body.mass, position=(x, 0, y), inertia=(i, i, i), group=body.group
        )
    for joint in flat.joints:
        x, y = joint.point
        scene.join(BallJoint(joint.a, joint.b, point=(x, 0, y)))
    return scene


@pytest.mark.parametrize("solver", ["cholesky", "sparse", "tree", "minimum_norm"])
def test_all_solvers_move_a_mechanism_alike(solver):
    expected = simulate(jointed.hinged_chain(4), 0.5, 0.005, solver="cholesky")
    run = simulate(jointed.hinged_chain(4), 0.5, 0.005, solver=solver)
    # rounding decides whether the projection takes one more iteration, of 1e-12
    assert np.abs(run.position - expected.position).max() < 1e-8 and run.settings["solver"] == solver
    assert run.joint_error().max() < 2e-11


def test_the_large_swing_of_a_pendulum_has_the_period_of_the_elliptic_integral():
    amplitude, length, g = np.deg2rad(170), 1.0, 9.81
    scene = Scene(gravity=(0, -g))
    x = length * np.array([np.sin(amplitude), -np.cos(amplitude)])
    scene.join(Distance(scene.add(Point(), mass=2, position=x), point_b=(0, 0)))
    period = 4 * np.sqrt(length / g) * ellipk(np.sin(amplitude / 2) ** 2)
    run = simulate(scene, period, period / 4000)
    assert np.linalg.norm(run.position[-1, 0] - x) < 1e-6
    assert np.abs(np.linalg.norm(run.position[:, 0], axis=1) - length).max() < 1e-12
    # the rod's tension: m g cos θ + m v²/l, towards the pivot
    θ = np.arctan2(run.position[:, 0, 0], -run.position[:, 0, 1])
    tension = 2 * (g * np.cos(θ) + np.square(run.velocity[:, 0]).sum(axis=1) / length)
    forces = run.joint_forces()
    assert np.abs(forces.force[:, 0] + tension[:, None] * run.position[:, 0]).max() < 1e-9 * 2 * g
    assert np.abs(np.abs(forces.λ[:, 0]) - np.abs(tension)).max() < 1e-9 * 2 * g


def test_a_beam_held_fast_carries_its_weight_and_moment():
    scene = Scene()
    beam = scene.add(Box((0.5, 0.1, 0.1)), mass=3, position=(0.5, 0, 0))
    scene.join(Fixed(beam))
    run = simulate(scene, 0.1, 0.01)
    assert np.abs(run.position - run.position[0]).max() < 1e-14
    forces = run.joint_forces()
    assert forces.force[-1, 0] == pytest.approx([0, 0, 3 * 9.81], abs=1e-12)
    assert forces.torque[-1, 0] == pytest.approx([0, 0, 0], abs=1e-12)  # about its point, the centre of mass
    weld = Scene(gravity=(0, -9.81))
    a = weld.add(Box((0.5, 0.1)), mass=3, position=(0.5, 0), group=1)
    b = weld.add(Box((0.5, 0.1)), mass=2, position=(1.5, 0), group=1)
    weld.join(Fixed(a))
    weld.join(Fixed(a, b))
    forces = simulate(weld, 0.1, 0.01).joint_forces()
    assert forces.force[-1] == pytest.approx(np.array([[0, 5 * 9.81], [0, 2 * 9.81]]), abs=1e-11)
    assert forces.torque[-1] == pytest.approx([2 * 9.81 * 1, 0], abs=1e-11)


def test_a_slider_on_an_incline_and_one_with_a_spring():
    slope = np.array([np.cos(0.5), -np.sin(0.5)])
    scene = Scene(gravity=(0, -9.81))
    block = scene.add(Box((0.1, 0.1)), mass=2, orientation=-0.5)
    scene.join(Slider(block, axis=slope))
    run = simulate(scene, 1, 0.01)
    assert run.position[-1, 0] == pytest.approx(0.5 * 9.81 * np.sin(0.5) * slope, abs=1e-12)
    scene = Scene(gravity=(0, 0))
    block = scene.add(Box((0.1, 0.1)), mass=2, velocity=(0.3, 0))
    scene.join(Slider(block, axis=(1, 0), stiffness=8))
    run = simulate(scene, 1, 0.005)
    assert run.position[-1, 0] == pytest.approx([0.15 * np.sin(2), 0], abs=1e-9)
    assert np.ptp(run.energy()) < 1e-9 and run.energy()[0] == pytest.approx(0.09)


def test_redundant_hinges_turn_as_one_hinge_does_and_say_so():
    run = simulate(jointed.door(ω=2), 1, 0.01)
    assert run.status == "ok" and "of 10 rows 5 are independent" in run.reason and "N m" in run.reason
    assert run.angular_velocity[-1, 0] == pytest.approx([0, 0, 2], abs=1e-8)
    assert run.position[-1, 0] == pytest.approx([0.4 * np.cos(2), 0.4 * np.sin(2), 1], abs=1e-8)
    forces = run.joint_forces()
    centripetal = -10 * 0.4 * 4 * np.array([np.cos(2), np.sin(2), 0])
    assert forces.force[-1].sum(axis=0) == pytest.approx(centripetal + [0, 0, 98.1], abs=1e-6)
    with pytest.raises(ValueError, match="must be 'minimum_norm' here"):
        simulate(jointed.door(), 1, 0.01, solver="cholesky")


def test_a_parallelogram_through_its_flat_position_says_so():
    run = simulate(jointed.parallelogram(0.5), 2, 0.005)
    assert run.status == "ok" and "near a singular position" in run.reason
    assert run.joint_error().max() < 1e-9
    E = run.energy()
    assert np.abs(E - E[0]).max() < 1e-3 * 9.81 * 3
    assert "singular" not in simulate(jointed.four_bar(0.8), 1, 0.005).reason


@pytest.mark.parametrize("steps", [200, 400])
def test_bricards_mechanism_is_not_locked_by_the_error_within_a_step(steps):
    case = CASES["bricard"]()
    run = simulate(case.scene, case.duration, case.duration / steps)
    assert run.status == "ok" and "of 30 rows 29 are independent" in run.reason
    assert case.error(run) < 0.01 * (200 / steps) ** 3
    assert np.ptp(run.energy()) < 1e-3 * 5 * 9.81


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("steps", [800, 1600])
def test_four_bars_pass_their_singular_positions_with_energy_kept(dimension, steps):
    case = CASES["n_four_bars"](dimension=dimension)
    run = simulate(case.scene, case.duration, case.duration / steps)
    assert run.status == "ok" and "near a singular position" in run.reason
    assert case.error(run) < 1e-3 and np.ptp(run.energy()) < 1e-4 * 6.5 * 9.81


def test_energy_that_jumps_in_a_singular_position_ends_the_run():
    case, steps = CASES["n_four_bars"](), 1600
    options = {"solver": "sparse"}  # which does not look at the rank
    run = simulate(case.scene, case.duration, case.duration / steps, **options)
    assert run.status == "singular" and "though nothing in the scene could change it" in run.reason
    assert "energy changed by" in run.reason and run.time[-1] < case.duration
    assert case.error(replace(run, status="ok")) < 1e-3  # up to there it is right
    assert np.ptp(run.energy()) < 1e-4 * 6.5 * 9.81
    damped = CASES["n_four_bars"]().scene
    damped.drag(0, linear=1e-3)
    assert "energy" not in simulate(damped, case.duration, case.duration / steps, **options).reason


def test_a_motor_without_a_limit_holds_its_speed():
    scene = Scene(gravity=(0, -9.81))
    arm = scene.add(Box((0.5, 0.1)), mass=2, position=(0.5, 0))
    scene.join(Hinge(arm, point=(0, 0), motor=(3.0, np.inf)))
    run = simulate(scene, 1, 0.01)
    assert run.angular_velocity[:, 0] == pytest.approx(3, abs=1e-12)
    assert run.orientation[-1, 0] == pytest.approx(3, abs=1e-9)
    assert "velocities at the start did not fit" in run.reason  # it stood still
    forces = run.joint_forces()
    assert forces.torque[:, 0] == pytest.approx(2 * 9.81 * 0.5 * np.cos(run.orientation[:, 0]), abs=1e-9)


def triangle(*lengths):
    scene = Scene(gravity=(0, 0))
    for x in ((0, 0), (1, 0), (0.5, 0.8)):
        scene.add(Point(), position=x)
    for a, b, length in zip((0, 1, 2), (1, 2, 0), lengths, strict=True):
        scene.join(Distance(a, b, length=length))
    return scene


def test_joints_that_can_not_close_are_refused_and_others_closed():
    with pytest.raises(ValueError, match=r"must be able to hold at the same time.*Distance of bodies"):
        simulate(triangle(1, 1, 3), 0.1, 0.01)
    run = simulate(triangle(1, 1.1, 1.2), 0.1, 0.01)
    sides = [np.linalg.norm(run.position[0, a] - run.position[0, b]) for a, b in ((0, 1), (1, 2), (2, 0))]
    assert sides == pytest.approx([1, 1.1, 1.2], abs=1e-11) and "positions at the start" in run.reason


def test_limits_and_motors_of_limited_force_are_not_smooth():
    for given in ({"limits": (-1, 1)}, {"motor": (1, 5)}):
        scene = Scene(gravity=(0, -9.81))
        scene.join(Hinge(scene.add(Box((0.5, 0.1))), point=(0, 0), **given))
        assert model(scene).simulator == "velocity_lcp"
        with pytest.raises(Unsupported, match="has limits, makes an LCP"):
            simulate(scene, 0.1, 0.01, simulator="smooth")


def test_solver_is_for_joints():
    scene = Scene()
    scene.add(Point())
    with pytest.raises(Unsupported, match="without joints there is nothing to solve"):
        simulate(scene, 0.1, 0.01, solver="sparse")
    with pytest.raises(ValueError, match="solver must be one of"):
        simulate(jointed.chain(2), 0.1, 0.01, solver="lemke")


def test_model_tells_solver_and_rows_and_that_no_contact_is_built():
    told = model(jointed.chain(50))
    assert (told.solver, told.rows, told.integrator) == ("sparse", 100, "rk4")
    assert any("joints: λ by sparse" == term.name for term in told.terms)
    assert any("collision detection" in name and "LCP" in name for name in told.absent)
    costs = [model(jointed.chain(n)).operations for n in (100, 200, 400)]
    assert costs[2] - costs[1] == pytest.approx(2 * (costs[1] - costs[0]), rel=0.01)
    assert "solver sparse for the 100 rows" in str(told)


def test_going_on_from_a_state_is_the_same_as_not_stopping():
    scene = jointed.hinged_chain(3)
    whole = simulate(scene, 1, 0.01)
    half = simulate(scene, 0.5, 0.01)
    rest = simulate(scene, 0.5, 0.01, start=half.state())
    assert np.abs(rest.position[-1] - whole.position[-1]).max() < 1e-10
    simulation = Simulation(scene, 0.01)
    simulation.advance(1)
    assert np.array_equal(simulation.state.position, whole.position[-1])


def test_asking_for_forces_changes_nothing():
    scene = jointed.hinged_chain(3)
    simulation = Simulation(scene, 0.01)
    run = simulation.run(0.3)
    before = simulation.state
    first, second = run.joint_forces(), run.joint_forces()
    assert np.array_equal(first.λ, second.λ)
    assert np.array_equal(simulation.state.position, before.position)


def test_a_users_own_force_acts_on_joined_bodies():
    expected = simulate(jointed.chain(2), 0.1, 0.01)
    scene = jointed.chain(2)
    scene.gravity = np.zeros(2)
    scene.force(lambda t, state: (np.array([[0, -9.81], [0, -9.81]]), np.zeros(2)))
    run = simulate(scene, 0.1, 0.01)
    assert np.abs(run.position - expected.position).max() < 1e-12
    assert np.abs(run.joint_forces().force - expected.joint_forces().force).max() < 1e-10


def plain(code):
    """What a fresh interpreter prints that compiles nothing, as JSON."""
    path = os.pathsep.join(["tests", "tests/reference", "."])
    environment = {**os.environ, "PYTHONPATH": path, "REFERENCE_COMPILED": "0"}
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def few_steps():
    """Two steps of a scene with each solver: positions and velocities, flat."""
    scenes = {
        "cholesky": jointed.hinged_chain(3),
        "sparse": jointed.four_bar(0.8),
        "tree": jointed.star(4),
        "minimum_norm": jointed.door(ω=1),
    }
    runs = {name: simulate(scene, 0.02, 0.01, solver=name) for name, scene in scenes.items()}
    return {
        name: np.concatenate(
            [part.ravel() for part in (run.position, run.orientation, run.velocity)]
        ).tolist()
        for name, run in runs.items()
    }


def test_compiled_and_plain_give_the_same():
    expected = plain("import json; from test_smooth_joints import few_steps; print(json.dumps(few_steps()))")
    for name, found in few_steps().items():
        scale = np.abs(expected[name]).max()
        assert np.abs(np.subtract(found, expected[name])).max() <= 1e-12 * scale, name


ORDERS = """
import json, sys
import numpy as np
import jointed
from reference import simulate
from test_smooth_joints import exact_tip, tip_of
exact, found = exact_tip(2, 1, 0.5), {}
for name in ("rk4", "splitting", "splitting4", "implicit_midpoint", "symplectic_euler", "explicit_euler"):
    errors = []
    for n in (20, 40):
        run = simulate(jointed.chain(2), 0.5, 0.5 / n, integrator=name)
        errors.append(float(np.linalg.norm(tip_of(run) - exact)))
    found[name] = float(np.log2(errors[0] / errors[1]))
json.dump(found, sys.stdout)
"""


def test_the_order_of_each_integrator_with_joints():
    found = plain(ORDERS)  # to save compiling each
    expected = {"rk4": 4, "splitting": 2, "splitting4": 4, "implicit_midpoint": 2}
    expected |= {"symplectic_euler": 1, "explicit_euler": 1}
    assert found == {name: pytest.approx(order, abs=0.35) for name, order in expected.items()}
