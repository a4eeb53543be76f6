"""The checks of exercise 03, the Jacobian (slides S5–S7). Grader's side only."""

import numpy as np

import exercises
from exercises.grader.check import Call, Case, Check, cause, cause_like
from exercises.grader.judges import all_of, equal, fitted_order, on_answer
from exercises.grader.replies import Given

right = exercises.part("03_jacobian", "answers")
engines = exercises.part("03_jacobian", "engines")

ROUNDING = "Both sides do the same few dozen operations, so only rounding, about 1e-15, may differ."


def vectors(stream, *sizes, reach=2.0):
    """Random vectors with three decimals, so that a case can be pasted."""
    return [np.round(stream.uniform(-reach, reach, size), 3) for size in sizes]


def number(stream, low, high):
    return round(stream.uniform(low, high), 3)


def direction(stream):
    """A unit vector in any direction."""
    vector = stream.normal(size=3)
    return vector / np.linalg.norm(vector)


def attitude(stream):
    q = stream.normal(size=4)
    return q / np.linalg.norm(q)


# --- the screw's row: shape and limiting cases --------------------------------------------------------------

Z = np.array([0.0, 0.0, 1.0])


def thread(axis=Z, arm_i=(0.0, 0.0, 0.0), arm_j=(0.0, 0.0, 0.0), pitch=0.5):
    return {"axis": axis, "arm_i": np.array(arm_i), "arm_j": np.array(arm_j), "pitch": pitch}


def threads(stream):
    for _ in range(6):
        arm_i, arm_j = vectors(stream, 3, 3)
        yield Case("any axis, any arms", thread(direction(stream), arm_i, arm_j, number(stream, -3, 3)))


SCREW_ROW = Check(
    name="screw_row",
    title="the row of J that ties turning to sliding",
    points=15,
    visible=(
        Case("along z, the point at both centres: only the thread turns anything", thread(pitch=2 * np.pi)),
        Case("pitch 0: the points may not part along the axis", thread(Z, (0.5, 0, 0), (0, -0.25, 1), 0.0)),
        Case("arms to the side", thread(np.array([0.6, 0.0, 0.8]), (0.3, -1.0, 0.2), (-0.4, 0.1, 2.0), 1.5)),
    ),
    hidden=lambda stream: list(threads(stream)),
    judge=equal(right.screw_row, 1e-12),
    why=ROUNDING,
    form="an array of 12 numbers: what v_i, ω_i, v_j and ω_j are multiplied with",
    section="The hinge by hand",
    causes=(
        cause_like(
            "The thread has the wrong sign: body j turned about +axis must move along +axis for w to stay 0, "
            "so −pitch/(2π) goes with ω_j, and + with ω_i.",
            lambda v: right.screw_row(v, thread=1),
        ),
        cause_like(
            "pitch is the way of a whole turn: a radian is worth pitch/(2π).",
            lambda v: right.screw_row(v, turns=False),
        ),
        cause_like("The row is −w: it must be body j as seen from i.", lambda v: right.screw_row(v, side=-1)),
        cause_like(
            "The moments have the wrong sign: axis·(ω × r) = (r × axis)·ω, with r first.",
            lambda v: right.screw_row(v, moment=-1),
        ),
        cause_like(
            "The moments r × axis are missing: the point moves when a body turns.",
            lambda v: right.screw_row(v, moment=0),
        ),
        cause_like("The thread is missing.", lambda v: right.screw_row(v, thread=0)),
        cause_like(
            "The two arms are swapped: arm_i belongs to body i.", lambda v: right.screw_row(v, arms="swapped")
        ),
    ),
    hint="Write w = axis·(v_j + ω_j×r_j − v_i − ω_i×r_i) − pitch/(2π) axis·(ω_j − ω_i), and read off what "
    "stands before v_i, ω_i, v_j, ω_j, in this order.",
)


# --- the free direction -------------------------------------------------------------------------------------


def screwing(turn=1.0, gap=0.0, v_i=(0.0, 0.0, 0.0), omega_i=(0.0, 0.0, 0.0), **geometry):
    values = thread(**geometry)
    pitch = values.pop("pitch")
    still = {"v_i": np.array(v_i), "omega_i": np.array(omega_i)}
    return {**values, "gap": gap, "pitch": pitch, **still, "turn": turn}


