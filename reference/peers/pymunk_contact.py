"""Contact in pymunk 7.3.1: what each shape becomes, and what pymunk's contacts do.

    Disc   Circle                     Capsule  Segment with a radius
    Box    Poly of four corners       Plane    a static Segment, 2 REACH long and WALL thick,
    Polygon  Poly                              whose side is the plane

**The law.** A contact is solved for velocities, one row after the other, ``iterations`` times, started from
the impulses of the step before (S16, S17): λ_n ≥ 0, and |λ_t| ≤ μ λ_n with the λ_n of that sweep. A pair's
friction and elasticity are the products of what its shapes have; where that can't be this course's law (see
``touching``) a handler sets them anew at each step, which costs a call of Python. The bounce is e times the
approach speed of that step; there is no limit below which it stops.

**Overlap** is pushed out by a second set of velocities, which is forgotten after the step (split impulse,
S13): of what is deeper than ``slop`` m, the share 1 − collision_bias^h a step. So resting bodies sink in by
``slop``, .1 by default, since pymunk thinks in pixels: in metres it should be set.

**Contacts are read** where pymunk has just solved them (post_solve): a total impulse for each pair is public;
that of each point is an accumulator in its arbiter, normal and tangential, and they add up to it. That costs
a call of Python for each pair, so it is done only while a trajectory is recorded.

Slides S10–S13, S17, S18; lectures/05_contact.md.
"""

import math

import numpy as np

from ..shapes import Box, Capsule, Disc, Plane
from .touching import apart_pairs, factors, friction_of, outward, restitution_of, solid_numbers

REACH, WALL = 1e3, 2.0  # m: half the length of what a Plane becomes, and its thickness


class Toucher:
    """Gives the bodies of a scene their shapes in a ``pymunk.Space``, and reads its contacts into a
    ``Touching``.

    in_engine: number → ``pymunk.Body`` of what moves. A shape's collision type is its body's number.
    """

    def __init__(self, pymunk, scene, space, in_engine, touching):
        self.pymunk, self.scene, self.space, self.touching = pymunk, scene, space, touching
        bodies = scene.bodies
        friction, off_friction = factors(scene, [b.friction for b in bodies], friction_of)
        elasticity, off_elasticity = factors(scene, [b.restitution for b in bodies], restitution_of)
        for i in solid_numbers(scene):
            shape = self._shape(bodies[i], in_engine.get(i))
            shape.collision_type, shape.friction, shape.elasticity = i, friction[i], elasticity[i]
            space.add(shape)
        for i, j in sorted({*off_friction, *off_elasticity}):
            law = friction_of(scene, i, j), restitution_of(scene, i, j)
            space.on_collision(i, j, pre_solve=_set_law, data=law)
        for i, j in apart_pairs(scene):
            space.on_collision(i, j, begin=_let_through)

    def watch(self):
        """From now on contacts are read."""
        self.touching.on = True
        self.space.on_collision(None, None, post_solve=self._read)

    def _shape(self, body, inside):
        """A shape on its body of pymunk, or at its place in the world on the static one."""
        pymunk, shape, owner = self.pymunk, body.shape, inside or self.space.static_body
        if isinstance(shape, Plane):
            n = outward(body)
            middle, along = body.position - 0.5 * WALL * n, REACH * np.array([-n[1], n[0]])
            ends = [tuple(end.tolist()) for end in (middle - along, middle + along)]
            return pymunk.Segment(owner, *ends, 0.5 * WALL)
        if isinstance(shape, Disc):
            return pymunk.Circle(owner, shape.radius, self._placed(body, inside, [(0.0, 0.0)])[0])
        if isinstance(shape, Capsule):
            half = shape.half_length
            ends = self._placed(body, inside, [(0.0, -half), (0.0, half)])
            return pymunk.Segment(owner, *ends, shape.radius)
        if isinstance(shape, Box):
            corners = np.array(shape.half_extents) * [(-1, -1), (1, -1), (1, 1), (-1, 1)]
        else:
            corners = shape.vertices
        return pymunk.Poly(owner, self._placed(body, inside, corners))

    def _placed(self, body, inside, points):
        """Points of a body's frame, in that frame where it moves, else in the world."""
        points = np.asarray(points, dtype=float)
        if inside is None:
            c, s = math.cos(body.orientation), math.sin(body.orientation)
            points = body.position + points @ np.array([(c, s), (-s, c)])
        return [tuple(point) for point in points.tolist()]

    def _read(self, arbiter, space, data):
        first, second = (shape.collision_type for shape in arbiter.shapes)
        found, (nx, ny) = arbiter.contact_point_set, arbiter.normal
        for point, made in zip(found.points, _accumulated(arbiter), strict=True):
            along, across = made
            push = nx * along - ny * across, ny * along + nx * across
            middle = 0.5 * (point.point_a + point.point_b)
            self.touching.add(first, second, middle, (nx, ny), -point.distance, push)


def _accumulated(arbiter):
    """(normal, tangential) impulse of each contact point, N s; pymunk's public word has only their sum."""
    inner = arbiter._arbiter
    return [(inner.contacts[k].jnAcc, inner.contacts[k].jtAcc) for k in range(inner.count)]


def _set_law(arbiter, space, law):
    arbiter.friction, arbiter.restitution = law


def _let_through(arbiter, space, data):
    arbiter.process_collision = False
