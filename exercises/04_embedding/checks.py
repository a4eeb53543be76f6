"""The checks of exercise 04, embedding (slides S8–S9). Grader's side only."""

import numpy as np

import exercises
from exercises.grader.check import Call, Case, Check, cause, cause_like
from exercises.grader.judges import all_of, equal, fitted_order, on_answer

right = exercises.part("04_embedding", "answers")
engines = exercises.part("04_embedding", "engines")
given = right.given

ROUNDING = "Both sides do the same few dozen operations, so only rounding, about 1e-15, may differ."


def number(stream, low, high):
    return round(float(stream.uniform(low, high)), 3)


def vector(stream, size, low=-2.0, high=2.0):
    """Three decimals, so that a case can be pasted."""
    return np.round(stream.uniform(low, high, size), 3)


# --- the rope: shape ----------------------------------------------------------------------------------------

PULLEYS = np.array([0.0, 0.0, 1.5, 0.0])


def hung(x, u=(0.0,) * 4, pulleys=PULLEYS):
    return {"x": np.array(x, dtype=float), "u": np.array(u, dtype=float), "pulleys": np.array(pulleys)}


def hanging(stream):
    """Two points below their pulleys, askew, at 0.6 to 1.6 m."""
    angle, r = stream.uniform(0.2, 0.8, 2) * stream.choice([-1, 1], 2), stream.uniform(0.6, 1.6, 2)
    pulleys = vector(stream, 4, -1, 1) + [-1.0, 0, 1.0, 0]
    offset = np.stack([r * np.sin(angle), -r * np.cos(angle)], axis=1).ravel()
    return np.round(pulleys + offset, 3), pulleys


def ropes(stream):
    for _ in range(6):
        x, pulleys = hanging(stream)
        yield Case("any places, any velocities", hung(x, vector(stream, 4), pulleys))


ROPE = Check(
    name="rope",
    title="the rope's row of J, and J̇ u",
    points=15,
    visible=(
        Case("straight down, one sinks and the other rises", hung([0, -1, 1.5, -2], [0, -0.5, 0, 0.5])),
        Case("the first swings through its lowest point", hung([0, -2.0, 1.5, -1.0], [3.0, 0, 0, 0])),
        Case("both askew", hung([-0.6, -0.8, 1.8, -1.2], [0.5, 0.2, -0.4, 1.0])),
    ),
    hidden=lambda stream: list(ropes(stream)),
    judge=equal(right.rope, 1e-11),
    why=ROUNDING,
    form="two values, (J, rate): an array of 4, and a number in m/s²",
    section="Bias terms",
    causes=(
        cause_like("J̇u is left out: J turns with the offsets.", lambda v: right.rope(v, turning=0)),
        cause_like(
            "J̇u has the wrong sign: turning makes the rope need more length.", lambda v: right.rope(v, -1)
        ),
        cause_like(
            "The part of u along the rope doesn't turn n: only |u|² − (n·u)² counts.",
            lambda v: right.rope(v, along=1),
        ),
        cause_like(
            "The second half of J has the wrong sign: both lengths add up.", lambda v: right.rope(v, side=-1)
        ),
        cause_like("The row holds offsets: divide by their lengths.", lambda v: right.rope(v, unit=False)),
    ),
    hint="n = offset/r with r = |offset|; J = (n_1, n_2); rate is the sum of (|u|² − (n·u)²)/r over both.",
)


# --- A and b: limiting cases --------------------------------------------------------------------------------


def system(J, mass, force, rate=None):
    J = np.array(J, dtype=float)
    rate = np.zeros(len(J)) if rate is None else np.array(rate, dtype=float)
    return {"J": J, "mass": np.array(mass, dtype=float), "force": np.array(force, dtype=float), "rate": rate}


def systems(stream):
    for m, n in ((1, 4), (2, 5), (3, 6), (2, 3), (4, 8)):
        J = vector(stream, (m, n))
        yield Case(
            "any rows",
            system(J, vector(stream, n, 0.3, 4), vector(stream, n, -9, 9), vector(stream, m, 1, 5)),
        )


