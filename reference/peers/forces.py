"""The forces that an engine has no word for, computed from the engine's own state and handed to it each step.

Written apart from `reference/forces.py`, in plain numbers, so that an engine stays a second opinion on our
own forces: springs and dampers, drag, gravitation between bodies, the user's functions. Gravity is left to
the engine.

Slides S4, S18; lectures/02_equation_of_motion.md.
"""

import math

import numpy as np

from ..compiled import plain
from ..rotation import conjugate, cross, rotate
from ..shapes import Point
from ..trajectory import BodyState

_cross, _rotate, _conjugate = plain(cross), plain(rotate), plain(conjugate)


class Forces:
    """``forces(t, x, q, v, ω)``: lists with one entry a body → (force, torque), lists with one entry a body.

    x, v, force: d numbers a body. q: four numbers, or an angle. ω, torque: three numbers, or one. World
    frame, SI units. springs, drags: those of the scene that are to be computed here; gravitation and user's
    forces always are.
    """

    def __init__(self, scene, springs, drags):
        self.dimension, self.bodies = scene.dimension, scene.bodies
        self.turns = [not (body.static or isinstance(body.shape, Point)) for body in scene.bodies]
        self.springs = [
            (s, self._fixed_point(s.a, s.point_a), self._fixed_point(s.b, s.point_b)) for s in springs
        ]
        self.drags, self.G, self.user_forces = drags, scene.gravitation, scene.user_forces
        self.sources = [i for i, body in enumerate(scene.bodies) if body.mass > 0]

    def any(self):
        """Whether there is anything to compute."""
        return bool(self.springs or self.drags or self.G or self.user_forces)

    def __call__(self, t, x, q, v, ω):
        force = [[0.0] * self.dimension for _ in x]
        torque = [[0.0] * 3 for _ in x] if self.dimension == 3 else [0.0] * len(x)
        for spring, end_a, end_b in self.springs:
            self._add_spring(spring, end_a, end_b, (x, q, v, ω), force, torque)
        for i, (linear, angular) in self.drags.items():
            force[i] = [f - linear * s for f, s in zip(force[i], v[i], strict=True)]
            torque[i] = _plus(torque[i], ω[i], -angular)
        if self.G:
            self._add_gravitation(x, force)
        if self.user_forces:
            self._add_user_forces(
                BodyState(t, np.array(x), np.array(q), np.array(v), np.array(ω)), force, torque
            )
        return force, torque

    def _fixed_point(self, i, point):
        """The body's number and the point in its own frame; where it doesn't turn, just the offset."""
        if i is None:
            return None, list(point)
        body = self.bodies[i]
        arm = (point - body.position).tolist()
        if not self.turns[i]:
            return i, arm
        return i, list(
            _rotate(_conjugate(body.orientation.tolist()), arm)
        ) if self.dimension == 3 else _turned(-body.orientation, arm)

    def _end(self, end, state):
        """Arm from the centre, position and velocity (lists of d) of a spring's end."""
        (i, point), (x, q, v, ω) = end, state
        if i is None:
            return None, point, [0.0] * self.dimension
        if not self.turns[i]:
            return point, _plus(x[i], point), v[i]
        if self.dimension == 3:
            arm = _rotate(q[i], point)
            return arm, _plus(x[i], arm), _plus(v[i], _cross(ω[i], arm))
        arm = _turned(q[i], point)
        return arm, _plus(x[i], arm), [v[i][0] - ω[i] * arm[1], v[i][1] + ω[i] * arm[0]]

    def _add_spring(self, spring, end_a, end_b, state, force, torque):
        arm_a, place_a, speed_a = self._end(end_a, state)
        arm_b, place_b, speed_b = self._end(end_b, state)
        span = _plus(place_b, place_a, -1.0)
        distance = math.sqrt(sum(c * c for c in span))
        if distance == 0:
            return
        rate = sum(c * (b - a) for c, a, b in zip(span, speed_a, speed_b, strict=True)) / distance
        tension = (spring.stiffness * (distance - spring.length) + spring.damping * rate) / distance
        for i, arm, sign in ((end_a[0], arm_a, tension), (end_b[0], arm_b, -tension)):
            if i is not None:
                pull = [sign * c for c in span]
                force[i] = _plus(force[i], pull)
                if self.turns[i]:
                    torque[i] = self._moment(torque[i], arm, pull)

    def _moment(self, torque, arm, pull):
        if self.dimension == 3:
            return _plus(torque, _cross(arm, pull))
        return torque + arm[0] * pull[1] - arm[1] * pull[0]

    def _add_gravitation(self, x, force):
        for i in self.sources:
            for j in self.sources:
                if j < i:
                    span = _plus(x[j], x[i], -1.0)
                    distance = math.sqrt(sum(c * c for c in span))
                    scale = self.G * self.bodies[i].mass * self.bodies[j].mass / distance**3
                    force[i], force[j] = _plus(force[i], span, scale), _plus(force[j], span, -scale)

    def _add_user_forces(self, state, force, torque):
        for user_force in self.user_forces:
            f, τ = (np.asarray(part, dtype=float) for part in user_force(state.time, state))
            if f.shape != state.position.shape or τ.shape != state.angular_velocity.shape:
                raise ValueError(
                    f"f(t, state) must return a force of shape {state.position.shape} and a torque of shape "
                    f"{state.angular_velocity.shape}, but returned shapes {f.shape} and {τ.shape}"
                )
            for i in range(len(force)):
                force[i], torque[i] = _plus(force[i], f[i].tolist()), _plus(torque[i], τ[i].tolist())


def _plus(a, b, scale=1.0):
    """a + scale · b, of lists or of numbers."""
    if isinstance(a, float):
        return a + scale * b
    return [p + scale * r for p, r in zip(a, b, strict=True)]


def _turned(angle, r):
    """A vector (2,) of the plane turned by an angle."""
    c, s = math.cos(angle), math.sin(angle)
    return [c * r[0] - s * r[1], s * r[0] + c * r[1]]
