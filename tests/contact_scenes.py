"""Scenes with contact that several tests use. z is up in space, y in the plane; g = 9.81 m/s²."""

import numpy as np

from reference import Box, Plane, Scene

G = 9.81


def at(d, x, z, y=0.0):
    """A point or vector: x along the ground, z up; y across, in space only."""
    return (x, z) if d == 2 else (x, y, z)


def ground(d, slope=0.0, **material):
    """A scene with a half-space under z = 0; gravity leans by ``slope``, rad, towards +x."""
    scene = Scene(gravity=at(d, G * np.sin(slope), -G * np.cos(slope)))
    scene.add(Plane(at(d, 0, 1)), **material)
    return scene


def stack(d, n, top=1.0):
    """n boxes of 1 m and 1 kg on each other; the mass of the last is ``top``."""
    scene = ground(d)
    for i in range(n):
        scene.add(Box((0.5,) * d), mass=top if i == n - 1 else 1.0, position=at(d, 0, i + 0.5))
    return scene


def pyramid(base):
    """Rows of base, base − 1, … 1 boxes, in the plane."""
    scene = ground(2)
    for row in range(base):
        for k in range(base - row):
            scene.add(Box((0.5, 0.5)), position=(k + 0.5 * row, row + 0.5))
    return scene


def block(d, slope, friction):
    """One box of 1 m on a slope."""
    scene = ground(d, slope, friction=1.0)
    scene.add(Box((0.5,) * d), position=at(d, 0, 0.5), friction=friction)
    return scene


def rise(energy):
    """By how much the energy (T,) ever exceeds what it was before, J."""
    return float(np.max(energy - np.minimum.accumulate(energy)))
