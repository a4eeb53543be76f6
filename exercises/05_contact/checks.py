"""The checks of exercise 05, contact (slides S10–S12). Grader's side only."""

import numpy as np

import exercises
from exercises.grader.check import Case, Check, cause, cause_like
from exercises.grader.judges import equal

right = exercises.part("05_contact", "answers")

ROUNDING = "The answer is one number by a formula or by a root to rounding, so 1e-12 or so may differ."


# --- a disc on a road ---------------------------------------------------------------------------------------


def disc(x, y, radius, a):
    return {"centre": np.array([x, y], dtype=float), "radius": float(radius), "a": float(a)}


def above(stream, distance=None):
    """A disc off the axis, over the road's upper side; its radius and curvature leave one nearest point."""
    a, r, s = stream.uniform(0.2, 0.8), stream.uniform(0.1, 0.4), stream.choice([-1, 1])
    x = s * stream.uniform(0.2, 1.0)
    far = r + (stream.uniform(-0.05, 0.2) if distance is None else distance)
    normal = np.array([-2 * a * x, 1]) / np.hypot(1, 2 * a * x)
    return disc(*(np.array([x, a * x * x]) + far * normal), r, a)


def discs(stream):
    for _ in range(5):
        yield Case("a disc near the road", above(stream))


GAP = Check(
    name="gap",
    title="the gap of a disc over a parabola",
    points=20,
    visible=(
        Case("a flat road", disc(0.7, 1.0, 0.4, 0)),
        Case("over the lowest point", disc(0, 0.5, 0.4, 0.5)),
        Case("on the right slope", disc(0.6, 0.75, 0.2, 0.8)),
        Case("an overlap: the gap is negative", disc(-0.8, 0.7, 0.3, 0.7)),
    ),
    hidden=lambda stream: list(discs(stream)),
    judge=equal(right.gap, 1e-8),
    why="The nearest point is a root of a cubic: by Newton's method or numpy.roots it is right to 1e-12.",
    form="(a number, an array (2,), an array (2,))",
    section="Gap and frame",
    causes=(
        cause_like(
            "The point is straight below the centre: the nearest point is where the normal leads to it.",
            lambda v: right.gap(v, below=True),
        ),
        cause_like(
            "The normal points into the road: from the road to the disc.", lambda v: right.gap(v, turned=-1.0)
        ),
        cause_like(
            "The radius is not taken off: the gap is between the surfaces.",
            lambda v: right.gap(v, radius=0.0),
        ),
    ),
    hint="The derivative of the squared distance by x: (x − c_x) + 2 a x (a x² − c_y) = 0. Of its real roots "
    "the nearest counts.",
)

ROWS = Check(
    name="rows",
    title="the rows of that contact",
    points=15,
    visible=(
        Case("a flat road", disc(0.7, 0.4, 0.4, 0)),
        Case("on the right slope, with a gap", disc(0.6, 0.75, 0.2, 0.8)),
    ),
    hidden=lambda stream: list(discs(stream)),
    judge=equal(right.rows, 1e-8),
    why=ROUNDING,
    form="an array (2, 3)",
    section="Gap and frame",
    causes=(
        cause_like(
            "The tangent's sign: t is n turned by a quarter anticlockwise, (−n_y, n_x).",
            lambda v: right.rows(v, tangent=-1.0),
        ),
        cause_like(
            "The moment's sign: r = −ρ n leads from the centre to the point, and r × t = −ρ.",
            lambda v: right.rows(v, moment=-1.0),
        ),
        cause_like(
            "The arm ends on the disc: the contact's point is half way between the surfaces.",
            lambda v: right.rows(v, arm=lambda r, size: r),
        ),
    ),
    hint="r = −(radius + gap/2) n from the centre; the rows are (e, r × e) with r × e = r_x e_y − r_y e_x.",
)


def moving(where, u, mass=1.0, mu=0.5, dt=0.01):
    return {**where, "u": np.array(u, dtype=float), "mass": mass, "mu": mu, "dt": dt}


def movements(stream):
    for k in range(6):
        where = above(stream, distance=(0.0, 0.0, 0.002, 0.005, 0.3, 0.0)[k])
        u = np.round(stream.uniform(-1, 1, 3), 2) * [1, 1, 5]
        μ = round(stream.uniform(0.1, 0.9), 2)
        yield Case("any motion", moving(where, u, round(stream.uniform(0.5, 3), 2), μ))


