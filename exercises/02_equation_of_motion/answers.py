"""Right answers of exercise 02, and what typical mistakes would answer instead. Grader's side only.

Each function takes a case's values by name, as `v`. The other parameters, with their right values as
defaults, build a mistake in: so a check can say which mistake an answer looks like.
"""

import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import ellipkm1

import exercises
from exercises.grader.replies import Given

given = exercises.part("02_equation_of_motion", "given")


# --- the plate ----------------------------------------------------------------------------------------------


def plate(v, own=1, shift=1, about=None):
    """Factors on the holes' own moments and on all parallel-axis terms, and another point than the centre."""
    parts = [(1, v["outline"]), *((-1, hole) for hole in v["holes"])]
    parts = [(sign, *given.polygon(corners)) for sign, corners in parts]
    area = sum(sign * part for sign, part, _, _ in parts)
    centre = sum(sign * part * middle for sign, part, middle, _ in parts) / area
    point, inertia = centre if about is None else about, 0.0
    for sign, part, middle, second in parts:
        away = middle - point
        inertia += sign * ((own if sign < 0 else 1) * second + shift * part * away @ away)
    return v["density"] * area, centre, v["density"] * inertia


def plate_about_outline(v):
    return plate(v, about=given.polygon(v["outline"])[1])


# --- rotation -----------------------------------------------------------------------------------------------


def product(p, q):
    """The product of two quaternions (w, x, y, z)."""
    a, x, b, y = p[0], p[1:], q[0], q[1:]
    return np.array([a * b - x @ y, *(a * y + b * x + np.cross(x, y))])


def body_rate(v):
    return product(v["q"], np.array([0.0, *v["omega"]])) / 2


def world_rate(v):
    return product(np.array([0.0, *v["omega"]]), v["q"]) / 2


def scalar_last_rate(v):
    q = np.roll(v["q"], 1)
    return np.roll(product(q, np.array([0.0, *v["omega"]])), -1) / 2


def gyrostat_rate(v, gyroscopic=1, wheel=1, body=1):
    spin = body * v["inertia"] @ v["omega"] + wheel * v["wheel"]
    return np.linalg.solve(v["inertia"], v["torque"] - gyroscopic * np.cross(v["omega"], spin))


def gyrostat_diagonal(v):
    return gyrostat_rate({**v, "inertia": np.diag(np.diag(v["inertia"]))})


def gyrostat_divided(v):
    """The right torque, divided by the diagonal of the inertia."""
    return v["inertia"] @ gyrostat_rate(v) / np.diag(v["inertia"])


# --- force --------------------------------------------------------------------------------------------------


def air_force(v, wind=1, magnus=1, drag=1):
    u = v["velocity"] - wind * v["wind"]
    return -drag * v["drag"] * np.linalg.norm(u) * u + magnus * v["magnus"] * np.cross(v["spin"], u)


def air_force_per_component(v):
    u = v["velocity"] - v["wind"]
    return air_force(v, drag=0) - v["drag"] * np.abs(u) * u


def air_force_linear(v):
    return air_force(v, drag=0) - v["drag"] * (v["velocity"] - v["wind"])


def air_force_over_ground(v):
    return air_force(v, magnus=0) + v["magnus"] * np.cross(v["spin"], v["velocity"])


# --- integrator ---------------------------------------------------------------------------------------------


def slopes(v, back=-1, times=(0.0, 0.5, 1.0)):
    """k1, k2, k3 as rows."""
    rate, t, y, dt = v["rate"].build(given), v["t"], v["y"], v["dt"]
    k1 = rate(t + times[0] * dt, y)
    k2 = rate(t + times[1] * dt, y + dt / 2 * k1)
    return np.array([k1, k2, rate(t + times[2] * dt, y + dt * (2 * k2 + back * k1))])


def kutta(v, back=-1, times=(0.0, 0.5, 1.0), weights=(1, 4, 1)):
    return v["y"] + v["dt"] * np.array(weights) @ slopes(v, back, times) / sum(weights)


def is_of_other_weights(v, answer):
    """Is it y + dt (a k1 + b k2 + c k3) / d, with whole numbers a, b, c up to 6 and d up to 12?"""
    weights = np.moveaxis(np.indices((7, 7, 7)), 0, -1).reshape(-1, 3)
    steps = v["dt"] * weights @ slopes(v)
    made = v["y"] + steps[:, None] / np.arange(1, 13)[:, None]
    return bool(np.any(np.all(np.abs(made - answer) < 1e-9, axis=-1)))


