"""The checks of unit 02, the equation of motion (slides S4, S9). Grader's side only: the oracles are here."""

import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import ellipkm1

import exercises
from exercises.grader.check import Call, Case, Check, cause, cause_like
from exercises.grader.judges import all_of, equal, fitted_order, on_answer
from exercises.grader.replies import Given, Reply, Student

given = exercises.part("02_equation_of_motion", "given")
engines = exercises.part("02_equation_of_motion", "engines")
ROUNDING = "Both sides do the same few dozen operations, so only rounding, about 1e-15, may differ."


def vectors(stream, *sizes, reach=2.0):
    """Random vectors with three decimals, so that a case can be pasted."""
    return [np.round(stream.uniform(-reach, reach, size), 3) for size in sizes]


def from_pool(oracle, visible, label, number):
    """Hidden cases drawn from what the engine was recorded on, beyond the visible ones, which come first."""
    def draw(stream):
        pool = oracle.pool[len(visible):]
        return [Case(label, pool[i]) for i in stream.choice(len(pool), number, replace=False)]
    return draw


# --- plate: mass, centre, inertia -------------------------------------------------------------------------------------

def plate_with(values, own=1, shift=1, about=None):
    """The plate's answer with a mistake built in: factors on holes' own moments and on all shifts."""
    parts = [(1, values["outline"]), *((-1, hole) for hole in values["holes"])]
    parts = [(sign, *given.polygon(corners)) for sign, corners in parts]
    mass = values["density"] * sum(sign * area for sign, area, _, _ in parts)
    centre = values["density"] * sum(sign * area * c for sign, area, c, _ in parts) / mass
    point = centre if about is None else about
    inertia = values["density"] * sum(
        sign * ((own if sign < 0 else 1) * second + shift * area * (c - point) @ (c - point))
        for sign, area, c, second in parts)
    return mass, centre, inertia


PLATE = Check(
    name="plate", title="mass, centre and inertia of a plate with holes", points=15,
    visible=tuple(Case(label, inputs) for label, inputs in engines.PLATES.items()),
    hidden=from_pool(engines.PLATE, engines.PLATES, "a plate of many corners with one or two holes", 5),
    judge=equal(engines.PLATE, 1e-9),
    why="pymunk computes in double precision too; its moments differ from ours by rounding, about 1e-14.",
    source=engines.PLATE.source, section="Inertia of a composite body",
    causes=(
        cause_like("The parallel-axis term m·d² is left out: each part's moment is about its own centre, "
                   "and must first be moved to the centre of the whole.", lambda v: plate_with(v, shift=0)),
        cause_like("The parallel-axis term has the wrong sign: moving away from a part's own centre adds m·d².",
                   lambda v: plate_with(v, shift=-1)),
        cause_like("The moment is about the origin of the coordinates, not about the plate's centre of mass.",
                   lambda v: plate_with(v, about=np.zeros(2))),
        cause_like("The holes' own moments are not taken off: a hole is a part of negative mass in every sum.",
                   lambda v: plate_with(v, own=0)),
        cause_like("The centre is that of the outline: the holes move it.",
                   lambda v: plate_with(v, about=given.polygon(v["outline"])[1])),
        cause("The mass counts the holes as if they were full, or adds them.",
              lambda v, verdict: abs(verdict.got[0] - verdict.expected[0]) > 1e-6),
        cause("The mass is right, the centre is not: weigh each centre by its part's mass, a hole's being negative, "
              "and divide by the mass of the whole.",
              lambda v, verdict: np.max(np.abs(verdict.got[1] - verdict.expected[1])) > 1e-6)),
    hint="Mass and centre are right, the moment is not: add up each part's own moment plus m·d², holes with negative m, "
         "and d measured from the centre of the whole plate.")


# --- body_rate: the quaternion's rate from the body's angular velocity --------------------------------------------------

