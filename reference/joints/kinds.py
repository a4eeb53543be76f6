"""The kinds of joint: each a list of rows, and the row of its coordinate.

Every kind fills in the same methods, which ``Joint`` describes: geometry, turns, rows, free_row.

Slides S5, S6; lectures/03_jacobian.md.
"""

from dataclasses import dataclass

import numpy as np

from .. import inputs
from ..shapes import Point
from .joint import Joint
from .row import ANGULAR, DISTANCE, LINEAR, TURN, Row, frame, linear_rows, parallel_rows, same_orientation


@dataclass(frozen=True, eq=False, kw_only=True)
class BallJoint(Joint):
    """The two bodies keep a point in common and turn freely about it: 3 rows.

    point (3,): in world coordinates at the start.
    """

    point: np.ndarray

    def geometry(self, bodies, d):
        """point, checked."""
        return {"point": inputs.array("point", self.point, (3,))}

    def turns(self, d):
        """No: all turning is free."""
        return False

    def rows(self, bodies):
        """Three LINEAR rows, along the world's axes at the start, which then turn with i."""
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
        """point and axis, checked; limits too, since in space the angle is known from −π to π only."""
        if d == 2 and self.axis is not None:
            raise ValueError(f"axis must be left out in the plane, but is {self.axis!r}")
        if d == 3 and self.axis is None:
            raise ValueError(
                "axis must be given in space, the direction about which the hinge turns, but is None"
            )
        axis = None if d == 2 else inputs.direction("axis", self.axis, 3)
        if d == 3 and self.limits and any(np.pi < abs(limit) < np.inf for limit in self.limits):
            raise ValueError(f"limits of a Hinge in space must be from −π to π, but are {self.limits!r}")
        return {"point": inputs.array("point", self.point, (d,)), "axis": axis}

    def turns(self, d):
        """In space, and where its angle has a spring, a motor or limits."""
        return d == 3 or self.soft or self.limits is not None or self.motor is not None

    def rows(self, bodies):
        """LINEAR rows for the point; in space two ANGULAR rows for the axis."""
        if self.axis is None:
            return linear_rows(np.eye(2), self.point, self.point)
        e1, e2, e3 = frame(self.axis)
        return [*linear_rows((e1, e2, e3), self.point, self.point), *parallel_rows(e1, e2, e3)]

    def free_row(self, bodies):
        """The TURN about the axis."""
        if self.axis is None:
            return Row(TURN)
        e1, e2, _ = frame(self.axis)
        return Row(TURN, e=e1, e2=e2, c=e1)


@dataclass(frozen=True, eq=False, kw_only=True)
class Slider(Joint):
    """Body j moves along an axis of i, and does not turn against it: 5 rows, in the plane 2.

    axis (d,), of any length: world coordinates at the start. Coordinate: the displacement along it, 0 at the
    start. Its point is j's centre of mass. A Point as j, a bead on a wire, needs no rows that keep an
    orientation: 2 rows, in the plane 1.
    """

    dimensions = (2, 3)
    coordinate = "displacement"
    carries_points = True
    axis: np.ndarray

    def geometry(self, bodies, d):
        """axis, checked."""
        return {"axis": inputs.direction("axis", self.axis, d)}

    def rows(self, bodies):
        """LINEAR rows across the axis, and rows that keep the orientation."""
        j, e = bodies[self.ends[1]], frame(self.axis)
        return [*linear_rows(e[:-1], j.position, j.position), *turning_rows(j, e)]

    def free_row(self, bodies):
        """The LINEAR row along the axis."""
        p = bodies[self.ends[1]].position
        return Row(LINEAR, p, p, frame(self.axis)[-1])


@dataclass(frozen=True, eq=False, kw_only=True)
class Fixed(Joint):
    """The two bodies move as one: 6 rows, in the plane 3. Its point is j's centre of mass.

    A Point as j needs no rows that keep an orientation: 3 rows, in the plane 2.
    """

    dimensions = (2, 3)
    carries_points = True

    def rows(self, bodies):
        """LINEAR rows along the world's axes at the start, and rows that keep the orientation."""
        j = bodies[self.ends[1]]
        e = np.eye(len(j.position))
        return [*linear_rows(e, j.position, j.position), *turning_rows(j, e)]


@dataclass(frozen=True, eq=False, kw_only=True)
class Universal(Joint):
    """A common point, and an axis of a that stays at right angles to one of b (Cardan's joint): 4 rows.

    point, axis_a, axis_b (3,): world coordinates at the start; the axes at right angles, of any length.
    """

    point: np.ndarray
    axis_a: np.ndarray
    axis_b: np.ndarray

    def geometry(self, bodies, d):
        """point and axes, checked."""
        axis_a, axis_b = (inputs.direction(n, getattr(self, n), d) for n in ("axis_a", "axis_b"))
        if abs(axis_a @ axis_b) > 1e-9:
            raise ValueError(
                f"axis_b must be at right angles to axis_a, but {self.axis_a!r} · {self.axis_b!r} is not 0: "
                f"their directions have {axis_a @ axis_b:.3g}"
            )
        return {"point": inputs.array("point", self.point, (d,)), "axis_a": axis_a, "axis_b": axis_b}

    def rows(self, bodies):
        """Three LINEAR rows, and an ANGULAR one between the two axes."""
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
        """point_a, point_b and length, checked and filled in."""
        if self.b is None and self.point_b is None:
            raise ValueError("point_b must be given where b is None, the world, but is None")
        points = {}
        for name, i in (("point_a", self.a), ("point_b", self.b)):
            given = getattr(self, name)
            points[name] = bodies[i].position.copy() if given is None else inputs.array(name, given, (d,))
            self.check_end(bodies, i, points[name])
        apart = float(np.linalg.norm(points["point_b"] - points["point_a"]))
        if apart == 0:
            raise ValueError(
                "point_b must be another point than point_a, since a Distance needs a direction, "
                f"but both are {points['point_a'].tolist()}"
            )
        length = apart if self.length is None else inputs.number("length", self.length, above=0)
        if self.limits and self.limits[1] <= 0:
            raise ValueError(f"limits of a Distance must reach above 0, but are {self.limits!r}")
        return {**points, "length": length}

    def turns(self, d):
        """No: it pulls at points."""
        return False

    @property
    def points(self):
        """The points on i and on j."""
        return (self.point_b, self.point_a) if self.b is None else (self.point_a, self.point_b)

    def rows(self, bodies):
        """The DISTANCE row of a rod; none where a spring, a motor or limits take its place."""
        rod = not self.soft and self.limits is None and self.motor is None
        return [self.free_row(bodies)] if rod else []

    def free_row(self, bodies):
        """The DISTANCE row."""
        return Row(DISTANCE, *self.points, length=self.length)


def turning_rows(j, e):
    """Rows that keep body j's orientation against i; none for a Point that moves: it has no orientation."""
    return [] if isinstance(j.shape, Point) and not j.static else same_orientation(e)
