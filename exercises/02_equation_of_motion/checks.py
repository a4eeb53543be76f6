"""The checks of exercise 02, the equation of motion (slides S4, S9). Grader's side only."""

import math

import numpy as np

import exercises
from exercises.grader.check import Call, Case, Check, cause, cause_like
from exercises.grader.judges import all_of, an_array, equal, on_answer, order_of_runs
from exercises.grader.replies import Given, Reply, Student

right = exercises.part("02_equation_of_motion", "answers")
engines = exercises.part("02_equation_of_motion", "engines")

ROUNDING = "Both sides do the same few dozen operations, so only rounding, about 1e-15, may differ."


def vectors(stream, *sizes, reach=2.0):
    """Random vectors with three decimals, so that a case can be pasted."""
    return [np.round(stream.uniform(-reach, reach, size), 3) for size in sizes]


def number(stream, low, high):
    return round(stream.uniform(low, high), 3)


def of_an_engine(oracle, visible, make, label, recorded=2, new=3):
    """Hidden cases: a few of those that the engine was recorded on (beyond the visible ones, which come
    first), and new ones, so that to know the recordings is not enough."""

    def draw(stream):
        pool = oracle.pool[len(visible) :]
        chosen = [pool[i] for i in stream.choice(len(pool), recorded, replace=False)]
        return [Case(label, values) for values in [*chosen, *(make(stream, i) for i in range(new))]]

    return draw


# --- shape and limiting cases: the plate --------------------------------------------------------------------

PLATE = Check(
    name="plate",
    title="mass, centre and inertia of a plate with holes",
    points=15,
    visible=tuple(Case(label, inputs) for label, inputs in engines.PLATES.items()),
    hidden=of_an_engine(
        engines.PLATE, engines.PLATES, engines.some_plate, "a plate of many corners with one or two holes"
    ),
    judge=equal(engines.PLATE, 1e-9),
    source=engines.PLATE.source,
    why="pymunk computes in double precision too: its moments differ from ours by rounding, about 1e-15.",
    form="three values, (mass, centre, inertia): a number, an array of 2, a number",
    section="Inertia",
    causes=(
        cause_like(
            "The parallel-axis term m·d² is left out: each part's moment is about its own centre, and must "
            "first be moved to the centre of the whole.",
            lambda v: right.plate(v, shift=0),
        ),
        cause_like(
            "The parallel-axis term has the wrong sign: away from a part's own centre, m·d² is added.",
            lambda v: right.plate(v, shift=-1),
        ),
        cause_like(
            "The moment is about the origin of the coordinates, not about the plate's centre of mass.",
            lambda v: right.plate(v, about=np.zeros(2)),
        ),
        cause_like(
            "The holes' own moments are not taken off: a hole is a part of negative mass in every sum.",
            lambda v: right.plate(v, own=0),
        ),
        cause_like(
            "The moment is about the outline's centre: the holes move the centre of mass.",
            right.plate_about_outline,
        ),
        cause(
            "The mass is not right: it is density times area, a hole's area being taken off.",
            lambda v, verdict: abs(verdict.got[0] - verdict.expected[0]) > 1e-6,
        ),
        cause(
            "The mass is right, the centre is not: weigh each centre by its part's mass, a hole's being "
            "negative, and divide by the mass of the whole.",
            lambda v, verdict: np.max(np.abs(verdict.got[1] - verdict.expected[1])) > 1e-6,
        ),
    ),
    hint="Mass and centre are right, the moment is not: add up each part's own moment plus m·d², with a "
    "hole's mass negative, and d measured from the centre of the whole plate.",
)


# --- rotation: quaternion, and Euler's equation -------------------------------------------------------------