def product(p, q):
    (a, x), (b, y) = (p[0], p[1:]), (q[0], q[1:])
    return np.array([a * b - x @ y, *(a * y + b * x + np.cross(x, y))])


def body_rate(v):
    return product(v["q"], np.array([0.0, *v["omega"]])) / 2


def scalar_last(v):
    q, w = v["q"], np.array([*v["omega"], 0.0])
    return np.roll(product(np.roll(q, 1), np.roll(w, 1)), -1) / 2


BODY_RATE = Check(
    name="body_rate", title="q̇ from an angular velocity in the body's frame", points=10,
    visible=(Case("no rotation yet: q̇ = ½ (0, Ω)",
                  {"q": np.array([1.0, 0, 0, 0]), "omega": np.array([0.4, -1.0, 2.0])}),
             Case("turned by 120° about (1, 1, 1)",
                  {"q": np.array([0.5, 0.5, 0.5, 0.5]), "omega": np.array([1.0, 0.0, 2.0])})),
    hidden=lambda stream: [Case("a random attitude", {"q": q / np.linalg.norm(q), "omega": omega})
                           for q, omega in (vectors(stream, 4, 3) for _ in range(6))],
    judge=equal(body_rate, 1e-12), why=ROUNDING, section="From ω to the quaternion's rate",
    causes=(
        cause_like("The angular velocity is taken as one in the world's frame. In the body's frame its quaternion "
                   "stands on the right: q̇ = ½ q (0, Ω).",
                   lambda v: product(np.array([0.0, *v["omega"]]), v["q"]) / 2),
        cause_like("The factor ½ is missing: a quaternion holds half the angle.", lambda v: 2 * body_rate(v)),
        cause_like("The sign is wrong throughout.", lambda v: -body_rate(v)),
        cause_like("The scalar is taken as the last of the four numbers. Here q = (w, x, y, z).", scalar_last),
        cause("q̇ is not at right angles to q, so the length of q would change: look at the signs of the scalar part, "
              "−x·Ω.", lambda v, verdict: abs(verdict.got @ v["q"]) > 1e-9)),
    hint="q̇ is at right angles to q, as it must be, but not the right one: look at the cross product, x × Ω with x "
         "first, and at w Ω.")


# --- gyrostat_rate: Euler's equation with a wheel ------------------------------------------------------------------------

def gyrostat_rate(v, gyroscopic=1, wheel=1, inertia=1):
    spin = inertia * v["inertia"] @ v["omega"] + wheel * v["wheel"]
    return np.linalg.solve(v["inertia"], v["torque"] - gyroscopic * np.cross(v["omega"], spin))


def some_inertia(stream):
    """A full inertia tensor that a body can have: no principal moment above the sum of the other two."""
    principal = stream.uniform(1.0, 1.9, 3)
    frame, _ = np.linalg.qr(stream.normal(size=(3, 3)))
    return np.round(frame * principal @ frame.T, 3)


def gyrostats(stream):
    for _ in range(6):
        omega, wheel, torque = vectors(stream, 3, 3, 3)
        yield Case("a body with full inertia tensor, wheel and torque",
                   {"omega": omega, "inertia": some_inertia(stream), "wheel": wheel, "torque": torque})


