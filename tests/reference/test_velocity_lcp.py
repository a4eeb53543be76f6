"""The velocity-based simulator: rest, friction, impacts, energy; against statics, mechanics, published
tables.
"""

import numpy as np
import pytest

from contact_scenes import G, at, block, ground, pyramid, rise, stack
from reference import (
    Box,
    Capsule,
    Disc,
    Plane,
    Point,
    Scene,
    Simulation,
    Sphere,
    Unsupported,
    model,
    simulate,
)

DIMENSIONS = pytest.mark.parametrize("d", [2, 3])
FRAME = 1 / 60


def moved(run):
    """The farthest that any body is from where it began, m."""
    return np.abs(run.position - run.position[0]).max()


def force_on(run, j, k=-1):
    """The contacts' normal force on body j from bodies with lower numbers, averaged over record k, N."""
    contacts = run.contacts[k]
    return contacts.impulse[contacts.bodies[:, 1] == j, 0].sum() / (run.time[k] - run.time[k - 1])


# --- rest ---------------------------------------------------------------------------------------------------


@DIMENSIONS
@pytest.mark.parametrize(("n", "top"), [(10, 1000.0), (20, 1000.0), (50, 1.0)])
def test_stacks_stand_and_carry_their_weight(d, n, top):
    """Each box carries the weights above, whatever the top weighs; nothing drifts, in 5 s."""
    run = simulate(stack(d, n, top), 5, FRAME, record_every=150)
    assert run.status == "ok" and moved(run) < 1e-9
    above = G * (np.arange(n - 1, -1, -1) + top)
    np.testing.assert_allclose([force_on(run, j) for j in range(1, n + 1)], above, rtol=1e-8)
    assert run.penetration().max() < 1e-9


def test_a_pyramid_stands():
    run = simulate(pyramid(20), 1, FRAME, record_every=30)
    assert moved(run) < 1e-9
    contacts = run.contacts[-1]
    on_ground = contacts.impulse[contacts.bodies[:, 0] == 0, 0].sum() / 0.5
    assert on_ground == pytest.approx(210 * G, rel=1e-8)


def test_a_table_on_four_legs():
    """Rank 3: single forces are not unique; their sum is the weight, and nothing moves."""
    scene = ground(3)
    scene.add(Box((1, 0.7, 0.1)), mass=8, position=(0, 0, 1.1))
    for x in (-0.9, 0.9):
        for y in (-0.6, 0.6):
            scene.add(Box((0.05, 0.05, 0.5)), mass=0.5, position=(x, y, 0.5))
    run = simulate(scene, 0.5, FRAME, record_every=10)
    contacts = run.contacts[-1]
    legs = contacts.bodies[:, 0] == 1  # table (1) on legs (2 … 5): n points down, from the lower number on
    assert contacts.impulse[legs, 0].sum() / (run.time[-1] - run.time[-2]) == pytest.approx(8 * G, rel=1e-8)
    assert moved(run) < 1e-9


@pytest.mark.parametrize(("overhang", "stands"), [(0.499, True), (0.501, False)])
def test_two_boxes_overhang(overhang, stands):
    """A box stands on another's edge up to half its length (½ Σ 1/k for k = 1)."""
    scene = ground(2)
    scene.add(Box((0.5, 0.5)), position=(0, 0.5))
    scene.add(Box((0.5, 0.5)), position=(overhang, 1.5))
    run = simulate(scene, 1, FRAME, record_every=60)
    assert (moved(run) < 1e-9) == stands


# --- friction -----------------------------------------------------------------------------------------------


@DIMENSIONS
@pytest.mark.parametrize("dt", [1 / 30, 1 / 60, 1 / 500])
def test_a_block_on_a_slope(d, dt):
    """It sticks if μ > tan θ, without creep; else it slides by ½ g (sin θ − μ cos θ) t²."""
    slope = np.pi / 6
    assert moved(simulate(block(d, slope, 1.005 * np.tan(slope)), 3, dt, record_every=30)) < 1e-9
    run = simulate(block(d, slope, 0.95 * np.tan(slope)), 3, dt, record_every=30)
    way = 0.5 * G * np.sin(slope) * 0.05 * run.time**2
    np.testing.assert_allclose(run.position[:, 1, 0], way, atol=1e-9)