BODY_RATE = Check(
    name="body_rate",
    title="q̇ from an angular velocity in the body's frame",
    points=10,
    visible=(
        Case(
            "not turned yet: q̇ = ½ (0, Ω)",
            {"q": np.array([1.0, 0, 0, 0]), "omega": np.array([0.4, -1.0, 2.0])},
        ),
        Case(
            "turned by 120° about (1, 1, 1)",
            {"q": np.array([0.5, 0.5, 0.5, 0.5]), "omega": np.array([1.0, 0.0, 2.0])},
        ),
    ),
    hidden=lambda stream: [
        Case("a random attitude", {"q": q / np.linalg.norm(q), "omega": omega})
        for q, omega in (vectors(stream, 4, 3) for _ in range(6))
    ],
    judge=equal(right.body_rate, 1e-12),
    why=ROUNDING,
    form="an array of 4 numbers",
    section="Attitude, and the matrix from ω to q̇",
    causes=(
        cause_like(
            "The angular velocity is taken as one in the world's frame. In the body's frame its quaternion "
            "stands on the right: q̇ = ½ q (0, Ω).",
            right.world_rate,
        ),
        cause_like(
            "The factor ½ is missing: a quaternion holds half the angle.", lambda v: 2 * right.body_rate(v)
        ),
        cause_like("The sign is wrong throughout.", lambda v: -right.body_rate(v)),
        cause_like(
            "The scalar is taken as the last of the four numbers. Here q = (w, x, y, z).",
            right.scalar_last_rate,
        ),
        cause(
            "q̇ is not at right angles to q, so the length of q would change: look at the signs, and at the "
            "scalar part, −x·Ω.",
            lambda v, verdict: abs(verdict.got @ v["q"]) > 1e-9,
        ),
    ),
    hint="q̇ is at right angles to q, as it must be, but not the right one: look at the cross product x × Ω, "
    "with x first, and at w Ω.",
)


def some_inertia(stream):
    """A full inertia tensor that a body can have: no principal moment above the sum of the other two."""
    frame, _ = np.linalg.qr(stream.normal(size=(3, 3)))
    return np.round(frame * stream.uniform(1.0, 1.9, 3) @ frame.T, 3)


def gyrostats(stream):
    for _ in range(6):
        omega, wheel, torque = vectors(stream, 3, 3, 3)
        values = {"omega": omega, "inertia": some_inertia(stream), "wheel": wheel, "torque": torque}
        yield Case("a body with full inertia tensor, wheel and torque", values)


def gyrostat(omega, inertia, wheel=(0.0, 0.0, 0.0), torque=(0.0, 0.0, 0.0)):
    return {
        "omega": np.array(omega),
        "inertia": inertia,
        "wheel": np.array(wheel),
        "torque": np.array(torque),
    }


TOP = np.diag([1.0, 2.0, 3.0])

GYROSTAT_RATE = Check(
    name="gyrostat_rate",
    title="Euler's equation in the body's frame, with a wheel",
    points=15,
    visible=(
        Case("all at rest: the torque alone, I⁻¹ τ", gyrostat([0.0] * 3, TOP, torque=[1.0, 1.0, -3.0])),
        Case("no torque, wheel at rest", gyrostat([1.0, 2.0, 3.0], TOP)),
        Case(
            "a ball with a wheel: it turns about the wheel's axis",
            gyrostat([0.0, 1.0, 0.0], 2.0 * np.eye(3), wheel=[0.0, 0.0, 5.0]),
        ),
    ),
    hidden=lambda stream: list(gyrostats(stream)),
    judge=equal(right.gyrostat_rate, 1e-11),
    why="Solving with I costs a few digits of rounding, about 1e-15 here; no physics is left out.",
    form="an array of 3 numbers",
    section="Newton and Euler",
    causes=(
        cause_like(
            "The gyroscopic term Ω × (I Ω + h_w) is missing: angular momentum is constant in the world, not "
            "in the turning frame.",
            lambda v: right.gyrostat_rate(v, gyroscopic=0),
        ),
        cause_like(
            "The gyroscopic term has the wrong sign: it is −Ω × (I Ω + h_w) on the torque's side, and the "
            "order of the cross product counts.",
            lambda v: right.gyrostat_rate(v, gyroscopic=-1),
        ),
        cause_like(
            "The wheel's angular momentum h_w is missing: Ω turns the whole of I Ω + h_w.",
            lambda v: right.gyrostat_rate(v, wheel=0),
        ),
        cause_like(
            "The wheel's angular momentum is subtracted instead of added.",
            lambda v: right.gyrostat_rate(v, wheel=-1),
        ),
        cause_like(
            "The body's own term −Ω × I Ω is missing, only the wheel's is there.",
            lambda v: right.gyrostat_rate(v, body=0),
        ),
        cause_like(
            "The result is I Ω̇, a torque: solve with I to get Ω̇.",
            lambda v: v["inertia"] @ right.gyrostat_rate(v),
        ),
        cause_like(
            "The torque is divided by the diagonal of the inertia: a full tensor needs "
            "np.linalg.solve(inertia, …).",
            right.gyrostat_divided,
        ),
        cause_like(
            "The inertia is used as if it had only its diagonal: a full tensor needs inertia @ Ω, and "
            "np.linalg.solve(inertia, …).",
            right.gyrostat_diagonal,
        ),
    ),
    hint="Without torque, Ω · I Ω̇ must be 0 (energy) and (I Ω + h_w) · I Ω̇ must be 0 (length of the angular "
    "momentum): see which of the two yours breaks.",
)