GYROSTAT_RATE = Check(
    name="gyrostat_rate", title="Euler's equation in the body's frame, with a wheel", points=15,
    visible=(Case("at rest, wheel at rest: the torque alone, I⁻¹ τ",
                  {"omega": np.zeros(3), "inertia": np.diag([1.0, 2.0, 3.0]), "wheel": np.zeros(3),
                   "torque": np.array([1.0, 1.0, -3.0])}),
             Case("no torque, wheel at rest",
                  {"omega": np.array([1.0, 2.0, 3.0]), "inertia": np.diag([1.0, 2.0, 3.0]), "wheel": np.zeros(3),
                   "torque": np.zeros(3)}),
             Case("a ball with a wheel: it turns about the wheel's axis",
                  {"omega": np.array([0.0, 1.0, 0.0]), "inertia": 2.0 * np.eye(3),
                   "wheel": np.array([0.0, 0.0, 5.0]), "torque": np.zeros(3)})),
    hidden=lambda stream: list(gyrostats(stream)),
    judge=equal(gyrostat_rate, 1e-11),
    why="Solving with I costs a few digits of rounding, about 1e-15 here; no physics is left out.",
    section="The gyroscopic term",
    causes=(
        cause_like("The gyroscopic term Ω × (I Ω + h) is missing: angular momentum is constant in the world, "
                   "not in the turning frame.", lambda v: gyrostat_rate(v, gyroscopic=0)),
        cause_like("The gyroscopic term has the wrong sign: it is −Ω × (I Ω + h) on the torque's side, and the order "
                   "of the cross product counts.", lambda v: gyrostat_rate(v, gyroscopic=-1)),
        cause_like("The wheel's angular momentum h is missing: Ω turns the whole of I Ω + h.",
                   lambda v: gyrostat_rate(v, wheel=0)),
        cause_like("The wheel's angular momentum is subtracted instead of added.", lambda v: gyrostat_rate(v, wheel=-1)),
        cause_like("The term −Ω × I Ω of the body itself is missing, only the wheel's is there.",
                   lambda v: gyrostat_rate(v, inertia=0)),
        cause_like("The result is I Ω̇, a torque: solve with I to get Ω̇.", lambda v: v["inertia"] @ gyrostat_rate(v)),
        cause_like("The inertia is used as if it had only its diagonal.",
                   lambda v: gyrostat_rate({**v, "inertia": np.diag(np.diag(v["inertia"]))}))),
    hint="Without torque, Ω · I Ω̇ must be 0 (energy) and (I Ω + h) · I Ω̇ must be 0 (length of the angular momentum): "
         "see which of the two yours breaks.")


# --- air_force: drag and Magnus force ------------------------------------------------------------------------------------

def air_force(v, wind=1, magnus=1, drag=1):
    u = v["velocity"] - wind * v["wind"]
    return -drag * v["drag"] * np.linalg.norm(u) * u + magnus * v["magnus"] * np.cross(v["spin"], u)


def flying(velocity, spin, wind, drag=0.5, magnus=0.2):
    return {"velocity": np.array(velocity), "spin": np.array(spin), "wind": np.array(wind), "drag": drag,
            "magnus": magnus}


def flights(stream):
    for _ in range(6):
        velocity, spin, wind = vectors(stream, 3, 3, 3, reach=4.0)
        yield Case("a spinning ball in the wind", flying(velocity, spin, wind, *np.round(stream.uniform(0.1, 1, 2), 3)))


AIR_FORCE = Check(
    name="air_force", title="drag and Magnus force on a ball in the wind", points=15,
    visible=(Case("no spin, no wind: drag against the velocity, k|v|²", flying([3.0, 0.0, 4.0], [0.0] * 3, [0.0] * 3)),
             Case("carried along by the wind: no force at all",
                  flying([2.0, -1.0, 0.5], [3.0, 1.0, 0.0], [2.0, -1.0, 0.5])),
             Case("back-spin lifts: spin about −y, flight along x",
                  flying([2.0, 0.0, 0.0], [0.0, -5.0, 0.0], [0.0] * 3)),
             Case("wind from the side pushes a ball at rest", flying([0.0] * 3, [0.0] * 3, [0.0, 2.0, 0.0]))),
    hidden=lambda stream: list(flights(stream)),
    judge=equal(air_force, 1e-12), why=ROUNDING, section="External forces",
    causes=(
        cause_like("The wind is left out: the air feels v − wind, in both forces.", lambda v: air_force(v, wind=0)),
        cause_like("The wind is added: the velocity seen from the air is v − wind.", lambda v: air_force(v, wind=-1)),
        cause_like("The Magnus force has the wrong sign: it is along spin × u, spin first.",
                   lambda v: air_force(v, magnus=-1)),
        cause_like("Drag pushes forward: it needs a minus.", lambda v: air_force(v, drag=-1)),
        cause_like("Each component is squared for itself. Drag is −k |u| u with the length |u| of the whole vector, or "
                   "its direction and size depend on how the axes lie.",
                   lambda v: air_force(v, drag=0) - v["drag"] * (np.abs(u := v["velocity"] - v["wind"]) * u)),
        cause_like("Drag is linear in the speed: it must grow with its square, −k |u| u.",
                   lambda v: air_force(v, drag=0) - v["drag"] * (v["velocity"] - v["wind"])),
        cause_like("The Magnus force uses the velocity over the ground: in the wind it is spin × (v − wind).",
                   lambda v: air_force(v, magnus=0) + v["magnus"] * np.cross(v["spin"], v["velocity"])),
        cause_like("The Magnus force is missing.", lambda v: air_force(v, magnus=0))),
    hint="With u = v − wind: the drag's power u·F must be −k |u|³, and the Magnus force must be at right angles to u.")


