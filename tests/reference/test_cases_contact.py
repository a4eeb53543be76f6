"""Cases with contact: exact answers against independent sums, ours to its promises, engines to CASES.md's."""

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from reference import simulate
from reference.cases import CASES
from reference.cases.heaps import RATE
from reference.peers import ENGINES, simulate_in

G, FRAME = 9.81, 1 / 60
ALL = [
    ("stack", {"n": 10, "heavy": 1000}, FRAME, 1e-6),
    ("stack", {"n": 4, "dimension": 3, "duration": 1.0}, FRAME, 1e-6),
    ("pyramid", {"base": 6, "duration": 1.0}, FRAME, 1e-6),
    ("pyramid", {"base": 3, "dimension": 3, "duration": 0.5}, FRAME, 1e-6),
    ("table", {"duration": 0.5}, FRAME, 1e-6),
    ("overhang", {"n": 4, "share": 0.97}, FRAME, 1e-6),
    ("overhang", {"n": 4, "share": 1.03}, FRAME, 0.0),
    ("arch", {}, FRAME, 1e-6),
    ("arch", {"ratio": 0.14}, FRAME, 1e-6),
    ("arch", {"ratio": 0.075}, FRAME, 0.0),
    ("slope", {}, FRAME, 1e-9),
    ("slope", {"share": 0.95}, FRAME, 1e-9),
    ("slope", {"share": 0.95, "dimension": 3}, FRAME, 1e-9),
    ("rolling", {}, FRAME, 1e-9),
    ("rolling", {"dimension": 3}, FRAME, 1e-9),
    ("spinning_disc", {}, 1e-3, 1e-5),
    ("bounce", {}, FRAME, 1e-8),
    ("bounce", {"dimension": 3, "restitution": 0.8, "duration": 4.0}, FRAME, 1e-8),
    ("cradle", {}, FRAME, 1e-11),
    ("cradle", {"incoming": 2}, FRAME, 1e-11),
    ("cradle", {"n": 3, "law": "newton"}, FRAME, 1e-11),
    ("rolling_plate", {}, 1 / 40, 1e-8),
    ("painleve", {}, 0.01, 1e-3),
    ("painleve", {}, 0.001, 1e-4),
    ("rocking_block", {}, 1e-3, 1e-2),
    ("heavy_on_two", {"duration": 1.0}, FRAME, 1e-9),
    ("heavy_on_two", {"duration": 0.5, "heavy": 1e8}, 0.1, 1e-8),
    ("heavy_on_two", {"duration": 0.5, "dimension": 3}, FRAME, 1e-9),
    ("pulled_block", {"share": 0.98}, FRAME, 1e-9),
    ("pulled_block", {}, FRAME, 1e-9),
    ("descent", {"share": 1.02}, FRAME, 1e-9),
    ("descent", {"share": 0.98}, FRAME, 1e-9),
    ("descent", {"share": 1.02, "dimension": 3}, FRAME, 1e-9),
    ("descent", {"share": 0.98, "dimension": 3}, FRAME, 1e-9),
    ("card_house", {"storeys": 1, "share": 1.02, "duration": 1.0}, FRAME, 1e-9),
    ("card_house", {"storeys": 1, "share": 0.98}, FRAME, 0.0),
    ("card_house", {"storeys": 3, "duration": 1.0}, FRAME, 1e-9),
    ("bridge", {"duration": 0.5}, FRAME, 1e-9),
    ("bridge", {"planks": 10, "duration": 0.5, "dimension": 3}, FRAME, 1e-9),
    ("kane", {}, 0.01, 1e-9),
]


@pytest.mark.parametrize(
    ("name", "parameters", "dt", "tolerance"), ALL, ids=[f"{i}-{a[0]}" for i, a in enumerate(ALL)]
)
def test_ours(name, parameters, dt, tolerance):
    case = CASES[name](**parameters)
    law = {"impact": parameters.get("law", "sequential")} if name == "cradle" else {}
    law |= {"impact": "newton"} if name == "kane" else {}
    run = simulate(case.scene, case.duration, dt, record_every=5, record_contacts=False, **law)
    assert case.error(run) <= tolerance


