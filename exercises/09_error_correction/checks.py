"""The checks of exercise 09, error correction (slide S13). Grader's side only."""

import numpy as np

import exercises
from exercises.grader.check import Call, Case, Check, cause, cause_like
from exercises.grader.judges import all_of, equal, fitted_order, on_answer

right = exercises.part("09_error_correction", "answers")
engines = exercises.part("09_error_correction", "engines")
number = engines.number

ROUNDING = "The answer is a formula, so only rounding may differ."
FEEDBACK, SPLIT, SOFT = "Baumgarte: a share of the gap", "Split impulse", "Soft constraints"


# --- A. Baumgarte's pendulum --------------------------------------------------------------------------------


def pendulum(x, v, alpha, beta, length=1.0):
    return {
        "x": np.array(x, dtype=float),
        "v": np.array(v, dtype=float),
        "length": length,
        "alpha": float(alpha),
        "beta": float(beta),
    }


def any_pendulum(stream, off=(0.02, 0.1)):
    """Off the rod's length and leaving it, swinging round at a good speed, at any angle but the upright."""
    length, angle = number(stream, 0.6, 1.5), number(stream, -2.5, -0.5)
    n = np.array([np.cos(angle), np.sin(angle)])
    r = length + number(stream, *off) * float(stream.choice([-1, 1]))
    rate, across = number(stream, 0.2, 0.6), number(stream, 1, 2) * float(stream.choice([-1, 1]))
    v = rate * n + across * np.array([-n[1], n[0]])
    return pendulum(r * n, v, number(stream, 3, 6), number(stream, 7, 10), length)


ACCELERATION = Check(
    name="acceleration",
    title="a pendulum whose rod comes back to its length, at the level of accelerations",
    points=15,
    visible=(
        Case("hangs still, and fits: no acceleration", pendulum([0, -1], [0, 0], 5, 5)),
        Case("let go from the horizontal, fits: free fall", pendulum([1, 0], [0, 0], 5, 5)),
        Case("goes round at 2 m/s: the centripetal acceleration", pendulum([0, -1], [2, 0], 5, 5)),
        Case("hangs still, 5 cm too long", pendulum([0, -1.05], [0, 0], 4, 8)),
        Case("fits, but is getting longer", pendulum([0, -1], [0, -0.5], 4, 8)),
    ),
    hidden=lambda stream: [Case("any motion", any_pendulum(stream)) for _ in range(6)],
    judge=equal(right.acceleration, 1e-9),
    why=ROUNDING,
    form="an array (2,)",
    section=FEEDBACK,
    causes=(
        cause_like(
            "J̇u is left out: n turns with the point, which is (|v|² − φ̇²)/|x|.",
            lambda v: right.acceleration(v, turning=0.0),
        ),
        cause_like(
            "Gravity's pull along the rod is still there: λ must make up for n·g, too.",
            lambda v: right.acceleration(v, weight=0.0),
        ),
        cause_like(
            "The damping lacks its factor 2: φ̈ + 2 α φ̇ + β² φ = 0.",
            lambda v: right.acceleration(v, damping=1.0),
        ),
        cause_like(
            "The gap is widened: λ leads φ̈ to −β² φ, back.", lambda v: right.acceleration(v, stiffness=-1.0)
        ),
        cause_like("φ̇ is n·v, not the speed |v|.", lambda v: right.acceleration(v, speed=True)),
    ),
    hint="n = x/|x|; φ̈ = n·ẍ + (|v|² − (n·v)²)/|x|; ẍ = g + λ n, mass 1. Solve φ̈ = −2 α φ̇ − β² φ for λ.",
)

DT = 0.01  # s; the order is fitted at DT, DT/2, DT/4


def swung(where, steps=20):
    return {**where, "dt": DT, "steps": steps}


def swing_calls(v):
    start = tuple(v[key] for key in ("x", "v", "length", "alpha", "beta"))
    return [Call("swing", (*start, v["dt"] / 2**k, v["steps"] * 2**k)) for k in range(3)]


def decay_errors(v, answers):
    """How far φ and φ̇/β are from the damped oscillation that they must be, whatever else happens."""
    exact, sizes = right.decay(v), []
    for x, speed in answers:
        x, speed = np.asarray(x, dtype=float), np.asarray(speed, dtype=float)
        r = np.hypot(*x)
        with np.errstate(invalid="ignore", divide="ignore"):  # a point at the origin has no rate: NaN
            off = np.array([r - v["length"], x @ speed / r]) - exact
        sizes.append(float(np.hypot(off[0], off[1] / v["beta"])))
    return [v["dt"] / 2**k for k in range(3)], sizes


