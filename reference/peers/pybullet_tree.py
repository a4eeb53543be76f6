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
frames are laid parallel to the world's at the start, so a JOINT_SPHERICAL's velocity, which is in the frame
of the child, is the world's there. ``getLinkStates`` gives the velocity of the centre of mass, but of the
step before unless told to compute it and the kinematics anew. Whatever order links are given in, the engine
numbers them depth first, so that is the order here.

**Springs and motors.** A spring is a torque −stiffness q − damping q̇ (or force), given anew before each step;
a motor is the engine's own, bounded by max_force; limits are the engine's own too, hit without a bounce.

Slides S3, S5, S9; lectures/04_embedding.md.
"""

from typing import NamedTuple

import numpy as np

from ..joints import BallJoint, Fixed, Hinge, Slider
from ..rotation import conjugate, multiply, over_arrays, rotate
from ..scene import Unsupported

BOUNDLESS = 1e30  # N or N m


class Branch(NamedTuple):
    """A body and the joint by which it hangs on its parent (None: on the base that stands in the world)."""

    body: int
    joint: object
    parent: int | None


def trees(scene):
    """The scene's trees as (base's number or None, list of Branch, parents first), and the joints left over.

    A joint is left over where it closes a loop.
    """
    joints_of = {i: [] for i, body in enumerate(scene.bodies) if not body.static}
    held = []  # branches on the world, or on what is static
    for joint in scene.joints:
        for i, other in (joint.ends, joint.ends[::-1]):
            if i in joints_of:
                joints_of[i].append(joint)
                if other not in joints_of:
                    held.append(Branch(i, joint, None))
    found, reached = [], set()
    for first in joints_of:
        if first not in reached:
            members = _members(first, joints_of)
            roots = [branch for branch in held if branch.body in members]
            base = None if roots else first
            reached.add(base)
            found.append((base, _grown(roots or _branches_from(first, joints_of), joints_of, reached)))
    used = {id(branch.joint) for _, branches in found for branch in branches}
    return found, [joint for joint in scene.joints if id(joint) not in used]


def _members(first, joints_of):
    """The moving bodies that are joined to ``first``, directly or not."""
    members, queue = {first}, [first]
    for i in queue:
        new = [b.body for b in _branches_from(i, joints_of) if b.body not in members]
        members.update(new)
        queue += new
    return members


def _branches_from(i, joints_of):
    return [
        Branch(other, joint, i)
        for joint in joints_of[i]
        for other in joint.ends
        if other in joints_of and other != i
    ]


def _grown(branches, joints_of, reached):
    """A tree's branches, from those at its base; ``reached`` gets the bodies.

    Each body hangs on the nearest to the base; the order is the engine's: a body, then all that hangs on it.
    """
    queue, hanging = list(branches), {}
    for branch in queue:
        if branch.body not in reached:
            reached.add(branch.body)
            hanging.setdefault(branch.parent, []).append(branch)
            queue += _branches_from(branch.body, joints_of)
    ordered, stack = [], hanging[branches[0].parent][::-1] if branches else []
    while stack:
        ordered.append(stack.pop())
        stack += hanging.get(ordered[-1].body, [])[::-1]
    return ordered


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
            _xyzw(back(q)),
            (body.position - origin).tolist(),
            _xyzw(product(body.orientation, np.array(axes[i]))),
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


def _xyzw(q):
    w, x, y, z = q.tolist()
    return x, y, z, w


def _axis(joint):
    return joint.axis if isinstance(joint, Hinge | Slider) else np.array([0.0, 0, 1])


def _sign(i, joint):
    """+1 where the child is the joint's body j, so that the coordinate is the scene's."""
    return 1.0 if joint.ends[1] == i else -1.0


def set_joints(p, client, scene, number, branches):
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
            p.resetJointStateMultiDof(number, link, [0, 0, 0, 1], spin.tolist(), physicsClientId=client)
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