EMBED = Check(
    name="embed",
    title="A and b at the level of accelerations",
    points=15,
    visible=(
        Case(
            "Atwood's machine, 1 and 3 kg, straight down: −b/A is the rope's pull, −14.715 N",
            system([[0, -1, 0, -1]], [1, 1, 3, 3], [0, -9.81, 0, -29.43]),
        ),
        Case(
            "a differential: one row for three shafts, ω_1 + ω_2 − 2 ω_3 = 0",
            system([[1, 1, -2]], [0.5, 0.5, 2.0], [3.0, 0, -1.0]),
        ),
        Case(
            "a movable pulley between two others, and a rod",
            system([[1, 2, 1], [0, 1, -1]], [1.0, 2.0, 4.0], [-9.81, -19.62, -39.24], [0.2, -0.5]),
        ),
    ),
    hidden=lambda stream: list(systems(stream)),
    judge=equal(right.embed, 1e-11),
    why=ROUNDING,
    form="two values, (A, b): arrays of shape (m, m) and (m,)",
    section="Multiply by J M⁻¹",
    causes=(
        cause_like("J̇u is left out of b.", lambda v: right.embed(v, rate=0)),
        cause_like("J̇u has the wrong sign in b: w's rate is J u̇ + J̇u.", lambda v: right.embed(v, rate=-1)),
        cause_like("A = J Jᵀ: the masses are left out.", lambda v: right.embed(v, inverse=0)),
        cause_like("A was made with M, not with M⁻¹.", lambda v: right.embed(v, inverse=1)),
        cause_like(
            "b has J f_e: the force is not yet divided by the masses.", lambda v: right.embed(v, weight=False)
        ),
    ),
    hint="A = J M⁻¹ Jᵀ; b = J M⁻¹ f_e + J̇u, the acceleration that w would have with no constraint force.",
)


# --- redundant rows -----------------------------------------------------------------------------------------


def redundant(J, mass, pull):
    J = np.array(J, dtype=float)
    A = (J / np.array(mass, dtype=float)) @ J.T
    return {"A": A, "b": A @ np.array(pull, dtype=float)}


def redundancies(stream):
    for m, n, rank in ((2, 4, 1), (3, 5, 2), (4, 6, 2), (5, 6, 3), (3, 5, 3)):
        rows = np.eye(n)[:rank] * 1.5 + vector(stream, (rank, n), -0.5, 0.5)
        mixed = np.vstack([np.eye(rank), stream.uniform(0.5, 1.5, (m - rank, rank))])
        yield Case(
            f"{m} rows of rank {rank}",
            redundant(mixed @ rows, stream.uniform(1, 3, n), vector(stream, m, 5, 9)),
        )


SHORTEST = Check(
    name="shortest",
    title="λ of redundant rows: the shortest",
    points=15,
    visible=(
        Case("not redundant", redundant([[1, 0, 1], [0, 1, -1]], [1, 2, 3], [4, 5])),
        Case("two ropes side by side share alike", redundant([[1, 1], [1, 1]], [1, 3], [6, 2])),
        Case("the second row is twice the first", redundant([[1, 1], [2, 2]], [1, 3], [6, 2])),
        Case(
            "the third row is the sum of the others",
            redundant([[1, 0, 1], [0, 1, -1], [1, 1, 0]], [1, 2, 3], [4, 5, 6]),
        ),
    ),
    hidden=lambda stream: list(redundancies(stream)),
    judge=equal(right.shortest, 1e-8),
    why="A pseudo-inverse loses digits as its singular values' ratio, up to a thousand here: about 1e-12.",
    form="an array of m numbers",
    section="Redundant joints",
    causes=(
        cause_like("The sign is wrong: A λ + b = 0.", lambda v: right.shortest(v, sign=1)),
        cause_like(
            "Rows that depend on others were left out: their λ is not 0 in the shortest.", right.basic
        ),
        cause_like(
            "Something was added to A's diagonal: that makes it regular, and the answer wrong.",
            lambda v: right.shortest(v, softening=1e-3),
        ),
    ),
    hint="Use A's eigenvalues (or np.linalg.lstsq, np.linalg.pinv), and count what is below 1e-10 of the "
    "largest as 0.",
)


# --- one step -----------------------------------------------------------------------------------------------


def stepping(x, u, J, mass, force, phi, dt=0.01, share=0.2):
    arrays = {"x": x, "u": u, "J": J, "mass": mass, "force": force, "phi": phi}
    return {**{name: np.array(a, dtype=float) for name, a in arrays.items()}, "dt": dt, "share": share}


def steps(stream):
    for m, n in ((1, 4), (2, 5), (3, 6), (1, 3), (2, 4)):
        J, phi = vector(stream, (m, n)) + np.eye(m, n), vector(stream, m, 0.01, 0.05)
        x, u, mass, force = (
            vector(stream, n),
            vector(stream, n, 1, 2),
            vector(stream, n, 1, 3),
            vector(stream, n, 5, 9),
        )
        yield Case(
            "any rows",
            stepping(x, u, J, mass, force, phi, number(stream, 0.01, 0.05), number(stream, 0.2, 0.8)),
        )


