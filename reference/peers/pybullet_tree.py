"""Joints in pybullet as an articulated tree: bodies are links, and only the joints' coordinates move.

**What it does.** Accelerations of the coordinates come from Featherstone's method (S3, reduced coordinates),
explicitly, from the state at the start of the step; then symplectic Euler in the coordinates, q̇ ← q̇ + h q̈,
q ← q + h q̇, so that a joint can't come apart. A chain of three equals ten lines of NumPy to 2e-14 after 2,000
steps; the tests repeat it. The time is linear in the number of links.

    Hinge  JOINT_REVOLUTE     Slider  JOINT_PRISMATIC     Fixed  JOINT_FIXED     BallJoint  JOINT_SPHERICAL

A joint to the world, or to what is static, makes a fixed base; else the lowest number of a tree is its base,
which moves freely. What closes a loop can't be in a tree: it becomes a constraint, see ``pybullet_joints``.

**Traps.** Each Hinge and Slider starts with a motor that brakes it, each BallJoint with one that brakes it a
thousand times as hard: all are switched off here. The limit on coordinates' velocities (100) is lifted. Link
frames are laid parallel to the world's at the start; but a JOINT_SPHERICAL's velocity is in the frame of the
child's principal axes. ``getLinkStates`` gives the velocity of the centre of mass, but of the
step before unless told to compute it and the kinematics anew. Whatever order links are given in, the engine
numbers them depth first, so that is the order here.

**Limits.** 127 links and 128 coordinates: 1 for a Hinge or Slider, 4 for a BallJoint, 7 for a base that
moves. Past that the engine reads and writes where nothing is, without a word. So a chain of balls has 32
links at most. A BallJoint turns by π/4 in a step at most, as a free body does; a Hinge by any angle.

**Springs and motors.** A spring is a torque −stiffness q − damping q̇ (or force), given anew before each step;
a motor is the engine's own, bounded by max_force; limits are the engine's own too, hit without a bounce.

Slides S3, S5, S9; lectures/04_embedding.md.
"""

from typing import NamedTuple

import numpy as np

from ..inertia import principal_axes
from ..joints import BallJoint, Fixed, Hinge, Slider
from ..rotation import conjugate, multiply, over_arrays, rotate
from ..scene import Unsupported
from ..shapes import Point

LINKS, COORDINATES = 127, 128  # at most, in a tree
BOUNDLESS, NO_LIMIT = 1e30, 1e300  # N or N m; m/s and rad/s


def check_size(base, branches):
    """Raises Unsupported where a tree is more than the engine holds."""
    free = {Hinge: 1, Slider: 1, BallJoint: 4}
    coordinates = sum(free.get(type(branch.joint), 0) for branch in branches) + 7 * (base is not None)
    if len(branches) > LINKS or coordinates > COORDINATES:
        raise Unsupported(
            f"pybullet's trees hold up to {LINKS} links and {COORDINATES} coordinates (a BallJoint has 4, a "
            f"base that moves 7), but this one has {len(branches)} and {coordinates}: body='rigid' has no "
            "such limit"
        )


class Place(NamedTuple):
    """Where a body is in the engine: the number of its multibody and the link, −1 for the base.

    axes: the quaternion principal axes (the engine's frame) → the body's frame.
    """

    number: int
    link: int
    axes: tuple


def add_tree(p, client, scene, tree, rigid, places, shape=None):
    """Make a tree (base, branches), or a single body, in the engine, at rest; returns its number.

    ``places`` gets the Place of each of its bodies. rigid: bodies in maximal coordinates, without branches.
    shape(i): the base's collision shape; None: it has none.
    """
    base, branches = tree
    bodies = [i for i in (base, *(branch.body for branch in branches)) if i is not None]
    moments, axes = {}, {}
    for i in bodies:
        body = scene.bodies[i]
        moments[i], axes[i] = principal_axes(np.eye(3) if isinstance(body.shape, Point) else body.inertia)
    frame = np.zeros(3), np.array([1.0, 0, 0, 0])
    if base is not None:
        body = scene.bodies[base]
        frame = body.position, over_arrays(multiply)(body.orientation, axes[base])
    number = p.createMultiBody(
        baseMass=0 if base is None else scene.bodies[base].mass,
        baseCollisionShapeIndex=shape(base) if shape and base is not None else -1,
        basePosition=frame[0].tolist(),
        baseOrientation=xyzw(frame[1]),
        useMaximalCoordinates=rigid,
        physicsClientId=client,
        **(link_arguments(p, scene, frame, branches, axes) if branches else {}),
    )
    for link, i in enumerate(bodies, start=0 if base is None else -1):
        places[i] = Place(number, link, tuple(axes[i].tolist()))
        moment = {"mass": scene.bodies[i].mass, "localInertiaDiagonal": moments[i].tolist()}
        p.changeDynamics(number, link, **moment, physicsClientId=client)
        p.changeDynamics(number, link, linearDamping=0, angularDamping=0, physicsClientId=client)
        p.changeDynamics(number, link, jointDamping=0, physicsClientId=client)
    awake = p.ACTIVATION_STATE_DISABLE_SLEEPING
    p.changeDynamics(number, -1, activationState=awake, physicsClientId=client)
    if not rigid:
        p.changeDynamics(number, -1, maxJointVelocity=NO_LIMIT, physicsClientId=client)
    return number