# ---- the answers themselves, again by other means


def test_bounce_against_flights_summed_one_by_one():
    """Rest at 1.354571 s, each apex e² of the last: CASES.md."""
    case = CASES["bounce"]()
    t = np.linspace(0, 2, 200_001)
    motion = case.exact(t)
    z, v = motion.position[:, 1, 1] - 0.1, motion.velocity[:, 1, 1]
    assert t[np.nonzero(v)[0][-1]] == pytest.approx(1.354571, abs=2e-5)
    tops = z[1:-1][(z[1:-1] > z[:-2]) & (z[1:-1] >= z[2:])]
    np.testing.assert_allclose(tops[:4], 0.25 ** np.arange(1, 5), rtol=1e-6)
    flying = z > 1e-3
    np.testing.assert_allclose(np.gradient(z, t)[flying][50:200], v[flying][50:200], atol=1e-3)


@pytest.mark.parametrize("dimension", [2, 3])
def test_rolling_keeps_angular_momentum_about_the_ground(dimension):
    case = CASES["rolling"](dimension=dimension)
    motion = case.exact(np.linspace(0, 1, 11))
    I, v = (0.5 if dimension == 2 else 0.4) * 0.09, motion.velocity[:, 1, 0]
    ω = -motion.angular_velocity[:, 1] if dimension == 2 else motion.angular_velocity[:, 1, 1]
    np.testing.assert_allclose(0.3 * v + I * ω, 0.6, rtol=1e-12)
    assert v[-1] == pytest.approx(2 * (2 / 3 if dimension == 2 else 5 / 7))
    assert v[-1] == pytest.approx(0.3 * ω[-1])


def test_spinning_disc_by_integrating_its_two_frictions():
    case, μ, r, t = CASES["spinning_disc"](), 0.3, 0.2, np.linspace(0, 0.3, 5)
    floor = G / (1 + μ * μ)
    rate = -μ * (floor + μ * floor) * r / (0.5 * r * r)
    np.testing.assert_allclose(case.exact(t).angular_velocity[:, 2], 20 + rate * t, rtol=1e-12)
    turns = case.exact(np.array([9.0])).orientation[0, 2] / (2 * np.pi)
    assert turns == pytest.approx((1 + μ**2) * 400 * r / (8 * np.pi * μ * (1 + μ) * G))


def test_rolling_plate_is_the_published_table():
    case = CASES["rolling_plate"]()
    speed = np.linalg.norm(case.exact(np.array([1.0])).velocity[0], axis=-1)
    np.testing.assert_allclose(speed[[1, 2, 26]], [0.7385, 0.2110, 0.2110], atol=5e-5)
    motion = case.exact(np.array([0.2]))
    slip = (
        motion.velocity[0, 5] + np.cross(motion.angular_velocity[0, 5], (0, 0, -0.5)) - motion.velocity[0, 1]
    )
    np.testing.assert_allclose(slip, 0, atol=1e-12)


def test_painleve_by_the_lcp_of_its_first_step():
    """M and q as CASES.md has them: v⁺ = (−.57, .285), ω = .637279; ours takes that very step."""
    M = np.array([[1.6, -1.2, 1.2, 0], [-1.2, 3.4, -3.4, 1], [1.2, -3.4, 3.4, 1], [2, -1, -1, 0]])
    q = np.array([-0.1, -1, 1, 0])
    λn, λt = np.linalg.solve([[1.6, -1.2], [-1.2, 3.4]], [0.1, 1.0])  # the tip stops: both w are 0
    assert 0 <= λt <= 2 * λn
    z = np.array([λn, λt, 0, 0])
    w = M @ z + q
    assert np.all(w >= -1e-12) and abs(w @ z) < 1e-12
    case = CASES["painleve"]()
    run = simulate(case.scene, 0.01, 0.01)
    np.testing.assert_allclose(run.velocity[-1, 1], [-1 + λt, λn - 0.1], atol=1e-9)
    assert run.angular_velocity[-1, 1] == pytest.approx(0.637279, abs=5e-7)