# --- a force ------------------------------------------------------------------------------------------------


def flying(velocity, spin=(0.0, 0.0, 0.0), wind=(0.0, 0.0, 0.0), drag=0.5, magnus=0.2):
    vectors_of = {"velocity": np.array(velocity), "spin": np.array(spin), "wind": np.array(wind)}
    return {**vectors_of, "drag": drag, "magnus": magnus}


def flights(stream):
    for _ in range(6):
        velocity, spin, wind = vectors(stream, 3, 3, 3, reach=4.0)
        drag, magnus = number(stream, 0.1, 1), number(stream, 0.1, 1)
        yield Case("a spinning ball in the wind", flying(velocity, spin, wind, drag, magnus))


AIR_FORCE = Check(
    name="air_force",
    title="drag and Magnus force on a ball in the wind",
    points=15,
    visible=(
        Case("no spin, no wind: drag against the velocity, k|v|²", flying([3.0, 0.0, 4.0])),
        Case(
            "carried along by the wind: no force", flying([2.0, -1.0, 0.5], [3.0, 1.0, 0.0], [2.0, -1.0, 0.5])
        ),
        Case("back-spin lifts: spin about −y, flight along x", flying([2.0, 0.0, 0.0], [0.0, -5.0, 0.0])),
        Case("wind from the side pushes a ball at rest", flying([0.0] * 3, wind=[0.0, 2.0, 0.0])),
    ),
    hidden=lambda stream: list(flights(stream)),
    judge=equal(right.air_force, 1e-12),
    why=ROUNDING,
    form="an array of 3 numbers",
    section="External forces",
    causes=(
        cause_like(
            "The wind is left out: the air feels u = velocity − wind, in both forces.",
            lambda v: right.air_force(v, wind=0),
        ),
        cause_like(
            "The wind is added: the velocity seen from the air is velocity − wind.",
            lambda v: right.air_force(v, wind=-1),
        ),
        cause_like(
            "The Magnus force has the wrong sign: it is along spin × u, spin first.",
            lambda v: right.air_force(v, magnus=-1),
        ),
        cause_like("Drag pushes forward: it needs a minus.", lambda v: right.air_force(v, drag=-1)),
        cause_like(
            "Each component is squared for itself. Drag is −k |u| u with the length |u| of the whole vector, "
            "or it depends on how the axes lie.",
            right.air_force_per_component,
        ),
        cause_like(
            "Drag is linear in the speed: it must grow with its square, −k |u| u.", right.air_force_linear
        ),
        cause_like(
            "The Magnus force uses the velocity over the ground: in the wind it is spin × (velocity − wind).",
            right.air_force_over_ground,
        ),
        cause_like("The Magnus force is missing.", lambda v: right.air_force(v, magnus=0)),
        cause(
            "0/0 where u = velocity − wind is 0: a direction u/|u| is not defined there. Write the drag as "
            "−k |u| u, which divides by nothing.",
            lambda v, verdict: "NaN" in verdict.got.message and not np.any(v["velocity"] - v["wind"]),
        ),
    ),
    hint="With u = velocity − wind, the drag's power u·F must be −k |u|³, and the Magnus force must be at "
    "right angles to u and to the spin. Look at the order of the arguments, too.",
)


