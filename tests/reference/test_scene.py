"""What a user may declare, and the error for each thing that may not be."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from reference import Box, Disc, Plane, Point, Scene, Simulation, Sphere, model, simulate

NAN = float("nan")


def falling():
    scene = Scene()
    scene.add(Sphere(0.5), position=(0, 0, 1))
    scene.add(Point(), position=(1, 0, 1))
    return scene


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Scene(gravity=9.81), "gravity must have 2 or 3 components"),
        (lambda: Scene(gravity=(0, NAN)), "gravity must hold finite numbers"),
        (lambda: falling().add(Sphere, mass=1), "shape must be an instance of Sphere, Box"),
        (lambda: falling().add(Disc(1)), "shape must fit this scene of 3 dimensions"),
        (lambda: falling().add(Box((1, 1))), "shape must fit this scene of 3 dimensions"),
        (lambda: falling().add(Sphere(1), mass=0), "mass must be a finite number greater than 0, but is 0"),
        (lambda: falling().add(Sphere(1), mass=-2), "mass must be a finite number greater than 0, but is -2"),
        (lambda: falling().add(Sphere(1), mass=NAN), "mass must be a finite number greater than 0"),
        (lambda: falling().add(Plane((0, 0, 1)), mass=1), "mass must be left out for a Plane"),
        (lambda: falling().add(Sphere(1), inertia=(1, 1, 3)), "triangle inequality"),
        (lambda: falling().add(Sphere(1), inertia=(1, 1)), "inertia must have shape (3,)"),
        (lambda: falling().add(Point(), inertia=(1, 1, 1)), "inertia must be left out for a Point"),
        (lambda: falling().add(Sphere(1), position=(0, 0)), "position must have shape (3,)"),
        (lambda: falling().add(Sphere(1), position=(0, 0, NAN)), "position must hold finite numbers"),
        (lambda: falling().add(Sphere(1), velocity=3), "velocity must have shape (3,)"),
        (lambda: falling().add(Sphere(1), velocity="fast"), "velocity must be an array of numbers"),
        (
            lambda: falling().add(Sphere(1), orientation=(1, 1, 0, 0)),
            "norm 1.41421: give (0.707106781, 0.707106781,",
        ),
        (lambda: falling().add(Sphere(1), orientation=(0, 0, 0, 0)), "is zero"),
        (lambda: falling().add(Sphere(1), orientation=0.3), "orientation must have shape (4,)"),
        (
            lambda: falling().add(Point(), orientation=(0, 1, 0, 0)),
            "orientation must be left out for a Point",
        ),
        (
            lambda: falling().add(Point(), angular_velocity=(1, 0, 0)),
            "angular_velocity must be 0 for a Point",
        ),
        (
            lambda: falling().add(Sphere(1), static=True, velocity=(1, 0, 0)),
            "velocity must be 0 for a static body",
        ),
        (lambda: falling().add(Sphere(1), friction=-1), "friction must be a finite number of at least 0"),
        (lambda: falling().add(Sphere(1), restitution=1.5), "restitution must be a number from 0 to 1"),
        (lambda: falling().add(Sphere(1), mass="1"), "mass must be a number, but is '1'"),
        (lambda: falling().add(Sphere(1), mass=np.array("1")), "mass must be a number, but is array('1'"),
        (lambda: falling().add(Sphere(1), friction=True), "friction must be a number, but is True"),
        (lambda: falling().add(Sphere(1), friction=np.True_), "friction must be a number, but is"),
        (lambda: falling().add(Sphere(1), position="123"), "position must be an array of numbers"),
        (lambda: falling().add(Sphere(1), position=["0", "0", "1"]), "position must be an array of numbers"),
        (lambda: falling().add(Sphere(1), static="no"), "static must be True or False, but is 'no'"),
        (lambda: falling().pair(0, 1, collide=0), "collide must be True or False, but is 0"),
        (lambda: falling().pair(0, 2), "j must be the number of a body, 0 … 1, but is 2"),
        (lambda: falling().pair(1, 1), "j must be another body than i"),
        (lambda: falling().spring(0, 1, -3), "stiffness must be a finite number of at least 0, but is -3"),
        (lambda: falling().spring(0, 0, 1), "b must be another body than a"),
        (lambda: falling().spring(0, None, 1), "point_b must be given where b is None"),
        (
            lambda: falling().spring(0, 1, 1, point_b=(0, 0, 0)),
            "point_b must be the body's position, since body 1 is",
        ),
        (lambda: falling().spring(0.0, 1, 1), "a must be a whole number"),
        (lambda: falling().spring(0, 1, 1, damping=NAN), "damping must be a finite number"),
        (lambda: falling().drag(0, -1), "linear must be a finite number of at least 0"),
        (lambda: falling().drag(1, 1, 1), "angular must be 0 for body 1, a Point"),
        (lambda: falling().gravitate(-1), "G must be a finite number of at least 0"),
        (lambda: falling().force(3), "f must be a function f(t, state)"),
        (lambda: simulate(falling(), 1, 0), "dt must be a finite number greater than 0, but is 0"),
        (lambda: simulate(falling(), 1, -0.1), "dt must be a finite number greater than 0"),
        (lambda: simulate(falling(), 1, 2), "dt must be at most the duration, 1 s, but is 2 s"),
        (lambda: simulate(falling(), 1, NAN), "dt must be a finite number"),
        (lambda: simulate(falling(), -1, 0.1), "duration must be a finite number greater than 0"),
        (
            lambda: simulate(falling(), 1, 0.3),
            "duration must be a whole number of dt = 0.3 s, but is 1 s: 0.9 s",
        ),
        (lambda: simulate(falling(), 1, 0.1, integrator="rk5"), "integrator must be one of explicit_euler, "),
        (
            lambda: simulate(falling(), 1, 0.1, simulator="magic"),
            "simulator must be one of acceleration_lcp, ",
        ),
        (
            lambda: simulate(falling(), 1, 0.1, integrater="rk4"),
            "a setting's name must be one of correction, ",
        ),
        (lambda: simulate(falling(), 1, 0.1, substeps=0), "substeps must be a whole number of at least 1"),
        (lambda: simulate(falling(), 1, 0.1, record_every=1.5), "record_every must be a whole number"),
        (
            lambda: simulate(falling(), 1, 0.1, warm_start="yes"),
            "warm_start must be True or False, but is 'yes'",
        ),
        (
            lambda: simulate(falling(), 1, 0.1, record_contacts=3),
            "record_contacts must be True or False, but is 3",
        ),
        (lambda: simulate(falling(), 1, 0.1, tolerance=True), "tolerance must be a number, but is True"),
        (lambda: simulate(falling(), 1, 0.1, integrator=["rk4"]), "integrator must be one of"),
        (lambda: simulate(falling(), 1, 0.1, start=3), "start must be a state"),
        (lambda: simulate(3, 1, 0.1), "scene must be a Scene, but is 3"),
        (
            lambda: simulate(falling(), 1, 0.1, simulator="penalty"),
            "simulator 'penalty' is not part of the course",
        ),
        (lambda: simulate(falling(), 1, 0.1, solver="lemke"), "solver='lemke' has no effect: without joints"),
    ],
)
def test_bad_input_says_what_would_be_right(make, words):
    with pytest.raises((ValueError, TypeError)) as raised:
        make()
    assert words in str(raised.value)


def test_start_must_fit():
    scene = falling()
    start = Simulation(scene, 0.1).state
    start.position[0, 0] = NAN
    with pytest.raises(ValueError, match=r"start\.position must hold finite numbers"):
        simulate(scene, 1, 0.1, start=start)


def test_numbers_of_other_kinds_are_numbers():
    for two in (2, np.float32(2), np.int64(2), np.array(2), Fraction(4, 2)):
        scene = Scene()
        scene.add(Sphere(two), mass=two, position=(0, two, 0), static=np.False_)
        assert scene.bodies[0].mass == scene.bodies[0].shape.radius == scene.bodies[0].position[1] == 2


def with_a_static_body(d):
    """A ball that falls beside a box that is fixed, turned, and far from the origin."""
    scene = Scene(gravity=(0, -10) if d == 2 else (0, 0, -10))
    fixed = Box((0.3, 0.2, 0.1)[:d])
    turned = 2.5 if d == 2 else (0.5, 0.5, -0.5, 0.5)
    scene.add(Sphere(0.5) if d == 3 else Disc(0.5), position=(0, 1, 2)[:d])
    scene.add(fixed, static=True, position=(30.1, -7.3, 1.7)[:d], orientation=turned)
    return scene


@pytest.mark.parametrize("d", [2, 3])
def test_start_must_leave_static_bodies_where_they_are(d):
    """Elsewhere, turned, or moving is refused; the same attitude told otherwise, and rounding, are not."""
    scene = with_a_static_body(d)
    start = simulate(scene, 0.1, 0.1).state()
    q = start.orientation
    elsewhere, turned, moving, same = start.position.copy(), q.copy(), start.velocity.copy(), q.copy()
    elsewhere[1, 0] += 1e-6
    moving[1, 0] = 1
    turned[1] = 2.4 if d == 2 else (1, 0, 0, 0)
    same[1] = q[1] + 2 * np.pi if d == 2 else -q[1]
    for wrong in ({"position": elsewhere}, {"orientation": turned}, {"velocity": moving}):
        with pytest.raises(ValueError, match="start must leave body 1, which is static, where the scene has"):
            simulate(scene, 0.1, 0.1, start=replace(start, **wrong))
    rounded = start.position * (1 + 1e-15)
    run = simulate(scene, 0.1, 0.1, start=replace(start, position=rounded, orientation=same))
    assert run.state().time == pytest.approx(0.2)
    simulate(scene, 0.1, 0.1, start=run.state())


def test_what_cannot_touch_needs_no_contact():
    scene = Scene()
    scene.add(Sphere(1), position=(0, 0, 1))
    scene.add(Plane((0, 0, 1)))
    assert model(scene).simulator == "velocity_lcp"
    scene.pair(1, 0, collide=False)
    assert model(scene).simulator == "smooth"
    assert simulate(scene, 1, 0.1).position[-1, 0, 2] < -3


def test_who_can_collide():
    scene = Scene()
    for group in ("a", "a", None, "b"):
        scene.add(Sphere(1), group=group)
    scene.add(Point())
    scene.add(Plane((0, 0, 1)))
    scene.add(Plane((0, 1, 0)))
    assert list(scene.colliding_pairs()) == [(0, 2), (0, 3), (0, 5), (0, 6), (1, 2), (1, 3), (1, 5), (1, 6),
                                             (2, 3), (2, 5), (2, 6), (3, 5), (3, 6)]  # fmt: skip


def test_defaults_and_what_is_kept():
    scene = Scene(gravity=(0, -1))
    i = scene.add(Box((1, 2)))
    j = scene.add(Plane((0, 2)))
    body = scene.bodies[i]
    assert (i, j, body.mass, body.inertia) == (0, 1, 1.0, 5 / 3)
    assert body.orientation == 0 and not body.static and scene.bodies[j].static
    assert scene.bodies[j].shape.normal == (0, 1)
    scene.drag(0, 1, 2)
    scene.drag(0, 1)
    assert scene.drags == {0: (2.0, 2.0)}


def test_arrays_given_are_copied():
    p = np.zeros(3)
    scene = Scene()
    scene.add(Sphere(1), position=p)
    p[:] = 7
    assert not scene.bodies[0].position.any()