SWING = Check(
    name="swing",
    title="a swing on that rod: the gap decays as it must, and the order",
    points=15,
    calls=swing_calls,
    visible=(
        Case("critically damped, α = β", swung(pendulum([1.05, 0], [0, 0], 8, 8))),
        Case("hardly damped: the gap swings, too", swung(pendulum([0.6, -0.85], [1, 1], 2, 10))),
        Case("overdamped", swung(pendulum([0.95, 0.1], [0, 0.5], 8, 4))),
    ),
    hidden=lambda stream: [Case("any swing", swung(any_pendulum(stream))) for _ in range(4)],
    judge=all_of(on_answer(0, equal(right.swing, 1e-9)), fitted_order(decay_errors, 4, 0.5)),
    why="The scheme is given, so only rounding may differ. The order is that of the gap's error against the "
    "solution of φ̈ + 2 α φ̇ + β² φ = 0, 4 to within 0.01 at these steps; with Euler's method, or λ held over "
    "a step, it is near 1.",
    form="two values, (x, v): arrays (2,)",
    section=FEEDBACK,
    after=("acceleration",),
    causes=(
        cause_like("α and β have changed places.", lambda v: right.swing(v, swapped=True)),
        cause_like("This is Euler's method: given.rk4 does a step.", lambda v: right.swing(v, "euler")),
        cause_like(
            "λ is held over the whole step: find it anew in each stage of rk4.",
            lambda v: right.swing(v, "held"),
        ),
    ),
    hint="y = (x, v) with the rate (v, acceleration(…)), whose α and β stay; given.rk4(rate, y, dt).",
)


# --- B. compliant links -------------------------------------------------------------------------------------


def links(x, lam, inverse, compliance, dt=0.05, length=1.0):
    return {
        "x": np.array(x, dtype=float),
        "lam": np.array(lam, dtype=float),
        "inverse": np.array(inverse, dtype=float),
        "length": length,
        "compliance": compliance,
        "dt": dt,
    }