def screwings(stream):
    for _ in range(6):
        arm_i, arm_j, v_i, omega_i = vectors(stream, 3, 3, 3, 3)
        geometry = {"axis": direction(stream), "arm_i": arm_i, "arm_j": arm_j}
        turn, gap, pitch = number(stream, -3, 3), number(stream, -2, 2), number(stream, 0.3, 3)
        yield Case("both bodies move", screwing(turn, gap, v_i, omega_i, pitch=pitch, **geometry))


SCREW_MOTION = Check(
    name="screw_motion",
    title="the motion that the screw leaves free",
    points=15,
    visible=(
        Case("body i at rest, j turns once a second: it climbs by one pitch", screwing(2 * np.pi)),
        Case(
            "no turning against each other: one rigid body",
            screwing(0.0, 0.5, (1.0, 0, 0), (0, 2.0, 0), arm_i=(0.5, 0, 0), arm_j=(0, 0, -1.0)),
        ),
        Case(
            "all at once",
            screwing(3.0, 0.4, (0, 1.0, 0), (0.5, 0, 1.0), arm_i=(0.2, 0.3, 0), arm_j=(-0.5, 0.1, 0)),
        ),
    ),
    hidden=lambda stream: list(screwings(stream)),
    judge=equal(right.screw_motion, 1e-12),
    why=ROUNDING,
    form="two values, (v_j, ω_j): arrays of 3",
    section="What is free does no work",
    causes=(
        cause_like(
            "The gap is left out: body i carries the point of j, which is arm_i + gap·axis from i's centre.",
            lambda v: right.screw_motion(v, gap=0),
        ),
        cause_like(
            "Body i's own turning does not carry the point: ω_i × (arm_i + gap·axis) is missing.",
            lambda v: right.screw_motion(v, carried=0),
        ),
        cause_like(
            "v_j is the velocity of the point: the centre's is smaller by ω_j × arm_j.",
            lambda v: right.screw_motion(v, own=0),
        ),
        cause_like(
            "`turn` is the rate against body i: ω_j = ω_i + turn·axis.",
            lambda v: right.screw_motion(v, added=0),
        ),
        cause_like(
            "The thread has the wrong sign: a positive pitch moves j along +axis when it turns about +axis.",
            lambda v: right.screw_motion(v, thread=-1),
        ),
        cause_like(
            "pitch is the way of a whole turn: a radian is worth pitch/(2π).",
            lambda v: right.screw_motion(v, turns=False),
        ),
    ),
    hint="First ω_j. Then the velocity of j's point: that of i's material where it is, plus "
    "pitch/(2π)·turn·axis. From there to j's centre. Your screw_row times (v_i, ω_i, v_j, ω_j) must be 0.",
)


# --- J̇ u ----------------------------------------------------------------------------------------------------


def whirling(u, gap=0.0, **geometry):
    values = thread(**geometry)
    pitch = values.pop("pitch")
    return {**values, "gap": gap, "pitch": pitch, "u": np.array(u, dtype=float)}


def whirls(stream):
    for _ in range(6):
        arm_i, arm_j, u = vectors(stream, 3, 3, 12)
        geometry = {"axis": direction(stream), "arm_i": arm_i, "arm_j": arm_j}
        gap, pitch = number(stream, 0.5, 2), number(stream, 1, 3)
        yield Case("any velocities", whirling(u, gap, pitch=pitch, **geometry))