# --- an integrator and its order ----------------------------------------------------------------------------


def steps_to_take(stream):
    rates = [
        Given("pendulum", length=number(stream, 0.5, 2)),
        Given("forced", frequency=number(stream, 1, 3), drive=number(stream, 0.5, 2)),
        Given("swelling", strength=number(stream, 0.3, 1)),
    ]
    for rate in rates:
        t, dt = number(stream, 0.2, 2), number(stream, 0.1, 0.4)
        yield Case("one step of a random size", {"rate": rate, "t": t, "y": vectors(stream, 2)[0], "dt": dt})


KUTTA_STEP = Check(
    name="kutta_step",
    title="one step of Kutta's third-order method",
    points=15,
    visible=(
        Case(
            "ẏ = −y: one step multiplies by 1 − dt + dt²/2 − dt³/6",
            {"rate": Given("decay", speed=1.0), "t": 0.0, "y": np.array([1.0, -2.0]), "dt": 0.5},
        ),
        Case(
            "a rate that depends on time",
            {
                "rate": Given("forced", frequency=2.0, drive=1.5),
                "t": 0.3,
                "y": np.array([1.0, 0.5]),
                "dt": 0.2,
            },
        ),
    ),
    hidden=lambda stream: list(steps_to_take(stream)),
    judge=equal(right.kutta, 1e-12),
    why="The scheme says which numbers to add, so only rounding may differ. The exact motion is further off "
    "than that, on purpose: it is this scheme that is asked for.",
    form="an array of the same shape as y",
    section="Integrators",
    causes=(
        cause_like(
            "The third slope is taken at y + dt (2 k2 + k1): k1 counts with a minus there.",
            lambda v: right.kutta(v, back=1),
        ),
        cause_like(
            "The third slope is taken at y + 2 dt k2: the part −dt k1 is missing.",
            lambda v: right.kutta(v, back=0),
        ),
        cause_like(
            "All slopes are taken at the time t: the second belongs to t + dt/2, the third to t + dt.",
            lambda v: right.kutta(v, times=(0, 0, 0)),
        ),
        cause_like(
            "The third slope is taken at the time t + dt/2: it belongs to t + dt.",
            lambda v: right.kutta(v, times=(0, 0.5, 0.5)),
        ),
        cause_like(
            "The three slopes are averaged evenly: their weights are 1, 4, 1 over 6.",
            lambda v: right.kutta(v, weights=(1, 1, 1)),
        ),
        cause_like(
            "This is the explicit Euler method: one slope only.",
            lambda v: right.kutta(v, weights=(1, 0, 0)),
        ),
        cause_like(
            "This is the midpoint method: only the second slope counts.",
            lambda v: right.kutta(v, weights=(0, 1, 0)),
        ),
        cause_like(
            "This is the classical fourth-order method. It is a good one, but another one is asked for.",
            right.rk4,
        ),
        cause(
            "k1, k2 and k3 are right, their weights are not: y + dt (k1 + 4 k2 + k3) / 6.",
            lambda v, verdict: right.is_of_other_weights(v, verdict.got),
        ),
    ),
    hint="Write down k1, k2, k3 for ẏ = −y, y = 1, dt = 0.5 by hand: −1, −0.75, −0.75.",
)

ORDER_STEPS = (64, 128, 256)
COMMON = 16  # errors are taken at these times, which all three runs share


def march_calls(v):
    """A few steps of a known method, then the student's own scheme at dt, dt/2, dt/4."""
    rate = Given("swelling", strength=v["strength"])
    runs = [(Student("kutta_step"), rate, v["y"], v["duration"] / n, n) for n in ORDER_STEPS]
    return [
        Call("march", run)
        for run in [(Given("euler"), rate, v["y"], right.EULER_DT, right.EULER_STEPS), *runs]
    ]


