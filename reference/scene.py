"""What a user declares: bodies, and the forces between them. Nothing is computed here.

A scene holds what there is and no more; ``reference.model(scene)`` tells what will be built from it. SI
units, world frame. Bodies are numbered from 0 in the order in which they were added.

Slides S4–S6, S10; lectures/02_equation_of_motion.md.
"""

from dataclasses import replace
from itertools import combinations

import numpy as np

from . import inputs
from .declared import Body, Pair, Spring
from .inertia import checked_inertia
from .joints import JOINTS
from .shapes import SHAPES, Plane, Point


class Unsupported(ValueError):
    """The simulator, solver or engine can't express what was asked for; the message says what it lacks."""


class Scene:
    """Bodies and forces. ``gravity``, m/s²: three components make a scene in space, two one in the plane."""

    def __init__(self, gravity=(0, 0, -9.81)):
        if np.size(gravity) not in (2, 3):
            raise ValueError(f"gravity must have 2 or 3 components, m/s², but is {gravity!r}")
        self.dimension = int(np.size(gravity))
        self.gravity = inputs.array("gravity", gravity, (self.dimension,))
        self.bodies, self.joints, self.springs, self.drags, self.pairs = [], [], [], {}, {}
        self.gravitation = 0.0
        self.user_forces = []

    def add(
        self,
        shape,
        *,
        mass=None,
        static=False,
        position=None,
        orientation=None,
        velocity=0,
        angular_velocity=0,
        friction=0.5,
        restitution=0.0,
        inertia=None,
        group=None,
    ):
        """Add a body and return its number.

        shape: an instance of Sphere, Box, Capsule, Disc, Polygon, Plane or Point.
        mass: kg; None: 1 kg. A static body needs none, but attracts others (``gravitate``) only if it has
        one.
        position: (d,) m, the centre of mass (a Plane: a point on it); None: the origin.
        orientation: unit quaternion (w, x, y, z) body → world, or an angle in rad in the plane; None: no
        rotation.
        velocity: (d,) m/s; angular_velocity: (3,) rad/s in the world frame, or a number in the plane; 0: at
        rest.
        friction ≥ 0; restitution 0 … 1.
        inertia: kg m² about the centre, body frame: principal moments (3,) or a tensor (3, 3), a number in
        the plane; None: the shape's own, filled evenly.
        group: bodies with the same group, other than None, do not collide with each other.

        Raises TypeError and ValueError, which name the argument, its value and what would be right.
        """
        d = self.dimension
        static = inputs.flag("static", static) or isinstance(shape, Plane)
        turns = self._checked_shape(shape, inertia)
        body = Body(
            shape,
            mass=self._mass(shape, mass, static),
            static=static,
            position=inputs.array("position", np.zeros(d) if position is None else position, (d,)),
            orientation=self._orientation(orientation, turns),
            velocity=self._motion("velocity", velocity, (d,), static and "a static body"),
            angular_velocity=self._motion(
                "angular_velocity",
                angular_velocity,
                (3,) if d == 3 else (),
                (static and "a static body") or (not turns and "a Point"),
            ),
            friction=inputs.number("friction", friction, least=0),
            restitution=self._restitution(restitution),
            inertia=None,
            group=group,
        )
        if turns and not static:
            body = replace(body, inertia=self._inertia(body, inertia))
        self.bodies.append(body)
        return len(self.bodies) - 1

    def pair(self, i, j, friction=None, restitution=None, collide=True):
        """Say what holds between the bodies i and j.

        None: the product of their frictions, the larger of their restitutions.
        """
        i, j = self._number("i", i), self._number("j", j)
        if i == j:
            raise ValueError(f"j must be another body than i, but both are {i}")
        friction = None if friction is None else inputs.number("friction", friction, least=0)
        restitution = None if restitution is None else self._restitution(restitution)
        self.pairs[min(i, j), max(i, j)] = Pair(friction, restitution, inputs.flag("collide", collide))

    def spring(self, a, b, stiffness, damping=0, length=None, point_a=None, point_b=None):
        """A spring and damper in parallel between the bodies a and b; b None: the world, at ``point_b``.

        stiffness: N/m; damping: N s/m, along the spring; length: at rest, m; None: the distance at the start.
        point_a, point_b: (d,) where it is fixed, world coordinates at the start; None: the centres of mass.
        """
        a, b = self._number("a", a), None if b is None else self._number("b", b)
        if a == b:
            raise ValueError(f"b must be another body than a, but both are {a}")
        if b is None and point_b is None:
            raise ValueError("point_b must be given where b is None, the world, but is None")
        ends = [
            self.bodies[i].position.copy() if p is None else inputs.array(name, p, (self.dimension,))
            for name, i, p in (("point_a", a, point_a), ("point_b", b, point_b))
        ]
        stiffness = inputs.number("stiffness", stiffness, least=0)
        damping = inputs.number("damping", damping, least=0)
        distance = float(np.linalg.norm(ends[1] - ends[0]))
        length = distance if length is None else inputs.number("length", length, least=0)
        for end, i, point in (("point_a", a, ends[0]), ("point_b", b, ends[1])):
            if (
                i is not None
                and isinstance(self.bodies[i].shape, Point)
                and not np.array_equal(point, self.bodies[i].position)
            ):
                raise ValueError(
                    f"{end} must be the body's position, since body {i} is a Point, but is {point.tolist()}"
                )
        self.springs.append(Spring(a, b, stiffness, damping, length, *ends))

    def drag(self, i, linear, angular=0):
        """Add a force −linear·v (N s/m) and a torque −angular·ω (N m s) to body i; it bounds dt."""
        i = self._number("i", i)
        linear, angular = inputs.number("linear", linear, least=0), inputs.number("angular", angular, least=0)
        if angular and isinstance(self.bodies[i].shape, Point):
            raise ValueError(
                f"angular must be 0 for body {i}, a Point, which doesn't rotate, but is {angular!r}"
            )
        before = self.drags.get(i, (0.0, 0.0))
        self.drags[i] = before[0] + linear, before[1] + angular

    def gravitate(self, G):
        """Let all pairs of masses attract each other with G m_i m_j / r²; G in m³/(kg s²)."""
        self.gravitation = inputs.number("G", G, least=0)

    def force(self, f):
        """Add the user's own force: ``f(t, state)`` returns a force and a torque for all n bodies.

        Force (n, d) in N, torque (n, 3) or (n,) in N m, world frame; ``state`` has position, orientation,
        velocity and angular_velocity of all bodies, and must not be changed. A run with such a force calls
        Python in each step, and is slower for it.
        """
        if not callable(f):
            raise TypeError(f"f must be a function f(t, state), but is {f!r}")
        self.user_forces.append(f)

    def join(self, joint):
        """Join two bodies, or one to the world: BallJoint, Hinge, Slider, Fixed, Universal or Distance.

        Returns the joint's number; ``scene.joints`` holds the joints, their arguments checked and filled in.
        Raises TypeError and ValueError, which name the argument, its value and what would be right.
        """
        if not isinstance(joint, JOINTS):
            names = ", ".join(kind.__name__ for kind in JOINTS)
            raise TypeError(f"joint must be one of {names}, but is {joint!r}")
        a, b = self._number("a", joint.a), None if joint.b is None else self._number("b", joint.b)
        if a == b:
            raise ValueError(f"b must be another body than a, or None, the world, but both are {a}")
        if all(i is None or self.bodies[i].static for i in (a, b)):
            raise ValueError(
                f"a must be a body that can move, or b one, but a is {a} and b is {b!r}, both static"
            )
        joint = replace(joint, a=a, b=b, collide=inputs.flag("collide", joint.collide))
        self.joints.append(joint.checked(self.bodies, self.dimension))
        return len(self.joints) - 1

    def colliding_pairs(self):
        """The pairs (i, j), i < j, that could ever touch: no points, not one group, not joined, …"""
        joined = {
            (min(joint.ends), max(joint.ends))
            for joint in self.joints
            if joint.b is not None and not joint.collide
        }
        solid = [i for i, body in enumerate(self.bodies) if not isinstance(body.shape, Point)]
        if len({self.bodies[i].group for i in solid}) == 1 and self.bodies[solid[0]].group is not None:
            return  # all in one group: no need to look at each pair
        for i, j in combinations(solid, 2):
            a, b = self.bodies[i], self.bodies[j]
            apart = (
                (a.static and b.static) or (a.group is not None and a.group == b.group) or (i, j) in joined
            )
            if not apart and self.pairs.get((i, j), Pair()).collide:
                yield i, j

    def _number(self, name, value):
        i = inputs.whole(name, value)
        if i >= len(self.bodies):
            raise ValueError(f"{name} must be the number of a body, 0 … {len(self.bodies) - 1}, but is {i}")
        return i

    def _checked_shape(self, shape, inertia):
        """Whether such a body rotates; TypeError or ValueError for what can't stand in this scene."""
        if not isinstance(shape, SHAPES):
            names = ", ".join(kind.__name__ for kind in SHAPES)
            raise TypeError(f"shape must be an instance of {names}, but is {shape!r}")
        if self.dimension not in shape.dimensions:
            raise ValueError(
                f"shape must fit this scene of {self.dimension} dimensions, but {shape!r} stands in "
                f"{shape.dimensions[0]}"
            )
        turns = not isinstance(shape, Point)
        if not turns and inertia is not None:
            raise ValueError(
                f"inertia must be left out for a Point, which doesn't rotate, but is {inertia!r}"
            )
        return turns

    def _mass(self, shape, mass, static):
        """kg; 1 where nothing was said, 0 for what is static."""
        if isinstance(shape, Plane) and mass is not None:
            raise ValueError(f"mass must be left out for a Plane, which is always static, but is {mass!r}")
        if mass is None:
            return 0.0 if static else 1.0
        return inputs.number("mass", mass, least=0) if static else inputs.number("mass", mass, above=0)

    def _orientation(self, value, turns):
        if value is None:
            return np.array([1.0, 0, 0, 0]) if self.dimension == 3 else 0.0
        angle_or_q = (inputs.unit_quaternion if self.dimension == 3 else inputs.number)("orientation", value)
        if not turns and not np.array_equal(angle_or_q, self._orientation(None, turns)):
            raise ValueError(f"orientation must be left out for a Point, which has none, but is {value!r}")
        return angle_or_q

    def _motion(self, name, value, shape, resting):
        """A velocity: an array of the shape, () for a number, or 0. resting: what must be at rest."""
        value = np.zeros(shape) if np.ndim(value) == 0 and value == 0 else value
        result = inputs.array(name, value, shape) if shape else inputs.number(name, value)
        if resting and np.any(result):
            raise ValueError(f"{name} must be 0 for {resting}, but is {value!r}")
        return result

    def _restitution(self, value):
        if inputs.number("restitution", value, least=0) > 1:
            raise ValueError(f"restitution must be a number from 0 to 1, but is {value!r}")
        return float(value)

    def _inertia(self, body, value):
        if value is None:
            return body.shape.inertia(body.mass, self.dimension)
        if self.dimension == 3:
            return checked_inertia("inertia", value)
        return inputs.number("inertia", value, above=0)
