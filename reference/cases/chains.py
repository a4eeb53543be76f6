"""Chains: let go level, with a light or a heavy end; and hanging between two points.

Slides S5, S9, S15; lectures/04_embedding.md.
"""

import numpy as np
from scipy.optimize import brentq

from .. import inputs
from .case import Case, position_error, positive
from .falling import Falling
from .upright import Upright, bar_inertia, checked_joint, end_error

LINK = 1.0  # m, of a chain's links


def chain(n=20, end_mass=1.0, dimension=2, joint="hinge", duration=2.0):
    """n links of 1 m and 1 kg, let go level from a fixed end. Error: of the free end, over the length.

    end_mass: of the last link, kg. joint: "hinge"; "ball", in space; or "distance", points on massless rods.
    """
    n = inputs.whole("n", n, least=1)
    positive(end_mass=end_mass, duration=duration)
    checked_joint(joint, dimension)
    points, plane = joint == "distance", Upright(dimension)
    masses = np.append(np.ones(n - 1), float(end_mass))
    for k in range(n):
        at = (k + 1) * LINK if points else (k + 0.5) * LINK
        body = plane.point(masses[k], (at, 0.0)) if points else plane.bar(LINK, masses[k], (at, 0.0), 0.0)
        if points and k:
            plane.join(joint, body, body - 1, ((at - LINK), 0.0))
        else:
            plane.join(joint, body, body - 1 if k else None, (k * LINK, 0.0))
    return Case(
        "chain",
        plane.scene,
        duration,
        Falling(plane, masses, None if points else bar_inertia(masses, LINK), LINK),
        end_error(n * LINK, 0.0 if points else LINK / 2),
        "relative to the length",
        "angles integrated by DOP853 to 1e-12, accelerations by the joints' pulls",
        "A heavy end on light links is a long narrow object: iterations converge slowly (S15).",
    )


def hanging_chain(n=30, length=1.5, span=1.0, dimension=2, settle=False, duration=2.0):
    """n bars on hinges (balls in space) hang between two points of one height. Error: over the span.

    settle=False: it starts where it hangs at rest, and must stay there. settle=True: it starts as an arc,
    with drag, and only where it ends counts; give it 20 s. ``case.exact.sag`` is this chain's sag, m, and
    ``case.exact.catenary_sag`` the limit of infinitely many links.
    """
    n = inputs.whole("n", n, least=2)
    positive(length=length, span=span, duration=duration)
    if length <= span:
        raise ValueError(f"length must exceed the span, {span:g} m, but is {length!r}")
    plane, link, joint = Upright(dimension), length / n, "hinge" if dimension == 2 else "ball"
    exact = _Hanging(plane, n, length, span)
    angles = _arc(n, span / link) if settle else exact.angles
    ends = _joints(angles, link)
    for k in range(n):
        body = plane.bar(link, 1.0 / n, (ends[k] + ends[k + 1]) / 2, angles[k])
        plane.join(joint, body, body - 1 if k else None, ends[k])
        if settle:
            plane.scene.drag(body, 4.0 / n, 0.5 * link**2 / n)
    plane.join(joint, n - 1, None, ends[n])
    everywhere = position_error(span)

    def at_the_end(run, motion):
        return np.linalg.norm(run.position[-1] - motion.position[-1], axis=-1).max() / span

    return Case(
        "hanging_chain",
        plane.scene,
        duration,
        exact,
        at_the_end if settle else everywhere,
        "relative to the span",
        "statics: tan θ_k = (k − (n + 1)/2) w/H; catenary: L = 2a sinh(span/2a)",
        "A loop through the world: no tree, and every joint carries the weight of half the chain.",
    )


class _Hanging:
    """The Motion of a chain at rest: link k at the angle whose tangent is (k − (n + 1)/2) w/H.

    w is a link's weight, H the pull along the chain's middle, found from Σ cos θ_k = span/ℓ.
    """

    def __init__(self, plane, n, length, span):
        self.plane, self.n, link = plane, n, length / n
        odd = np.arange(1, n + 1) - (n + 1) / 2

        def too_wide(r):
            return np.sum(1 / np.hypot(1, odd * r)) - span / link

        self.angles = np.arctan(odd * brentq(too_wide, 1e-12, 1e12, xtol=1e-300, rtol=1e-15))
        ends = _joints(self.angles, link)
        self.places = (ends[1:] + ends[:-1]) / 2
        self.sag = -float(ends[:, 1].min())
        a = brentq(lambda a: 2 * a * np.sinh(span / (2 * a)) - length, span / 1000, 1000 * span)
        self.catenary_sag = a * (np.cosh(span / (2 * a)) - 1)

    def __call__(self, time):
        shape = (*np.shape(time), self.n)
        still = np.zeros((*shape, 2))
        return self.plane.motion(still + self.places, np.zeros(shape) + self.angles, still, np.zeros(shape))


def _joints(angles, link):
    """The points (n + 1, 2) between links at these angles, from the origin on."""
    steps = link * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    return np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])


def _arc(n, links):
    """Angles of n equal chords of an arc as wide as ``links`` of them, below its ends."""
    odd = np.arange(1, n + 1) - (n + 1) / 2
    turn = brentq(lambda turn: np.sum(np.cos(odd * turn)) - links, 0.0, 2 * np.pi / n)
    return odd * turn
