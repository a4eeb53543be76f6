"""S9's fixed step with each correction: against the formulas for one row, and the damped oscillator."""

import numpy as np
import pytest

from contact_scenes import G, at, ground, stack
from reference import Box, Disc, Distance, Scene, Simulation, Sphere, Unsupported, simulate
from reference.correction import CORRECTIONS

DIMENSIONS = pytest.mark.parametrize("d", [2, 3])
FRAME = 1 / 60
CLOSED = 1e-9  # of a body's size: an overlap that counts as none, which no second solve is made for
FIXED = [name for name in CORRECTIONS if name != "projection"]


def sunk(d, depth, gravity=G):
    """A ball of 2 kg, at rest, so deep in the ground."""
    scene = Scene(gravity=at(d, 0, -gravity))
    scene.add(Box((5,) * d), static=True, position=at(d, 0, -5))
    scene.add(Disc(0.5) if d == 2 else Sphere(0.5), mass=2.0, position=at(d, 0, 0.5 - depth))
    return scene


def pulled_open(opening, correction, duration, dt, **settings):
    """The opening (T,) of a rod of 1 m between the world and a mass of 3 kg, pulled open along itself."""
    scene = Scene(gravity=(0, 0))
    scene.add(Disc(0.1), mass=3.0, position=(1, 0))
    scene.add(Disc(0.1), static=True, position=(0, 9))  # what may be touched, so that this simulator runs
    scene.join(Distance(0, None, point_a=(1, 0), point_b=(0, 0)))
    sim = Simulation(scene, dt, correction=correction, **settings)
    start = sim.state
    start.position[0, 0] += opening
    run = simulate(scene, duration, dt, start=start, correction=correction, **settings)
    assert run.status == "ok"
    return run.position[:, 0, 0] - 1, run


def depth(run, d):
    """(T,), m."""
    return 0.5 - run.position[:, 1, d - 1]


# --- the decay of the error ---------------------------------------------------------------------------------


@DIMENSIONS
def test_baumgarte_takes_back_a_fraction_a_step_and_rests_at_slop(d):
    """Weight holds the ball in touch: from one step to the next its speed falls by less than g Δt."""
    run = simulate(sunk(d, 0.01), 2, FRAME, correction="baumgarte")
    beyond = 0.005 * 0.8 ** np.arange(len(run.time))
    np.testing.assert_allclose(depth(run, d), 0.005 + beyond, rtol=0, atol=1e-13)


@DIMENSIONS
def test_split_impulse_takes_back_the_same_without_any_speed(d):
    run = simulate(sunk(d, 0.01), 2, FRAME, correction="split_impulse")
    np.testing.assert_allclose(depth(run, d), 0.01 * 0.8 ** np.arange(len(run.time)), rtol=0, atol=CLOSED)
    assert np.abs(run.velocity).max() < 1e-13
    rise = 2 * G * (0.01 - depth(run, d))  # what is lifted gains m g times its height, and nothing else
    np.testing.assert_allclose(run.energy() - run.energy()[0], rise, atol=1e-12)


@DIMENSIONS
def test_baumgarte_throws_and_split_impulse_does_not(d):
    """Without weight: fraction · (depth − slop)/Δt stays in the ball, and so does its kinetic energy."""
    thrown = simulate(sunk(d, 0.01, 0.0), 0.5, FRAME, correction="baumgarte")
    speed = 0.2 * 0.005 / FRAME
    np.testing.assert_allclose(thrown.velocity[1:, 1, d - 1], speed, rtol=1e-12)
    assert thrown.energy()[-1] - thrown.energy()[0] == pytest.approx(0.5 * 2 * speed**2, rel=1e-12)
    lifted = simulate(sunk(d, 0.01, 0.0), 0.5, FRAME, correction="split_impulse")
    assert np.abs(lifted.energy() - lifted.energy()[0]).max() < 1e-15


@DIMENSIONS
def test_nonlinear_takes_back_a_fraction_a_sweep(d):
    run = simulate(sunk(d, 0.01), 1, FRAME, correction="nonlinear")
    beyond = 0.005 * 0.8 ** (3 * np.arange(len(run.time)))
    np.testing.assert_allclose(depth(run, d), 0.005 + beyond, rtol=0, atol=1e-13)
    assert np.abs(run.velocity).max() < 1e-13


