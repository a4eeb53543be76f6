"""Joints in pybullet as constraints between bodies: all of a scene's with ``body="rigid"``, and those that
close a loop of a tree (``pybullet_tree``) with ``body="multibody"``.

Constraints are solved for velocities, row by row (S16), in ``iterations`` sweeps; the share ``erp`` of a gap
is closed in each step.

    BallJoint   JOINT_POINT2POINT
    Hinge       two of them, on the axis: six rows for five, so how they share the force along it is open
    Fixed       JOINT_FIXED
    Slider      JOINT_PRISMATIC: between multibodies only

There is no Universal and no Distance; constraints have no springs, motors or limits. Those raise Unsupported.

**Traps.** Between multibodies a constraint gives way at a force of 500 N unless told otherwise: lifted here.
Between rigid bodies one to the world fails: the world is a body of no mass here. Points are given in each
body's frame of principal axes, from its centre of mass.

Slides S5, S9, S16; lectures/04_embedding.md.
"""

import numpy as np

from ..joints import BallJoint, Fixed, Hinge, Slider
from ..rotation import conjugate, multiply, over_arrays, rotate
from ..scene import Unsupported
from .pybullet_tree import BOUNDLESS, xyzw

ARM = 0.5  # m: from a hinge's point to each of the two points on its axis


class Constrainer:
    """Adds constraints for joints: ``add(joint)``.

    p: the package; client: its number; scene: the Scene; places: body's number → Place; rigid: the form of
    the bodies.
    """

    def __init__(self, p, client, scene, places, rigid):
        self.p, self.client, self.scene, self.places, self.rigid = p, client, scene, places, rigid
        self.world = None

    def add(self, joint):
        """The constraints of a joint. Raises Unsupported for what pybullet has no word for."""
        p, kind, form = self.p, type(joint), "rigid bodies" if self.rigid else "multibodies"
        if joint.soft or joint.limits is not None or joint.motor is not None:
            raise Unsupported(
                f"pybullet's constraints have no springs, motors or limits, as this {kind.__name__} should: "
                "only joints of a multibody's tree have, body='multibody'"
            )
        if kind is BallJoint:
            self._constrain(p.JOINT_POINT2POINT, joint.ends, joint.point)
        elif kind is Hinge:
            for side in (-ARM, ARM):
                self._constrain(p.JOINT_POINT2POINT, joint.ends, joint.point + side * joint.axis)
        elif kind is Fixed:
            self._constrain(p.JOINT_FIXED, joint.ends, self._place_of(joint))
        elif kind is Slider and not self.rigid:
            self._constrain(p.JOINT_PRISMATIC, joint.ends, self._place_of(joint), joint.axis)
        else:
            raise Unsupported(f"pybullet has no {kind.__name__} between {form}")

    def _place_of(self, joint):
        return self.scene.bodies[joint.ends[1]].position

    def _constrain(self, kind, ends, point, axis=(0.0, 0.0, 1.0)):
        """A constraint at a point, the frames of both its sides parallel to the world's."""
        (i, j), p = ends, self.p
        if i not in self.places:  # pybullet wants a body that moves first
            i, j = j, i
            axis = -np.asarray(axis)
        (number, link, point_i, turn_i), (other, link_j, point_j, turn_j) = (
            self._side(i, point),
            self._side(j, point),
        )
        made = p.createConstraint(
            number,
            link,
            other,
            link_j,
            kind,
            tuple(np.asarray(axis).tolist()),
            point_i,
            point_j,
            turn_i,
            turn_j,
            physicsClientId=self.client,
        )
        if not self.rigid:
            p.changeConstraint(made, maxForce=BOUNDLESS, physicsClientId=self.client)

    def _side(self, i, point):
        """Number, link, point and quaternion (x, y, z, w) in the frame of the body, or of the world."""
        if i not in self.places:
            return self._world(), -1, tuple(point.tolist()), (0.0, 0.0, 0.0, 1.0)
        body, place = self.scene.bodies[i], self.places[i]
        q = over_arrays(multiply)(body.orientation, np.array(place.axes))
        back = over_arrays(conjugate)(q)
        local = over_arrays(rotate)(back, point - body.position)
        return place.number, place.link, tuple(local.tolist()), xyzw(back)

    def _world(self):
        if not self.rigid:
            return -1
        if self.world is None:
            self.world = self.p.createMultiBody(
                baseMass=0, useMaximalCoordinates=True, physicsClientId=self.client
            )
        return self.world