def test_rocking_block_by_integrating_it_anew():
    """With an event where it lands; Housner's share of ω is left."""
    α, p2 = np.arctan2(0.25, 1.0), 0.75 * G / np.hypot(0.25, 1.0)

    def landed(t, y):
        return y[0]

    landed.terminal = True
    first = solve_ivp(
        lambda t, y: [y[1], -p2 * np.sin(α - y[0])], (0, 2), (0.1, 0.0), events=landed, rtol=1e-11, atol=1e-13
    )
    assert first.t_events[0][0] == pytest.approx(0.4, abs=0.1)
    left = first.y_events[0][0][1] * (1 - 1.5 * np.sin(α) ** 2)
    then = solve_ivp(
        lambda t, y: [y[1], p2 * np.sin(α + y[0])], (first.t[-1], 1.0), (0.0, left), rtol=1e-11, atol=1e-13
    )
    motion = CASES["rocking_block"]().exact(np.array([first.t[-1] - 1e-6, 1.0]))
    assert motion.orientation[0, 1] == pytest.approx(0, abs=1e-5)
    assert motion.orientation[1, 1] == pytest.approx(then.y[0, -1], rel=1e-6)
    numeric = CASES["rocking_block"]().exact(np.array([0.7 - 1e-5, 0.7, 0.7 + 1e-5]))
    slope = (numeric.position[2, 1] - numeric.position[0, 1]) / 2e-5
    np.testing.assert_allclose(slope, numeric.velocity[1, 1], rtol=1e-5)


def test_the_arch_is_a_half_ring_on_the_ground():
    scene = CASES["arch"](ratio=0.2, stones=60).scene
    mass = sum(body.mass for body in scene.bodies)
    assert mass == pytest.approx(2000 * np.pi / 2 * (1.1**2 - 0.9**2), rel=1e-3)
    assert min(b.position[1] + min(y for _, y in b.shape.vertices) for b in scene.bodies[1:]) > -0.1


def carried(run, j, k=-1):
    """The normal force on body j from bodies with lower numbers, averaged over record k, N."""
    c = run.contacts[k]
    return c.impulse[c.bodies[:, 1] == j, 0].sum() / (run.time[k] - run.time[k - 1])


def test_each_of_two_boxes_carries_half():
    run = simulate(CASES["heavy_on_two"]().scene, 0.5, FRAME)
    assert [carried(run, j) for j in (1, 2)] == pytest.approx([201 * G, 201 * G], rel=1e-8)


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("share", [0.5, 1.0, 2.0])
def test_descent_by_newtons_law_and_no_slip_or_coulomb(dimension, share):
    """Three equations for a, α and the friction F: m a = m g sin θ − F, I α = F r, and a = α r or F = μ N."""
    angle, r, k = 0.4, 0.3, 1 / 2 if dimension == 2 else 2 / 5
    μ = share * (1 / 3 if dimension == 2 else 2 / 7) * np.tan(angle)
    third = [1, -r, 0] if share >= 1 else [0, 0, 1]
    right = [G * np.sin(angle), 0, 0 if share >= 1 else μ * G * np.cos(angle)]
    a, α, _ = np.linalg.solve([[1, 0, 1], [0, k * r * r, -r], third], right)
    motion = CASES["descent"](share=share, dimension=dimension).exact(np.array([2.0]))
    assert motion.velocity[0, 1, 0] == pytest.approx(2 * a)
    ω = -motion.angular_velocity[0, 1] if dimension == 2 else motion.angular_velocity[0, 1, 1]
    assert ω == pytest.approx(2 * α)


def test_card_house_by_its_own_forces():
    """One pair: what its feet push outwards, as found by the solver, is what moments about a foot say."""
    run = simulate(CASES["card_house"](storeys=1).scene, 0.5, FRAME)
    c = run.contacts[-1]
    foot = c.bodies[:, 0] == 0
    thrust = np.abs(c.impulse[foot, 1] / FRAME)
    s, h = np.sin(0.3), np.cos(0.3)
    np.testing.assert_allclose(thrust, 0.1 * G * 0.5 * s / (h + 0.02), rtol=1e-8)