def march_exact(v):
    return v["duration"], right.swelling(v, v["duration"] * np.arange(COMMON + 1) / COMMON)


def to_march(stream):
    for _ in range(2):
        y = np.array([number(stream, 0.3, 0.6), -number(stream, 0.3, 0.6), number(stream, 0.3, 0.6)])
        values = {"y": y, "strength": number(stream, 0.6, 1), "duration": number(stream, 1.8, 2.2)}
        yield Case("five Euler steps; then the order of your kutta_step", values)


def shows_order(order):
    return lambda v, verdict: abs(float(verdict.got.removeprefix("order ").split()[0]) - order) < 0.3


MARCH = Check(
    name="march",
    title="a whole run, and the order that it shows",
    points=10,
    calls=march_calls,
    visible=(
        Case(
            "five Euler steps; then the order of your kutta_step",
            {"y": np.array([0.5, -0.4]), "strength": 1.0, "duration": 2.0},
        ),
    ),
    hidden=lambda stream: list(to_march(stream)),
    judge=all_of(
        on_answer(0, an_array(equal(right.march_euler, 1e-12))),
        order_of_runs(march_exact, ORDER_STEPS, 3, 0.08, first=1),
    ),
    why="The Euler steps may differ by rounding. The order is fitted from three runs at dt, dt/2, dt/4: at "
    "these steps a scheme of order 3 shows 3.000 ± 0.001, and the next wrong order is 2 or 4. The errors are "
    "the largest differences to the exact y(t) = 1 / (1/y(0) − strength · sin t).",
    form="an array of shape (steps + 1, len(y)): the start, then the state after each step",
    section="Integrators",
    causes=(
        cause_like(
            "The clock stands still: give the step the time k · dt at which it starts.",
            lambda v: right.march_euler(v, clock=lambda k: 0),
        ),
        cause_like(
            "The step is given the time at its end: it wants the time at which it starts.",
            lambda v: right.march_euler(v, clock=lambda k: k + 1),
        ),
        cause_like(
            "`march` calls kutta_step whatever `step` it is given: call step(rate, t, y, dt).",
            right.march_kutta,
        ),
        cause("The run is right, but kutta_step is of order 1: see the check of kutta_step.", shows_order(1)),
        cause("The run is right, but kutta_step is of order 2: see the check of kutta_step.", shows_order(2)),
        cause("The order is 4, so the step is not Kutta's third-order method.", shows_order(4)),
    ),
    hint="Row k of the result is the state at the time k · dt, row 0 the start; there are steps + 1 rows.",
)


# --- invariants and whole runs ------------------------------------------------------------------------------


def tumbling(inertia, wheel, omega, longest=5.0):
    wheel = np.array([0.0, wheel, 0.0])
    return {
        "inertia": np.diag(inertia),
        "wheel": wheel,
        "omega": np.array(omega),
        "dt": 0.01,
        "longest": longest,
    }


def tumbles(stream):
    for _ in range(3):
        inertia = [number(stream, 1, 1.1), number(stream, 1.9, 2.1), number(stream, 2.7, 2.9)]
        omega = [number(stream, 0.3, 0.6), number(stream, 2.5, 3.5), number(stream, 0.3, 0.6)]
        yield Case("a body with a slow wheel", tumbling(inertia, number(stream, 0.3, 0.8), omega))


