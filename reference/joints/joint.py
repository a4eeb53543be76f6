"""What all joints have in common: whom they join, and the spring, motor and limits of their coordinate.

Slides S5, S6; lectures/03_jacobian.md.
"""

from dataclasses import dataclass, field, replace

import numpy as np

from .. import inputs
from ..shapes import Point


@dataclass(frozen=True, eq=False, kw_only=True)
class Joint:
    """A joint between the bodies a and b, or between a and the world where b is None.

    a: a body's number; b: another body's, or None. limits: (low, high) of the coordinate, rad or m.
    motor: (speed, max_force), rad/s and N m or m/s and N; max_force may be inf. stiffness, damping: of a
    spring and damper along the coordinate, from where it stands at the start (a Distance: from its length),
    N m/rad and N m s or N/m and N s/m. collide: whether the two bodies can collide.
    """

    dimensions = (3,)
    coordinate = None  # its name; None: the joint has none
    carries_points = False  # whether j may be a Point, though the joint turns what can turn

    a: int = field(kw_only=False)
    b: int | None = field(default=None, kw_only=False)
    limits: tuple | None = None
    motor: tuple | None = None
    stiffness: float = 0
    damping: float = 0
    collide: bool = False

    @property
    def ends(self):
        """The bodies (i, j); None: the world. i → j is a → b, or the world → a."""
        return (None, self.a) if self.b is None else (self.a, self.b)

    @property
    def soft(self):
        """Whether a spring or damper acts along the coordinate."""
        return self.stiffness > 0 or self.damping > 0

    def checked(self, bodies, d):
        """This joint with its arguments as arrays and numbers, for these bodies in d dimensions.

        Raises ValueError or TypeError, naming the argument.
        """
        if d not in self.dimensions:
            raise ValueError(f"a {type(self).__name__} stands in space only: in the plane, use a Hinge")
        joint = replace(self, **self._checked_law())
        values = joint.geometry(bodies, d)
        for i in self.ends:
            joint.check_end(bodies, i, values.get("point"))
        return replace(joint, **values)

    def geometry(self, bodies, d):
        """The checked points and axes: a dictionary of arrays. Raises ValueError or TypeError."""
        return {}

    def turns(self, d):
        """Whether a row or spring of it turns bodies."""
        return True

    def rows(self, bodies):
        """The rows that must stay 0: a list of ``Row``."""
        raise TypeError("a kind of joint must define rows(bodies)")

    def free_row(self, bodies):
        """The row of the joint's coordinate, or None where it has none. A Distance's is its only one."""
        return None

    def _checked_law(self):
        """limits, motor, stiffness and damping, checked; only a joint with a coordinate can have them."""
        law = {name: inputs.number(name, getattr(self, name), least=0) for name in ("stiffness", "damping")}
        law |= {"limits": checked_limits(self.limits), "motor": checked_motor(self.motor)}
        for name, value in law.items():
            if self.coordinate is None and value not in (0, None):
                raise ValueError(
                    f"{name} must be left out for a {type(self).__name__}, which has no coordinate, "
                    f"but is {value!r}"
                )
        return law

    def check_end(self, bodies, i, point=None):
        """Raises ValueError where body i, a Point, is asked to turn, or to be joined elsewhere than it is."""
        if i is None or bodies[i].static or not isinstance(bodies[i].shape, Point):
            return
        if self.turns(len(bodies[i].position)) and not (self.carries_points and i == self.ends[1]):
            instead = "let it be b, or the only body" if self.carries_points else "use a Distance"
            raise ValueError(
                f"a {type(self).__name__} needs bodies that rotate, but body {i} is a Point: {instead}"
            )
        if point is not None and not np.array_equal(point, bodies[i].position):
            raise ValueError(
                f"point must be body {i}'s position {bodies[i].position.tolist()}, since it is a Point, "
                f"but is {point.tolist()}"
            )


def checked_limits(limits):
    """(low, high) with low ≤ high, each finite or not; None stays None. Raises ValueError or TypeError."""
    if limits is None:
        return None
    try:
        low, high = limits
    except (TypeError, ValueError):
        raise TypeError(f"limits must be (low, high), but is {limits!r}") from None
    low, high = (inputs.number("limits", value, finite=False) for value in (low, high))
    if low > high:
        raise ValueError(f"limits must be (low, high) with low ≤ high, but is {limits!r}")
    return low, high


def checked_motor(motor):
    """(speed, max_force) with max_force ≥ 0 or inf; None stays None. Raises ValueError or TypeError."""
    if motor is None:
        return None
    try:
        speed, max_force = motor
    except (TypeError, ValueError):
        raise TypeError(f"motor must be (speed, max_force), but is {motor!r}") from None
    speed = inputs.number("motor's speed", speed)
    return speed, inputs.number("motor's max_force", max_force, least=0, finite=False)