AFTER = Check(
    name="after",
    title="one step with contact",
    points=20,
    visible=(
        Case("far above: free fall", moving(disc(0, 1, 0.2, 0), [1, 0, 3])),
        Case("at rest on a flat road", moving(disc(0, 0.2, 0.2, 0), [0, 0, 0])),
        Case("slides on a flat road", moving(disc(0, 0.2, 0.2, 0), [2, 0, 0], mu=0.3)),
        Case("a small gap may be used up", moving(disc(0, 0.205, 0.2, 0), [0, -1, 0])),
        Case("leaves the road", moving(disc(0, 0.2, 0.2, 0), [0, 1, 0])),
    ),
    hidden=lambda stream: list(movements(stream)),
    judge=equal(right.after, 1e-8),
    why=ROUNDING,
    form="an array (3,)",
    section="One step",
    causes=(
        cause_like("The contact pulls: λ_n must not be negative.", lambda v: right.after(v, pulls=True)),
        cause_like(
            "The gap is left out: w_n ≥ −gap/Δt, so the disc may come as near as just to touch.",
            lambda v: right.after(v, closing=False),
        ),
        cause_like(
            "Friction is not limited: |λ_t| ≤ μ λ_n; beyond it slides.", lambda v: right.after(v, clip=False)
        ),
        cause_like(
            "The limit is μ times the weight's impulse: it is μ λ_n, of the same step.",
            lambda v: right.after(v, limit=lambda v, h: v["mass"] * right.G * h),
        ),
        cause_like("A disc has I = ½ m r², not m r².", lambda v: right.after(v, disc=1.0)),
    ),
    hint="The two rows don't disturb each other: A_nt = 0, as the normal passes through the centre. So λ_n = "
    "max(0, −(w_n + gap/Δt)/A_nn) first, then λ_t = −w_t/A_tt clipped to ±μ λ_n.",
)


def rolling(x, radius, a, dt=0.002, steps=250):
    normal = np.array([-2 * a * x, 1]) / np.hypot(1, 2 * a * x)
    return {**disc(*(np.array([x, a * x * x]) + radius * normal), radius, a), "dt": dt, "steps": steps}


def swings(stream):
    for _ in range(3):
        a, r, x = stream.uniform(0.3, 0.6), stream.uniform(0.1, 0.3), stream.uniform(0.3, 0.5)
        yield Case("another road", rolling(*(round(float(value), 2) for value in (x, r, a)), steps=200))


ROLL = Check(
    name="roll",
    title="rolling down a road, against mechanics",
    points=15,
    visible=(
        Case("half a second", rolling(0.5, 0.2, 0.5)),
        Case("a second", rolling(-0.4, 0.1, 0.5, steps=500)),
    ),
    hidden=lambda stream: list(swings(stream)),
    judge=equal(right.rolled, 2.5e-5),
    why="The steps are of first order: at Δt = 2 ms one run is off by half a millimetre. What is left after "
    "extrapolation is of second order, 2e-6 at most. The answer is that of a smooth motion with one "
    "coordinate, which SciPy integrates to 1e-9.",
    form="an array (2,)",
    section="One step",
    causes=(
        cause(
            "The disc slides without turning: with μ = 1 it rolls, and half of its mass counts once more.",
            lambda v, verdict: np.abs(right.rolled(v, inertia=0.0) - verdict.got).max() < 0.005,
        ),
        cause(
            "It is off as one run of first order is: return 2 fine − coarse.",
            lambda v, verdict: 1e-4 < np.abs(right.rolled(v) - verdict.got).max() < 3e-3,
        ),
        cause(
            "The disc stays where it was: carry u from step to step, and move the centre by dt u⁺.",
            lambda v, verdict: np.abs(v["centre"] - verdict.got).max() < 0.02,
        ),
    ),
    hint="A run begins at rest; in each step u = after(…), then centre += dt (u_x, u_y); mass, mu 1. "
    "Do it with dt and steps, and with dt/2 and 2 steps: return 2 fine − coarse.",
    after=("after",),
)


# --- friction that depends on the direction -----------------------------------------------------------------


def slip(w, mu, normal=2.0):
    return {"w": np.array(w, dtype=float), "mu": np.array(mu, dtype=float), "normal": normal}


def slips(stream):
    for _ in range(5):
        w, μ = np.round(stream.uniform(-2, 2, 2), 2) + 0.001, np.round(stream.uniform(0.1, 1, 2), 2)
        μ[1] = μ[0] * stream.choice([0.3, 3])
        yield Case("any sliding", slip(w, μ, round(float(stream.uniform(0.5, 4)), 2)))


