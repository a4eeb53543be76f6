"""The kinds of joint: each a list of rows.

Slides S5, S6; lectures/03_jacobian.md.
"""

from dataclasses import dataclass

import numpy as np

from .. import inputs
from .joint import Joint
from .row import ANGULAR, DISTANCE, LINEAR, TURN, Row, frame, linear_rows, parallel_rows, same_orientation


@dataclass(frozen=True, eq=False, kw_only=True)
class BallJoint(Joint):
    """The two bodies keep a point in common and turn freely about it: 3 rows.

    point (3,): in world coordinates at the start.
    """

    point: np.ndarray

    def geometry(self, bodies, d):
        return {"point": inputs.array("point", self.point, (3,))}

    def turns(self, d):
        return False

    def rows(self, bodies):
        return linear_rows(np.eye(3), self.point, self.point)


@dataclass(frozen=True, eq=False, kw_only=True)
class Hinge(Joint):
    """The two bodies keep a point and an axis in common: 5 rows, in the plane 2, where it has no axis.

    point (d,), axis (3,), of any length: world coordinates at the start. Coordinate: the angle of j seen from
    i about the axis, 0 at the start, in space from −π to π.
    """

    dimensions = (2, 3)
    coordinate = "angle"
    point: np.ndarray
    axis: np.ndarray = None

    def geometry(self, bodies, d):
        if d == 2 and self.axis is not None:
            raise ValueError(f"axis must be left out in the plane, but is {self.axis!r}")
        if d == 3 and self.axis is None:
            raise ValueError(
                "axis must be given in space, the direction about which the hinge turns, but is None"
            )
        axis = None if d == 2 else inputs.direction("axis", self.axis, 3)
        return {"point": inputs.array("point", self.point, (d,)), "axis": axis}

    def turns(self, d):
        return d == 3 or self.soft or self.limits is not None or self.motor is not None

    def rows(self, bodies):
        if self.axis is None:
            return linear_rows(np.eye(2), self.point, self.point)
        e1, e2, e3 = frame(self.axis)
        return [*linear_rows((e1, e2, e3), self.point, self.point), *parallel_rows(e1, e2, e3)]

    def free_row(self, bodies):
        if self.axis is None:
            return Row(TURN)
        e1, e2, _ = frame(self.axis)
        return Row(TURN, e=e1, e2=e2, c=e1)


@dataclass(frozen=True, eq=False, kw_only=True)
class Slider(Joint):
    """Body j moves along an axis of i, and does not turn against it: 5 rows, in the plane 2.

    axis (d,), of any length: world coordinates at the start. Coordinate: the displacement along it, 0 at the
    start. Its point is j's centre of mass.
    """

    dimensions = (2, 3)
    coordinate = "displacement"
    axis: np.ndarray

    def geometry(self, bodies, d):
        return {"axis": inputs.direction("axis", self.axis, d)}

    def rows(self, bodies):
        p, e = bodies[self.ends[1]].position, frame(self.axis)
        return [*linear_rows(e[:-1], p, p), *same_orientation(e)]

    def free_row(self, bodies):
        p = bodies[self.ends[1]].position
        return Row(LINEAR, p, p, frame(self.axis)[-1])


@dataclass(frozen=True, eq=False, kw_only=True)
class Fixed(Joint):
    """The two bodies move as one: 6 rows, in the plane 3. Its point is j's centre of mass."""

    dimensions = (2, 3)

    def rows(self, bodies):
        p = bodies[self.ends[1]].position
        e = np.eye(len(p))
        return [*linear_rows(e, p, p), *same_orientation(e)]


@dataclass(frozen=True, eq=False, kw_only=True)
class Universal(Joint):
    """A common point, and an axis of a that stays at right angles to one of b (Cardan's joint): 4 rows.

    point, axis_a, axis_b (3,): world coordinates at the start; the axes at right angles, of any length.
    """

    point: np.ndarray
    axis_a: np.ndarray
    axis_b: np.ndarray

    def geometry(self, bodies, d):
        axis_a, axis_b = (inputs.direction(n, getattr(self, n), d) for n in ("axis_a", "axis_b"))
        if abs(axis_a @ axis_b) > 1e-9:
            raise ValueError(
                f"axis_b must be at right angles to axis_a, but {self.axis_a!r} · {self.axis_b!r} is not 0: "
                f"their directions have {axis_a @ axis_b:.3g}"
            )
        return {"point": inputs.array("point", self.point, (d,)), "axis_a": axis_a, "axis_b": axis_b}

    def rows(self, bodies):
        on_i, on_j = (self.axis_b, self.axis_a) if self.b is None else (self.axis_a, self.axis_b)
        return [*linear_rows(np.eye(3), self.point, self.point), Row(ANGULAR, e=on_i, c=on_j)]


@dataclass(frozen=True, eq=False, kw_only=True)
class Distance(Joint):
    """Two points keep their distance, as on a massless rod: 1 row.

    point_a, point_b (d,): world coordinates at the start; None: the centres of mass. length: m; None: the
    distance at the start. Coordinate: the distance itself; with a spring, a motor or limits there is no rod.
    """

    dimensions = (2, 3)
    coordinate = "length"
    point_a: np.ndarray = None
    point_b: np.ndarray = None
    length: float = None

    def geometry(self, bodies, d):
        if self.b is None and self.point_b is None:
            raise ValueError("point_b must be given where b is None, the world, but is None")
        points = {}
        for name, i in (("point_a", self.a), ("point_b", self.b)):
            given = getattr(self, name)
            points[name] = bodies[i].position.copy() if given is None else inputs.array(name, given, (d,))
            self._check_turning("Distance", bodies, points[name], (i,))
        apart = float(np.linalg.norm(points["point_b"] - points["point_a"]))
        if apart == 0:
            raise ValueError(
                "point_b must be another point than point_a, since a Distance needs a direction, "
                f"but both are {points['point_a'].tolist()}"
            )
        length = apart if self.length is None else inputs.number("length", self.length, above=0)
        return {**points, "length": length}

    def turns(self, d):
        return False

    @property
    def points(self):
        """The points on i and on j."""
        return (self.point_b, self.point_a) if self.b is None else (self.point_a, self.point_b)

    def rows(self, bodies):
        rod = not self.soft and self.limits is None and self.motor is None
        return [self.free_row(bodies)] if rod else []

    def free_row(self, bodies):
        return Row(DISTANCE, *self.points, length=self.length)
