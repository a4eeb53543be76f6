"""Contact in the engines: against statics, momentum and Coulomb's law; what they can't express is refused."""

import numpy as np
import pytest

from contact_scenes import G, at, block, ground, stack
from reference import BallJoint, Box, Capsule, Disc, Hinge, Plane, Polygon, Scene, Sphere, Unsupported
from reference.peers import ENGINES, simulate_in

FINE = {
    "pymunk": {"slop": 1e-4, "iterations": 100},
    "pybullet": {"body": "rigid", "residual": 0.0, "warm_start": 0.95, "iterations": 100},
}
EACH = pytest.mark.parametrize(
    "engine",
    [
        pytest.param(name, marks=pytest.mark.skipif(not there.available, reason=f"{name} is not installed"))
        for name, there in ENGINES.items()
    ],
)
PYMUNK, PYBULLET = (
    pytest.mark.skipif(not ENGINES[name].available, reason=f"{name} is not installed")
    for name in ("pymunk", "pybullet")
)


def run_in(engine, scene, duration=0.5, dt=1e-3, record_every=100, **settings):
    return simulate_in(scene, engine, duration, dt, record_every=record_every, **FINE[engine] | settings)


def push(run, j, k=-1):
    """The impulse (d,) on body j over record k from bodies with lower numbers, world frame."""
    c = run.contacts[k]
    mine = c.bodies[:, 1] == j
    return np.einsum("mi,mij->j", c.impulse[mine], c.frame[mine])


@EACH
def test_a_stack_carries_its_weight(engine):
    """CASES' table: forces in a stack within 1e-4, here as means over a second."""
    run = run_in(engine, stack(ENGINES[engine].dimension, 5), 3.0, record_every=1000)
    forces = [push(run, j)[-1] for j in range(1, 6)]
    np.testing.assert_allclose(forces, G * np.arange(5, 0, -1), rtol=1e-4)


@EACH
@pytest.mark.parametrize("substeps", [1, 4])
def test_impulses_are_what_changes_the_momentum(engine, substeps):
    """Record by record, in all components, also with substeps, where pybullet's force reads a part of it."""
    d = ENGINES[engine].dimension
    scene = ground(d, 0.4, friction=1.0)
    scene.add(Box((0.5, 0.3, 0.2)[:d]), mass=3.0, position=at(d, 0, 0.31 if d == 2 else 0.21), friction=0.2)
    dt = 1 / 500
    run = run_in(engine, scene, 0.4, dt, record_every=50, substeps=substeps)
    gained = 3.0 * np.diff(run.velocity[:, 1], axis=0)
    weight = 3.0 * scene.gravity * 50 * dt
    found = [push(run, 1, k) + weight for k in range(1, 5)]
    np.testing.assert_allclose(found, gained, atol=1e-9)
    slides = run.contacts[-1].impulse
    assert np.linalg.norm(slides[:, 1:].sum(axis=0)) == pytest.approx(0.2 * slides[:, 0].sum(), rel=0.03)


@EACH
def test_contacts_have_the_form_promised(engine):
    """Lower number first, n from first to second, right-handed frames, the point where they touch."""
    d = ENGINES[engine].dimension
    ball, scene = Disc(0.5) if d == 2 else Sphere(0.5), Scene(gravity=at(d, 0, -G))
    scene.add(ball, position=at(d, 0, 1.5))
    scene.add(ball, position=at(d, 0, 0.5))
    scene.add(Plane(at(d, 0, 1)))
    run = run_in(engine, scene)
    assert len(run.contacts[0].depth) == 0
    c = run.contacts[-1]
    assert sorted(map(tuple, c.bodies)) == [(0, 1), (1, 2)]
    for pair, height in (((0, 1), 1.0), ((1, 2), 0.0)):
        k = [tuple(bodies) for bodies in c.bodies].index(pair)
        np.testing.assert_allclose(c.frame[k, 0], at(d, 0, -1), atol=1e-9)
        np.testing.assert_allclose(c.point[k], at(d, 0, height), atol=1e-3)
        np.testing.assert_allclose(c.frame[k] @ c.frame[k].T, np.eye(d), atol=1e-12)
        assert np.linalg.det(c.frame[k]) == pytest.approx(1)
    assert np.all(np.abs(c.depth) < 1e-3) and run.penetration()[-1] == c.depth.max()


