"""A semicircular arch of loose stones: it stands by its shape alone, if it is thick enough.

Slides S10–S12; lectures/05_contact.md.
"""

import math
from itertools import pairwise

import numpy as np

from ..shapes import Polygon
from .case import Case, position_error, positive
from .ground import Ground, counted, standing, topples

LIMIT = 0.1075  # thickness over radius of the centre line


def arch(ratio=0.2, stones=15, duration=5.0):
    """A semicircular arch of ``stones`` voussoirs on the ground; ratio: thickness over radius (1 m).

    The error is what has moved, m, or, where it must fall, 1 unless it does.
    """
    counted(stones=stones)
    positive(ratio=ratio, duration=duration)
    if ratio >= 1 or abs(ratio - LIMIT) < 0.1 * LIMIT:
        raise ValueError(f"ratio must be below 1 and 10 % or more off the limit {LIMIT}, but is {ratio!r}")
    plane = Ground(2)
    low, high = 1 - 0.5 * ratio, 1 + 0.5 * ratio
    angles = np.linspace(0, math.pi, stones + 1)
    for a, b in pairwise(angles):
        corners = [
            (r * math.cos(φ), r * math.sin(φ) if 0 < φ < math.pi else 0.0)
            for r, φ in ((low, a), (high, a), (high, b), (low, b))
        ]
        stone = Polygon(corners)
        centre = np.array(corners[0]) - stone.vertices[0]
        area = 0.5 * (high**2 - low**2) * math.sin(b - a)
        plane.scene.add(stone, mass=2000 * area, position=centre, friction=0.9)
    stands = ratio > LIMIT
    return Case(
        "arch",
        plane.scene,
        duration,
        standing(plane.scene),
        position_error(1.0) if stands else topples(0.1),
        "m" if stands else "1 if it stands",
        "Milankovitch 1907; Heyman, The Stone Skeleton (1995): a semicircular arch stands down to t/R = "
        f"{LIMIT}.",
        "The line of thrust must lie within the stones; no contact may slip, and few carry much.",
    )
