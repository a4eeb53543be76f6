"""Rotations as unit quaternions, and the matrix that takes ω to q̇.

A quaternion is (w, x, y, z). It takes vectors from the body's frame to the world's: ``r_world = q ⊗ r_body ⊗
q*``.
Angular velocities ω are in the world frame, rad/s, unless the name says otherwise.

The *kernels* work on components: they take tuples or arrays that are indexed along their first axis, and
return tuples. They are what the compiled loops call. ``over_arrays`` turns one into a function of arrays (…,
4) and (…, 3).

Slides S4, S9; lectures/02_equation_of_motion.md. Source: Diebel, Representing Attitude (2006); Hairer, Lubich
& Wanner, Geometric Numerical Integration (2006), section VII.5.
"""

from types import FunctionType

import numpy as np

from .compiled import lean, plain


@lean
def multiply(p, q):
    """The Hamilton product p ⊗ q: first the rotation q, then p."""
    return (
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
        p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
        p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0],
    )


@lean
def conjugate(q):
    """q*, the inverse rotation of a unit quaternion."""
    return q[0], -q[1], -q[2], -q[3]


@lean
def rotate(q, r):
    """q ⊗ r ⊗ q*: the vector r taken from the body's frame to the world's."""
    tx = 2 * (q[2] * r[2] - q[3] * r[1])
    ty = 2 * (q[3] * r[0] - q[1] * r[2])
    tz = 2 * (q[1] * r[1] - q[2] * r[0])
    return (
        r[0] + q[0] * tx + q[2] * tz - q[3] * ty,
        r[1] + q[0] * ty + q[3] * tx - q[1] * tz,
        r[2] + q[0] * tz + q[1] * ty - q[2] * tx,
    )


@lean
def rotate_back(q, r):
    """q* ⊗ r ⊗ q: the vector r taken from the world's frame to the body's."""
    return rotate(conjugate(q), r)


@lean
def vector(a, i):
    """Row i of an array (n, 3) as components."""
    return a[i, 0], a[i, 1], a[i, 2]


@lean
def quaternion(a, i):
    """Row i of an array (n, 4) as components."""
    return a[i, 0], a[i, 1], a[i, 2], a[i, 3]


@lean
def store(a, i, r):
    """Write the components r of a vector into row i of an array (n, 3)."""
    a[i, 0], a[i, 1], a[i, 2] = r


@lean
def store_quaternion(a, i, q):
    """Write the components of q into row i of an array (n, 4)."""
    a[i, 0], a[i, 1], a[i, 2], a[i, 3] = q


@lean
def add(a, i, r):
    """Add the components of a vector to row i of an array (n, 3)."""
    a[i, 0] += r[0]
    a[i, 1] += r[1]
    a[i, 2] += r[2]


@lean
def cross(a, b):
    """The vector product a × b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@lean
def dot(a, b):
    """The scalar product a · b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@lean
def plus(a, b):
    """a + b."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@lean
def minus(a, b):
    """a − b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@lean
def quaternion_rate(q, ω):
    """q̇ = E(q) ω = ½ (0, ω) ⊗ q, for ω in the world frame (S9)."""
    return (
        0.5 * (-q[1] * ω[0] - q[2] * ω[1] - q[3] * ω[2]),
        0.5 * (q[0] * ω[0] + q[3] * ω[1] - q[2] * ω[2]),
        0.5 * (-q[3] * ω[0] + q[0] * ω[1] + q[1] * ω[2]),
        0.5 * (q[2] * ω[0] - q[1] * ω[1] + q[0] * ω[2]),
    )


@lean
def exponential(φ):
    """The quaternion of the rotation vector φ: by |φ| radians about φ. Its norm is 1 to rounding, for
    any φ.
    """
    angle = np.sqrt(φ[0] ** 2 + φ[1] ** 2 + φ[2] ** 2 + 1e-300)  # so that s is ½ at φ = 0, and not 0/0
    s = np.sin(angle / 2) / angle
    return np.cos(angle / 2), s * φ[0], s * φ[1], s * φ[2]


@lean
def cayley(φ):
    """The quaternion of the Cayley map: about φ, by 2 atan(|φ|/2) radians; equals ``exponential`` to
    O(|φ|³).
    """
    w = 1 / np.sqrt(1 + 0.25 * (φ[0] ** 2 + φ[1] ** 2 + φ[2] ** 2))
    return w, 0.5 * w * φ[0], 0.5 * w * φ[1], 0.5 * w * φ[2]


@lean
def normalise(q):
    """q / |q|."""
    scale = 1 / np.sqrt(q[0] ** 2 + q[1] ** 2 + q[2] ** 2 + q[3] ** 2)
    return scale * q[0], scale * q[1], scale * q[2], scale * q[3]