def rk4(v):
    rate, t, y, dt = v["rate"].build(given), v["t"], v["y"], v["dt"]
    k1 = rate(t, y)
    k2 = rate(t + dt / 2, y + dt / 2 * k1)
    k3 = rate(t + dt / 2, y + dt / 2 * k2)
    return y + dt / 6 * (k1 + 2 * k2 + 2 * k3 + rate(t + dt, y + dt * k3))


EULER_STEPS, EULER_DT = 5, 0.1


def march_euler(v, clock=lambda k: k):
    """A few explicit Euler steps; `clock(k)` is the number of steps that step k believes to lie behind it."""
    rate, rows = given.swelling(v["strength"]), [v["y"]]
    for k in range(EULER_STEPS):
        rows.append(rows[-1] + EULER_DT * rate(EULER_DT * clock(k), rows[-1]))
    return np.array(rows)


def march_kutta(v):
    """The same steps by Kutta's method, where `step` is passed over."""
    rate, rows = Given("swelling", strength=v["strength"]), [v["y"]]
    for k in range(EULER_STEPS):
        rows.append(kutta({"rate": rate, "t": k * EULER_DT, "y": rows[-1], "dt": EULER_DT}))
    return np.array(rows)


def swelling(v, times):
    """The exact motion under given.swelling, one row for each time."""
    return 1 / (1 / v["y"] - v["strength"] * np.sin(times)[:, None])


# --- whole runs ---------------------------------------------------------------------------------------------


def flip_time(v):
    """The instant at which Ω₂ first changes its sign: by elliptic functions, or integrated to about 1e-10
    s."""
    if not np.any(v["wheel"]) and v["omega"][2] == 0:
        return quarter_period(np.diag(v["inertia"]), v["omega"])
    inertia, inverse, wheel = v["inertia"], np.linalg.inv(v["inertia"]), v["wheel"]

    def rate(t, omega):
        return -inverse @ np.cross(omega, inertia @ omega + wheel)

    def crossing(t, omega):
        return omega[1]

    crossing.terminal = True
    run = solve_ivp(rate, (0, v["longest"]), v["omega"], "DOP853", events=crossing, rtol=1e-11, atol=1e-12)
    return float(run.t_events[0][0]) if len(run.t_events[0]) else math.inf


def quarter_period(inertia, omega):
    """From the largest Ω₂ to its zero, by the elliptic functions of the free top, with I₁ < I₂ < I₃."""
    (a, b, c), energy, momentum = inertia, inertia @ omega**2, inertia**2 @ omega**2
    steep, flat = (b - a) * (energy * c - momentum), (c - b) * (momentum - energy * a)
    if momentum > energy * b:
        steep, flat = flat, steep
    return float(ellipkm1(1 - flat / steep) * math.sqrt(a * b * c / steep))


def swing(v, shift=1, first="rate", sign=-1, torque=math.sin):
    """`first`: what is renewed first, "rate" or "position"; or "none", where both take the old values."""
    angle, rate, angles = v["angle"], 0.0, [v["angle"]]
    about_pivot = v["inertia"] + shift * v["mass"] * v["length"] ** 2
    factor = sign * v["mass"] * given.GRAVITY * v["length"] / about_pivot
    for _ in range(v["steps"]):
        moved = angle + v["dt"] * rate
        rate += v["dt"] * factor * torque(moved if first == "position" else angle)
        angle = angle + v["dt"] * rate if first == "rate" else moved
        angles.append(angle)
    return np.array(angles)


def swing_swapped(v):
    return swing({**v, "mass": v["inertia"], "inertia": v["mass"]})


def swing_exact(v):
    factor = v["mass"] * given.GRAVITY * v["length"] / (v["inertia"] + v["mass"] * v["length"] ** 2)
    times = v["dt"] * np.arange(v["steps"] + 1)
    run = solve_ivp(
        lambda t, y: (y[1], -factor * math.sin(y[0])),
        (0, times[-1]),
        (v["angle"], 0.0),
        "DOP853",
        t_eval=times,
        rtol=1e-10,
        atol=1e-12,
    )
    return run.y[0]