NONE = [0.0, 0.0, 0.0]
SCREW_RATE = Check(
    name="screw_rate",
    title="J̇ u, what w changes by although u does not",
    points=20,
    visible=(
        Case(
            "only j turns, about x: its point is drawn in by ω² times the arm along the axis",
            whirling([*NONE, *NONE, *NONE, 2.0, 0, 0], arm_j=(0, 0, 0.5)),
        ),
        Case(
            "i turns about x, j moves along y: twice the Coriolis term",
            whirling([*NONE, 1.5, 0, 0, 0, 2.0, 0, *NONE]),
        ),
        Case(
            "i turns the axis away from a nut that stands off by the gap",
            whirling([*NONE, 2.0, 0, 0, *NONE, *NONE], gap=0.5),
        ),
        Case(
            "all at once",
            whirling(
                [0.1, 0.2, 0.3, 1, -1, 0.5, -0.4, 0.3, 0, 0.5, 2, 1],
                0.7,
                axis=np.array([0.0, 0.6, 0.8]),
                arm_i=(0.2, 0.3, 0),
                arm_j=(-0.5, 0.1, 0.4),
                pitch=2.0,
            ),
        ),
    ),
    hidden=lambda stream: list(whirls(stream)),
    judge=equal(right.screw_rate, 1e-11),
    why="Products of a dozen numbers below ten: rounding is about 1e-14.",
    form="a number, in m/s²",
    section="J̇ u: what changes although u does not",
    causes=(
        cause_like(
            "The Coriolis term counts twice: once for the axis that turns under the motion, once for the "
            "motion along the axis that has turned.",
            lambda v: right.screw_rate(v, coriolis=1),
        ),
        cause_like("The Coriolis term 2 ė·Δ̇ is missing.", lambda v: right.screw_rate(v, coriolis=0)),
        cause_like(
            "The centripetal terms ω × (ω × r) are missing: a point on a turning body is accelerated, though "
            "ω is constant.",
            lambda v: right.screw_rate(v, centripetal=0),
        ),
        cause_like(
            "The centripetal terms have the wrong sign: ω_j × (ω_j × r_j) counts plus, that of i minus.",
            lambda v: right.screw_rate(v, signs=-1),
        ),
        cause_like(
            "The gap is left out: e turns with i, and ë·Δ = −gap·|ω_i × e|².",
            lambda v: right.screw_rate(v, carried=0),
        ),
        cause_like(
            "The thread's own part is missing: its axis turns with i, so −pitch/(2π) ė·(ω_j − ω_i) belongs "
            "to it.",
            lambda v: right.screw_rate(v, thread=0),
        ),
        cause_like("The thread's part has the wrong sign.", lambda v: right.screw_rate(v, thread=-1)),
        cause_like("The sign is wrong throughout.", lambda v: -right.screw_rate(v)),
    ),
    hint="Differentiate w = e·Δ̇ + ė·Δ − pitch/(2π) e·(ω_j − ω_i) once more, with ė = ω_i × e, Δ = gap·e, "
    "all v and ω held constant: four terms. Set all but one velocity to 0 to find which one is wrong.",
)


# --- finite differences -------------------------------------------------------------------------------------

H = 0.1  # s; the order is fitted at H, H/2, H/4


def poses(stream):
    """A pose near the thread's own, and velocities of about 1."""
    q_i, u = attitude(stream), np.concatenate(vectors(stream, 12, reach=1.2))
    turn = np.concatenate([[1.0], stream.uniform(-0.4, 0.4, 3)])
    q_j = right.given.product(q_i, turn / np.linalg.norm(turn))
    x_i, x_j = vectors(stream, 3, 3)
    return np.concatenate([x_i, q_i, x_j, q_j]), u


def of_screw(stream):
    point_i, point_j = vectors(stream, 3, 3)
    pitch = number(stream, 0.5, 2)
    return Given("screw", axis=direction(stream), point_i=point_i, point_j=point_j, pitch=pitch)


def of_rope(stream):
    pulley_i, pulley_j, point_i, point_j = vectors(stream, 3, 3, 3, 3)
    above = np.array([0.0, 0, 4.0])
    points = {"point_i": point_i / 4, "point_j": point_j / 4}
    return Given("rope", pulley_i=pulley_i + above, pulley_j=pulley_j + above, ratio=2.0, **points)


def slopes(stream):
    for make, label in ((of_screw, "a screw"), (of_rope, "a rope"), (of_screw, "another screw")):
        pose, u = poses(stream)
        yield Case(f"{label}, with both bodies moving", {"phi": make(stream), "pose": pose, "u": u, "h": H})


def slope_calls(v):
    """At h, h/2 and h/4, each along four motions: one alone might happen to have no h² term."""
    return [
        Call("slope", (v["phi"], v["pose"], np.roll(v["u"], 3 * shift), v["h"] / 2**k))
        for k in range(3)
        for shift in range(4)
    ]


