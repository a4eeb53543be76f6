"""Joints as declared: their rows and bounds as laid out, and the error for each thing that may not be."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from reference import BallJoint, Box, Disc, Distance, Fixed, Hinge, Point, Scene, Slider, Sphere, Universal
from reference.joints import ANGULAR, DISTANCE, JOINTS, LINEAR, TURN
from reference.joints.row import frame
from reference.layout import Bodies
from reference.mechanism import bounded_rows, rigid_rows, soft_rows

NAN, INF = float("nan"), float("inf")
Z = (0, 0, 1)


def space():
    """Two balls, a point mass, and something that stands still."""
    scene = Scene()
    scene.add(Sphere(0.1), position=(1, 0, 0))
    scene.add(Sphere(0.1), position=(2, 0, 0))
    scene.add(Point(), position=(3, 0, 0))
    scene.add(Box((1, 1, 1)), static=True, position=(0, 0, -5))
    return scene


def plane():
    scene = Scene(gravity=(0, -9.81))
    scene.add(Disc(0.1), position=(1, 0), orientation=0.5)
    scene.add(Disc(0.1), position=(2, 0), orientation=0.2)
    scene.add(Point(), position=(3, 0))
    scene.add(Disc(1), static=True, position=(0, -5), orientation=1.1)
    return scene


REFUSED = {
    "not a joint": (space, lambda: "hinge", "joint must be one of BallJoint, Hinge"),
    "a kind, not a joint": (space, lambda: Hinge, "joint must be one of BallJoint, Hinge"),
    "no such body": (
        space,
        lambda: BallJoint(0, 7, point=(0, 0, 0)),
        "b must be the number of a body",
    ),
    "no number": (
        space,
        lambda: BallJoint(None, 0, point=(0, 0, 0)),
        "a must be a whole number",
    ),
    "to itself": (space, lambda: BallJoint(1, 1, point=(0, 0, 0)), "b must be another body than a"),
    "static to the world": (space, lambda: Fixed(3, None), "both static"),
    "zero axis": (space, lambda: Hinge(0, 1, point=(0, 0, 0), axis=(0, 0, 0)), "axis must be a direction"),
    "NaN in the axis": (space, lambda: Slider(0, 1, axis=(0, 0, NAN)), "axis must hold finite numbers"),
    "axis of two": (space, lambda: Slider(0, 1, axis=(0, 1)), "axis must have shape (3,)"),
    "no axis": (space, lambda: Hinge(0, 1, point=(0, 0, 0)), "axis must be given in space"),
    "an axis in the plane": (plane, lambda: Hinge(0, 1, point=(0, 0), axis=Z), "axis must be left out"),
    "point of three": (plane, lambda: Hinge(0, 1, point=(0, 0, 0)), "point must have shape (2,)"),
    "point in words": (space, lambda: BallJoint(0, 1, point="here"), "point must be an array of numbers"),
    "ball joint in the plane": (plane, lambda: BallJoint(0, 1, point=(0, 0)), "in the plane, use a Hinge"),
    "axes not square": (
        space,
        lambda: Universal(0, 1, point=(0, 0, 0), axis_a=Z, axis_b=(0, 1, 1)),
        "axis_b must be at right angles to axis_a",
    ),
    "no distance": (space, lambda: Distance(0, 1, point_a=(1, 1, 1), point_b=(1, 1, 1)), "needs a direction"),
    "no point in the world": (space, lambda: Distance(0, None), "point_b must be given where b is None"),
    "zero length": (space, lambda: Distance(0, 1, length=0), "length must be a finite number greater than 0"),
    "off a point mass": (space, lambda: BallJoint(0, 2, point=(2, 0, 0)), "point must be body 2's position"),
    "rod off a point mass": (space, lambda: Distance(0, 2, point_b=(2, 0, 1)), "since it is a Point"),
    "turn a point mass": (space, lambda: Hinge(2, None, point=(3, 0, 0), axis=Z), "needs bodies that rotate"),
    "slide on a point mass": (space, lambda: Slider(2, 0, axis=Z), "body 2 is a Point: let it be b"),
    "spring on a point": (
        plane,
        lambda: Hinge(2, None, point=(3, 0), stiffness=1),
        "a Hinge needs bodies that rotate, but body 2 is a Point",
    ),
    "negative stiffness": (space, lambda: Slider(0, 1, axis=Z, stiffness=-1), "stiffness must be"),
    "stiffness in words": (plane, lambda: Hinge(0, 1, point=(0, 0), stiffness="soft"), "stiffness must be"),
    "damping NaN": (space, lambda: Slider(0, 1, axis=Z, damping=NAN), "damping must be a finite number"),
    "a soft ball joint": (
        space,
        lambda: BallJoint(0, 1, point=(0, 0, 0), stiffness=3),
        "stiffness must be left out for a BallJoint, which has no coordinate, but is 3",
    ),
    "limits of a weld": (space, lambda: Fixed(0, 1, limits=(0, 1)), "limits must be left out for a Fixed"),
    "motor of a universal joint": (
        space,
        lambda: Universal(0, 1, point=(0, 0, 0), axis_a=Z, axis_b=(0, 1, 0), motor=(1, 1)),
        "motor must be left out for a Universal",
    ),
    "one limit": (space, lambda: Slider(0, 1, axis=Z, limits=(1,)), "limits must be (low, high)"),
    "limits swapped": (space, lambda: Slider(0, 1, axis=Z, limits=(1, 0)), "low ≤ high"),
    "limits NaN": (space, lambda: Slider(0, 1, axis=Z, limits=(NAN, 0)), "limits must be a number"),
    "more than half a turn": (
        space,
        lambda: Hinge(0, 1, point=(0, 0, 0), axis=Z, limits=(-4, 1)),
        "limits of a Hinge in space must be from −π to π",
    ),
    "a length below 0": (space, lambda: Distance(0, 1, limits=(-2, -1)), "limits of a Distance"),
    "a motor of one": (space, lambda: Slider(0, 1, axis=Z, motor=3), "motor must be (speed, max_force)"),
    "a motor that pushes back": (space, lambda: Slider(0, 1, axis=Z, motor=(1, -3)), "motor's max_force"),
    "a motor of infinite speed": (space, lambda: Slider(0, 1, axis=Z, motor=(INF, 3)), "motor's speed"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_may_not_be_says_why(case):
    make, joint, words = REFUSED[case]
    scene = make()
    with pytest.raises((ValueError, TypeError)) as caught:
        scene.join(joint())
    assert words in str(caught.value)
    assert scene.joints == []


def test_all_kinds_take_the_promised_arguments():
    kept = {"limits": None, "motor": None, "stiffness": 0, "damping": 0, "collide": True}
    scene = space()
    for joint in (
        BallJoint(0, 1, point=(0, 0, 0), **kept),
        Hinge(0, 1, point=(0, 0, 0), axis=Z, **kept),
        Slider(0, 1, axis=Z, **kept),
        Fixed(0, 1, **kept),
        Universal(0, 1, point=(0, 0, 0), axis_a=Z, axis_b=(0, 1, 0), **kept),
        Distance(0, 1, **kept),
    ):
        scene.join(joint)
    assert {type(joint) for joint in scene.joints} == set(JOINTS)
    assert [len(joint.rows(scene.bodies)) for joint in scene.joints] == [3, 5, 5, 6, 4, 1]


def test_arguments_are_checked_and_filled_in():
    scene = space()
    number = scene.join(Distance(0, None, point_b=[1, 0, 2], limits=(1, INF)))
    rod = scene.joints[number]
    assert rod.length == 2 and rod.ends == (None, 0) and rod.limits == (1, INF)
    assert_allclose(rod.point_a, scene.bodies[0].position)
    door = scene.joints[scene.join(Hinge(3, 0, point=(0, 0, 0), axis=(0, 0, 5)))]
    assert_allclose(door.axis, Z)
    assert door.ends == (3, 0)


@pytest.mark.parametrize("axis", [(1, 0, 0), (0, 0, -1), (0.6, 0, 0.8), (0.48, 0.6, 0.64), (0, 1)])
def test_a_joint_s_frame_is_right_handed_with_its_last_axis_along_the_joint(axis):
    e = frame(np.array(axis, dtype=float))
    assert_allclose(e @ e.T, np.eye(len(axis)), atol=1e-15)
    assert_allclose(e[-1], axis)
    assert_allclose(np.linalg.det(e), 1)


def laid_out(scene, make):
    return make(Bodies(scene))


def test_rows_say_whose_they_are():
    scene = space()
    scene.join(Hinge(1, 0, point=(1.5, 0, 0), axis=Z))
    scene.join(Distance(0, 3))
    scene.join(BallJoint(2, None, point=(3, 0, 0)))
    rows = laid_out(scene, rigid_rows)
    assert rows.kind.tolist() == [LINEAR] * 3 + [ANGULAR] * 2 + [DISTANCE] + [LINEAR] * 3
    assert rows.joint.tolist() == [0] * 5 + [1] + [2] * 3
    assert rows.bodies.tolist() == [[1, 0]] * 5 + [[0, -1]] + [[-1, 2]] * 3
    assert (rows.lower == -INF).all() and (rows.upper == INF).all() and not rows.speed.any()
    assert_allclose(rows.p[5], [(0, 0, 0), (0, 0, -5)])  # in body 0; in the world


def test_rows_of_a_joint_share_its_first_row_s_points():
    """What fill_rows relies on."""
    law = {"limits": (-1, 1), "motor": (1, INF), "stiffness": 1}
    scene, flat = space(), plane()
    for joint in (
        BallJoint(0, 1, point=(0, 1, 0)),
        Hinge(0, 1, point=(0, 1, 0), axis=Z, **law),
        Slider(0, 1, axis=Z, **law),
        Fixed(0, 1),
        Universal(0, 1, point=(0, 1, 0), axis_a=Z, axis_b=(0, 1, 0)),
        Distance(0, 1, point_a=(0, 1, 0), **law),
        Slider(0, 2, axis=Z, **law),
    ):
        scene.join(joint)
    for joint in (Hinge(0, 1, point=(0, 1), **law), Slider(0, 1, axis=(0, 1), **law), Fixed(0, 1)):
        flat.join(joint)
    for rows in (make(Bodies(s)) for s in (scene, flat) for make in (rigid_rows, soft_rows, bounded_rows)):
        with_points = np.isin(rows.kind, (LINEAR, DISTANCE))
        first = np.searchsorted(rows.joint, rows.joint)
        assert (np.diff(rows.joint) >= 0).all() and with_points.any()
        assert_allclose(rows.p[with_points], rows.p[first[with_points]], rtol=0, atol=0)


def test_a_motor_bounds_λ_and_a_limit_takes_one_side():
    """S12: a motor is a polyline in the (w, λ) plane, a limit a contact's, a spring a slanted line."""
    scene = space()
    scene.join(Slider(0, None, axis=(1, 0, 0), limits=(-0.5, 2), motor=(3, 10), stiffness=7, damping=0.1))
    bounded, rigid, soft = (laid_out(scene, make) for make in (bounded_rows, rigid_rows, soft_rows))
    assert bounded.kind.tolist() == [LINEAR] * 3
    assert bounded.lower.tolist() == [0, -INF, -10] and bounded.upper.tolist() == [INF, 0, 10]
    assert bounded.target.tolist() == [-0.5, 2, 0] and bounded.speed.tolist() == [0, 0, 3]
    assert len(rigid.kind) == 5 and not rigid.speed.any()
    assert (soft.stiffness, soft.damping, soft.target) == (7, 0.1, 0)


