"""Contact in pybullet 3.2.7: what each shape becomes, and what pybullet's contacts do.

    Sphere GEOM_SPHERE     Box GEOM_BOX     Capsule GEOM_CAPSULE     Plane GEOM_PLANE

**The law.** A contact is solved for velocities, one row after the other, ``iterations`` times or until a
sweep changes less than ``residual``, started from ``warm_start`` times the impulses of the step before
(S16, S17). Friction has two tangents. A pair's friction and restitution are the products of what its bodies
have, and there is no other word for a pair: where that can't be this course's law (see ``touching``) the
scene is refused. Approach slower than ``rest_speed`` m/s does not bounce.

**Overlap** is pushed out by the share ``contact_erp`` a step (S13); a small share calms stacks: the forces in
ten boxes are right to 6e-11 with .05, at 1 kHz, and to 4e-5 with .2. Margins are set to 0; a hull has 1 mm.

**Contacts are read** after each step, with forces: an impulse is that times h. With numSubSteps = k the force
reads 1/k of what it is and is that of the last substep only; so where something can touch, each substep is a
call of its own. Two bodies that are near each other without touching are reported too, with a force of 0:
they are left out. ``contactNormalOnB`` points from B to A; the sum of normal and lateral forces acts on A.

**Bodies** that touch have one shape each and no joint in a tree: with joints, take ``body="rigid"``.

Slides S10–S13, S17, S18; lectures/05_contact.md.
"""

from ..inertia import principal_axes
from ..rotation import conjugate, over_arrays
from ..scene import Unsupported
from ..shapes import Box, Capsule, Plane, Sphere
from .pybullet_tree import xyzw
from .touching import apart_pairs, factors, friction_of, outward, restitution_of, solid_numbers


class Solid:
    """Shapes, laws and contacts of a scene in a pybullet client.

    ``shape(i)`` is made before the body, ``settle`` is called once all bodies are there. Raises Unsupported
    for a law of a pair that products can't say.
    """

    def __init__(self, p, client, scene, touching):
        self.p, self.client, self.scene, self.touching = p, client, scene, touching
        self.number_of = {}  # pybullet's number → the scene's
        self.numbers = solid_numbers(scene)
        self.laws = [
            _products(scene, name, law)
            for name, law in (("friction", friction_of), ("restitution", restitution_of))
        ]

    def shape(self, i):
        """A collision shape for body i, in the frame of its principal axes; −1 for a Point."""
        if i not in self.numbers:
            return -1
        p, body = self.p, self.scene.bodies[i]
        shape = body.shape
        kinds = {
            Sphere: lambda: (p.GEOM_SPHERE, {"radius": shape.radius}),
            Box: lambda: (p.GEOM_BOX, {"halfExtents": list(shape.half_extents)}),
            Capsule: lambda: (p.GEOM_CAPSULE, {"radius": shape.radius, "height": 2 * shape.half_length}),
            Plane: lambda: (p.GEOM_PLANE, {"planeNormal": outward(body).tolist()}),
        }
        kind, sizes = kinds[type(shape)]()
        if not body.static:
            _, axes = principal_axes(body.inertia)
            if abs(axes[0]) < 1:  # a turned shape is one more level for the engine
                sizes["collisionFrameOrientation"] = xyzw(over_arrays(conjugate)(axes))
        return p.createCollisionShape(kind, physicsClientId=self.client, **sizes)

    def add_static(self, rigid):
        """The static bodies that something can touch."""
        for i in self.numbers:
            body = self.scene.bodies[i]
            if body.static:
                turned = [0, 0, 0, 1] if isinstance(body.shape, Plane) else xyzw(body.orientation)
                number = self.p.createMultiBody(
                    0,
                    self.shape(i),
                    basePosition=body.position.tolist(),
                    baseOrientation=turned,
                    useMaximalCoordinates=rigid,
                    physicsClientId=self.client,
                )
                self.number_of[number] = i

    def settle(self, places):
        """The laws of all bodies, and which pairs don't meet. places: number → Place of what moves."""
        p, c = self.p, self.client
        self.number_of.update({place.number: i for i, place in places.items()})
        in_engine = {i: number for number, i in self.number_of.items()}
        friction, restitution = self.laws
        for i in self.numbers:
            p.changeDynamics(
                in_engine[i],
                -1,
                lateralFriction=friction[i],
                restitution=restitution[i],
                rollingFriction=0,
                spinningFriction=0,
                collisionMargin=0,
                physicsClientId=c,
            )
        for i, j in apart_pairs(self.scene):
            p.setCollisionFilterPair(in_engine[i], in_engine[j], -1, -1, 0, c)

    def read(self, h):
        """The contacts of the step of h just taken, into ``touching``."""
        for one in self.p.getContactPoints(physicsClientId=self.client):
            _, a, b, _, _, on_a, on_b, n, distance, force, f1, t1, f2, t2 = one
            if force or f1 or f2 or distance <= 0:
                pull = [-h * (force * n[k] + f1 * t1[k] + f2 * t2[k]) for k in range(3)]  # on B
                middle = [0.5 * (on_a[k] + on_b[k]) for k in range(3)]
                i, j = self.number_of[a], self.number_of[b]
                self.touching.add(i, j, middle, [-value for value in n], -distance, pull)
        self.touching.next_step()


def _products(scene, name, law):
    """A factor for each body, or Unsupported where they can't be."""
    values, off = factors(scene, [getattr(body, name) for body in scene.bodies], law)
    if off:
        i, j = off[0]
        raise Unsupported(
            f"pybullet multiplies the {name} of two bodies, and that can't make {law(scene, i, j):g} between "
            f"bodies {i} and {j} beside what the other pairs have: choose values whose products do"
        )
    return values