# --- kutta_step, march: an integrator and its order ----------------------------------------------------------------------

def kutta(rate, t, y, dt, back=-1, stage_times=(0.0, 0.5, 1.0), weights=(1, 4, 1)):
    k1 = rate(t + stage_times[0] * dt, y)
    k2 = rate(t + stage_times[1] * dt, y + dt / 2 * k1)
    k3 = rate(t + stage_times[2] * dt, y + dt * (2 * k2 + back * k1))
    return y + dt * (weights[0] * k1 + weights[1] * k2 + weights[2] * k3) / sum(weights)


def kutta_with(**mistake):
    return lambda v: kutta(v["rate"].build(given), v["t"], v["y"], v["dt"], **mistake)


def rk4(v):
    rate, t, y, dt = v["rate"].build(given), v["t"], v["y"], v["dt"]
    k1 = rate(t, y)
    k2 = rate(t + dt / 2, y + dt / 2 * k1)
    k3 = rate(t + dt / 2, y + dt / 2 * k2)
    return y + dt / 6 * (k1 + 2 * k2 + 2 * k3 + rate(t + dt, y + dt * k3))


def steps_to_take(stream):
    rates = [Given("pendulum", length=round(stream.uniform(0.5, 2), 3)),
             Given("forced", frequency=round(stream.uniform(1, 3), 3), drive=round(stream.uniform(0.5, 2), 3)),
             Given("swelling", strength=round(stream.uniform(0.3, 1), 3))]
    for rate in rates:
        t, dt, y = round(stream.uniform(0.2, 2), 3), round(stream.uniform(0.1, 0.4), 3), vectors(stream, 2)[0]
        yield Case("one step of a random size", {"rate": rate, "t": t, "y": y, "dt": dt})


KUTTA_STEP = Check(
    name="kutta_step", title="one step of Kutta's third-order method", points=15,
    visible=(Case("ẏ = −y: one step multiplies by 1 − dt + dt²/2 − dt³/6",
                  {"rate": Given("decay", speed=1.0), "t": 0.0, "y": np.array([1.0, -2.0]), "dt": 0.5}),
             Case("a rate that depends on time",
                  {"rate": Given("forced", frequency=2.0, drive=1.5), "t": 0.3, "y": np.array([1.0, 0.5]), "dt": 0.2})),
    hidden=lambda stream: list(steps_to_take(stream)),
    judge=equal(kutta_with(), 1e-12),
    why="The scheme says which numbers to add, so only rounding may differ; the exact motion is further off than that, "
        "on purpose.",
    section="Integrators and their order",
    causes=(
        cause_like("The third slope is taken at y + dt (2 k2 + k1): k1 counts with a minus there.", kutta_with(back=1)),
        cause_like("The third slope is taken at y + 2 dt k2: the part −dt k1 is missing.", kutta_with(back=0)),
        cause_like("All slopes are taken at the time t: the second belongs to t + dt/2, the third to t + dt.",
                   kutta_with(stage_times=(0, 0, 0))),
        cause_like("The third slope is taken at the time t + dt/2: it belongs to t + dt.",
                   kutta_with(stage_times=(0, 0.5, 0.5))),
        cause_like("The three slopes are averaged evenly: their weights are 1, 4, 1 over 6.",
                   kutta_with(weights=(1, 1, 1))),
        cause_like("This is the explicit Euler method: one slope only.", kutta_with(weights=(1, 0, 0))),
        cause_like("This is the midpoint method: only the second slope counts.", kutta_with(weights=(0, 1, 0))),
        cause_like("This is the classical fourth-order method. It is a good one, but another one is asked for.", rk4)),
    hint="Write down k1, k2, k3 for ẏ = −y, y = 1, dt = 0.5 by hand: −1, −0.75, −0.75.")

