"""Joints written a second time, by SciPy's rotations and from what they mean, not from rows.

A *displacement* takes the world as it was at the start to where a body has carried it: a pair (R, t), p → R p
+ t, in space or in the plane. φ is a function of the displacements of i and j.
"""

from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from reference import BallJoint, Box, Distance, Fixed, Hinge, Point, Polygon, Scene, Slider, Universal
from reference.joints.row import frame

TENSOR = np.array([[0.5, 0.1, 0.02], [0.1, 0.6, 0.05], [0.02, 0.05, 0.7]])  # principal axes ≠ body's axes


def move(displacement, p):
    """Where a point has been carried."""
    return displacement[0] @ p + displacement[1]


def after(second, first):
    """The displacement second ∘ first."""
    return second[0] @ first[0], move(second, first[1])


def inverse(displacement):
    """The displacement back."""
    R, t = displacement
    return R.T, -R.T @ t


def turn(φ):
    """A rotation matrix: of a rotation vector (3,), or of an angle in the plane."""
    if np.ndim(φ) == 0:
        return np.array([[np.cos(φ), -np.sin(φ)], [np.sin(φ), np.cos(φ)]])
    return Rotation.from_rotvec(φ).as_matrix()


def turn_about(p, φ):
    """The displacement that turns about a point."""
    return turn(φ), p - turn(φ) @ p


def slide(s):
    """The displacement by s."""
    return np.eye(len(s)), np.asarray(s)


# --- the joints ---------------------------------------------------------------------------------------------


class Kind(NamedTuple):
    """A joint of one kind.

    declare(a, b, **law). φ(D_i, D_j, p): of its rows; p is the position of j at the start. allowed(c, p): the
    displacement of j against i, as seen by i at the start, that the joint allows; c (freedom,) are its
    coordinates. driven: whether c[0] is the coordinate for motors and springs.
    """

    declare: object
    φ: object
    allowed: object
    freedom: int
    driven: bool = False


def apart(D_i, D_j, directions, p, q):
    """The components of D_j q − D_i p along directions that i carries."""
    return [(D_i[0] @ e) @ (move(D_j, q) - move(D_i, p)) for e in directions]


def tilt(D_i, D_j, pairs):
    """The scalar products of directions that i and j carry."""
    return [(D_i[0] @ a) @ (D_j[0] @ c) for a, c in pairs]


def parallel(e):
    """The pairs that keep j's e3 along i's."""
    return [(-e[1], e[2]), (e[0], e[2])]


def upright(e):
    """The pairs that keep j's orientation."""
    return [*parallel(e), (-e[0], e[1])]


def twist(D_i, D_j):
    """The angle of j against i in the plane."""
    R = D_i[0].T @ D_j[0]
    return [np.arctan2(R[1, 0], R[0, 0])]


POINT, FAR = np.array([0.4, -0.3, 0.6]), np.array([1.5, 0.2, -0.4])
AXIS, OTHER = np.array([0.6, 0.0, 0.8]), np.array([0.8, 0.0, -0.6])
E, X, Y = frame(AXIS), np.eye(3), np.eye(2)
LENGTH = np.linalg.norm(FAR - POINT)


