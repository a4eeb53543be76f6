"""A scene laid out as arrays for computing, and the way back to bodies in the order in which they were added.

Only what moves goes into the state; what is static becomes part of the constants.

Slides S4, S9; lectures/02_equation_of_motion.md.
"""

import numpy as np

from .bodies import System, make_state
from .inertia import principal_axes
from .rotation import conjugate, multiply, over_arrays, rotate, rotate_back, rotate_in_plane
from .shapes import Point


class Bodies:
    """A scene laid out as arrays: ``system``, ``state()``, and ``unpack()``, the way back.

    n bodies in all: mass (n,), 0 for the static; source_mass (n,), all that attracts; inertia (n, 3, 3) or
    (n,), body frame, 0 for what does not rotate.
    """

    def __init__(self, scene):
        bodies, self.dimension = scene.bodies, scene.dimension
        self.declared, self.joints = bodies, scene.joints
        moving = [i for i, body in enumerate(bodies) if not body.static]
        rotating = [i for i in moving if not isinstance(bodies[i].shape, Point)]
        self.rotating = np.array(rotating, dtype=int)
        self.moving = np.array(
            rotating + [i for i in moving if isinstance(bodies[i].shape, Point)], dtype=int
        )
        self.slot = {int(i): k for k, i in enumerate(self.moving)}  # body's number → row of the state
        n, d = len(bodies), self.dimension
        self.position = np.array([body.position for body in bodies]).reshape(n, d)
        self.orientation = np.array([body.orientation for body in bodies]).reshape((n, 4) if d == 3 else n)
        self.velocity = np.array([body.velocity for body in bodies]).reshape(n, d)
        self.angular_velocity = np.array([body.angular_velocity for body in bodies]).reshape(
            (n, 3) if d == 3 else n
        )
        self.source_mass = np.array([body.mass for body in bodies])
        self.mass = np.array([0.0 if body.static else body.mass for body in bodies])
        self.inertia = np.zeros((n, 3, 3) if d == 3 else n)
        for i in rotating:
            self.inertia[i] = bodies[i].inertia
        self.gravity, self.gravitation = scene.gravity, scene.gravitation
        self._turn_to_principal_axes()
        self._lay_out_springs(scene.springs)
        self.system = self._system(scene)

    def state(self, position=None, orientation=None, velocity=None, angular_velocity=None):
        """The State (see there) of all bodies given in the scene's order; None: as at the scene's start."""
        state = make_state(len(self.moving), len(self.rotating), self.dimension)
        state.x[:] = (self.position if position is None else position)[self.moving]
        state.v[:] = (self.velocity if velocity is None else velocity)[self.moving]
        state.q[:] = self._principal_frames(self.orientation if orientation is None else orientation)
        spin = self.angular_velocity if angular_velocity is None else angular_velocity
        state.ω[:] = spin[self.rotating].reshape(state.ω.shape)
        if self.dimension == 3:
            in_principal = over_arrays(rotate)(over_arrays(conjugate)(state.q), state.ω)
            state.L[:] = over_arrays(rotate)(state.q, self.moments * in_principal)
        return state

    def pack(self, position, orientation):
        """Records y (T, size) of position (T, n, d) and orientation (T, n, 4) or (T, n), at rest."""
        T, state = len(position), make_state(len(self.moving), len(self.rotating), self.dimension)
        x, q = position[:, self.moving], self._principal_frames(orientation)
        return np.concatenate([x.reshape(T, -1), q.reshape(T, -1), np.zeros((T, state.u.size))], axis=1)

    def _principal_frames(self, orientation):
        """q of the State from orientation (…, n, 4) or (…, n)."""
        if self.dimension == 2:
            return orientation[..., self.rotating, None]
        return over_arrays(multiply)(orientation[..., self.rotating, :], self.principal)

    def unpack(self, y):
        """Position (T, n, d), orientation (T, n, 4) or (T, n), velocity (T, n, d), angular velocity (T, n, 3)
        or (T, n).

        y (T, size): records of ``State.y``. Static bodies are where the scene put them, at rest.
        """
        T, m, r, d = len(y), len(self.moving), len(self.rotating), self.dimension
        x, q, v, ω = np.split(y, np.cumsum([m * d, r * (4 if d == 3 else 1), m * d]), axis=1)
        result = [
            np.repeat(a[None], T, axis=0)
            for a in (self.position, self.orientation, self.velocity, self.angular_velocity)
        ]
        result[0][:, self.moving] = x.reshape(T, m, d)
        result[2][:, self.moving] = v.reshape(T, m, d)
        if d == 3:
            q = q.reshape(T, r, 4)
            if self.turned:
                q = over_arrays(multiply)(q, over_arrays(conjugate)(self.principal))
            result[1][:, self.rotating], result[3][:, self.rotating] = q, ω.reshape(T, r, 3)
        else:
            result[1][:, self.rotating], result[3][:, self.rotating] = q, ω
        return tuple(result)

    def _turn_to_principal_axes(self):
        """Each rotating body's principal moments, and the quaternion principal frame → body frame."""
        r = len(self.rotating)
        if self.dimension == 2:
            self.moments, self.principal, self.turned = self.inertia[self.rotating].reshape(r, 1), None, False
            return
        axes = [principal_axes(self.inertia[i]) for i in self.rotating]
        self.moments = np.array([moments for moments, _ in axes]).reshape(r, 3)
        self.principal = np.array([q for _, q in axes]).reshape(r, 4)
        self.turned = bool(np.any(self.principal[:, 0] != 1))

    def _lay_out_springs(self, springs):
        """Each spring's two ends as (body's number or None, point): in that body's frame, or in the
        world's.
        """
        self.spring_ends = [
            [(i, point if i is None else self._in_body(i, point)) for i, point in ends]
            for ends in (((s.a, s.point_a), (s.b, s.point_b)) for s in springs)
        ]

    def _in_body(self, i, point):
        """A point (d,) given in world coordinates at the start, in the frame of body i."""
        turn = over_arrays(rotate) if self.dimension == 3 else rotate_in_plane
        q = self.orientation[i]
        return turn(q * [1, -1, -1, -1] if self.dimension == 3 else -q, point - self.position[i])

    def fixed_point(self, i, point):
        """Where a point (d,), in world coordinates at the start, is in body i's principal frame.

        What is fixed to the world (i None) or to a static body stays in world coordinates.
        """
        return self.fixed_direction(i, point - self.position[i] if i in self.slot else point)

    def fixed_direction(self, i, direction):
        """A direction (d,), world coordinates at the start, in body i's principal frame; see fixed_point."""
        slot = self.slot.get(i, -1)
        if slot < 0 or slot >= len(self.rotating):
            return direction
        if self.dimension == 2:
            return rotate_in_plane(-self.orientation[i], direction)
        q = over_arrays(multiply)(self.orientation[i], self.principal[slot])
        return over_arrays(rotate_back)(q, direction)

    def _spring_arrays(self, springs):
        """The System's arrays: what is fixed to a static body is fixed in the world, the rest in
        principal frames.
        """
        s, d = len(springs), self.dimension
        slots, points = np.full((s, 2), -1), np.zeros((s, 2, d))
        for row, (spring, ends) in enumerate(zip(springs, self.spring_ends, strict=True)):
            for k, (i, _) in enumerate(ends):
                slots[row, k] = self.slot.get(i, -1)
                points[row, k] = self.fixed_point(i, (spring.point_a, spring.point_b)[k])
        law = np.array([[spring.stiffness, spring.damping, spring.length] for spring in springs]).reshape(
            s, 3
        )
        return slots, points, law

    def _system(self, scene):
        spring_bodies, spring_points, spring_law = self._spring_arrays(scene.springs)
        drags = {self.slot[i]: law for i, law in scene.drags.items() if i in self.slot}
        attracting = [
            i for i, body in enumerate(scene.bodies) if body.static and body.mass and scene.gravitation
        ]
        return System(
            mass=self.mass[self.moving],
            inertia=self.moments,
            gravity=self.gravity,
            spring_bodies=spring_bodies,
            spring_points=spring_points,
            spring_law=spring_law,
            drag_bodies=np.array(list(drags), dtype=int),
            drag_law=np.array(list(drags.values()), dtype=float).reshape(-1, 2),
            gravitation=self.gravitation,
            fixed_masses=self.source_mass[attracting],
            fixed_positions=self.position[attracting],
            velocity_dependent=bool(drags) or bool(np.any(spring_law[:, 1])) or bool(scene.user_forces),
        )
