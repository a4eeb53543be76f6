"""LCPs as they come from a step of a real scene: it is run up to a time, and what it asks its solver is kept.

All are planar, where friction bounds ±μ λ_n are Coulomb's law itself. A is J M⁻¹ Jᵀ, b = J u + c with u the
velocities that there would be without contact, and c what a gap may still close. Where more contacts carry a
body than statics can tell apart, λ isn't unique; then w is what a λ is judged by.

Slides S9, S12, S15; lectures/07_iterative_lcp.md.
"""

import math

import numpy as np

from ..compiled import bind
from ..factored import Factored
from ..layout import Bodies
from ..lcp import LCP, lemke, min_map_newton
from ..shapes import Plane
from ..simulators.flight import push
from ..simulators.model import model
from ..simulators.settings import Settings
from ..simulators.velocity_lcp import VelocityLCP
from .arches import arch
from .ground import Ground
from .impacts import cradle
from .lcp_problems import Known
from .slopes import slope
from .stacks import pyramid, stack


def heap(discs=30, seed=0):
    """A scene: discs of 5 to 12 cm, no two alike, that fall into a notch of 120°."""
    random, plane = np.random.default_rng(seed), Ground(2, friction=0.5)
    for side in (-1, 1):
        plane.scene.add(Plane((0.5 * side, math.sqrt(0.75))), friction=0.5)
    for i in range(discs):
        row, column = divmod(i, 6)
        centre = 0.25 * (column - 2.5) + 0.02 * random.normal(), 0.9 + 0.26 * row
        plane.ball(random.uniform(0.05, 0.12), centre, friction=0.5)
    return plane.scene


# name: (its scene, when, s, and what is hard)
SCENES = {
    "stack": (lambda: stack(n=20, heavy=100.0).scene, 0.0, "a heavy top; two contacts a face, λ not unique"),
    "pyramid": (lambda: pyramid(base=8).scene, 0.0, "more contacts than statics can tell apart"),
    "arch": (lambda: arch().scene, 0.0, "the thrust runs round, and each joint has two contacts"),
    "cradle": (lambda: cradle(n=5).scene, 0.0, "an impact that must go through five balls"),
    "heap": (heap, 0.6, "in the midst of falling: some roll, some slide, some stick"),
    "sliding": (lambda: slope(share=0.5).scene, 0.5, "friction at its bound"),
}


class Recorder(VelocityLCP):
    """A run that keeps what it asked its solver where that had to push most, and what velocities came out."""

    asked = after = None
    most = 0.0  # N s; set to 0 to keep what comes next

    def __init__(self, scene, bodies, settings):
        super().__init__(scene, bodies, settings)
        self.coast, self.push = None, bind(push, self.solve_in_flight)  # so that each problem is seen

    def solve(self, rows, free, λ):
        """As that of ``VelocityLCP``."""
        return self.noted(rows, self.M, free, λ)

    def solve_in_flight(self, rows, M, free, λ, limits, worst):
        """As that of ``VelocityLCP``: what moves, without what rests."""
        return self.noted(rows, M, free, λ)

    def noted(self, rows, M, free, λ):
        """The velocities u⁺; what was asked is kept."""
        asked = rows, M.copy(), free.copy()
        after = self.solver(rows, M, free, λ, time=self.now)
        if np.abs(λ).sum() > self.most:
            self.asked, self.after, self.most = asked, after.copy(), np.abs(λ).sum()
        return after


def record(scene, time, dt=0.01):
    """The Recorder of a scene, run until one step of dt after ``time``, s."""
    run = Recorder(
        scene, Bodies(scene), Settings.chosen(model(scene), simulator="velocity_lcp", impact="newton")
    )
    run.advance(0.0, 0, dt, round(time / dt))
    run.most = 0.0
    run.advance(time, 0, dt, 1)
    return run


def as_lcp(rows, M, free):
    """(LCP, w of velocities): the LCP of ContactRows, M (n, k, k) and free (n, k); w(u) for any u (n, k)."""
    there = rows.bodies >= 0
    B = np.zeros_like(rows.J)
    B[there] = np.linalg.solve(M[rows.bodies[there]], rows.J[there][:, :, None])[:, :, 0]

    def w(u):
        return np.einsum("rsk,rsk->r", rows.J, np.where(there[:, :, None], u[rows.bodies], 0.0)) + rows.c

    count = np.diff(rows.block) - 1  # of tangents, contact by contact
    first = np.repeat(rows.block[:-1], count)
    normal = np.setdiff1d(np.arange(len(rows.c)), rows.block[:-1])
    friction = (normal, first, np.repeat(rows.μ, count)) if len(normal) else None
    A = Factored(rows.bodies, rows.J, B, len(M)).toarray()
    return LCP(A, w(free), rows.lower, rows.upper, friction=friction), w


def recorded(name="stack"):
    """The problem of one of ``SCENES``: "stack", "pyramid", "arch", "cradle", "heap" or "sliding"."""
    scene, time, hard = SCENES[name]
    problem, _ = as_lcp(*record(scene(), time).asked)
    best = min((solve(problem) for solve in (lemke, min_map_newton)), key=lambda solution: solution.residual)
    size = np.linalg.svd(problem.A, compute_uv=False)
    unique = size[-1] > 1e-9 * size[0]
    source = f"a step of a scene, {name}, {time} s after its start"
    return Known(problem, best.lam if unique else None, source, hard, w=None if unique else best.w)