SLIDING = Check(
    name="sliding",
    title="kinetic friction of a grained floor",
    points=10,
    visible=(
        Case("isotropic: straight against w", slip([3, 4], [0.5, 0.5])),
        Case("along the grain", slip([1, 0], [0.2, 0.8])),
        Case("askew", slip([1, 1], [0.2, 0.8])),
        Case("no sliding: no kinetic friction", slip([0, 0], [0.2, 0.8])),
    ),
    hidden=lambda stream: list(slips(stream)),
    judge=equal(right.sliding, 1e-10),
    why=ROUNDING,
    form="an array (2,)",
    section="Friction in space: cone, pyramid, box",
    causes=(
        cause_like(
            "It must be against the sliding: a minus is missing.", lambda v: right.sliding(v, sign=1.0)
        ),
        cause_like(
            "It is straight against w: the λ_t with the least λ_t·w is where w is a normal of the ellipse.",
            right.opposite,
        ),
        cause_like(
            "μ_1 and μ_2 stand in the numerator squared: λ_1 = −λ_n μ_1² w_1/√(μ_1² w_1² + μ_2² w_2²).",
            lambda v: right.sliding(v, power=1),
        ),
    ),
    hint="Lagrange: w + τ (λ_1/μ_1², λ_2/μ_2²) = 0 with λ on the ellipse.",
)


def pulled(pull, mu, normal=1.0, angle=None):
    values = {"pull": np.array(pull, dtype=float), "mu": np.array(mu, dtype=float), "normal": normal}
    return values if angle is None else {**values, "angle": angle}


def pulls(stream, grain=False):
    for _ in range(5):
        p, μ = np.round(stream.uniform(0.5, 2, 2) * stream.choice([-1, 1], 2), 2), stream.uniform(0.3, 0.5)
        angle = round(float(stream.uniform(0.2, 1.3)), 2) if grain else None
        yield Case(
            "any pull",
            pulled(p, [round(μ, 2), round(2 * μ, 2)], round(float(stream.uniform(0.5, 1)), 2), angle),
        )


HOLDING = Check(
    name="holding",
    title="the friction under a pull: sticking or not",
    points=15,
    visible=(
        Case("it sticks", pulled([0.1, -0.3], [0.4, 0.8])),
        Case("isotropic, slides", pulled([3, 4], [0.5, 0.5])),
        Case("straight along one direction", pulled([2, 0], [0.4, 0.8])),
        Case("askew", pulled([1, 1], [0.4, 0.8])),
    ),
    hidden=lambda stream: list(pulls(stream)),
    judge=equal(right.holding, 1e-7),
    why="One equation in one unknown, which bisection solves to rounding in 60 halvings.",
    form="an array (2,)",
    section="Friction in space: cone, pyramid, box",
    causes=(
        cause_like(
            "The pull is shortened: the point of the ellipse nearest to −pull lies elsewhere.",
            right.shortened,
        ),
        cause_like("Each component is clipped by itself: that is the box.", right.boxed),
    ),
    hint="With s = λ_n μ: λ_k = −s_k² p_k/(s_k² + τ). Find τ ≥ 0 with (λ_1/s_1)² + (λ_2/s_2)² = 1.",
)

GRAINED = Check(
    name="grained",
    title="the same with the grain at an angle",
    points=5,
    visible=(
        Case("no angle", pulled([1, 1], [0.4, 0.8], angle=0.0)),
        Case(
            "a quarter turn: the two coefficients change places", pulled([2, 0], [0.4, 0.8], angle=np.pi / 2)
        ),
        Case("askew", pulled([1, 0.5], [0.4, 0.8], angle=0.6)),
    ),
    hidden=lambda stream: list(pulls(stream, grain=True)),
    judge=equal(right.grained, 1e-7),
    why="A rotation there and back adds rounding only.",
    form="an array (2,)",
    section="Friction in space: cone, pyramid, box",
    causes=(
        cause_like(
            "The answer is still in the grain's frame: turn it back.", lambda v: right.grained(v, back=0.0)
        ),
        cause_like(
            "The pull is turned the wrong way: into the grain's frame by minus the angle, back by plus.",
            lambda v: right.grained(v, there=-1.0, back=-1.0),
        ),
    ),
    hint="Turn the pull by −angle, use holding, turn the friction by +angle.",
    after=("holding",),
)

CHECKS = (GAP, ROWS, AFTER, ROLL, SLIDING, HOLDING, GRAINED)