def slope_errors(v, answers):
    exact = [right.slope_exact({**v, "u": np.roll(v["u"], 3 * shift)}) for shift in range(4)]
    off = np.array([float(answer) for answer in answers]).reshape(3, 4) - exact
    return [v["h"] / 2**k for k in range(3)], np.linalg.norm(off, axis=1).tolist()


STRAIGHT = np.array([0.0, 0, 0, 1, 0, 0, 0, 0.5, 0.0, 1.0, 1, 0, 0, 0])
SLOPE = Check(
    name="slope",
    title="φ̇ by a central difference along the motion, and its order",
    points=15,
    calls=slope_calls,
    visible=(
        Case(
            "a rope over two pulleys, straight up",
            {
                "phi": Given(
                    "rope",
                    pulley_i=np.array([0.0, 0, 3]),
                    pulley_j=np.array([0.5, 0, 3]),
                    point_i=np.array([0.2, 0, 0.1]),
                    point_j=np.array([0.0, 0.3, 0.2]),
                    ratio=2.0,
                ),
                "pose": STRAIGHT,
                "u": np.array([0.1, 0.4, -0.3, 0.5, 1.0, -0.5, 0.3, -0.2, 0.6, 1.0, 0.2, 0.4]),
                "h": H,
            },
        ),
    ),
    hidden=lambda stream: list(slopes(stream)),
    judge=all_of(on_answer(0, equal(right.slope, 1e-11)), fitted_order(slope_errors, 2, 0.25)),
    why="The scheme says which two values to subtract, so only rounding, divided by h, may differ. The order "
    "is fitted at h, h/2, h/4: a central difference shows 2.0 ± 0.02 here, a one-sided one 1.",
    form="a number",
    section="Finite differences along the motion",
    causes=(
        cause_like(
            "The difference is one-sided, (φ(h) − φ(0))/h: its error falls like h, not like h².",
            lambda v: right.slope(v, back=0.0, over=1.0),
        ),
        cause_like(
            "The difference is one-sided, (φ(0) − φ(−h))/h: its error falls like h, not like h².",
            lambda v: right.slope(v, there=0.0, over=1.0),
        ),
        cause_like("From −h to h is 2h: divide by that.", lambda v: right.slope(v, over=1.0)),
        cause_like(
            "The bodies move but don't turn: given.moved takes the whole of u.",
            lambda v: right.slope(v, still=True),
        ),
        cause_like("The sign is wrong: later minus earlier.", lambda v: -right.slope(v)),
    ),
    hint="φ at given.moved(pose, u, h), minus φ at given.moved(pose, u, −h), divided by 2h.",
)


# --- the rope: both ways, and virtual work ------------------------------------------------------------------


def roped(offset_i, offset_j, ratio=1.0, arm_i=(0.0, 0, 0), arm_j=(0.0, 0, 0), u=(0.0,) * 12, tension=1.0):
    names = ("arm_i", "arm_j", "offset_i", "offset_j")
    vectors_of = dict(zip(names, map(np.array, (arm_i, arm_j, offset_i, offset_j)), strict=True))
    return {**vectors_of, "ratio": ratio, "u": np.array(u, dtype=float), "tension": tension}


def ropes(stream):
    for _ in range(6):
        offset_i, offset_j, arm_i, arm_j, u = vectors(stream, 3, 3, 3, 3, 12)
        ratio, tension = number(stream, 1.5, 4), number(stream, 1, 20)
        offset_i[2], offset_j[2] = -2.5, -3.0
        yield Case("any arms, any ratio", roped(offset_i, offset_j, ratio, arm_i, arm_j, u, tension))