def zigzag(stream, n, length):
    """Points of a chain of n links, each somewhat too long or too short, and the inverse masses, one held."""
    angles, sizes = stream.uniform(-1.2, 1.2, n), length * stream.uniform(1.1, 1.4, n)
    steps = sizes[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
    x = np.round(np.vstack([np.zeros(2), np.cumsum(steps, axis=0)]), 3)
    return x, np.concatenate([[0.0], np.round(stream.uniform(0.5, 2, n), 3)])


def any_links(stream):
    n, length = int(stream.integers(3, 6)), number(stream, 0.5, 1)
    x, inverse = zigzag(stream, n, length)
    λ = np.round(stream.uniform(-0.3, -0.1, n), 3)
    return links(x, λ, inverse, number(stream, 0.001, 0.003), number(stream, 0.02, 0.05), length)


RELAX = Check(
    name="relax",
    title="one sweep over links that give (XPBD)",
    points=20,
    visible=(
        Case("two equal points, no compliance: each half", links([[0, 0], [1.2, 0]], [0], [1, 1], 0.0)),
        Case("the first one is held", links([[0, 0], [0, -1.2]], [0], [0, 1], 0.0)),
        Case("compliance: not all of it", links([[0, 0], [1.2, 0]], [0], [1, 1], 0.005)),
        Case("λ has balanced the gap: nothing moves", links([[0, 0], [1.2, 0]], [-0.4], [1, 1], 0.00125)),
        Case(
            "two links, one after the other", links([[0, 0], [1.2, 0], [1.2, 1.2]], [0, 0], [0, 1, 2], 0.001)
        ),
    ),
    hidden=lambda stream: [Case("any chain", any_links(stream)) for _ in range(5)],
    judge=equal(right.relax, 1e-10),
    why=ROUNDING,
    form="two values, (x, lam): arrays (n + 1, 2) and (n,)",
    section=SOFT,
    causes=(
        cause_like("The compliance must be divided by dt².", lambda v: right.relax(v, squared=False)),
        cause_like(
            "α̃ λ is missing in the numerator: without it a link grows stiffer with every sweep.",
            lambda v: right.relax(v, memory=0.0),
        ),
        cause_like(
            "Both ends move alike: each moves by its inverse mass.", lambda v: right.relax(v, weighed=False)
        ),
        cause_like("The link is stretched further: a sign.", lambda v: right.relax(v, sign=-1.0)),
        cause_like(
            "All links look at the old positions: each link sees what the one before has moved.",
            lambda v: right.relax(v, at_once=True),
        ),
    ),
    hint="d = x[k+1] − x[k]; Δ = −(|d| − length + α̃ λ_k)/(w_k + w_{k+1} + α̃), α̃ = compliance/dt²; λ_k += Δ; "
    "x[k] −= w_k Δ d/|d|, x[k+1] += w_{k+1} Δ d/|d|.",
)


def hung(x, v, inverse, compliance, dt, sweeps, length=1.0):
    return {
        "x": np.array(x, dtype=float),
        "v": np.array(v, dtype=float),
        "inverse": np.array(inverse, dtype=float),
        "length": length,
        "compliance": compliance,
        "dt": dt,
        "sweeps": sweeps,
    }


ENOUGH = 300  # sweeps: what is left after them is rounding, for the vertical chains below


def straight_down(stream):
    n, length = int(stream.integers(2, 4)), number(stream, 0.5, 1)
    y = -np.cumsum(np.concatenate([[0], np.round(stream.uniform(1, 1.3, n) * length, 3)]))
    v = np.column_stack([np.zeros(n + 1), np.concatenate([[0], np.round(stream.uniform(-1, 1, n), 3)])])
    inverse = np.concatenate([[0.0], np.round(stream.uniform(0.5, 2, n), 3)])
    x = np.column_stack([np.zeros(n + 1), y])
    return hung(x, v, inverse, number(stream, 0.005, 0.02), number(stream, 0.05, 0.1), ENOUGH, length)


def any_chain(stream):
    n, length = int(stream.integers(3, 6)), number(stream, 0.5, 1)
    x, inverse = zigzag(stream, n, length)
    v = np.where(inverse[:, None] > 0, np.round(stream.uniform(-1, 1, (n + 1, 2)), 3), 0)
    dt = number(stream, 0.03, 0.06)
    return hung(x, v, inverse, number(stream, 0.002, 0.01), dt, int(stream.integers(2, 5)), length)


def chain_answer(v):
    """Where the sweeps have converged and the chain hangs straight down, a linear system knows the answer."""
    return right.implicit(v) if v["sweeps"] == ENOUGH else right.chain(v)


DOWN = np.array([[0, 0], [0, -1], [0, -2], [0, -3]])
CHAIN = Check(
    name="chain",
    title="one step of a chain of such links",
    points=10,
    visible=(
        Case(
            "free fall: two points without a held one",
            hung([[0, 0], [1, 0]], [[1, 0], [1, 0]], [1, 1], 0.01, 0.1, 1),
        ),
        Case(
            "a rigid pendulum from the horizontal",
            hung([[0, 0], [1, 0]], np.zeros((2, 2)), [0, 1], 0.0, 0.1, 1),
        ),
        Case(
            "three links, straight down, converged",
            hung(DOWN, np.zeros((4, 2)), [0, 1, 1, 2], 0.01, 0.1, ENOUGH),
        ),
        Case(
            "a zigzag, three sweeps",
            hung([[0, 0], [1, 0.3], [2, 0], [3, 0.3]], np.zeros((4, 2)), [0, 1, 1, 1], 0.002, 0.05, 3),
        ),
    ),
    hidden=lambda stream: [
        *(Case("any chain", any_chain(stream)) for _ in range(4)),
        *(Case("straight down, converged", straight_down(stream)) for _ in range(3)),
    ],
    judge=equal(chain_answer, 1e-8),
    why="The sweeps are given, so only rounding may differ, divided by dt in the velocity. Converged, and "
    "straight down, the step is implicit Euler on springs, which one linear system solves; 300 sweeps leave "
    "less than 1e-12.",
    form="three values, (x, v, lam): arrays (n + 1, 2), (n + 1, 2), (n,)",
    section=SOFT,
    after=("relax",),
    causes=(
        cause_like(
            "The velocity is the predicted one: it is what the points have really moved, over dt.",
            lambda v: right.chain(v, predicted=True),
        ),
        cause_like(
            "λ must be 0 at the step's start only, not at each sweep's.", lambda v: right.chain(v, kept=True)
        ),
        cause_like(
            "The held point has fallen: an inverse mass of 0 means that it stays.",
            lambda v: right.chain(v, held=False),
        ),
    ),
    hint="Free flight: v + dt g for all but held points, x + dt v; then sweeps of relax, λ from 0; then "
    "v = Δx/dt.",
)


def hanging(mass, compliance, dt=1.0, length=1.0):
    return {"mass": np.array(mass, dtype=float), "length": length, "compliance": compliance, "dt": dt}


def any_hanging(stream):
    mass = np.round(stream.uniform(0.5, 2, int(stream.integers(2, 4))), 3)
    return hanging(mass, number(stream, 0.02, 0.04), number(stream, 0.6, 1.0), number(stream, 0.5, 1))


HANG = Check(
    name="hang",
    title="a chain at rest: each link bears what hangs below it",
    points=10,
    visible=(
        Case("one mass", hanging([1.0], 0.02)),
        Case("the same with another dt: the same stretch and force", hanging([1.0], 0.02, 0.5)),
        Case("three masses, the heaviest at the bottom", hanging([1.0, 0.5, 2.0], 0.02)),
    ),
    hidden=lambda stream: [Case("any chain", any_hanging(stream)) for _ in range(3)],
    judge=equal(right.hang, 1e-4),
    why="At rest it is statics: the force is the weight below, the stretch is compliance times that. Steps "
    "until all speeds are below 1e-8 m/s, of 100 sweeps each, leave less than 1e-5.",
    form="two values, (stretch, tension): arrays (n,), m and N",
    section=SOFT,
    after=("chain",),
    causes=(
        cause_like(
            "A link that is pulled has a tension of plus: λ is negative where it pulls.",
            lambda v: right.hang(v, sign=-1.0),
        ),
        cause_like("λ/dt is an impulse: the force is λ/dt².", lambda v: right.hang(v, power=1)),
        cause_like("λ is not the force: it has dt² in it.", lambda v: right.hang(v, power=0)),
        cause(
            "It still swings: step on until all speeds are below 1e-8 m/s.",
            lambda v, verdict: 1e-7 < np.abs(np.asarray(verdict.got[0]) - right.hang(v)[0]).max() < 0.5,
        ),
    ),
    hint="Start straight down with links of length, v = 0; chain with 100 sweeps; end when |v| < 1e-8; the "
    "stretch from the positions, the tension from λ.",
)


# --- C. an engine's corrections -----------------------------------------------------------------------------

PIN = Check(
    name="pin",
    title="a stretched joint, as pymunk corrects it",
    points=15,
    visible=tuple(Case(label, inputs) for label, inputs in engines.PINS.items()),
    hidden=lambda stream: [Case("any pair", engines.any_pin(stream)) for _ in range(6)],
    judge=equal(engines.PIN, 1e-8),
    source=engines.PIN.source,
    why="With one joint pymunk's iteration is done after one go: the two agree to rounding.",
    form="two values, (x, v): arrays (2,)",
    section=FEEDBACK,
    causes=(
        cause_like(
            "error_bias is what is left after a second: a step takes back the share 1 − error_bias^dt.",
            lambda v: right.pin(v, power=False),
        ),
        cause_like(
            "The correction is a velocity: the share of the gap must be divided by dt.",
            lambda v: right.pin(v, per_dt=False),
        ),
        cause_like("The gap is widened: the bodies must come together.", lambda v: right.pin(v, sign=1.0)),
        cause_like("max_bias is the fastest that it corrects.", lambda v: right.pin(v, limit=False)),
        cause_like(
            "Both bodies get the same: the heavy one moves less.", lambda v: right.pin(v, weighed=False)
        ),
        cause_like(
            "pymunk moves the positions first, with the velocities before the step.",
            lambda v: right.pin(v, order="new"),
        ),
        cause_like(
            "The correcting velocity is taken away again: pymunk's joints keep it.",
            lambda v: right.pin(v, gone=True),
        ),
    ),
    hint="In a step: x += dt v; φ = x[1] − x[0] − length; v[1] − v[0] becomes −share φ/dt, no faster than "
    "max_bias; momentum stays.",
)

LIFT = Check(
    name="lift",
    title="two discs lifted apart, as pymunk does it",
    points=15,
    visible=tuple(Case(label, inputs) for label, inputs in engines.LIFTS.items()),
    hidden=lambda stream: [Case("any pair", engines.any_lift(stream)) for _ in range(6)],
    judge=equal(engines.LIFT, 1e-8),
    source=engines.LIFT.source,
    why="With one contact pymunk's iteration is done after one go: the two agree to rounding.",
    form="two values, (x, v): arrays (2,)",
    section=SPLIT,
    causes=(
        cause_like(
            "The correcting velocity stays: it moves the positions once, and is forgotten.",
            lambda v: right.lift(v, stays=True),
        ),
        cause_like(
            "The slop is left alone: only what is deeper counts.", lambda v: right.lift(v, slop=False)
        ),
        cause_like(
            "bias is what is left after a second: a step takes back the share 1 − bias^dt.",
            lambda v: right.lift(v, power=False),
        ),
        cause_like(
            "Both discs move alike: the heavy one moves less.", lambda v: right.lift(v, weighed=False)
        ),
        cause_like(
            "The contact pulls: discs that leave each other may.", lambda v: right.lift(v, pulls=True)
        ),
        cause_like(
            "pymunk moves the positions first, with the velocities before the step.",
            lambda v: right.lift(v, order="new"),
        ),
    ),
    hint="In a step: x += dt (v + p), p = 0; if they overlap: make v[1] − v[0] at least 0, and p[1] − p[0] = "
    "share (depth − slop)/dt, or 0. Both keep the momentum.",
)


CHECKS = (ACCELERATION, SWING, RELAX, CHAIN, HANG, PIN, LIFT)