@EACH
def test_reading_contacts_changes_nothing(engine):
    scene = stack(ENGINES[engine].dimension, 3)
    run = run_in(engine, scene, 0.2)
    with ENGINES[engine].load(scene, 1e-3, **FINE[engine]) as peer:
        peer.advance(0.2)
        assert np.array_equal(peer.state.position, run.position[-1])


@EACH
def test_what_does_not_collide_passes_through(engine):
    """One group, or a pair told so: each falls freely through what lies below."""
    d = ENGINES[engine].dimension
    box, scene = Box((0.5,) * d), Scene(gravity=at(d, 0, -G))
    scene.add(box, static=True, group="a")
    group = scene.add(box, position=at(d, 0, 0.9), group="a")
    told = scene.add(box, position=at(d, 0, 1.7))
    held = scene.add(box, position=at(d, 5, 1.0))
    scene.add(box, static=True, position=at(d, 5, 0))
    for other in (0, group):
        scene.pair(told, other, collide=False)
    run = run_in(engine, scene, 0.5)
    fallen = run.position[0, :, -1] - run.position[-1, :, -1]
    np.testing.assert_allclose(fallen[[group, told]], 0.5 * G * 0.5**2, rtol=5e-3)
    assert abs(fallen[held]) < 1e-3


@EACH
def test_what_is_joined_does_not_push_apart(engine):
    d = ENGINES[engine].dimension
    ball, scene = Disc(0.5) if d == 2 else Sphere(0.5), Scene(gravity=(0,) * d)
    for x in (0.0, 0.6, 5.0):
        scene.add(ball, position=at(d, x, 0))
    scene.join((Hinge if d == 2 else BallJoint)(0, 1, point=at(d, 0.3, 0)))
    run = run_in(engine, scene, 0.1)
    np.testing.assert_allclose(run.position[-1], run.position[0], atol=1e-9)
    assert len(run.contacts[-1].depth) == 0


@EACH
@pytest.mark.parametrize("share", [0.5, 1.3])
def test_a_block_sticks_or_slides(engine, share):
    """CASES' 3e-3 of the distance; in pybullet a cube needs a multibody: a rigid one goes 2 % less far."""
    slope, body = np.pi / 6, {"body": "multibody", "iterations": 200} if engine == "pybullet" else {}
    run = run_in(engine, block(ENGINES[engine].dimension, slope, share * np.tan(slope)), 1.0, **body)
    way = 0.5 * G * np.sin(slope) * max(0.0, 1 - share) * 1.0**2
    assert run.position[-1, 1, 0] == pytest.approx(way, rel=3e-3, abs=1e-3)


@PYMUNK
def test_every_planar_shape_rests_on_every_kind_of_floor():
    for floor in (Plane((0, 1)), Box((5, 1)), Polygon([(-5, -1), (5, -1), (5, 1), (-5, 1)])):
        for shape, height in (
            (Disc(0.5), 0.5),
            (Box((0.5, 0.3)), 0.3),
            (Capsule(0.2, 0.6), 0.8),
            (Capsule(0.3, 0), 0.3),
            (Polygon([(-1, 0), (1, 0), (0, 0.9)]), 0.3),
        ):
            scene = Scene(gravity=(0, -G))
            top = 0.0 if isinstance(floor, Plane) else 1.0
            scene.add(floor, static=True, position=(0, 0), orientation=0.0)
            scene.add(shape, position=(0, top + height + 0.01))
            run = run_in("pymunk", scene)
            assert run.position[-1, 1, 1] == pytest.approx(top + height, abs=2e-4), shape
            assert push(run, 1)[1] == pytest.approx(G * 0.1, rel=1e-3)