@lean
def solve3(a, b, c, r):
    """x of the three equations a·x = r₀, b·x = r₁, c·x = r₂, by Cramer's rule."""
    bc, ca, ab = cross(b, c), cross(c, a), cross(a, b)
    determinant = a[0] * bc[0] + a[1] * bc[1] + a[2] * bc[2]
    return (
        (r[0] * bc[0] + r[1] * ca[0] + r[2] * ab[0]) / determinant,
        (r[0] * bc[1] + r[1] * ca[1] + r[2] * ab[1]) / determinant,
        (r[0] * bc[2] + r[1] * ca[2] + r[2] * ab[2]) / determinant,
    )


def plain_throughout(kernel):
    """The kernel in plain Python, with all kernels that it calls: compiled, they could not make arrays."""
    function = plain(kernel)
    called = {name: function.__globals__.get(name) for name in function.__code__.co_names}
    names = {name: plain_throughout(f) for name, f in called.items() if hasattr(f, "py_func")}
    return FunctionType(function.__code__, {**function.__globals__, **names})


def over_arrays(kernel):
    """The kernel as a function of arrays, components along the last axis; leading axes broadcast.

    ``over_arrays(rotate)(q, r)`` takes q (…, 4) and r (…, 3) and gives (…, 3).
    """
    function = plain_throughout(kernel)

    def on_arrays(*arguments):
        components = [np.moveaxis(np.asarray(a, dtype=float), -1, 0) for a in arguments]
        return np.stack(np.broadcast_arrays(*function(*components)), axis=-1)

    on_arrays.__doc__ = kernel.__doc__
    return on_arrays


def rotate_in_plane(θ, r):
    """The vectors r (…, 2) turned by the angles θ (…,), rad: the planar ``rotate``."""
    c, s, r = np.cos(θ), np.sin(θ), np.asarray(r, dtype=float)
    return np.stack([c * r[..., 0] - s * r[..., 1], s * r[..., 0] + c * r[..., 1]], axis=-1)


def quaternion_rate_matrix(q):
    """E(q), the matrix that takes ω to q̇: ``q̇ = E(q) ω`` with ω in the world frame (S9).

    q: (…, 4). Returns (…, 4, 3). Its columns are orthogonal to q, so q̇ never changes the norm, in exact
    arithmetic.
    """
    q = np.asarray(q, dtype=float)[..., None, :]
    return np.swapaxes(over_arrays(quaternion_rate)(q, np.eye(3)), -1, -2)


def rotation_matrix(q):
    """R(q) (…, 3, 3) of unit quaternions (…, 4): ``r_world = R r_body``."""
    q = np.asarray(q, dtype=float)[..., None, :]
    return np.swapaxes(over_arrays(rotate)(q, np.eye(3)), -1, -2)


def quaternion_of_matrix(R):
    """The unit quaternion (4,), w ≥ 0, of a rotation matrix (3, 3). Source: Shepperd, J. Guidance 1
    (1978) 223.
    """
    R = np.asarray(R, dtype=float)
    xx, yy, zz = np.diag(R)
    squares = 0.25 * np.array([1 + xx + yy + zz, 1 + xx - yy - zz, 1 - xx + yy - zz, 1 - xx - yy + zz])
    k = int(np.argmax(squares))  # divide by the largest component, for accuracy
    sums = np.array(
        [
            [4 * squares[0], R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]],
            [R[2, 1] - R[1, 2], 4 * squares[1], R[0, 1] + R[1, 0], R[0, 2] + R[2, 0]],
            [R[0, 2] - R[2, 0], R[0, 1] + R[1, 0], 4 * squares[2], R[1, 2] + R[2, 1]],
            [R[1, 0] - R[0, 1], R[0, 2] + R[2, 0], R[1, 2] + R[2, 1], 4 * squares[3]],
        ]
    )
    q = sums[k] / np.linalg.norm(sums[k])
    return q if q[0] >= 0 else -q


def rotation_angle(p, q):
    """The angle (…,) in rad, 0 … π, between the attitudes p and q (…, 4); exact for tiny angles too."""
    difference = over_arrays(multiply)(over_arrays(conjugate)(p), q)
    return 2 * np.arctan2(np.linalg.norm(difference[..., 1:], axis=-1), np.abs(difference[..., 0]))


def skew(r):
    """The matrix (…, 3, 3) of the cross product: ``skew(r) @ a = r × a``."""
    return -np.cross(np.asarray(r, dtype=float)[..., None, :], np.eye(3))
