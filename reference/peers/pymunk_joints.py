"""Joints in pymunk 7.3.1: what each becomes, and what pymunk's constraints do.

A constraint of pymunk is solved for velocities, row by row (S16): ``iterations`` sweeps, started from the
impulses of the step before. A gap C left by the motion is closed by the speed

    −(1 − error_bias^h) / h · C,

so error_bias is the share of a gap that is left after one second: 1 never mends it, 0 mends all of it in the
next step. pymunk's own is .9⁶⁰ = .0018. That speed is the bodies' own and stays with them: a limit that a
step has run past throws back. There is no word for the spin that the two bodies' arms have gained
in between, so a joint's positions are right to order h.

    Hinge       PivotJoint                        spring: DampedRotarySpring   motor: SimpleMotor
                                                  limits: RotaryLimitJoint
    Slider      GrooveJoint and GearJoint         spring: DampedSpring along the groove, from far away
                (equal angles)                    limits: the ends of the groove
    Fixed       PivotJoint and GearJoint
    Distance    PinJoint                          spring: DampedSpring   limits: SlideJoint

pymunk has no motor that pushes along a line: a Slider's or a Distance's raises Unsupported. Springs here are
as in ``pymunk_peer``: the spring exact, the damper an exponential. A GrooveJoint always ends somewhere; here
it is REACH long both ways where there are no limits, far off and yet near enough for rounding (1e-13 m).

Signs, found by one step of each: SimpleMotor(a, b, rate) makes ω_a − ω_b = rate; DampedRotarySpring looks at
φ_a − φ_b, RotaryLimitJoint and GearJoint at φ_b − φ_a. The tests repeat it.

Slides S5, S9, S16; lectures/04_embedding.md.
"""

import math

import numpy as np

from ..joints import Distance, Fixed, Hinge, Slider
from ..scene import Unsupported

REACH = 1e3  # m: half the length of a groove without limits


class Joiner:
    """Makes pymunk's constraints for the joints of a scene: ``made(joint)`` is a list of them.

    pymunk: the package; scene: the Scene; in_engine: number → ``pymunk.Body``; world: the static body.
    """

    def __init__(self, pymunk, scene, in_engine, world):
        self.pymunk, self.scene, self.in_engine, self.world = pymunk, scene, in_engine, world
        self.kinds = {Hinge: self._hinge, Slider: self._slider, Fixed: self._fixed, Distance: self._distance}

    def made(self, joint):
        """The constraints of a joint. Raises Unsupported for what pymunk has no word for."""
        if joint.motor is not None and not isinstance(joint, Hinge):
            raise Unsupported(
                f"pymunk has no motor that pushes along a line, as this {type(joint).__name__}'s should: "
                "it can only turn a Hinge"
            )
        pair = [self.in_engine.get(i, self.world) for i in joint.ends]
        return self.kinds[type(joint)](joint, *pair)

    def _hinge(self, joint, i, j):
        made = [self._pivot(i, j, joint.point)]
        start = self._angle(joint)
        if joint.soft:
            made.append(self.pymunk.DampedRotarySpring(i, j, -start, joint.stiffness, joint.damping))
        if joint.limits is not None:
            low, high = joint.limits
            made.append(self.pymunk.RotaryLimitJoint(i, j, start + low, start + high))
        if joint.motor is not None:
            speed, most = joint.motor
            motor = self.pymunk.SimpleMotor(i, j, -speed)
            motor.max_force = most  # N m
            made.append(motor)
        return made

    def _slider(self, joint, i, j):
        place, axis = self.scene.bodies[joint.ends[1]].position, joint.axis
        low, high = joint.limits or (-math.inf, math.inf)
        ends = (_local(i, place + np.clip(s, -REACH, REACH) * axis) for s in (low, high))
        made = [self.pymunk.GrooveJoint(i, j, *ends, _local(j, place)), self._gear(joint, i, j)]
        if joint.soft:
            anchors = _local(i, place - REACH * axis), _local(j, place)
            made.append(self.pymunk.DampedSpring(i, j, *anchors, REACH, joint.stiffness, joint.damping))
        return made

    def _fixed(self, joint, i, j):
        place = self.scene.bodies[joint.ends[1]].position
        return [self._pivot(i, j, place), self._gear(joint, i, j)]

    def _distance(self, joint, i, j):
        ends = i, j, *(_local(body, point) for body, point in zip((i, j), joint.points, strict=True))
        made = []
        if joint.soft:
            made.append(self.pymunk.DampedSpring(*ends, joint.length, joint.stiffness, joint.damping))
        if joint.limits is not None:
            low, high = joint.limits
            made.append(self.pymunk.SlideJoint(*ends, max(low, 0.0), high))
        if not made:
            rod = self.pymunk.PinJoint(*ends)
            rod.distance = joint.length
            made.append(rod)
        return made

    def _pivot(self, i, j, point):
        return self.pymunk.PivotJoint(i, j, _local(i, point), _local(j, point))

    def _gear(self, joint, i, j):
        return self.pymunk.GearJoint(i, j, self._angle(joint), 1.0)

    def _angle(self, joint):
        """The angle of j less that of i in pymunk at the start; what is static has none there."""
        i, j = (0.0 if n not in self.in_engine else self.in_engine[n].angle for n in joint.ends)
        return j - i


def _local(body, point):
    """A point (2,) in world coordinates at the start, in the body's frame, as pymunk wants it."""
    return body.world_to_local(tuple(np.asarray(point).tolist()))