def test_a_motor_of_any_force_is_a_row_that_holds():
    scene = space()
    scene.join(Hinge(0, None, point=(0, 0, 0), axis=Z, motor=(3, INF)))
    rows = laid_out(scene, rigid_rows)
    assert rows.kind.tolist() == [LINEAR] * 3 + [ANGULAR] * 2 + [TURN]
    assert rows.speed.tolist() == [0] * 5 + [3]
    assert len(laid_out(scene, bounded_rows).kind) == 0


def test_a_distance_with_a_law_has_no_rod():
    scene = space()
    scene.join(Distance(0, 1, limits=(0.5, 3)))
    scene.join(Distance(0, 1, stiffness=3, length=0.2))
    assert len(laid_out(scene, rigid_rows).kind) == 0
    assert laid_out(scene, bounded_rows).target.tolist() == [0.5, 3]  # the distance itself
    assert laid_out(scene, soft_rows).target.tolist() == [0.2]


def test_angles_in_the_plane_count_from_the_start():
    scene = plane()
    scene.join(Hinge(0, 1, point=(1.5, 0), limits=(-7, 9)))  # more than a turn
    scene.join(Hinge(3, 1, point=(0, 0), stiffness=1))
    assert_allclose(laid_out(scene, bounded_rows).target, [-0.3 - 7, -0.3 + 9])
    assert_allclose(laid_out(scene, soft_rows).target, [0.2])  # what is static counts as 0


def test_beads_need_no_rows_for_an_orientation():
    scene, flat = space(), plane()
    scene.join(Slider(0, 2, axis=Z))
    scene.join(Fixed(2, None))
    flat.join(Slider(2, None, axis=(1, 0)))
    assert laid_out(scene, rigid_rows).kind.tolist() == [LINEAR] * 5
    assert laid_out(flat, rigid_rows).kind.tolist() == [LINEAR]


def test_joined_bodies_don_t_collide_unless_they_are_to():
    scene = Scene()
    for x in (0, 1):
        scene.add(Sphere(1), position=(x, 0, 0))
    assert list(scene.colliding_pairs()) == [(0, 1)]
    scene.join(Distance(0, 1, collide=True))
    assert list(scene.colliding_pairs()) == [(0, 1)]
    scene.join(BallJoint(0, 1, point=(0.5, 0, 0)))
    assert list(scene.colliding_pairs()) == []