def test_bridge_against_its_forces_summed_along_it():
    """Forces at each hinge by summing weights from the left pier; each plank's moments must vanish."""
    planks, load = 12, 30.0
    scene = CASES["bridge"](planks=planks, load=load).scene
    φ = np.array([body.orientation for body in scene.bodies[:planks]])
    e = np.stack([np.cos(φ), np.sin(φ)], axis=1)
    ball, middle = scene.bodies[planks].position, scene.bodies[planks // 2]
    n = np.array([-e[planks // 2, 1], e[planks // 2, 0]])
    along = (ball - middle.position) @ e[planks // 2]
    assert (ball - middle.position) @ n == pytest.approx(0.5 + 0.05)  # touches the top of the plank
    N = load * G / 2 / n[1]
    pier_up = (planks * G + load * G) / 2
    H = (pier_up - 0.5 * G) * e[0, 0] / -e[0, 1]  # the first plank: its far end and its weight
    V = pier_up
    for k in range(planks // 2 - 1):  # V: the upward force on the plank's left end, H: pulls it to the left
        assert e[k, 0] * (V - 0.5 * G) + e[k, 1] * H == pytest.approx(0, abs=1e-9 * H)
        V -= G
    k = planks // 2 - 1  # this one bears the ball, at the mirror place of the one right of it
    ball_force, place = N * np.array([-n[0], -n[1]]) * [-1, 1], -along
    V_right = V - G + ball_force[1]
    assert V_right == pytest.approx(0, abs=1e-9 * H)  # nothing goes up or down in the middle, by symmetry
    turn = -0.5 * (e[k, 0] * V + e[k, 1] * H) + place * (e[k, 0] * ball_force[1] - e[k, 1] * ball_force[0])
    right_end = np.array([H - ball_force[0], 0.0])
    turn += 0.5 * (e[k, 0] * right_end[1] - e[k, 1] * right_end[0])
    assert turn == pytest.approx(0, abs=1e-9 * H)


def test_kanes_paradox_gains_energy_only_where_it_is_asked_for():
    """ΔT = ½ λᵀ(w⁺ + w⁻) by hand: .0531 J of .68 under Newton's law; none by default, nor under Poisson's
    with so little friction that the tip goes on sliding.
    """
    scene = CASES["kane"]().scene
    gains = {}
    for law in (None, "newton"):
        energy = simulate(scene, 0.1, 0.01, impact=law).energy()
        gains[law] = energy[-1] - energy[0]
    λ_n, λ_t = (2.5 * 1.9 - 1.5 * 0.6) / 4, (1.5 * 1.9 - 2.5 * 0.6) / 4  # A = [[2.5, −1.5], [−1.5, 2.5]]
    assert gains["newton"] == pytest.approx(0.5 * (-0.1 * λ_n + 0.6 * λ_t), rel=1e-9)
    assert gains[None] <= 1e-12


def test_silo_law_by_quadrature():
    """Grains that fall freely from a half circle over the opening: ∫ √(2 g y) dx."""
    flow = quad(lambda x: np.sqrt(2 * np.sqrt(1 - x * x)), -1, 1)[0]
    assert flow / 2**1.5 == pytest.approx(RATE, abs=5e-4)


@pytest.mark.parametrize(("dimension", "n"), [(2, 30), pytest.param(3, 20, marks=pytest.mark.study)])
def test_a_small_heap_comes_to_rest(dimension, n):
    """On the box stands its weight, to 1e-6; nothing went through, or gained energy."""
    case = CASES["heap"](n=n, dimension=dimension, duration=4.0)
    run = simulate(case.scene, case.duration, 1 / 60, record_every=15)
    assert run.status == "ok" and case.error(run) < 1e-6


# ---- the engines, to what CASES.md grants them

FINE = {"slop": 1e-4, "iterations": 100}
BULLET = {"residual": 0.0, "iterations": 200}
IN_ENGINES = [
    ("pymunk", "rolling", {}, 1e-3, {}, 1e-8),
    ("pybullet", "rolling", {"dimension": 3}, 1e-3, {}, 1e-8),
    ("pymunk", "slope", {"share": 0.5, "duration": 1.0}, 1e-3, FINE, 3e-3),
    ("pybullet", "slope", {"share": 0.5, "duration": 1.0, "dimension": 3}, 1e-3, BULLET, 3e-3),
    ("pymunk", "stack", {"n": 10, "duration": 1.0}, 1e-3, FINE, 1e-2),
    ("pymunk", "arch", {"duration": 1.0}, 1e-3, FINE, 1e-2),
    ("pymunk", "arch", {"ratio": 0.06, "duration": 2.0}, 1e-3, FINE, 0.0),
    ("pymunk", "overhang", {"share": 0.7}, 1e-3, FINE, 1e-2),
    ("pymunk", "overhang", {"share": 1.3}, 1e-3, FINE, 0.0),
    ("pymunk", "heavy_on_two", {"duration": 0.5}, 1e-3, FINE, 1e-2),
    ("pybullet", "pulled_block", {"share": 2.0}, 1e-3, BULLET, 3e-3),
    ("pymunk", "descent", {"share": 0.5}, 1e-3, FINE, 3e-3),
    ("pymunk", "descent", {"share": 1.5}, 1e-3, FINE, 3e-3),
    ("pybullet", "descent", {"share": 1.5, "dimension": 3}, 1e-3, BULLET, 3e-3),
    ("pymunk", "card_house", {"storeys": 1, "share": 1.5, "duration": 1.0}, 1e-3, FINE, 1e-2),
    ("pymunk", "card_house", {"storeys": 1, "share": 0.6}, 1e-3, FINE, 0.0),
    ("pymunk", "bridge", {"planks": 10, "duration": 0.2}, 1e-3, FINE, 1e-2),
]


@pytest.mark.parametrize(("engine", "name", "parameters", "dt", "settings", "tolerance"), IN_ENGINES)
def test_in_engines(engine, name, parameters, dt, settings, tolerance):
    if not ENGINES[engine].available:
        pytest.skip(f"{engine} is not installed")
    case = CASES[name](**parameters)
    run = simulate_in(
        case.scene, engine, case.duration, dt, record_every=50, record_contacts=False, **settings
    )
    assert case.error(run) <= tolerance


def test_bad_parameters_are_named():
    for name, parameters, word in (
        ("stack", {"n": 0}, "n must"), ("stack", {"heavy": -1}, "heavy"), ("pyramid", {"base": 1.5}, "base"),
        ("slope", {"angle": 1.0}, "angle"), ("overhang", {"share": 1}, "share"),
        ("arch", {"ratio": 0.11}, "ratio"),
        ("bounce", {"restitution": 2}, "restitution"), ("cradle", {"law": "glue"}, "law"),
        ("cradle", {"law": "newton"}, "incoming"), ("painleve", {"friction": 1.0}, "friction"),
        ("rocking_block", {"tilt": 0.5}, "tilt"), ("rolling", {"dimension": 4}, "dimension"),
        ("spinning_disc", {"spin": -1}, "spin"), ("table", {"leg": 0}, "leg"),
        ("rolling_plate", {"duration": 0}, "duration"),
        ("heavy_on_two", {"heavy": 0}, "heavy"), ("pulled_block", {"share": -1}, "share"),
        ("descent", {"angle": 2.0}, "angle"), ("card_house", {"storeys": 2, "share": 0.9}, "share"),
        ("bridge", {"planks": 11}, "planks"), ("bridge", {"span": 1.5}, "span"),
        ("kane", {"friction": 0.1}, "friction"), ("heap", {"n": 0}, "n must"),
        ("silo", {"opening": 0}, "opening"),
    ):  # fmt: skip
        with pytest.raises(ValueError, match=word):
            CASES[name](**parameters)