STEP = Check(
    name="step",
    title="one step of S9, at the level of velocities",
    points=15,
    visible=(
        Case(
            "Atwood's machine from rest: it gains g/2 · dt",
            stepping(
                [0, -1, 1.5, -1], [0] * 4, [[0, -1, 0, -1]], [1, 1, 3, 3], [0, -9.81, 0, -29.43], [0], 0.1, 0
            ),
        ),
        Case(
            "the rope is 2 cm too long, and a fifth of it is taken back",
            stepping(
                [0, -1, 1.5, -1], [0] * 4, [[0, -1, 0, -1]], [1, 1, 3, 3], [0, -9.81, 0, -29.43], [0.02]
            ),
        ),
        Case(
            "a differential that has been knocked",
            stepping(
                [0.1, 0.2, 0.3], [1.0, 2, 0.5], [[1, 1, -2]], [0.5, 0.5, 2.0], [3.0, 0, -1], [-0.3], 0.05, 0.5
            ),
        ),
    ),
    hidden=lambda stream: list(steps(stream)),
    judge=equal(right.step, 1e-10),
    why="The scheme says what to compute: only rounding, divided by dt, may differ.",
    form="three values, (x, u, lam): arrays of n, n and m numbers; lam in N",
    section="Velocities, and why Δt",
    causes=(
        cause_like(
            "λ is an impulse: A must have the factor Δt, for λ to be a force.",
            lambda v: right.step(v, impulse=True),
        ),
        cause_like("The positions went with the old velocities.", lambda v: right.step(v, position="old")),
        cause_like("The gap is widened: + share φ/Δt belongs to b.", lambda v: right.step(v, bias=-1)),
        cause_like("The gap is left out: share φ/Δt belongs to b.", lambda v: right.step(v, bias=0)),
        cause_like(
            "share φ must be divided by Δt: it is to vanish within a step.",
            lambda v: right.step(v, times_dt=True),
        ),
        cause_like(
            "f_e is left out: b is the w after a step under f_e alone.", lambda v: right.step(v, force=0)
        ),
    ),
    hint="u_free = u + dt M⁻¹ f_e; b = J u_free + share phi/dt; A = dt J M⁻¹ Jᵀ; then λ; x with the new u.",
)


# --- projection ---------------------------------------------------------------------------------------------


def slack(x, mass, length, pulleys=PULLEYS):
    return {
        "x": np.array(x, dtype=float),
        "mass": np.array(mass, dtype=float),
        "pulleys": np.array(pulleys),
        "length": length,
    }


def slacks(stream):
    for _ in range(6):
        x, pulleys = hanging(stream)
        m1, m2 = number(stream, 0.5, 2), number(stream, 3, 9)
        φ = number(stream, 0.2, 0.4)
        yield Case(
            "any places", slack(x, [m1, m1, m2, m2], round(right.free_length(x, pulleys) - φ, 3), pulleys)
        )


PROJECT = Check(
    name="project",
    title="positions put back where the rope fits",
    points=10,
    visible=(
        Case(
            "straight down: 1 kg moves three times as far as 3 kg",
            slack([0, -1, 1.5, -1.2], [1, 1, 3, 3], 2.0),
        ),
        Case("both askew", slack([-0.6, -0.8, 1.8, -1.2], [1, 1, 3, 3], 2.0)),
    ),
    hidden=lambda stream: list(slacks(stream)),
    judge=equal(right.project, 1e-10),
    why="Newton's method doubles its digits: with |φ| below 1e-12 m the point is right to that.",
    form="an array of 4",
    section="Projection",
    causes=(
        cause_like(
            "The move is along Jᵀ: both masses move alike. Along M⁻¹Jᵀ a light one moves more.",
            lambda v: right.project(v, metric=0),
        ),
        cause_like(
            "A single step is not enough: repeat until |φ| < 1e-12 m.",
            lambda v: right.project(v, iterations=1),
        ),
        cause_like(
            "Only the first mass moves: the rope pulls at both.", lambda v: right.project(v, sides=(1, 0))
        ),
    ),
    hint="x ← x − M⁻¹ Jᵀ A⁻¹ φ with A = J M⁻¹ Jᵀ, J at the new x each time, until |φ| < 1e-12.",
)


# --- a run: order -------------------------------------------------------------------------------------------

DT = 0.01  # s; the order is fitted at DT, DT/2, DT/4


def swung(x, u, m1, m2, pulleys=PULLEYS, steps=20):
    mass = np.array([m1, m1, m2, m2], dtype=float)
    return {
        "x": np.array(x, dtype=float),
        "u": np.array(u, dtype=float),
        "mass": mass,
        "pulleys": np.array(pulleys),
        "dt": DT,
        "steps": steps,
    }


