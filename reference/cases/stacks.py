"""Boxes that rest on one another: nothing may move, and statics says what each contact carries.

Slides S10–S12, S15; lectures/05_contact.md.
"""

from ..shapes import Box
from .case import Case, position_error, positive
from .ground import Ground, counted, standing, topples


def stack(n=10, heavy=1.0, dimension=2, duration=5.0):
    """n cubes of 1 m and 1 kg, the mass of the top one ``heavy`` kg; the unit of drift is m."""
    counted(n=n)
    positive(heavy=heavy, duration=duration)
    plane = Ground(dimension)
    for i in range(n):
        plane.box(0.5, 0.5, (0.0, i + 0.5), mass=heavy if i == n - 1 else 1.0)
    return Case(
        "stack",
        plane.scene,
        duration,
        standing(plane.scene),
        position_error(1.0),
        "m",
        "Statics: nothing moves, and box j carries the weights above it, g (n − 1 − j + heavy).",
        "A load goes down one contact a sweep, and sweeping from light to heavy gains 1/heavy a sweep.",
    )


def pyramid(base=20, dimension=2, duration=5.0):
    """Rows of base, base − 1, … 1 cubes of 1 m and 1 kg."""
    counted(base=base)
    positive(duration=duration)
    plane = Ground(dimension)
    for row in range(base):
        for k in range(base - row):
            plane.box(0.5, 0.5, (k + 0.5 * row, row + 0.5))
    return Case(
        "pyramid",
        plane.scene,
        duration,
        standing(plane.scene),
        position_error(1.0),
        "m",
        "Statics: nothing moves, and the ground carries base (base + 1)/2 times a box's weight.",
        "Many contacts, and more of them than statics can tell apart.",
    )


def table(mass=8.0, leg=0.5, duration=2.0):
    """A table top on four legs that stand loose under it, in space."""
    positive(mass=mass, leg=leg, duration=duration)
    plane = Ground(3)
    plane.scene.add(Box((1.0, 0.7, 0.1)), mass=mass, position=(0, 0, 1.1))
    for x in (-0.9, 0.9):
        for y in (-0.6, 0.6):
            plane.scene.add(Box((0.05, 0.05, 0.5)), mass=leg, position=(x, y, 0.5))
    return Case(
        "table",
        plane.scene,
        duration,
        standing(plane.scene),
        position_error(1.0),
        "m",
        "Statics: nothing moves; the legs together carry the top's weight, each at least 0.",
        "Four legs, three equations: the forces are not unique, their sum and the rest are.",
    )


def heavy_on_two(heavy=400.0, dimension=2, duration=5.0):
    """A box of 2.2 m and ``heavy`` kg on two cubes of 1 m and 1 kg, .2 m apart."""
    positive(heavy=heavy, duration=duration)
    plane = Ground(dimension)
    for x in (-0.6, 0.6):
        plane.box(0.5, 0.5, (x, 0.5))
    plane.box(1.1, 1.1, (0.0, 2.1), mass=heavy)
    return Case(
        "heavy_on_two",
        plane.scene,
        duration,
        standing(plane.scene),
        position_error(1.0),
        "m",
        "Statics: nothing moves, and each cube carries half the box, heavy g/2.",
        "Heavy on light: a sweep of Gauss–Seidel gains 1/heavy of what is missing.",
    )


def overhang(n=4, share=0.97, duration=2.0):
    """n blocks of 1 m × .2 m that lean out over a table's edge by ``share`` of the limit ½ Σ 1/k."""
    counted(n=n)
    positive(share=share, duration=duration)
    if share == 1:
        raise ValueError("share must be less than 1 (stands) or more (falls), but is 1, the limit itself")
    plane = Ground(2)
    plane.scene.add(Box((5.0, 0.5)), static=True, position=(-5.0, 0.5), friction=1.0)
    edge = 0.0
    for k in range(n, 0, -1):  # from the lowest, which has k − 1 above it
        edge += share * 0.5 / k
        plane.scene.add(Box((0.5, 0.1)), position=(edge - 0.5, 1.1 + 0.2 * (n - k)))
    stands = share < 1
    return Case(
        "overhang",
        plane.scene,
        duration,
        standing(plane.scene),
        position_error(1.0) if stands else topples(0.1),
        "m" if stands else "1 if it stands",
        "Statics: the centre of the k blocks above an edge may lie up to over it, which is ½ Σ 1/k in all "
        "(Phear, Elementary Mechanics, 1850; Gardner, Scientific American, November 1964).",
        "At the limit each contact carries all of its load at one end.",
    )
