"""pybullet 3.2.7 (Bullet in double precision): what it does to a scene, and the scene in it.

**The integrator is symplectic Euler, velocity first.** One ``stepSimulation`` of h is, for a single body,

    v ← v + h (g + f/m),   ω ← see below;      x ← x + h v,   q ← exp(h ω) ⊗ q, normalised.

It has two kinds of body, which differ in the gyroscopic term (setting ``body``; s = Rᵀω in the body's frame):

- ``"multibody"``, what createMultiBody gives by default (the base of an articulated tree): taken explicitly,
  at the start of the step, s ← s + h I⁻¹ (τ − s × I s). So it gains energy. It also limits each component of
  v and ω to 100 unless told otherwise: this adapter lifts that limit.
- ``"rigid"`` (``useMaximalCoordinates=1``): taken implicitly, by one step of Newton's method from s on
  I (s′ − s) + h s′ × I s′ = 0 (Catto, GDC 2015), to which h I⁻¹ τ is added. So it loses energy.

**Rotation** is by the exponential map of the *new* ω, for both, up to |ω| h = π/4; past that the angle is cut
off, silently and wrongly. The adapter refuses a scene that starts there.

**Damping** d is .04 by default for a multibody, the extra force −m v d (1 + |v|), and likewise for rotation:
at 3 m/s it takes 16 % of the speed a second. A rigid body has none by default; if given, it multiplies v and
ω by (1 − d)^h. Both are set to 0 here. Sleeping is off by default, and switched off again.

**Setting up.** ``changeDynamics(mass=…)`` alone puts the shape's inertia back, and ``localInertiaDiagonal``
alone takes the mass of a rigid body that has a shape: mass and inertia are given together, damping in a call
of its own. A rigid body's inverse inertia *in the world* is stale until it has once been stepped, and putting
the body elsewhere does not renew it: the first torque would meet the inertia of the shape. So each client
takes one step at rest, in place and without gravity, before anything is set in motion. Inertia is diagonal,
so the engine's frame of a body is the one of its principal axes.

**Forces** other than gravity are computed from the state at the start of each step and applied at the centre
of mass (``applyExternalForce`` and ``applyExternalTorque``, world frame): what an explicit force in
velocity-first Euler means. The engine forgets them after the step. Without such forces ``substeps`` is the
engine's own numSubSteps, a loop in C++; with them, each substep is a call, and its forces are new.

How it was found: one step from given numbers agrees with the formulas above to 4e-16, with and without
torque, for both kinds of body and several spins, and not with the other kind's formula (5e-4); 5,000 steps
agree to 1e-11. Cut-off, limit, damping and sleeping were seen in single steps from chosen states. Bullet's
public source (btMultiBody, read) has the explicit term and that damping. The tests repeat the steps.

**Joints**: see ``pybullet_tree`` for multibodies and ``pybullet_joints`` for what closes a loop and for rigid
bodies. Where they are constraints, the engine's sweeps end after ``iterations``, or before that once a sweep
changes little (``residual``; 0: never). **Contact**: see ``pybullet_contact``.

Slides S4, S5, S9, S18; lectures/02_equation_of_motion.md.
"""

import math
import weakref

import numpy as np

from ..compiled import plain
from ..joints import BallJoint
from ..rotation import conjugate, multiply, over_arrays
from ..scene import Unsupported
from .engine import Between, Engine, Peer
from .forces import Forces
from .pybullet_contact import Solid
from .pybullet_joints import Constrainer
from .pybullet_tree import add_tree, check_size, set_joints, xyzw
from .quiet import silence
from .trees import trees

_multiply, _conjugate = plain(multiply), plain(conjugate)
CONTACT_WORDS = {  # a setting of this adapter, and pybullet's word for it
    "contact_erp": "contactERP",
    "friction_erp": "frictionERP",
    "warm_start": "warmStartingFactor",
    "rest_speed": "restitutionVelocityThreshold",
}