@pytest.mark.parametrize("angle", np.linspace(0, np.pi, 7))
def test_friction_is_isotropic(angle):
    """1 kg, μ = ½: sticks up to a pull of ½ g in every direction; beyond it the rest of the pull
    accelerates.
    """
    for pull in (4.9, 6.0):
        scene = ground(3, friction=1.0)
        scene.add(Box((0.5,) * 3), position=(0, 0, 0.5), friction=0.5)
        along = np.array([np.cos(angle), np.sin(angle), 0])
        scene.force(lambda t, state, f=pull * along: (np.array([0 * f, f]), np.zeros((2, 3))))
        run = simulate(scene, 0.5, FRAME, record_every=30)
        rate = max(0.0, pull - 0.5 * G)
        np.testing.assert_allclose(run.velocity[-1, 1], 0.5 * rate * along, atol=1e-8)


@pytest.mark.parametrize(("shape", "d", "share"), [(Sphere(0.3), 3, 5 / 7), (Disc(0.3), 2, 2 / 3)])
def test_sliding_turns_to_rolling(shape, d, share):
    """The final speed is 5/7 (2/3) of the first, whatever μ is."""
    scene = ground(d, friction=1.0)
    scene.add(shape, position=at(d, 0, 0.3), velocity=at(d, 2, 0), friction=0.3)
    run = simulate(scene, 1, FRAME, record_every=60)
    assert run.velocity[-1, 1, 0] == pytest.approx(2 * share, rel=1e-9)


@pytest.mark.parametrize(("shape", "d", "least"), [(Sphere(0.3), 3, 2 / 7), (Disc(0.3), 2, 1 / 3)])
@pytest.mark.parametrize("share", [0.9, 1.1])
def test_rolling_on_a_slope_needs_friction(shape, d, least, share):
    """Rolls without slipping if μ ≥ 2/7 (1/3) tan θ; with less it slips, and is faster."""
    slope = 0.4
    scene = ground(d, slope, friction=1.0)
    scene.add(shape, position=at(d, 0, 0.3), friction=share * least * np.tan(slope))
    run = simulate(scene, 1, FRAME, record_every=60)
    speed, spin = run.velocity[-1, 1, 0], np.linalg.norm(run.angular_velocity[-1, 1])
    slip = speed - 0.3 * spin
    assert slip < 1e-9 if share > 1 else slip > 0.01
    rolling = G * np.sin(slope) * (1 - least)
    assert speed == pytest.approx(rolling if share > 1 else G * np.sin(slope) * (1 - share * least), rel=1e-8)


