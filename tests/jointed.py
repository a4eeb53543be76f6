"""Scenes with joints, and what is known of them from equations written apart from the reference."""

import numpy as np
from scipy.spatial.transform import Rotation

from reference import BallJoint, Box, Disc, Distance, Hinge, Point, Scene


def chain(n, end=1.0, planar=True, length=1.0):
    """n rods of 1 kg, the last of another mass, along x from the origin; in space with ball joints."""
    scene = Scene(gravity=(0, -9.81) if planar else (0, 0, -9.81))
    rest = (0,) if planar else (0, 0)
    for k in range(n):
        body = scene.add(
            Box((length / 2, 0.05) if planar else (length / 2, 0.05, 0.05)),
            mass=end if k == n - 1 else 1.0,
            position=((k + 0.5) * length, *rest),
            group="chain",
        )
        ends = (body,) if k == 0 else (body - 1, body)
        scene.join((Hinge if planar else BallJoint)(*ends, point=(k * length, *rest)))
    return scene


def hinged_chain(n):
    """Rods in space, each turned, with hinges about axes that differ, so that every row has all its parts."""
    scene, rng = Scene(), np.random.default_rng(11)
    at = np.zeros(3)
    for k in range(n):
        along = rng.normal(size=3)
        along /= np.linalg.norm(along)
        turn = Rotation.from_rotvec(rng.normal(size=3)).as_quat(scalar_first=True)
        body = scene.add(
            Box((0.5, 0.1, 0.2)), mass=1 + k, position=at + along / 2, orientation=turn, group="chain"
        )
        ends = (body,) if k == 0 else (body - 1, body)
        scene.join(Hinge(*ends, point=at, axis=rng.normal(size=3)))
        at = at + along
    return scene


def star(n):
    """A free disc with n rods hinged to its rim."""
    scene = Scene(gravity=(0, -9.81))
    hub = scene.add(Disc(1), mass=3, group="star")
    for k in range(n):
        e = np.array([np.cos(2 * np.pi * k / n), np.sin(2 * np.pi * k / n)])
        angle = float(np.arctan2(e[1], e[0]))
        rod = scene.add(Box((0.4, 0.05)), mass=0.5 + k, position=1.4 * e, orientation=angle, group="star")
        scene.join(Hinge(hub, rod, point=e))
    return scene


def bar(scene, p, q, **more):
    """A planar bar from p to q."""
    p, q = np.array(p, dtype=float), np.array(q, dtype=float)
    along = q - p
    return scene.add(
        Box((np.linalg.norm(along) / 2, 0.02)),
        position=(p + q) / 2,
        orientation=float(np.arctan2(along[1], along[0])),
        group="bars",
        **more,
    )


def four_bar(angle, coupler=1.3):
    """A crank of 1 m at this angle, a coupler, a rocker of 1 m; pivots 1.5 m apart."""
    A, D = np.array([0.0, 0.0]), np.array([1.5, 0.0])
    B = A + [np.cos(angle), np.sin(angle)]
    apart = D - B
    distance = np.linalg.norm(apart)
    along = (coupler**2 - 1 + distance**2) / (2 * distance)  # where the two circles meet
    across = np.sqrt(coupler**2 - along**2)
    C = B + (along * apart + across * np.array([-apart[1], apart[0]])) / distance
    return _four_bar(A, B, C, D)


def parallelogram(angle=0.0):
    """A four-bar linkage with equal opposite sides; flat at the angle 0, where a row is redundant."""
    B = np.array([np.cos(angle), np.sin(angle)])
    return _four_bar(np.zeros(2), B, B + [1.5, 0], np.array([1.5, 0]))


def _four_bar(A, B, C, D):
    scene = Scene(gravity=(0, -9.81))
    crank, coupler, rocker = bar(scene, A, B), bar(scene, B, C), bar(scene, D, C)
    scene.join(Hinge(crank, point=A))
    scene.join(Hinge(crank, coupler, point=B))
    scene.join(Hinge(coupler, rocker, point=C))
    scene.join(Hinge(rocker, point=D))
    return scene


def net():
    """Sixteen points in a square grid, held by rods to those beside and under them, hung up at two."""
    scene = Scene(gravity=(0, -9.81))
    number = {}
    for x in range(4):
        for y in range(4):
            number[x, y] = scene.add(Point(), mass=1 + x + 2 * y, position=(x + 0.1 * y * y, -y + 0.2 * x))
    for (x, y), i in number.items():
        for other in ((x + 1, y), (x, y + 1)):
            if other in number:
                scene.join(Distance(i, number[other]))
    for corner in ((0, 0), (3, 0)):
        above = scene.bodies[number[corner]].position + (0.3, 1.0)
        scene.join(Distance(number[corner], point_b=above))
    return scene


def door(ω=0.0):
    """A door of 10 kg on two hinges with one axis: 5 of 10 rows are redundant. Its speed about the axis."""
    scene = Scene()
    leaf = scene.add(
        Box((0.4, 0.02, 1.0)),
        mass=10,
        position=(0.4, 0, 1),
        velocity=(0, 0.4 * ω, 0),
        angular_velocity=(0, 0, ω),
    )
    for z in (0.2, 1.8):
        scene.join(Hinge(leaf, point=(0, 0, z), axis=(0, 0, 1)))
    return scene


def doubled_distance():
    """Two points on two rods that are the same rod."""
    scene = Scene(gravity=(0, -9.81))
    a, b = scene.add(Point()), scene.add(Point(), mass=2, position=(1, 0.5))
    scene.join(Distance(a, b))
    scene.join(Distance(a, b))
    return scene


def mass_matrix(scene, bodies):
    """M (N, N) at the start, columns as in ``State.u``, from the scene's own declarations."""
    blocks = [np.eye(scene.dimension) * scene.bodies[i].mass for i in bodies.moving]
    for i in bodies.rotating:
        body = scene.bodies[i]
        if scene.dimension == 2:
            blocks.append(np.eye(1) * body.inertia)
        else:
            R = Rotation.from_quat(body.orientation, scalar_first=True).as_matrix()
            blocks.append(R @ body.inertia @ R.T)
    size = sum(len(block) for block in blocks)
    M, at = np.zeros((size, size)), 0
    for block in blocks:
        M[at : at + len(block), at : at + len(block)] = block
        at += len(block)
    return M


def chain_rates(n, end, length=1.0, g=9.81):
    """ẏ of y = (angles, their rates) of the planar ``chain``, in minimal coordinates, by Lagrange."""
    m = np.ones(n)
    m[-1] = end
    inertia = m * (length**2 + 0.1**2) / 12
    beyond = np.append(np.cumsum(m[::-1])[::-1][1:], 0.0)  # the mass that hangs on the far end of each rod
    # x_k = Σ_{i<k} l e_i + l/2 e_k: coefficient of θ_i, θ_j in the kinetic energy, times cos(θ_i − θ_j)
    later = np.maximum.outer(np.arange(n), np.arange(n))
    weight = length**2 * (beyond[later] + m[later] / 2)
    np.fill_diagonal(weight, length**2 * (beyond + m / 4))
    moment = g * length * (beyond + m / 2)

    def rates(t, y):
        θ, ω = y[:n], y[n:]
        apart = θ[:, None] - θ[None, :]
        M = weight * np.cos(apart) + np.diag(inertia)
        right = -(weight * np.sin(apart)) @ ω**2 - moment * np.cos(θ)
        return np.concatenate([ω, np.linalg.solve(M, right)])

    return rates
