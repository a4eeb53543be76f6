"""A bridge of planks on hinges, with a ball that rests where it sags the most.

Slides S6, S9, S12; lectures/05_contact.md.
"""

import math

import numpy as np
from scipy.optimize import brentq

from .. import inputs
from .case import GRAVITY, Case, position_error, positive
from .ground import standing
from .upright import SLENDER, Upright

RADIUS = 0.5  # of the ball, m


def bridge(planks=160, load=100.0, span=0.95, dimension=2, duration=2.0):
    """An even number of planks of 1 m and 1 kg between two piers of one height, and a ball of ``load`` kg.

    span: of the planks' length. It starts where it rests, and must stay there: the error, over the span.
    """
    planks = inputs.whole("planks", planks, least=4)
    positive(load=load, duration=duration)
    if planks % 2:
        raise ValueError(f"planks must be even, so that the ball lies between two, but is {planks}")
    if not 0.5 <= span < 1:
        raise ValueError(f"span must be at least .5 and less than 1, of the length, but is {span!r}")
    plane, width = Upright(dimension), span * planks
    angles = _angles(planks, load, width)
    steps = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    ends = np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])
    for k in range(planks):
        body = plane.bar(1.0, 1.0, (ends[k] + ends[k + 1]) / 2, angles[k])
        plane.join("hinge", body, body - 1 if k else None, ends[k])
    plane.join("hinge", planks - 1, None, ends[-1])
    above = (RADIUS + SLENDER / 2) / math.cos(angles[planks // 2])
    centre = ends[planks // 2] + np.array([0.0, above])
    plane.ball(RADIUS, centre, mass=load, friction=0.0)
    return Case(
        "bridge",
        plane.scene,
        duration,
        standing(plane.scene),
        position_error(width),
        "relative to the span",
        "Statics: the planks outside the ball lean by tan θ_k = ((k − ½) w + W/2)/H, k from the middle, and "
        "the two that bear it by the moments about the hinge between them (Irvine, Cable Structures, 1981).",
        "A loop of joints through the world bears a contact: all forces hang together, over 160 bodies.",
    )


def _angles(planks, load, width):
    """Of the planks from left to right, rad; H found so that they span the width."""
    w, W, half = GRAVITY, load * GRAVITY, planks // 2
    arm = RADIUS + SLENDER / 2

    def inner(H):
        """Of the plank right of the middle: its outer hinge, its weight and the ball make no moment."""

        def moment(θ):
            c, s = math.cos(θ), math.sin(θ)
            return c * (w + W / 2) - s * H - 0.5 * w * c - 0.5 * W / c * arm * s / c

        return brentq(moment, 0.0, 1.2, xtol=1e-15, rtol=1e-15)

    def lean(H):
        outer = np.arctan(((np.arange(2, half + 1) - 0.5) * w + W / 2) / H)
        return np.concatenate([[inner(H)], outer])

    most = 1e6 * planks * (w + W)
    H = brentq(lambda H: np.cos(lean(H)).sum() - width / 2, 0.5 * (w + W), most, xtol=1e-12, rtol=1e-15)
    right = lean(H)
    return np.concatenate([-right[::-1], right])