def swing(c, p, q):
    """j's point q goes round i's point p at the distance it had, and j turns about it."""
    carried = p + turn(c[: c.size // 2 or 1].squeeze()) @ (q - p)
    return after(slide(carried - q), turn_about(q, c[c.size // 2 :].squeeze()))


SPACE = {
    "BallJoint": Kind(
        lambda a, b: BallJoint(a, b, point=POINT),
        lambda D_i, D_j, p: apart(D_i, D_j, X, POINT, POINT),
        lambda c, p: turn_about(POINT, c),
        3,
    ),
    "Hinge": Kind(
        lambda a, b, **law: Hinge(a, b, point=POINT, axis=7 * AXIS, **law),
        lambda D_i, D_j, p: apart(D_i, D_j, E, POINT, POINT) + tilt(D_i, D_j, parallel(E)),
        lambda c, p: turn_about(POINT, c[0] * AXIS),
        1,
        driven=True,
    ),
    "Slider": Kind(
        lambda a, b, **law: Slider(a, b, axis=AXIS, **law),
        lambda D_i, D_j, p: apart(D_i, D_j, E[:2], p, p) + tilt(D_i, D_j, upright(E)),
        lambda c, p: slide(c[0] * AXIS),
        1,
        driven=True,
    ),
    "Fixed": Kind(
        lambda a, b: Fixed(a, b),
        lambda D_i, D_j, p: apart(D_i, D_j, X, p, p) + tilt(D_i, D_j, upright(X)),
        lambda c, p: slide(np.zeros(3)),
        0,
    ),
    "Universal": Kind(
        lambda a, b: Universal(a, b, point=POINT, **axes(b)),
        lambda D_i, D_j, p: apart(D_i, D_j, X, POINT, POINT) + tilt(D_i, D_j, [(AXIS, OTHER)]),
        lambda c, p: after(turn_about(POINT, c[0] * AXIS), turn_about(POINT, c[1] * OTHER)),
        2,
    ),
    "Distance": Kind(
        lambda a, b: Distance(a, b, **points(b)),
        lambda D_i, D_j, p: [np.linalg.norm(move(D_j, FAR) - move(D_i, POINT)) - LENGTH],
        lambda c, p: swing(c, POINT, FAR),
        6,  # 5: a turn of the rod about itself does nothing
    ),
}

PLANE = {
    "Hinge": Kind(
        lambda a, b, **law: Hinge(a, b, point=POINT[:2], **law),
        lambda D_i, D_j, p: apart(D_i, D_j, Y, POINT[:2], POINT[:2]),
        lambda c, p: turn_about(POINT[:2], c[0]),
        1,
        driven=True,
    ),
    "Slider": Kind(
        lambda a, b, **law: Slider(a, b, axis=(0.6, 0.8), **law),
        lambda D_i, D_j, p: apart(D_i, D_j, [np.array([0.8, -0.6])], p, p) + twist(D_i, D_j),
        lambda c, p: slide(c[0] * np.array([0.6, 0.8])),
        1,
        driven=True,
    ),
    "Fixed": Kind(
        lambda a, b: Fixed(a, b),
        lambda D_i, D_j, p: apart(D_i, D_j, Y, p, p) + twist(D_i, D_j),
        lambda c, p: slide(np.zeros(2)),
        0,
    ),
    "Distance": Kind(
        lambda a, b: Distance(a, b, **points(b, 2)),
        lambda D_i, D_j, p: [
            np.linalg.norm(move(D_j, FAR[:2]) - move(D_i, POINT[:2])) - np.linalg.norm((FAR - POINT)[:2])
        ],
        lambda c, p: swing(c, POINT[:2], FAR[:2]),
        2,
    ),
}


def axes(b):
    """axis_a and axis_b so that i's is AXIS and j's is OTHER."""
    return {"axis_a": OTHER, "axis_b": AXIS} if b is None else {"axis_a": AXIS, "axis_b": OTHER}


def points(b, d=3):
    """point_a and point_b so that i's is POINT and j's is FAR."""
    p, q = POINT[:d], FAR[:d]
    return {"point_a": q, "point_b": p} if b is None else {"point_a": p, "point_b": q}


# --- scenes and motions -------------------------------------------------------------------------------------

PARTNERS = ("two bodies", "the world", "static i", "static j")


def joined(kind, partners, rng, d=3, **law):
    """A scene of two bodies of any attitude, joined; the joint's numbers (i, j), where None is the world."""
    scene = Scene(gravity=np.zeros(d))
    scene.add(Point(), position=np.ones(d))  # so that the numbers are not those of the state
    for number in range(2):
        q = rng.normal(size=4) if d == 3 else rng.normal()
        scene.add(
            Box((0.3, 0.4, 0.5)) if d == 3 else Polygon([(0, 0), (1, 0), (0, 0.7)]),
            mass=1 + number,
            inertia=TENSOR if d == 3 else 0.3 + number,
            position=rng.normal(size=d),
            orientation=q / np.linalg.norm(q) if d == 3 else q,
            static=partners == ("static i", "static j")[number],
            group="all",
        )
    i, j = (None, 1) if partners == "the world" else (1, 2)
    scene.join(kind.declare(*((j, None) if i is None else (i, j)), **law))
    return scene, i, j


def steady(x, v, ω, start=None):
    """Constant v, of the point that was at x at the start, and constant ω; after the displacement start."""

    def at(t):
        R, s = start or slide(np.zeros(len(x)))
        c = R @ x + s
        turned = turn(ω * t)
        return after((turned, c + v * t - turned @ c), (R, s))

    return at


def random_displacement(rng, d):
    """Anywhere, turned by any angle."""
    return turn(rng.normal(size=3) if d == 3 else rng.normal()), rng.normal(size=d)


def derivatives(f, h):
    """f, its first and its second derivative at 0, by central differences of order 4."""
    before2, before, now, later, later2 = (np.asarray(f(k * h)) for k in (-2, -1, 0, 1, 2))
    first = (before2 - 8 * before + 8 * later - later2) / (12 * h)
    second = (-before2 + 16 * before - 30 * now + 16 * later - later2) / (12 * h * h)
    return now, first, second


def spin(R):
    """ω and ω̇ at 0 of a rotation R(t), from Ṙ Rᵀ = [ω]×; numbers in the plane."""
    now, first, second = derivatives(R, 5e-3)
    W = first @ now.T
    dW = second @ now.T + first @ first.T
    if len(now) == 2:
        return W[1, 0], dW[1, 0]
    return tuple(np.array([A[2, 1] - A[1, 2], A[0, 2] - A[2, 0], A[1, 0] - A[0, 1]]) / 2 for A in (W, dW))


def state_of(bodies, motions):
    """The State at t = 0 of bodies whose displacements are motions {number: at}, and u̇ laid out as u."""
    scene, d = bodies.declared, bodies.dimension
    x, q = bodies.position.copy(), bodies.orientation.copy()
    v, ω = np.zeros_like(x), np.zeros_like(bodies.angular_velocity)
    a, α = v.copy(), ω.copy()
    for i, at in motions.items():
        x[i], v[i], a[i] = derivatives(lambda t, i=i, at=at: move(at(t), scene[i].position), 5e-3)
        ω[i], α[i] = spin(lambda t, at=at: at(t)[0])
        R = at(0.0)[0]
        if d == 2:
            q[i] += np.arctan2(R[1, 0], R[0, 0])
        else:
            start = Rotation.from_quat(scene[i].orientation, scalar_first=True)
            q[i] = (Rotation.from_matrix(R) * start).as_quat(scalar_first=True)
    state = bodies.state(x, q, v, ω)
    return state, bodies.state(x, q, a, α).u