def fitting(x, u, pulleys):
    """u without what the rope doesn't allow, each mass weighing the same."""
    J, _ = right.rope({"x": x, "u": u, "pulleys": pulleys})
    return u - J * (J @ u) / (J @ J)


def swings(stream):
    for _ in range(3):
        x, pulleys = hanging(stream)
        u = fitting(x, vector(stream, 4, 1, 2) * np.sign(vector(stream, 4)), pulleys)
        yield Case("swinging and pulling", swung(x, u, number(stream, 1, 2), number(stream, 2, 4), pulleys))


def swing_calls(v):
    state = (v["x"], v["u"], v["mass"], v["pulleys"])
    return [Call("swing", (*state, v["dt"] / 2**k, v["steps"] * 2**k)) for k in range(3)]


def swing_errors(v, answers):
    exact = np.concatenate(right.swing_exact(v))
    sizes = [np.linalg.norm(np.concatenate([x, u]).astype(float) - exact) for x, u in answers]
    return [v["dt"] / 2**k for k in range(3)], [float(size) for size in sizes]


SWING = Check(
    name="swing",
    title="a swinging Atwood machine: λ in each stage, and the order",
    points=10,
    calls=swing_calls,
    visible=(
        Case("let go at an angle", swung([-0.8, -0.6, 1.5, -1.0], [0] * 4, 1, 3)),
        Case(
            "the first swings round fast, the second hangs",
            swung([0, -1.2, 1.5, -0.8], [3.0, 0, 0, 0], 1, 1.5),
        ),
    ),
    hidden=lambda stream: list(swings(stream)),
    judge=all_of(on_answer(0, equal(right.swing, 1e-9)), fitted_order(swing_errors, 4, 0.3)),
    why="The scheme is given, so only rounding may differ. The order, against Lagrange's equations for the "
    "rope's length and two angles (DOP853), is 4 ± 0.1 at these steps; with λ held over a step it is 1.",
    form="two values, (x, u): arrays of 4",
    section="Accelerations in each stage",
    after=("rope", "embed"),
    causes=(
        cause_like(
            "λ is held over the whole step: find it anew in each stage of rk4.",
            lambda v: right.swing(v, held=True),
        ),
        cause_like(
            "J̇u is left out: the rope does not know that the masses swing.",
            lambda v: right.swing(v, turning=0),
        ),
        cause_like("J̇u has the wrong sign in b.", lambda v: right.swing(v, turning=-1)),
        cause_like(
            "The rope pulls at the first mass only: Jᵀλ acts on both.", lambda v: right.swing(v, side=0)
        ),
    ),
    hint="y = (x, u); its rate is (u, M⁻¹(f_e + Jᵀλ)) with λ = −b/A at that x and u; given.rk4 does a step.",
)


# --- an engine ----------------------------------------------------------------------------------------------

TRAIN = Check(
    name="train",
    title="a gear train, driven and braked, as pymunk's gear joints do it",
    points=20,
    visible=tuple(Case(label, inputs) for label, inputs in engines.TRAINS.items()),
    hidden=lambda stream: [Case("any three wheels", engines.any_train(stream)) for _ in range(5)],
    judge=equal(engines.TRAIN, 1e-8),
    source=engines.TRAIN.source,
    why="pymunk iterates on the same A until only rounding is left; λ is a difference of speeds over dt: the "
    "two agree to about 1e-12.",
    form="two values, (omega, lam): arrays of 3 and of 2; rad/s and N",
    section="Velocities, and why Δt",
    causes=(
        cause_like(
            "Wheels in mesh turn opposite ways: both entries of a row have a plus.",
            lambda v: right.train(v, sign=-1),
        ),
        cause_like(
            "lam is an impulse: a force is asked for, so A has the factor dt.",
            lambda v: right.train(v, impulse=True),
        ),
        cause_like(
            "Each gear was solved as if it were alone: the middle wheel couples them, A is not diagonal.",
            lambda v: right.train(v, coupled=False),
        ),
        cause_like(
            "The brake's torque must be that of the step's start, −drag·omega[2].",
            lambda v: right.train(v, late_drag=True),
        ),
        cause_like("The middle wheel has a place in both rows.", lambda v: right.train(v, middle=False)),
        cause(
            "The teeth slip: radii[0] omega[0] + radii[1] omega[1] must be 0.",
            lambda v, verdict: abs(v["radii"][:2] @ np.array(verdict.got[0])[:2]) > 1e-6,
        ),
    ),
    hint="J = [[R_1, R_2, 0], [0, R_2, R_3]]. In each step: the torques, u_free, A λ + b = 0, the new rates.",
)


CHECKS = (ROPE, EMBED, SHORTEST, STEP, PROJECT, SWING, TRAIN)
