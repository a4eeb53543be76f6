"""What all joints have in common: whom they join, and the spring, motor and limits of their coordinate.

Slides S5, S6; lectures/03_jacobian.md.
"""

from dataclasses import dataclass, field, replace

import numpy as np

from .. import inputs
from ..shapes import Point


@dataclass(frozen=True, eq=False, kw_only=True)
class Joint:
    """What all joints have in common.

    a: a body's number; b: another body's, or None, the world. limits: (low, high) of the coordinate, rad or
    m. motor: (speed, max_force), rad/s and N m or m/s and N; max_force may be inf. stiffness, damping: of a
    spring and damper along the coordinate, from where it stands at the start (a Distance: from its length),
    N m/rad and N m s or N/m and N s/m. collide: whether the two bodies can collide.
    """

    dimensions = (3,)
    coordinate = None  # its name; None: the joint has none

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
        """This joint with its arguments as arrays, for these bodies in d dimensions.

        Raises ValueError or TypeError, naming the argument.
        """
        kind = type(self).__name__
        if d not in self.dimensions:
            raise ValueError(f"a {kind} stands in space only: in the plane a Hinge does what it does")
        values = self.geometry(bodies, d)
        self._check_turning(kind, bodies, values.get("point"), self.ends)
        for name in ("stiffness", "damping"):
            values[name] = inputs.number(name, getattr(self, name), least=0)
            if values[name] and self.coordinate is None:
                raise ValueError(
                    f"{name} must be 0 for a {kind}, which has no coordinate, but is {values[name]!r}"
                )
        for name in ("limits", "motor"):
            given = getattr(self, name)
            if given is not None and self.coordinate is None:
                raise ValueError(
                    f"{name} must be None for a {kind}, which has no coordinate, but is {given!r}"
                )
        return replace(self, **values, limits=checked_limits(self.limits), motor=checked_motor(self.motor))

    def geometry(self, bodies, d):
        """The checked points and axes: a dictionary of arrays."""
        return {}

    def _check_turning(self, kind, bodies, point, ends):
        for i in ends:
            if i is None or bodies[i].static or not isinstance(bodies[i].shape, Point):
                continue
            if self.turns(len(bodies[i].position)):
                raise ValueError(
                    f"a {kind} needs bodies that rotate, but body {i} is a Point: use a Distance"
                )
            if point is not None and not np.array_equal(point, bodies[i].position):
                raise ValueError(
                    f"point must be body {i}'s position {bodies[i].position.tolist()}, since it is a Point, "
                    f"but is {point.tolist()}"
                )

    def turns(self, d):
        """Whether a row or spring of it turns bodies."""
        return True

    def rows(self, bodies):
        """The rows that must stay 0: a list of ``Row``."""
        raise TypeError("a kind of joint must define rows(bodies)")

    def free_row(self, bodies):
        """The row of the joint's coordinate, or None; a Distance has none that is free."""
        return None


def checked_limits(limits):
    """(low, high), low ≤ 0 ≤ high not asked; None stays None."""
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
    """(speed, max_force); None stays None."""
    if motor is None:
        return None
    try:
        speed, max_force = motor
    except (TypeError, ValueError):
        raise TypeError(f"motor must be (speed, max_force), but is {motor!r}") from None
    return inputs.number("motor's speed", speed), inputs.number(
        "motor's max_force", max_force, least=0, finite=False
    )