def test_balls_on_a_plate_that_slides():
    """SimBenchmark's rolling plate: 25 balls on a plate, pulled along (½, √3/2) by 150 N; all friction is
    one cone.
    """
    scene = Scene()
    scene.add(Plane((0, 0, 1)), friction=1.0)
    plate = scene.add(Box((5, 5, 0.1)), mass=10, position=(0, 0, 0.1), friction=0.4)
    for i in range(25):
        place = (2.0 * (i % 5) - 4, 2.0 * (i // 5) - 4, 0.7)
        scene.pair(plate, scene.add(Sphere(0.5), position=place), friction=0.8)
    pull = 150 * np.array([0.5, np.sqrt(0.75), 0])

    def force(t, state):
        f = np.zeros((27, 3))
        f[plate] = pull
        return f, np.zeros((27, 3))

    scene.force(force)
    run = simulate(scene, 0.25, 1 / 40, record_every=10)
    a = run.velocity[-1] / 0.25
    along = pull / 150
    # the balls roll, a_ball = 2/7 a_plate; the ground bears 35 kg at μ = 0.4: 137.34 N
    rate = (150 - 137.34) / (10 + 25 * 2 / 7)
    assert rate == pytest.approx(0.7385, abs=1e-9)
    np.testing.assert_allclose(a[plate], rate * along, atol=1e-8)
    np.testing.assert_allclose(a[2:], np.tile(2 / 7 * rate * along, (25, 1)), atol=1e-8)


# --- impacts ------------------------------------------------------------------------------------------------


@DIMENSIONS
@pytest.mark.parametrize("dt", [1 / 30, 1 / 60, 1 / 240])
def test_a_ball_bounces_to_rest(d, dt):
    """h = 1 m, e = ½: at rest after (1 + e)/(1 − e) √(2h/g) = 1.354571 s; each apex is e² of the last."""
    scene = ground(d)
    scene.add(Disc(0.1) if d == 2 else Sphere(0.1), position=at(d, 0, 1.1), restitution=0.5)
    run = simulate(scene, 2, dt)
    height = run.position[:, 1, -1] - 0.1
    rest = 3 * np.sqrt(2 / G)
    assert rest == pytest.approx(1.354571, abs=1e-6)
    assert np.all(np.abs(height[run.time > rest + dt]) < 1e-9)
    assert np.all(run.velocity[run.time > rest + 2 * dt] == 0)  # rest is rest
    fall = np.sqrt(2 / G)
    in_flight = (run.time > fall) & (run.time < 2 * fall)  # between the first impact and the second
    t = run.time[in_flight] - fall
    np.testing.assert_allclose(height[in_flight], 0.5 * G * fall * t - 0.5 * G * t**2, atol=1e-8)
    assert rise(run.energy()) < 1e-9 * G


@pytest.mark.parametrize("incoming", [1, 2, 3])
def test_newtons_cradle_one_after_the_other(incoming):
    """As many go out as came in: what one sees on a desk."""
    scene = Scene(gravity=(0, 0))
    for i in range(5):
        scene.add(Disc(0.5), position=(i, 0), velocity=at(2, i < incoming, 0), restitution=1.0, friction=0)
    run = simulate(scene, 0.5, FRAME, impact="sequential", record_every=30)
    np.testing.assert_allclose(run.velocity[-1, :, 0], np.arange(5) >= 5 - incoming, atol=1e-11)


@pytest.mark.parametrize("law", ["newton", "poisson"])
def test_newtons_cradle_all_at_once(law):
    """Three balls under a simultaneous law with e = 1: (−⅓, ⅔, ⅔)."""
    scene = Scene(gravity=(0, 0))
    for i in range(3):
        scene.add(Disc(0.5), position=(i, 0), velocity=at(2, i < 1, 0), restitution=1.0, friction=0)
    run = simulate(scene, 0.1, FRAME / 2, impact=law, record_every=6)
    np.testing.assert_allclose(run.velocity[-1, :, 0], [-1 / 3, 2 / 3, 2 / 3], atol=1e-11)


# --- energy -------------------------------------------------------------------------------------------------


def test_with_friction_a_sequence_of_blows_can_gain_energy():
    """A flat box in space, dropped flat: 4 % at the second bounce (lecture 05, section 8); by default none,
    and none without friction.
    """
    most = {}
    for law, friction in (("sequential", 0.5), ("sequential", 0.0), (None, 0.5)):
        scene = ground(3, friction=friction)
        scene.add(Box((0.3, 0.2, 0.1)), position=(0, 0, 1.1), restitution=1.0, friction=0.5)
        run = simulate(scene, 1.5, FRAME, impact=law, record_contacts=False)
        most[law, friction] = run.energy().max() / run.energy()[0] - 1
    assert 0.03 < most.pop(("sequential", 0.5)) < 0.06 and max(most.values()) < 1e-9


@DIMENSIONS
@pytest.mark.parametrize("restitution", [0.0, 0.6])
@pytest.mark.parametrize("dt", [1 / 30, 1 / 100])
def test_energy_never_rises(d, restitution, dt):
    """Three bodies fall on each other, tumbling: by no step does the energy grow by 1e-6 of its scale."""
    scene = ground(d)
    half_turn = 0.4 if d == 2 else (np.cos(0.2), 0, np.sin(0.2), 0)
    scene.add(Box((0.3, 0.6) if d == 2 else (0.3, 0.4, 0.6)), position=at(d, 0, 1.2), orientation=half_turn,
              restitution=restitution)  # fmt: skip
    scene.add(Capsule(0.2, 0.4), position=at(d, 0.3, 2.6), restitution=restitution)
    scene.add(Disc(0.3) if d == 2 else Sphere(0.3), position=at(d, 0.1, 3.9), restitution=restitution)
    run = simulate(scene, 1.5, dt, record_contacts=False)
    assert run.status == "ok"
    assert rise(run.energy()) < 1e-6 * run.energy()[0]


# --- the same bits, any order -------------------------------------------------------------------------------


def test_the_same_scene_gives_the_same_bits():
    runs = [simulate(pyramid(4), 0.2, FRAME) for _ in range(2)]
    assert np.array_equal(runs[0].position, runs[1].position)
    assert np.array_equal(runs[0].contacts[-1].impulse, runs[1].contacts[-1].impulse)


def test_bodies_in_another_order_move_alike():
    def scene(order):
        made = ground(2)
        for k in order:
            made.add(Box((0.5, 0.5)), position=(0.3 * k, k + 0.5), velocity=(0.2 * k, 0))
        return made

    one, other = (simulate(scene(order), FRAME, FRAME) for order in ((0, 1, 2), (2, 0, 1)))
    assert len(one.contacts[1].depth) == len(other.contacts[1].depth)
    np.testing.assert_allclose(one.velocity[-1, 1:], other.velocity[-1, [2, 3, 1]], atol=1e-10)


# --- trouble ------------------------------------------------------------------------------------------------


def test_an_overlap_is_lifted_apart_and_its_energy_told():
    scene = ground(2)
    scene.add(Box((0.5, 0.5)), position=(0, 0.2))
    run = simulate(scene, 0.5, FRAME)
    assert run.position[-1, 1, 1] == pytest.approx(0.5, abs=1e-8)
    assert run.status == "ok" and "lifting overlaps apart has added 2.94 J" in run.reason


@DIMENSIONS
def test_a_fast_ball_does_not_go_through_a_thin_wall(d):
    scene = Scene(gravity=(0,) * d)
    scene.add(Box((0.001, 1) if d == 2 else (0.001, 1, 1)), static=True)
    scene.add(
        Disc(0.01) if d == 2 else Sphere(0.01), position=at(d, -1, 0), velocity=at(d, 500, 0), restitution=1.0
    )
    run = simulate(scene, 0.1, 0.1)
    assert run.position[-1, 1, 0] < 0 and run.velocity[-1, 1, 0] == pytest.approx(-500)


def test_a_mass_ratio_of_1e8_and_long_steps():
    run = simulate(stack(2, 2, 1e8), 2, 0.1)
    assert run.status == "ok" and moved(run) < 1e-8


def test_what_is_not_there_is_said():
    scene = block(2, 0, 0.5)
    for setting in (
        {"solver": "lemke"},
        {"integrator": "rk4"},
    ):
        with pytest.raises(Unsupported, match=next(iter(setting.values()))):
            simulate(scene, 0.1, 0.1, **setting)
    with pytest.raises(Unsupported, match="can touch"):
        simulate(scene, 0.1, 0.1, simulator="smooth")
    with pytest.raises(ValueError, match="impact"):
        simulate(scene, 0.1, 0.1, impact="bouncy")


# --- only what the scene needs ------------------------------------------------------------------------------


def test_a_scene_that_cannot_touch_builds_no_collision():
    scene = Scene(gravity=(0, -G))
    scene.add(Point(), position=(0, 1))
    assert model(scene).simulator == "smooth" and "nothing can touch" in model(scene).absent[-1]
    assert model(stack(2, 2)).simulator == "velocity_lcp"
    assert "3 " in str(model(stack(2, 2)))


def test_without_friction_a_contact_has_one_row():
    scene = ground(3, friction=0.0)
    scene.add(Sphere(0.5), position=(0, 0, 0.5), velocity=(1, 0, 0))
    run = simulate(scene, 1, FRAME, record_every=60)
    np.testing.assert_allclose(run.velocity[-1, 1], [1, 0, 0], atol=1e-12)
    assert np.all(run.contacts[-1].impulse[:, 1:] == 0)


def test_a_run_goes_on_where_another_ended():
    sim = Simulation(block(2, 0.5, 0.1), FRAME)
    sim.advance(0.5)
    rest = simulate(block(2, 0.5, 0.1), 0.5, FRAME, start=sim.state)
    whole = simulate(block(2, 0.5, 0.1), 1, FRAME)
    np.testing.assert_allclose(rest.position[-1], whole.position[-1], atol=1e-12)