ROPE = Check(
    name="rope",
    title="a rope over two pulleys, there and back",
    points=15,
    visible=(
        Case(
            "Atwood: one sinks as fast as the other rises; the rope pulls both up",
            roped((0, 0, -1.0), (0, 0, -2.0), u=[0, 0, 1.0, 0, 0, 0, 0, 0, -1.0, 0, 0, 0], tension=5.0),
        ),
        Case(
            "a block and tackle of 3: body j moves a third as fast and is pulled three times as hard",
            roped((0, 0, -2.0), (0, 0, -1.0), 3.0, u=[0, 0, 3.0, 0, 0, 0, 0, 0, -1.0, 0, 0, 0], tension=2.0),
        ),
        Case(
            "arms and slanted ropes",
            roped((1.2, 0, -1.6), (0, -0.6, -0.8), 2.0, (0, 0.5, 0.2), (0.3, 0, 0), np.arange(12) / 4, 3.0),
        ),
    ),
    hidden=lambda stream: list(ropes(stream)),
    judge=equal(right.rope, 1e-12),
    why=ROUNDING,
    form="two values, (w, forces): a number in m/s, and an array of 12, (f_i, τ_i, f_j, τ_j)",
    section="The same J both ways",
    causes=(
        cause_like(
            "w is right, the forces have the wrong sign: a rope pulls, so λ = −tension along a w that counts "
            "lengthening.",
            lambda v: right.rope(v, pull=1),
        ),
        cause_like(
            "The ratio is missing: body j hangs from `ratio` strands.", lambda v: right.rope(v, ratio=False)
        ),
        cause_like(
            "The directions are not of length 1: n is the offset divided by its length.",
            lambda v: right.rope(v, unit=False),
        ),
        cause_like(
            "The moments arm × n are missing: the rope turns a body that it does not pull at its centre.",
            lambda v: right.rope(v, moment=0),
        ),
        cause_like(
            "The moments have the wrong sign: arm × n, with the arm first.",
            lambda v: right.rope(v, moment=-1),
        ),
        cause_like(
            "The two sides count against each other: both lengths add up to the rope's, with a plus.",
            lambda v: right.rope(v, sign=-1),
        ),
        cause(
            "The power on both sides differs: λ·w must equal forces·u for every u. Use one row for both: w "
            "is the row times u, the forces are the row times λ.",
            lambda v, verdict: abs(verdict.got[1] @ v["u"] + v["tension"] * verdict.got[0]) > 1e-9,
        ),
    ),
    hint="n = offset/|offset|; the row is (n_i, arm_i × n_i, ratio n_j, ratio arm_j × n_j); w is the row "
    "times u, the forces are −tension times the row.",
)


# --- an engine ----------------------------------------------------------------------------------------------


GEARS = Check(
    name="gears",
    title="two wheels in mesh, as pymunk's gear joint does it",
    points=20,
    visible=tuple(Case(label, inputs) for label, inputs in engines.GEARS.items()),
    hidden=lambda stream: [Case("any two wheels", engines.any_wheels(stream)) for _ in range(5)],
    judge=equal(engines.WHEELS, 1e-9),
    source=engines.WHEELS.source,
    why="pymunk solves a single joint exactly in its first iteration: the two agree to 1e-14.",
    form="three values, (ω_i, ω_j, λ): rad/s, rad/s, N s",
    section="The same J both ways",
    causes=(
        cause_like(
            "Wheels in mesh turn opposite ways: J = (R_i, R_j), both with a plus.",
            lambda v: right.gears(v, sign=-1),
        ),
        cause_like(
            "The radii are swapped: the rim of wheel i moves with R_i ω_i.",
            lambda v: right.gears(v, inverted=True),
        ),
        cause_like(
            "λ has the wrong sign: wheel i gets R_i λ of angular momentum.",
            lambda v: right.gears(v, λ_sign=-1),
        ),
        cause_like(
            "The inertias are left out: one impulse λ turns a light wheel more than a heavy one.",
            lambda v: right.gears(v, mass=False),
        ),
        cause_like(
            "Both rims were set to their mean speed: which speed they agree on depends on the inertias.",
            right.gears_halfway,
        ),
        cause(
            "The angular momentum of the two wheels is not kept: their bearings push. Each wheel gets R λ.",
            lambda v, verdict: abs(v["inertia"] @ (np.array(verdict.got[:2]) - v["omega"])) < 1e-9,
        ),
    ),
    hint="J = (R_i, R_j), w = J ω. An impulse λ changes ω by J λ / inertia. Which λ makes w = 0? Check with "
    "two equal wheels, one at rest.",
)


CHECKS = (SCREW_ROW, SCREW_MOTION, SCREW_RATE, SLOPE, ROPE, GEARS)