def link_arguments(p, scene, base_frame, branches, axes):
    """The link arrays of ``createMultiBody``. base_frame: position and quaternion of the base's frame.

    axes: body's number → quaternion principal axes → body's frame.
    """
    turn, product, back = over_arrays(rotate), over_arrays(multiply), over_arrays(conjugate)
    frames, numbers = {branches[0].parent: base_frame}, {branches[0].parent: 0}
    kinds = {
        Hinge: p.JOINT_REVOLUTE,
        Slider: p.JOINT_PRISMATIC,
        Fixed: p.JOINT_FIXED,
        BallJoint: p.JOINT_SPHERICAL,
    }
    links = {name: [] for name in _LINK_ARRAYS}
    for number, (i, joint, parent) in enumerate(branches, start=1):
        if type(joint) not in kinds:
            raise Unsupported(f"pybullet's multibodies have no {type(joint).__name__} joint")
        body, (place, q) = scene.bodies[i], frames[parent]
        origin = scene.bodies[joint.ends[1]].position if isinstance(joint, Slider | Fixed) else joint.point
        frames[i], numbers[i] = (origin, np.array([1.0, 0, 0, 0])), number
        values = (
            body.mass,
            -1,
            -1,
            turn(back(q), origin - place).tolist(),
            xyzw(back(q)),
            (body.position - origin).tolist(),
            xyzw(product(body.orientation, np.array(axes[i]))),
            numbers[parent],
            kinds[type(joint)],
            (_sign(i, joint) * _axis(joint)).tolist(),
        )
        for name, value in zip(_LINK_ARRAYS, values, strict=True):
            links[name].append(value)
    return links


_LINK_ARRAYS = (
    "linkMasses",
    "linkCollisionShapeIndices",
    "linkVisualShapeIndices",
    "linkPositions",
    "linkOrientations",
    "linkInertialFramePositions",
    "linkInertialFrameOrientations",
    "linkParentIndices",
    "linkJointTypes",
    "linkJointAxis",
)


def xyzw(q):
    """A quaternion (w, x, y, z) in the engine's order."""
    w, x, y, z = q.tolist()
    return x, y, z, w


def _axis(joint):
    return joint.axis if isinstance(joint, Hinge | Slider) else np.array([0.0, 0, 1])


def _sign(i, joint):
    """+1 where the child is the joint's body j, so that the coordinate is the scene's."""
    return 1.0 if joint.ends[1] == i else -1.0


def set_joints(p, client, scene, number, branches, places):
    """Each joint's velocity at the start, its motor and its limits; the engine's own brakes switched off.

    Returns [(link, joint)] of those with a spring or damper, which is a force to be given at each step.
    """
    sprung, at_rest = [], np.zeros(3)
    for link, (i, joint, parent) in enumerate(branches):
        body = scene.bodies[i]
        v, ω = (at_rest, at_rest) if parent is None else _moving_with(scene.bodies[parent], body.position)
        spin, speed = body.angular_velocity - ω, body.velocity - v
        who = {"bodyUniqueId": number, "jointIndex": link, "physicsClientId": client}
        if isinstance(joint, BallJoint):
            _check_soft(joint)
            p.setJointMotorControlMultiDof(
                number,
                link,
                p.POSITION_CONTROL,
                targetPosition=[0, 0, 0, 1],
                positionGain=0,
                velocityGain=1,
                force=[0, 0, 0],
                physicsClientId=client,
            )
            back = over_arrays(conjugate)(over_arrays(multiply)(body.orientation, np.array(places[i].axes)))
            own = over_arrays(rotate)(back, spin).tolist()
            p.resetJointStateMultiDof(number, link, [0, 0, 0, 1], own, physicsClientId=client)
        elif isinstance(joint, Hinge | Slider):
            rate = _sign(i, joint) * _axis(joint) @ (spin if isinstance(joint, Hinge) else speed)
            target, most = joint.motor or (0.0, 0.0)
            p.setJointMotorControl2(
                controlMode=p.VELOCITY_CONTROL, targetVelocity=target, force=min(most, BOUNDLESS), **who
            )
            p.resetJointState(targetValue=0.0, targetVelocity=float(rate), **who)
            if joint.limits is not None:
                low, high = np.clip(joint.limits, -BOUNDLESS, BOUNDLESS).tolist()
                p.changeDynamics(
                    number, link, jointLowerLimit=low, jointUpperLimit=high, physicsClientId=client
                )
            if joint.soft:
                sprung.append((link, joint))
    return sprung


def _check_soft(joint):
    if joint.soft:
        raise Unsupported("this adapter has no spring for pybullet's JOINT_SPHERICAL")


def _moving_with(body, point):
    """Velocity and angular velocity of a point that moves with a body."""
    ω = body.angular_velocity
    return body.velocity + np.cross(ω, point - body.position), ω
