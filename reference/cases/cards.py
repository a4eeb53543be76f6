"""Card houses: cards that lean on each other, and stand by friction.

Slides S11, S12; lectures/05_contact.md.
"""

import math

from ..shapes import Box, Capsule
from .case import Case, position_error, positive
from .ground import Ground, counted, standing, topples

LENGTH, RADIUS, LEAN = 1.0, 0.02, 0.3  # of a card, m, between the centres of its round ends, and rad
FOOT = RADIUS + LENGTH * math.sin(LEAN)  # of a pair: from its middle to where a card stands


def card_house(storeys=2, share=1.05, duration=2.0):
    """Pairs of cards in the plane, with a board on each storey but the last; one pair fewer each storey.

    Friction is ``share`` of what a pair needs: without a load if there is one storey, else under any load.
    """
    counted(storeys=storeys)
    positive(share=share, duration=duration)
    if share == 1 or (share < 1 and storeys > 1):
        raise ValueError(f"share must exceed 1, or be less with one storey (it falls), but is {share!r}")
    needed = LENGTH * math.sin(LEAN) / (LENGTH * math.cos(LEAN) + RADIUS)
    plane = Ground(2)
    friction = share * needed * (0.5 if storeys == 1 else 1.0)
    apart, height = 2 * FOOT + 4 * RADIUS, 0.0
    for pairs in range(storeys, 0, -1):
        for k in range(pairs):
            _lean(plane, (k - (pairs - 1) / 2) * apart, height, friction)
        height += LENGTH * math.cos(LEAN) + 2 * RADIUS
        if pairs > 1:
            board = Box(((pairs - 1) * apart / 2 + 2 * RADIUS, RADIUS))
            plane.scene.add(board, mass=0.1 * pairs, position=(0.0, height + RADIUS), friction=1.0)
            height += 2 * RADIUS
    stands = share > 1
    return Case(
        "card_house",
        plane.scene,
        duration,
        standing(plane.scene),
        position_error(1.0) if stands else topples(0.1),
        "m" if stands else "1 if it stands",
        "Moments about the foot: the thrust is (P + W/2) ℓ sin θ/(ℓ cos θ + r) under a load P, the foot "
        "bears P + W, so μ must be ½ ℓ sin θ/(ℓ cos θ + r) if P = 0, and twice that at most (as two ladders "
        "lean: Meriam & Kraige, Engineering Mechanics: Statics, chapter 6).",
        "It stands by friction alone; whatever slips a little each step brings it down.",
    )


def _lean(plane, x, z, friction):
    """Two cards of .1 kg that lean on each other over (x, z)."""
    for side in (-1, 1):
        across, up = 0.5 * LENGTH * math.sin(LEAN), 0.5 * LENGTH * math.cos(LEAN)
        plane.scene.add(
            Capsule(RADIUS, LENGTH / 2),
            mass=0.1,
            position=(x + side * (RADIUS + across), z + RADIUS + up),
            orientation=side * LEAN,
            friction=friction,
        )
