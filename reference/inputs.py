"""What a user may hand in: each check names the argument, the value it got and what would be right.

Every public function that takes numbers from a user reads them through one of these, so that a mistake is met
where it is made, and not as a NaN ten thousand steps later. Used by all units;
lectures/02_equation_of_motion.md, slide S4.
"""

import math

import numpy as np


def number(name, value, *, least=None, above=None, finite=True):
    """A float. ``least``: the smallest value allowed; ``above``: a bound it must exceed.

    Raises ValueError or TypeError, which name the argument.
    """
    try:
        result = float(_numeric(value))
    except (TypeError, ValueError):
        raise TypeError(f"{name} must be a number, but is {value!r}") from None
    wanted = "a finite number" if finite else "a number"
    if least is not None:
        wanted += f" of at least {least:g}"
    if above is not None:
        wanted += f" greater than {above:g}"
    if math.isnan(result) or (finite and math.isinf(result)):
        raise ValueError(f"{name} must be {wanted}, but is {value!r}")
    if (least is not None and result < least) or (above is not None and result <= above):
        raise ValueError(f"{name} must be {wanted}, but is {value!r}")
    return result


def _numeric(value):
    """``value`` itself; TypeError for what Python would turn into a number, though nobody means one: text,
    True and False.
    """
    if np.asarray(value).dtype.kind in "bSU":
        raise TypeError
    return value


def flag(name, value):
    """True or False; TypeError for anything else, such as "no", which Python takes for true."""
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name} must be True or False, but is {value!r}")
    return bool(value)


def whole(name, value, *, least=0):
    """An int of at least ``least``. Raises ValueError or TypeError, which name the argument."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)):
        raise TypeError(f"{name} must be a whole number, but is {value!r}")
    if value < least:
        raise ValueError(f"{name} must be a whole number of at least {least}, but is {value!r}")
    return int(value)


def array(name, value, shape):
    """A new float array of the given shape, all finite. Raises ValueError or TypeError, which name the
    argument.
    """
    try:
        result = np.array(_numeric(value), dtype=float)
    except (TypeError, ValueError):
        raise TypeError(f"{name} must be an array of numbers of shape {shape}, but is {value!r}") from None
    if result.shape != tuple(shape):
        raise ValueError(f"{name} must have shape {tuple(shape)}, but is {value!r}, of shape {result.shape}")
    if not np.isfinite(result).all():
        raise ValueError(f"{name} must hold finite numbers only, but is {value!r}")
    return result


def direction(name, value, size):
    """A unit vector (size,) along ``value``, which may have any length but 0."""
    vector = array(name, value, (size,))
    length = np.linalg.norm(vector)
    if length == 0:
        raise ValueError(f"{name} must be a direction, but is the zero vector {value!r}")
    return vector / length


def unit_quaternion(name, value):
    """A quaternion (w, x, y, z) of norm 1; what is off by less than 1e-6 is normalised, anything else
    refused.
    """
    q = array(name, value, (4,))
    norm = np.linalg.norm(q)
    if norm == 0:
        raise ValueError(
            f"{name} must be a unit quaternion (w, x, y, z), but is zero: no rotation at all is (1, 0, 0, 0)"
        )
    if abs(norm - 1) > 1e-6:
        right = ", ".join(f"{c:.9g}" for c in q / norm)
        raise ValueError(
            f"{name} must be a unit quaternion (w, x, y, z), but {value!r} has norm {norm:.6g}: "
            f"give ({right})"
        )
    return q / norm


def choice(name, value, choices):
    """One of the names in ``choices``, or a ValueError that lists them."""
    if value not in list(choices):  # a list, so that what can't be hashed is met too
        raise ValueError(f"{name} must be one of {', '.join(sorted(choices))}, but is {value!r}")
    return value
