"""pymunk 7.3.1 (Chipmunk 2D in double precision): what it does to a scene, and the scene in it.

**The integrator is symplectic Euler, position first.** One ``space.step(h)`` is, in this order,

    x ← x + h v,  φ ← φ + h ω;    v ← damping^h v + h (g + f/m),  ω ← damping^h ω + h τ/I;

then constraints (joints: see ``pymunk_joints``) and contact (see ``pymunk_contact``).

All numbers are doubles. ``space.damping`` is 1 by default, no damping, and it is the factor that is left
after one second. Bodies don't sleep by default. ``body.force`` and ``body.torque`` are used in the velocity
update, and cleared by it. A step starts by moving the body, so a force that was computed from the state
*before* the step acts late, and the update would become explicit Euler: springs would gain energy. Hence:

**Forces without a word in pymunk** are computed before each step at the place to which that step is about to
move the bodies (x + h v, φ + h ω, the velocities as they are, the time at the end), and set as
``body.force``: the same place at which pymunk looks at its own springs. This is what
`reference.integrators.symplectic_euler_position_first` does.

**Springs** are pymunk's ``DampedSpring`` (setting ``springs="engine"``): an impulse h k (length − distance)
along the spring, computed where the bodies are after moving, once a step; so without damping it is the same
as a force. Then the damper: by the factor e^(−c h/μ) it takes down the speed along the spring, once a step
whatever ``iterations``, where 1/μ is what a unit impulse along the spring changes that speed by. That agrees
with a force −c v to order h and is stable for any c. ``springs="force"`` computes spring and damper by the
law of this course instead.

**Drag** is a force −c v (``drag="force"``), or pymunk's damping (``drag="engine"``: e^(−c/m) left after a
second), which it has only for all bodies alike: then c/m must be the same for each, and so must (angular
drag)/I for what rotates.

How it was found: one step from given numbers, done by hand, agrees to the last bit; 5 steps of spring and
damper in closed form agree to 5e-16 for (k, c) = (5, 0), (5, 1), (0, 1), (500, 30), on one body and on two.
The tests repeat it.

Slides S4, S9, S18; lectures/02_equation_of_motion.md.
"""

import math

from ..scene import Unsupported
from ..shapes import Point
from .engine import Between, Engine, Peer
from .forces import Forces
from .pymunk_contact import Toucher
from .pymunk_joints import Joiner


class PymunkPeer(Peer):
    """A planar scene in a ``pymunk.Space``. Where nothing can touch, the bodies have no shapes."""

    def __init__(self, engine, scene, dt, settings):
        import pymunk

        super().__init__(engine, scene, dt, settings)
        self.space = pymunk.Space()
        self.space.gravity = tuple(scene.gravity.tolist())
        self.space.iterations = settings["iterations"]
        self.space.collision_slop, self.space.collision_bias = settings["slop"], settings["collision_bias"]
        self.in_engine = {i: self._body(pymunk, scene.bodies[i]) for i in self.moving}
        self.space.add(*self.in_engine.values())
        by_engine = settings["springs"] == "engine"
        if by_engine:
            self.space.add(*filter(None, (self._spring(pymunk, spring) for spring in scene.springs)))
        joiner = Joiner(pymunk, scene, self.in_engine, self.space.static_body)
        for constraint in (made for joint in scene.joints for made in joiner.made(joint)):
            constraint.error_bias = settings["error_bias"]
            self.space.add(constraint)
        if self.touching:
            self.toucher = Toucher(pymunk, scene, self.space, self.in_engine, self.touching)
        drags = {i: law for i, law in scene.drags.items() if i in self.in_engine}
        if settings["drag"] == "engine" and drags:
            self.space.damping = math.exp(-self._common_rate(drags))
            drags = {}
        self.forces = Forces(scene, () if by_engine else scene.springs, drags)

    def _body(self, pymunk, body):
        """A body of pymunk; a point mass is one that no torque can turn."""
        moment = math.inf if isinstance(body.shape, Point) else body.inertia
        made = pymunk.Body(body.mass, moment)
        made.position, made.velocity = tuple(body.position.tolist()), tuple(body.velocity.tolist())
        made.angle, made.angular_velocity = float(body.orientation), float(body.angular_velocity)
        return made

    def _spring(self, pymunk, spring):
        """A DampedSpring; None where both its ends are fixed."""
        ends = []
        for i, point in ((spring.a, spring.point_a), (spring.b, spring.point_b)):
            body = self.in_engine.get(i, self.space.static_body)
            ends.append((body, body.world_to_local(tuple(point.tolist()))))
        (a, anchor_a), (b, anchor_b) = ends
        if a is b:
            return None
        return pymunk.DampedSpring(a, b, anchor_a, anchor_b, spring.length, spring.stiffness, spring.damping)

    def _common_rate(self, drags):
        """c/m, 1/s, the same for everything that moves; else Unsupported."""
        rates = set()
        for i in self.moving:
            body, (linear, angular) = self.scene.bodies[i], drags.get(i, (0.0, 0.0))
            rates.add(linear / body.mass)
            if not isinstance(body.shape, Point):
                rates.add(angular / body.inertia)
        if len(rates) > 1:
            raise Unsupported(
                "pymunk's damping is one for all bodies, linear and angular, but this scene's drags need "
                f"{sorted(rates)} 1/s: use drag='force'"
            )
        return rates.pop()

    def step(self, steps):
        """A tight loop where the engine does everything itself; else forces are set before each step."""
        h, step = self.dt / self.substeps, self.space.step
        watched = self.touching is not None and self.touching.on
        if not self.forces.any() and not watched:
            for _ in range(steps * self.substeps):
                step(h)
            return
        start = self.time
        for k in range(steps * self.substeps):
            if self.forces.any():
                self._set_forces(start + (k + 1) * h, h)
            step(h)
            if watched:
                self.touching.next_step()

    def watch(self):
        """From now on contacts are read."""
        self.toucher.watch()

    def _set_forces(self, t, h):
        """Forces where the next step of h, which ends at t, will have moved the bodies to."""
        x, q, v, ω = self._start_lists()
        for i, body in self.in_engine.items():
            place, v[i], ω[i] = body.position, list(body.velocity), body.angular_velocity
            x[i] = [place[0] + h * v[i][0], place[1] + h * v[i][1]]
            q[i] = body.angle + h * ω[i]
        force, torque = self.forces(t, x, q, v, ω)
        for i, body in self.in_engine.items():
            body.force, body.torque = tuple(force[i]), torque[i]

    def _start_lists(self):
        """Lists of all bodies, filled with what is static."""
        start = self.bodies
        return (
            start.position.tolist(),
            start.orientation.tolist(),
            start.velocity.tolist(),
            start.angular_velocity.tolist(),
        )

    def read(self):
        """Position, angle, velocity and angular velocity of each moving body."""
        return [
            (tuple(b.position), b.angle, tuple(b.velocity), b.angular_velocity)
            for b in self.in_engine.values()
        ]


PYMUNK = Engine(
    "pymunk",
    2,
    {
        "substeps": (1, 1),
        "iterations": (10, 1),
        "error_bias": (0.9**60, Between(0.0, 1.0)),
        "slop": (0.1, Between(0.0, 1.0)),
        "collision_bias": (0.9**60, Between(0.0, 1.0)),
        "springs": ("engine", ("engine", "force")),
        "drag": ("force", ("engine", "force")),
    },
    "python -m pip install pymunk==7.3.1",
    PymunkPeer,
)