@PYBULLET
def test_every_shape_of_space_rests_on_every_kind_of_floor():
    for floor in (Plane((0, 0, 1)), Box((5, 5, 1))):
        for shape, height in (
            (Sphere(0.5), 0.5),
            (Box((0.5, 0.3, 0.2)), 0.2),
            (Capsule(0.2, 0.6), 0.8),
        ):
            scene, top = Scene(), 0.0 if isinstance(floor, Plane) else 1.0
            scene.add(floor, static=True)
            scene.add(shape, position=(0, 0, top + height + 0.001))
            run = run_in("pybullet", scene, 0.4)
            assert run.position[-1, 1, 2] == pytest.approx(top + height, abs=2e-3), shape


@PYBULLET
def test_an_inertia_with_turned_axes_keeps_the_shape_in_place():
    """The engine's frame of such a body is another than the shape's."""
    scene = ground(3)
    tensor = np.array([[0.3, 0.1, 0], [0.1, 0.3, 0], [0, 0, 0.4]])
    scene.add(Box((0.5, 0.3, 0.2)), position=(0, 0, 0.2), inertia=tensor)
    run = run_in("pybullet", scene, 0.3)
    corners = run.contacts[-1].point
    assert np.abs(corners[:, 0]).max() == pytest.approx(0.5, abs=1e-3)
    assert np.abs(corners[:, 1]).max() == pytest.approx(0.3, abs=1e-3)


@PYMUNK
def test_each_pair_has_its_own_law_in_pymunk():
    """The larger of two restitutions counts; frictions of pairs that no products make."""
    scene = ground(2, restitution=0.1)
    balls = [
        scene.add(Disc(0.1), position=(k, 0.35), restitution=e, friction=0.0)
        for k, e in enumerate((0.8, 0.3, 0.0))
    ]
    run = run_in("pymunk", scene, 1.0, 1e-4, record_every=10)
    for i, e in zip(balls, (0.8, 0.3, 0.1), strict=True):
        fall = np.sqrt(2 * 0.25 / G)
        after = (run.time > fall + 1e-3) & (run.time < fall * (1 + 2 * e))
        assert run.position[after, i, 1].max() - 0.1 == pytest.approx(0.25 * e**2, rel=0.1)
    scene = ground(2, 0.5, friction=1.0)
    boxes = [scene.add(Box((0.5, 0.5)), position=(3 * k, 0.5)) for k in range(2)]
    scene.pair(0, boxes[0], friction=2.0)
    scene.pair(0, boxes[1], friction=0.1)
    run = run_in("pymunk", scene, 0.5)
    way = 0.5 * G * (np.sin(0.5) - 0.1 * np.cos(0.5)) * 0.5**2
    moved = run.position[-1, boxes, 0] - run.position[0, boxes, 0]
    np.testing.assert_allclose(moved, [0, way], atol=3e-3)
    assert push(run, boxes[1])[1] == pytest.approx(0.1 * G * np.cos(0.5), rel=1e-3)


def test_what_pybullet_has_no_word_for():
    scene = ground(3, friction=1.0)
    for k, μ in enumerate((2.0, 0.1)):
        scene.pair(0, scene.add(Sphere(0.5), position=(3 * k, 0, 0.5)), friction=μ)
    joined = ground(3)
    for k in range(2):
        joined.add(Sphere(0.5), position=(3 * k, 0, 0.5))
    joined.join(Hinge(1, 2, point=(1.5, 0, 0.5), axis=(0, 1, 0)))
    if ENGINES["pybullet"].available:
        with pytest.raises(Unsupported, match="pybullet multiplies the friction"):
            run_in("pybullet", scene)
        with pytest.raises(Unsupported, match="body='rigid' takes joints and contact"):
            run_in("pybullet", joined, body="multibody")
        assert run_in("pybullet", joined, 0.1).status == "ok"