@DIMENSIONS
def test_none_leaves_what_there_is(d):
    run = simulate(sunk(d, 0.01), 1, FRAME, correction="none")
    np.testing.assert_allclose(depth(run, d), 0.01, atol=1e-13)


@pytest.mark.parametrize(
    ("correction", "left"),
    [("none", 1.0), ("baumgarte", 0.8), ("split_impulse", 0.8), ("nonlinear", 0.8**3)],
)
def test_joints_are_closed_at_the_same_rate(correction, left):
    """Along the rod φ is linear, so the decay is exact."""
    opening, _ = pulled_open(0.01, correction, 0.5, FRAME)
    np.testing.assert_allclose(opening, 0.01 * left ** np.arange(len(opening)), rtol=0, atol=CLOSED)


def test_substeps_are_steps():
    """Four substeps take back a fraction four times."""
    run = simulate(sunk(2, 0.01), 0.5, FRAME, correction="split_impulse", substeps=4)
    np.testing.assert_allclose(
        depth(run, 2), 0.01 * 0.8 ** (4 * np.arange(len(run.time))), rtol=0, atol=CLOSED
    )


# --- soft constraints ---------------------------------------------------------------------------------------


def implicit_euler(x, v, a, h, ω, ζ, steps):
    """x (steps + 1,) and v of x'' = a − ω² x − 2 ζ ω x', by the implicit Euler method."""
    xs, vs = [x], [v]
    for _ in range(steps):
        v = (v + h * a - h * ω**2 * x) / (1 + 2 * h * ζ * ω + h * h * ω**2)
        x += h * v
        xs.append(x)
        vs.append(v)
    return np.array(xs), np.array(vs)


@DIMENSIONS
@pytest.mark.parametrize(("frequency", "ratio"), [(30.0, 10.0), (2.0, 1.0), (500.0, 0.7)])
def test_a_soft_contact_is_the_implicit_spring_and_damper(d, frequency, ratio):
    """Overdamped from a depth beyond that of rest, or stiff, the ball does not leave the ground: x = gap.

    Solved exactly, by a pivoting method that does not take the λ of the step before for good enough.
    """
    ω, sinks = 2 * np.pi * frequency, G / (2 * np.pi * frequency) ** 2
    soft = {"correction": ("soft", {"frequency": frequency, "ratio": ratio})}
    run = simulate(sunk(d, 1.5 * sinks), 0.5, FRAME, friction="box", warm_start=False, **soft)
    default = simulate(sunk(d, 1.5 * sinks), 0.5, FRAME, **soft)
    np.testing.assert_allclose(default.position, run.position, rtol=0, atol=1e-11)
    x, v = implicit_euler(-1.5 * sinks, 0.0, -G, FRAME, ω, ratio, 30)
    assert x.max() < 0
    np.testing.assert_allclose(-depth(run, d), x, rtol=0, atol=1e-12)
    np.testing.assert_allclose(run.velocity[:, 1, d - 1], v, rtol=0, atol=1e-12)


def test_a_soft_joint_is_the_damped_oscillator():
    """x = e^(−ζωt) (cos ω't + ζω/ω' sin ω't); the method damps by ½ h ω² a second besides."""
    f, ζ = 1.0, 0.1
    ω = 2 * np.pi * f
    ω_d = ω * np.sqrt(1 - ζ**2)
    worst = []
    for h in (1 / 250, 1 / 500):
        opening, run = pulled_open(0.01, ("soft", {"frequency": f, "ratio": ζ}), 1, h)
        t = run.time
        exact = 0.01 * np.exp(-ζ * ω * t) * (np.cos(ω_d * t) + ζ * ω / ω_d * np.sin(ω_d * t))
        worst.append(np.abs(opening - exact).max())
    assert worst[1] < 0.01 * 0.5 * ω**2 / 500 and 1.8 < worst[0] / worst[1] < 2.2