FLIP_TIME = Check(
    name="flip_time",
    title="when a body thrown about its middle axis turns over",
    points=10,
    visible=(
        Case(
            "no wheel: the exact time is a quarter of an elliptic period",
            tumbling([1.0, 2.0, 3.0], 0.0, [0.4, 3.0, 0.0]),
        ),
        Case("a slow wheel puts the flip off", tumbling([1.0, 2.0, 2.8], 0.6, [0.5, 3.0, 0.4])),
        Case(
            "a fast wheel keeps it from turning over: inf",
            tumbling([1.0, 2.0, 2.8], 4.0, [0.3, 2.0, 0.1], longest=3.0),
        ),
    ),
    hidden=lambda stream: list(tumbles(stream)),
    judge=equal(right.flip_time, 1e-4),
    reply=Reply(nonfinite=True),
    why="At this dt Kutta's method finds the flip to about 3e-6 s. The step is 1e-2 s, so a time taken from "
    "the grid, without the straight line between two steps, does not pass.",
    form="a number, a time in s, or np.inf",
    section="A body that turns over",
    causes=(
        cause(
            "The time is that of a step, before or after the flip: find where the straight line between the "
            "two steps crosses zero.",
            lambda v, verdict: 1e-4 < abs(verdict.got - verdict.expected) <= v["dt"],
        ),
        cause(
            "It should turn over, and never does: is it the second component whose sign is looked at, in "
            "all steps up to `longest`, with one starting where the one before ended?",
            lambda v, verdict: verdict.got == math.inf,
        ),
        cause(
            "It should never turn over: give the wheel to gyrostat_rate, and return np.inf after `longest`.",
            lambda v, verdict: verdict.expected == math.inf,
        ),
    ),
    after=("gyrostat_rate", "kutta_step", "march"),
    hint="Draw Ω₂ over time, and see where it crosses zero. Does the run start from `omega`, with the wheel, "
    "without torque, in steps of dt? Between step k and k + 1 the line is zero at "
    "(k + Ω₂[k] / (Ω₂[k] − Ω₂[k+1])) · dt.",
)


# --- an engine, to the scheme -------------------------------------------------------------------------------

SWING = Check(
    name="swing",
    title="a pendulum, step for step as pybullet does it",
    points=10,
    visible=tuple(Case(label, inputs) for label, inputs in engines.SWINGS.items()),
    hidden=of_an_engine(engines.SWING, engines.SWINGS, engines.some_swing, "let go at a large angle", new=2),
    judge=equal(engines.SWING, 1e-9),
    source=engines.SWING.source,
    why="pybullet steps its jointed trees exactly like this, in double precision: the two agree to 1e-15. "
    "The exact motion of the pendulum is 1e-3 off or more, and does not pass.",
    form="an array of steps + 1 angles, the start first",
    section="What engines do",
    causes=(
        cause_like(
            "The angle is updated with the old rate, which is the explicit Euler method; pybullet updates "
            "the rate first, and the angle with the new rate.",
            lambda v: right.swing(v, first="none"),
        ),
        cause_like(
            "The angle is moved first, and the torque taken at the new angle: symplectic Euler, but position "
            "first. pybullet renews the rate first, from the torque at the old angle.",
            lambda v: right.swing(v, first="position"),
        ),
        cause_like(
            "The moment of inertia is that about the centre of mass; the body turns about the pivot: add "
            "m·length².",
            lambda v: right.swing(v, shift=0),
        ),
        cause_like(
            "The parallel-axis term is subtracted: from the centre of mass to the pivot, m·length² is added.",
            lambda v: right.swing(v, shift=-1),
        ),
        cause_like(
            "Gravity drives the pendulum away from the bottom: its torque needs a minus.",
            lambda v: right.swing(v, sign=1),
        ),
        cause_like(
            "sin(angle) is replaced by the angle, which holds only for small ones.",
            lambda v: right.swing(v, torque=float),
        ),
        cause_like("Mass and inertia are swapped: look at the order of the arguments.", right.swing_swapped),
        cause(
            "This is the exact motion, or nearly so: what is asked for is the engine's own step.",
            lambda v, verdict: np.max(np.abs(verdict.got - right.swing_exact(v))) < 1e-4,
        ),
    ),
    hint="For each step: torque −m g length sin(angle) about the pivot; rate += dt · torque / (inertia about "
    "the pivot); then angle += dt · rate. No damping. Row 0 is the start.",
)


CHECKS = (PLATE, BODY_RATE, GYROSTAT_RATE, AIR_FORCE, KUTTA_STEP, MARCH, FLIP_TIME, SWING)