ORDER_STEPS = (64, 128, 256)
COMMON = 16       # errors are taken at these times, which all three runs share


def march_calls(v):
    """A few steps of a known method, then the student's own scheme at dt, dt/2, dt/4."""
    runs = [(Student("kutta_step"), Given("swelling", strength=v["strength"]), v["y"], v["duration"] / n, n)
            for n in ORDER_STEPS]
    return [Call("march", run) for run in [(Given("euler"), Given("swelling", strength=v["strength"]), v["y"], 0.1, 5),
                                           *runs]]


def march_euler(v, clock=1):
    rate, rows = given.swelling(v["strength"]), [v["y"]]
    for k in range(5):
        rows.append(rows[-1] + 0.1 * rate(clock * 0.1 * k, rows[-1]))
    return np.array(rows)


def march_errors(v, answers):
    times = v["duration"] * np.arange(COMMON + 1) / COMMON
    exact = 1 / (1 / v["y"] - v["strength"] * np.sin(times)[:, None])
    runs = answers[1:]
    if any(np.shape(run) != (n + 1, len(v["y"])) for run, n in zip(runs, ORDER_STEPS, strict=True)):
        raise ValueError("shape")
    errors = [np.max(np.abs(run[::n // COMMON] - exact)) for run, n in zip(runs, ORDER_STEPS, strict=True)]
    return [v["duration"] / n for n in ORDER_STEPS], errors


def to_march(stream):
    return [Case("order of your kutta_step, as march runs it",
                 {"y": np.round(stream.uniform(0.3, 0.6, 3) * (1, -1, 1), 3), "strength": round(stream.uniform(0.6, 1), 3),
                  "duration": round(stream.uniform(1.8, 2.2), 3)}) for _ in range(2)]


def measured(low, high):
    return lambda v, verdict: isinstance(verdict.got, str) and low < verdict.error < high


MARCH = Check(
    name="march", title="a whole run, and the order that it shows", points=10, calls=march_calls,
    visible=(Case("five Euler steps; then the order of your kutta_step",
                  {"y": np.array([0.5, -0.4]), "strength": 1.0, "duration": 2.0}),),
    hidden=to_march,
    judge=all_of(on_answer(0, equal(march_euler, 1e-12)), fitted_order(march_errors, 3, 0.08)),
    why="The Euler steps may differ by rounding. The order is fitted from three runs at dt, dt/2, dt/4: at these steps "
        "a scheme of order 3 shows 3.00 ± 0.01, and the next wrong answer is 2.",
    section="Integrators and their order",
    causes=(
        cause_like("The clock stands still: give the step the time k · dt at which it starts.",
                   lambda v: march_euler(v, clock=0)),
        cause_like("The step is given the time at its end: it wants the time at which it starts.",
                   lambda v: march_euler_late(v)),
        cause("The run is right, but kutta_step is of order 2 only: see the check of kutta_step.", measured(0.8, 1.2)),
        cause("The run is right, but kutta_step is of order 1 only: see the check of kutta_step.", measured(1.8, 2.2)),
        cause("The order is 4: the step is not Kutta's third-order method.", measured(0.8, 1.2))),
    hint="Row k of the result is the state at the time k · dt, row 0 the start; steps + 1 rows in all.")


def march_euler_late(v):
    rate, rows = given.swelling(v["strength"]), [v["y"]]
    for k in range(5):
        rows.append(rows[-1] + 0.1 * rate(0.1 * (k + 1), rows[-1]))
    return np.array(rows)


# --- flip_time: a property of a whole run ---------------------------------------------------------------------------------

def flip_time(v):
    """The instant at which Ω₂ first changes its sign, to about 1e-10 s."""
    if not np.any(v["wheel"]) and v["omega"][2] == 0:
        return quarter_period(np.diag(v["inertia"]), v["omega"])

    def crossing(t, omega):
        return omega[1]
    crossing.terminal = True

    def rate(t, omega):
        return gyrostat_rate({"omega": omega, "inertia": v["inertia"], "wheel": v["wheel"], "torque": np.zeros(3)})
    run = solve_ivp(rate, (0, v["longest"]), v["omega"], "DOP853", events=crossing, rtol=1e-11, atol=1e-12)
    return float(run.t_events[0][0]) if len(run.t_events[0]) else math.inf


def quarter_period(inertia, omega):
    """From the largest Ω₂ to its zero, by the elliptic functions of the free top (I₁ < I₂ < I₃, turning about 2)."""
    (a, b, c), energy, momentum = inertia, inertia @ omega**2, inertia**2 @ omega**2
    steep, flat = (b - a) * (energy * c - momentum), (c - b) * (momentum - energy * a)
    if momentum > energy * b:
        steep, flat = flat, steep
    return float(ellipkm1(1 - flat / steep) * math.sqrt(a * b * c / steep))


def tumbling(inertia, wheel, omega, dt=0.01, longest=5.0):
    return {"inertia": np.diag(inertia), "wheel": np.array(wheel), "omega": np.array(omega), "dt": dt,
            "longest": longest}


def tumbles(stream):
    for _ in range(3):
        spin, off = round(stream.uniform(2.5, 3.5), 3), np.round(stream.uniform(0.3, 0.6, 2), 3)
        inertia = np.round([stream.uniform(1, 1.1), stream.uniform(1.9, 2.1), stream.uniform(2.7, 2.9)], 3)
        wheel = [0.0, round(stream.uniform(0.3, 0.8), 3), 0.0]
        yield Case("a plate with a slow wheel", tumbling(inertia, wheel, [off[0], spin, off[1]]))


FLIP_TIME = Check(
    name="flip_time", title="when a body thrown about its middle axis turns over", points=10,
    visible=(Case("no wheel: the exact time is a quarter of an elliptic period",
                  tumbling([1.0, 2.0, 3.0], [0.0] * 3, [0.4, 3.0, 0.0])),
             Case("a slow wheel puts the flip off", tumbling([1.0, 2.0, 2.8], [0.0, 0.6, 0.0], [0.5, 3.0, 0.4])),
             Case("a fast wheel keeps it from turning over: math.inf",
                  tumbling([1.0, 2.0, 2.8], [0.0, 4.0, 0.0], [0.3, 2.0, 0.1], longest=3.0))),
    hidden=lambda stream: list(tumbles(stream)),
    judge=equal(flip_time, 1e-4, floor=1.0), reply=Reply(nonfinite=True),
    why="At this dt Kutta's method finds the flip to about 1e-6 s; the step itself is 1e-2 s, so a time taken from the "
        "grid, without the straight line between two steps, does not pass.",
    section="The free top",
    causes=(
        cause("The time is that of a step, before or after the flip: find where the straight line between the two "
              "steps crosses zero.", lambda v, verdict: 1e-4 < abs(verdict.got - verdict.expected) <= v["dt"]),
        cause("It should turn over, and never does: is the gyroscopic term in gyrostat_rate, and is the sign of the "
              "second component looked at?", lambda v, verdict: verdict.got == math.inf),
        cause("It should never turn over: give the wheel to gyrostat_rate, and return math.inf after `longest`.",
              lambda v, verdict: verdict.expected == math.inf),
        cause("The flip comes at a wrong time: look first at the checks of gyrostat_rate and kutta_step.",
              lambda v, verdict: abs(verdict.got - verdict.expected) > v["dt"])),
    hint="Look first at the checks of gyrostat_rate and kutta_step; then draw Ω₂ over time and see where it crosses zero.")


# --- swing: what an engine really does -----------------------------------------------------------------------------------

def swing_with(v, shift=1, first="rate", sign=-1, linear=False):
    angle, rate, angles = v["angle"], 0.0, [v["angle"]]
    about_pivot = v["inertia"] + shift * v["mass"] * v["length"]**2
    for _ in range(v["steps"]):
        before = rate
        rate += sign * v["dt"] * v["mass"] * given.GRAVITY * v["length"] * (angle if linear else math.sin(angle)) / about_pivot
        angle += v["dt"] * (rate if first == "rate" else before)
        angles.append(angle)
    return np.array(angles)


def exact_swing(v):
    factor = v["mass"] * given.GRAVITY * v["length"] / (v["inertia"] + v["mass"] * v["length"]**2)
    run = solve_ivp(lambda t, y: (y[1], -factor * math.sin(y[0])), (0, v["steps"] * v["dt"]), (v["angle"], 0.0), "DOP853",
                    t_eval=v["dt"] * np.arange(v["steps"] + 1), rtol=1e-10, atol=1e-12)
    return run.y[0]


SWING = Check(
    name="swing", title="a pendulum, step for step as pybullet does it", points=10,
    visible=tuple(Case(label, inputs) for label, inputs in engines.SWINGS.items()),
    hidden=from_pool(engines.SWING, engines.SWINGS, "let go at a large angle", 4),
    judge=equal(engines.SWING, 1e-9),
    why="pybullet steps its jointed trees exactly like this, in double precision: they agree to 1e-12. The exact motion "
        "of the pendulum is 1e-3 off, and would not pass.",
    source=engines.SWING.source, section="What the engines do",
    causes=(
        cause_like("The angle is updated with the old rate, which is the explicit Euler method; pybullet updates the "
                   "rate first, and the angle with the new rate.", lambda v: swing_with(v, first="angle")),
        cause_like("The moment of inertia is that about the centre of mass; the body turns about the pivot: add m·length².",
                   lambda v: swing_with(v, shift=0)),
        cause_like("The parallel-axis term is subtracted: going from the centre of mass to the pivot adds m·length².",
                   lambda v: swing_with(v, shift=-1)),
        cause_like("Gravity drives the pendulum away from the bottom: its torque needs a minus.",
                   lambda v: swing_with(v, sign=1)),
        cause_like("sin(angle) is replaced by the angle, which holds only for small ones.",
                   lambda v: swing_with(v, linear=True)),
        cause_like("Mass and inertia are swapped: look at the order of the arguments.",
                   lambda v: swing_with({**v, "mass": v["inertia"], "inertia": v["mass"]})),
        cause("This is closer to the exact motion than pybullet is: what is asked for is the engine's own step.",
              lambda v, verdict: np.max(np.abs(verdict.got - exact_swing(v))) < 1e-5)),
    hint="For each step: torque −m g length sin(angle) about the pivot, rate += dt · torque / (inertia about the pivot), "
         "then angle += dt · rate. No damping. Row 0 is the start.")


CHECKS = (PLATE, BODY_RATE, GYROSTAT_RATE, AIR_FORCE, KUTTA_STEP, MARCH, FLIP_TIME, SWING)
assert sum(check.points for check in CHECKS) == 100