@pytest.mark.parametrize(
    ("friction", "solver"), [("cone", "cone_gauss_seidel"), ("box", "gauss_seidel"), ("pyramid", "lemke")]
)
def test_all_methods_know_softness(friction, solver):
    run = simulate(sunk(3, 0.01), 0.2, FRAME, correction="soft", friction=friction, solver=solver)
    default = simulate(sunk(3, 0.01), 0.2, FRAME, correction="soft")
    np.testing.assert_allclose(run.position, default.position, atol=1e-10)


# --- rest, rebound, energy ----------------------------------------------------------------------------------


@DIMENSIONS
@pytest.mark.parametrize("correction", ["projection", "split_impulse"])
def test_at_rest_nothing_is_left_of_an_overlap(d, correction):
    """Five boxes, each 1 cm in the one below: .8^180 of it is left after 3 s, or what counts as none."""
    scene = ground(d)
    for i in range(5):
        scene.add(Box((0.5,) * d), position=at(d, 0, 0.5 + i - 0.01 * (i + 1)))
    run = simulate(scene, 3, FRAME, correction=correction, record_every=180)
    assert run.penetration()[-1] < 1e-6 and np.abs(run.velocity[-1]).max() < 1e-9
    rise = G * 0.01 * 15  # m g times the height that each is lifted by
    assert run.energy()[-1] - run.energy()[0] == pytest.approx(rise, rel=1e-6)


@pytest.mark.parametrize("correction", FIXED)
def test_a_stack_stands_under_each(correction):
    """What it settles by is the slop, or the softness: less than 1 cm for each contact."""
    run = simulate(stack(2, 5), 2, FRAME, correction=correction, record_every=60)
    assert run.status == "ok" and not run.reason and run.settings["correction"] == correction
    assert np.abs(run.position - run.position[0]).max() < 0.01
    assert np.abs(run.velocity[-1]).max() < 1e-6
    contacts = run.contacts[-1]
    assert contacts.impulse[contacts.bodies[:, 0] == 0, 0].sum() == pytest.approx(5 * G, rel=1e-6)


@DIMENSIONS
def test_a_ball_rebounds_from_the_speed_at_the_start(d):
    """In the step in which it would meet the ground: w⁺ = −e w⁻, whatever the gap still is."""
    scene = Scene(gravity=at(d, 0, -G))
    scene.add(Box((5,) * d), static=True, position=at(d, 0, -5))
    scene.add(Disc(0.5) if d == 2 else Sphere(0.5), position=at(d, 0, 1.5), restitution=0.6)
    run = simulate(scene, 1, FRAME, correction="none")
    v = run.velocity[:, 1, d - 1]
    k = int(np.argmax(v > 0))
    assert v[k] == pytest.approx(-0.6 * v[k - 1], rel=1e-12)
    assert v[k - 1] == pytest.approx(-G * FRAME * (k - 1), rel=1e-12)  # symplectic Euler until then


@DIMENSIONS
def test_free_flight_is_symplectic_euler(d):
    """x_k = −g Δt² k (k + 1)/2: half a step ahead of the parabola, as every engine that steps so."""
    run = simulate(sunk(d, -10.0), 0.5, FRAME, correction="none")
    k = np.arange(len(run.time))
    np.testing.assert_allclose(depth(run, d) + 10, G * FRAME**2 * k * (k + 1) / 2, atol=1e-12)


def test_bad_corrections_are_named():
    scene = stack(2, 1)
    for given, error, words in (
        ("springs", ValueError, "correction must be one of baumgarte, "),
        (("baumgarte", {"frequency": 3}), ValueError, "no parameter 'frequency': there is fraction, slop"),
        (("soft", {"frequency": 0}), ValueError, "correction's frequency must be"),
        (("nonlinear", {"sweeps": 1.5}), TypeError, "correction's sweeps must be"),
        (("soft", 3), TypeError, "correction must be a name, or"),
        (["soft", {}], TypeError, r"correction must be a name, or .*, but is \['soft', {}\]"),
        ((["soft"], {}), TypeError, "correction must be a name, or"),
    ):
        with pytest.raises(error, match=words):
            simulate(scene, 0.1, 0.1, correction=given)
    with pytest.raises(Unsupported, match="Newton's law only"):
        simulate(scene, 0.1, 0.1, correction="none", impact="poisson")
