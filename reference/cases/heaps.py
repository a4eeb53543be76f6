"""Hundreds of discs and spheres: dropped into a box, and running out of a silo.

Where each of them goes nobody can say. What is known are sums, and these are what the errors measure; so the
Motion that these cases call exact is nan.

Slides S10–S12, S16; lectures/05_contact.md.
"""

import math

import numpy as np

from ..shapes import Disc, Plane, Sphere
from .case import GRAVITY, Case, Motion, positive
from .ground import Ground, counted

SPACING, SPREAD = 2.3, 0.1  # radii between the centres at first; share by which radii differ


def heap(n=666, dimension=3, radius=0.1, friction=0.5, seed=0, duration=4.0):
    """n balls (discs in the plane) of slightly different sizes are dropped into a box; then they must rest.

    The error is the largest of: what the box carries at the end, against the balls' weight; the speed that is
    left, over √(g r); penetration, over r; energy gained. Infinite if a ball went through a wall.
    """
    counted(n=n, seed=seed + 1)
    positive(radius=radius, friction=friction, duration=duration)
    plane, rng, d = Ground(dimension), np.random.default_rng(seed), dimension
    wide = math.ceil(n ** (1 / dimension))  # balls side by side
    half = 0.5 * SPACING * radius * wide
    walls = _walls(plane, half)
    pour(plane, n, wide, half, 0.0, radius, friction, rng)
    weight = GRAVITY * sum(body.mass for body in plane.scene.bodies[walls:])

    def measure(run, motion):
        sizes = np.array([body.shape.radius for body in plane.scene.bodies[walls:]])
        sideways = np.abs(run.position[:, walls:, : d - 1]).max(axis=-1)
        if np.any(sideways > half) or np.any(run.position[:, walls:, -1] < 0):
            return np.inf
        energy = run.energy()
        gained = np.max(energy - np.minimum.accumulate(energy)) / energy[0]
        speed = np.linalg.norm(run.velocity[-1], axis=-1).max() / math.sqrt(GRAVITY * radius)
        deep = run.penetration().max() / sizes.min()
        return max(abs(carried(run, walls) / weight - 1), speed, deep, gained)

    return Case(
        "heap",
        plane.scene,
        duration,
        unknown(plane.scene),
        measure,
        "relative",
        "Newton's laws: at rest the box carries the weight; contact and friction only take energy (the "
        "scene: SimBenchmark, leggedrobotics, 2018, 666 balls).",
        "Hundreds of contacts hang together, more than statics can tell apart, and change all the time.",
    )


def silo(n=2000, opening=10.0, radius=0.1, friction=0.5, seed=0, duration=8.0):
    """n discs run out of a silo with a flat bottom, through an opening of so many diameters, onto the ground.

    The error is that of the rate, as an area a second, while the second fifth of them runs out, relative to
    Hagen's and Beverloo's law; its constant is good to some 20 %. Infinite if a disc went through a wall.
    """
    counted(n=n, seed=seed + 1)
    positive(opening=opening, radius=radius, friction=friction, duration=duration)
    plane, rng = Ground(2), np.random.default_rng(seed)
    wide = max(math.ceil(math.sqrt(n)), 3 * math.ceil(opening))
    half, gap, high = 0.5 * SPACING * radius * wide, opening * radius, 0.35 * SPACING * radius * wide
    _walls(plane, half)
    for side in (-1, 1):
        plane.box(0.5 * (half - gap), 0.5 * radius, (side * 0.5 * (half + gap), high), static=True)
    walls = len(plane.scene.bodies)
    pour(plane, n, wide, half, high + radius, radius, friction, rng)
    mean = 1 - 0.5 * SPREAD  # of the diameters, over the largest
    law = RATE * DENSE * math.sqrt(GRAVITY) * (2 * radius * (opening - EMPTY * mean)) ** 1.5

    def measure(run, motion):
        place = run.position[:, walls:]
        inside = (np.abs(place[..., 0]) <= half) & (place[..., 1] >= 0)
        out = np.sum(place[..., 1] < high, axis=1)
        if not np.all(inside) or out[-1] < 0.4 * n:
            return np.inf
        begin, end = np.interp((0.2 * n, 0.4 * n), out, run.time)
        area = math.pi * np.mean([body.shape.radius**2 for body in plane.scene.bodies[walls:]])
        return abs(0.2 * n * area / (end - begin) / law - 1)

    return Case(
        "silo",
        plane.scene,
        duration,
        unknown(plane.scene),
        measure,
        "of the rate",
        "The rate doesn't depend on how full it is (Hagen, Bericht Akad. Wiss. Berlin 1852, 35), but goes as "
        "√g (D − 1.4 d)^(3/2) in the plane (Beverloo, Leniger & van de Velde, Chem. Eng. Sci. 15 (1961) "
        "260); that grains fall freely from an arch over the opening gives .874 (Nedderman, Statics and "
        "Kinematics of Granular Materials, 1992, chapter 10).",
        "Arches form and break: sticking, sliding and parting all over, in each step.",
    )


RATE = 0.874  # ∫ √(2 g √(R² − x²)) dx over an opening 2 R wide is this times √g (2 R)^(3/2)
EMPTY, DENSE = 1.4, 0.82  # diameters along which nothing flows; share of the area that discs fill


def _walls(plane, half):
    """Upright planes at ± half, in all horizontal directions. Returns how many bodies there are then."""
    d = plane.dimension
    for axis in range(d - 1):
        for side in (-1, 1):
            inwards = np.zeros(d)
            inwards[axis] = -side
            plane.scene.add(Plane(tuple(inwards)), position=tuple(-half * inwards), friction=1.0)
    return len(plane.scene.bodies)


def pour(plane, n, wide, half, height, radius, friction, rng):
    """Add n balls, ``wide`` of them side by side, in layers from ``height`` up, none touching another."""
    layer, step = wide ** (plane.dimension - 1), 2 * half / wide
    for i in range(n):
        place = [(i // wide**axis % wide + 0.5) * step - half for axis in range(plane.dimension - 1)]
        place = np.array([*place, height + 0.5 * step + i // layer * step])
        own = radius * (1 - SPREAD * rng.random())
        shift = (0.5 * step - radius) * rng.uniform(-1, 1, plane.dimension)
        mass = (own / radius) ** plane.dimension
        shape = Disc(own) if plane.dimension == 2 else Sphere(own)
        plane.scene.add(shape, mass=mass, position=place + shift, friction=friction)


def carried(run, walls):
    """The mean force, N, since the record before, with which the first ``walls`` bodies bear the others."""
    c = run.contacts[-1]
    on = (c.bodies[:, 0] < walls) & (c.bodies[:, 1] >= walls)
    upward = np.einsum("mi,mi->", c.impulse[on], c.frame[on][:, :, -1])
    return upward / (run.time[-1] - run.time[-2])


def unknown(scene):
    """A Motion of which nothing is known."""
    n, d = len(scene.bodies), scene.dimension

    def exact(t):
        vector, turn = np.full((len(t), n, d), np.nan), np.full((len(t), n), np.nan)
        if d == 2:
            return Motion(vector, turn, vector, turn)
        return Motion(vector, np.full((len(t), n, 4), np.nan), vector, vector)

    return exact