class PybulletPeer(Peer):
    """A scene in space, in a pybullet client of its own; without shapes where nothing can touch."""

    def __init__(self, engine, scene, dt, settings):
        with silence():
            import pybullet

        super().__init__(engine, scene, dt, settings)
        self.forces = Forces(scene, scene.springs, scene.drags)
        self.p, self.client = pybullet, pybullet.connect(pybullet.DIRECT)
        self._disconnect = weakref.finalize(self, _disconnect, pybullet, self.client)
        try:
            self._build(settings["body"] == "rigid")
        except BaseException:
            self.close()
            raise

    def _check_spin(self, trees):
        """What turns by more than π/4 a step from the start; a tree's Hinges have no such limit."""
        balls = [b.body for _, branches in trees for b in branches if isinstance(b.joint, BallJoint)]
        for i in [base for base, _ in trees if base is not None] + balls:
            turn = np.linalg.norm(self.scene.bodies[i].angular_velocity) * self.dt / self.substeps
            if turn > math.pi / 4:
                raise Unsupported(
                    f"pybullet can turn a body by π/4 a step at most, but body {i} starts with {turn:.4g}: "
                    f"dt must be at most {self.dt * math.pi / 4 / turn:.4g} s"
                )

    def _build(self, rigid):
        p, c = self.p, self.client
        self.places, self.sprung = {}, []  # sprung: (number, link, joint) of the trees' springs
        found, left = ([(i, []) for i in self.moving], self.scene.joints) if rigid else trees(self.scene)
        self._check_spin(found)
        for tree in found:
            check_size(*tree)
        self.solid = Solid(p, c, self.scene, self.touching) if self.touching else None
        if self.solid:
            self._check_branches(found)
            self.solid.add_static(rigid)
        shape = self.solid.shape if self.solid else None
        made = [(add_tree(p, c, self.scene, tree, rigid, self.places, shape), tree[1]) for tree in found]
        p.stepSimulation(physicsClientId=c)  # brings a rigid body's inertia in the world up to date
        constrainer = Constrainer(p, c, self.scene, self.places, rigid)
        for joint in left:
            constrainer.add(joint)
        for (base, _), (number, branches) in zip(found, made, strict=True):
            if base is not None:
                body = self.scene.bodies[base]
                if self.solid:
                    self._put_back(number, base)
                speeds = body.velocity.tolist(), body.angular_velocity.tolist()
                p.resetBaseVelocity(number, *speeds, physicsClientId=c)
            sprung = set_joints(p, c, self.scene, number, branches, self.places)
            self.sprung += [(number, link, joint) for link, joint in sprung]
        if self.solid:
            self.solid.settle(self.places)
        self.in_loop = self.forces.any() or bool(self.sprung)
        self.calls = self.substeps if self.in_loop or self.solid else 1  # of stepSimulation for each dt
        p.setPhysicsEngineParameter(
            fixedTimeStep=self.dt / self.calls,
            numSubSteps=0 if self.calls == self.substeps else self.substeps,
            numSolverIterations=self.settings["iterations"],
            solverResidualThreshold=self.settings["residual"],
            erp=self.settings["erp"],
            **{word: self.settings[name] for name, word in CONTACT_WORDS.items() if self.solid},
            physicsClientId=c,
        )
        p.setGravity(*self.scene.gravity.tolist(), physicsClientId=c)
        self._check_velocities()

    def _check_branches(self, trees):
        if any(branches for _, branches in trees):
            raise Unsupported(
                "this adapter gives the links of pybullet's trees no shapes: body='rigid' takes joints and "
                "contact together"
            )

    def _put_back(self, number, i):
        """To where the scene has it: what overlaps has been moved by the step at rest."""
        body, axes = self.scene.bodies[i], np.array(self.places[i].axes)
        turned = xyzw(over_arrays(multiply)(body.orientation, axes))
        self.p.resetBasePositionAndOrientation(
            number, body.position.tolist(), turned, physicsClientId=self.client
        )

    def _check_velocities(self):
        """A tree's bodies can only start as its joints move them."""
        for i, (_, _, velocity, spin) in zip(self.moving, self.read(), strict=True):
            body = self.scene.bodies[i]
            gap = np.abs(np.concatenate([velocity - body.velocity, spin - body.angular_velocity])).max()
            if gap > 1e-9 * (1 + np.abs([*velocity, *spin]).max()):
                raise Unsupported(
                    f"in pybullet's trees a body starts as its joints move it, but body {i} should start "
                    f"{gap:.3g} (m/s or rad/s) off that: give velocities that fit the joints"
                )

    def step(self, steps):
        """A tight loop where the engine does everything itself; else forces are applied before each step."""
        step, c = self.p.stepSimulation, self.client
        watched = self.touching is not None and self.touching.on
        if not self.in_loop and not watched:
            for _ in range(steps * self.calls):
                step(c)
            return
        start, h = self.time, self.dt / self.calls
        for k in range(steps * self.calls):
            self._apply_forces(start + k * h)
            step(c)
            if watched:
                self.solid.read(h)

    def _apply_forces(self, t):
        p, c = self.p, self.client
        for number, link, joint in self.sprung:
            angle, rate, *_ = p.getJointState(number, link, c)
            pull = -joint.stiffness * angle - joint.damping * rate
            p.setJointMotorControl2(number, link, p.TORQUE_CONTROL, force=pull, physicsClientId=c)
        if not self.forces.any():
            return
        start = self.bodies
        x, q = start.position.tolist(), start.orientation.tolist()
        v, ω = start.velocity.tolist(), start.angular_velocity.tolist()
        for i, body in zip(self.moving, self.read(), strict=True):
            x[i], q[i], v[i], ω[i] = body
        force, torque = self.forces(t, x, q, v, ω)
        for i, (number, link, _) in self.places.items():
            p.applyExternalForce(number, link, force[i], x[i], p.WORLD_FRAME, c)
            if any(torque[i]):
                p.applyExternalTorque(number, link, torque[i], p.WORLD_FRAME, c)

    def read(self):
        """Position, quaternion (w, x, y, z), velocity and angular velocity of each moving body."""
        p, c, links, found = self.p, self.client, {}, []
        for number in {place.number for place in self.places.values() if place.link >= 0}:
            links[number] = p.getLinkStates(number, range(p.getNumJoints(number, c)), 1, 1, c)
        for i in self.moving:
            number, link, axes = self.places[i]
            if link < 0:
                place, (x, y, z, w) = p.getBasePositionAndOrientation(number, c)
                velocity, spin = p.getBaseVelocity(number, c)
            else:
                place, (x, y, z, w), *_, velocity, spin = links[number][link]
            found.append((place, _multiply((w, x, y, z), _conjugate(axes)), velocity, spin))
        return found

    def close(self):
        """Disconnect the client; once is enough, and garbage collection does it too."""
        self._disconnect()


def _disconnect(pybullet, client):
    if pybullet.isConnected(client):
        pybullet.disconnect(client)


PYBULLET = Engine(
    "pybullet",
    3,
    {
        "substeps": (1, 1),
        "iterations": (50, 1),
        "residual": (1e-7, Between(0.0, 1.0)),
        "erp": (0.2, Between(0.0, 1.0)),
        "contact_erp": (0.2, Between(0.0, 1.0)),
        "friction_erp": (0.2, Between(0.0, 1.0)),
        "warm_start": (0.85, Between(0.0, 1.0)),
        "rest_speed": (0.2, Between(0.0, 1e3)),
        "body": ("multibody", ("multibody", "rigid")),
    },
    "python -m pip install pybullet==3.2.7, which has wheels for Linux x86-64 with Python up to 3.11",
    PybulletPeer,
)
