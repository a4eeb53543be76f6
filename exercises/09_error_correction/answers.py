"""Right answers to the exercise of unit 09, and what typical mistakes would answer. Grader's side only."""

import numpy as np

import exercises

given = exercises.part("09_error_correction", "given")
G, GRAVITY = given.G, given.GRAVITY


# --- Baumgarte's pendulum, in polar coordinates -------------------------------------------------------------


def acceleration(v, turning=1.0, damping=2.0, stiffness=1.0, weight=1.0, speed=False):
    """ẍ of a point on a rod: along it r̈ = −2 α ṙ − β² (r − L), across it as if there were no rod.

    ``turning``, ``weight``: how much of v_t²/r and of gravity's pull along the rod λ makes up for.
    """
    r = np.hypot(*v["x"])
    n = v["x"] / r
    t = np.array([-n[1], n[0]])
    rate, across = n @ v["v"], t @ v["v"]
    back = damping * v["alpha"] * (np.hypot(*v["v"]) if speed else rate)
    back += stiffness * v["beta"] ** 2 * (r - v["length"])
    along = -back - turning * across**2 / r + (1 - weight) * (n @ GRAVITY)
    return along * n + (t @ GRAVITY) * t


def swing(v, scheme="rk4", swapped=False):
    """(x, v) after the steps, by the named scheme."""
    alpha, beta = (v["beta"], v["alpha"]) if swapped else (v["alpha"], v["beta"])

    def rate(y):
        here = {"x": y[:2], "v": y[2:], "length": v["length"], "alpha": alpha, "beta": beta}
        return np.concatenate([y[2:], acceleration(here)])

    y, dt = np.concatenate([v["x"], v["v"]]), v["dt"]
    for _ in range(v["steps"]):
        if scheme == "rk4":
            y = given.rk4(rate, y, dt)
        elif scheme == "euler":
            y = y + dt * rate(y)
        else:  # λ of the step's start, held
            force = rate(y)[2:]
            y = given.rk4(lambda z, force=force: np.concatenate([z[2:], force]), y, dt)
    return y[:2], y[2:]


def decay(v):
    """(φ, φ̇) at the end, by the solution of φ̈ + 2 α φ̇ + β² φ = 0: gravity and swinging don't matter."""
    r = np.hypot(*v["x"])
    φ, rate, α = r - v["length"], v["x"] @ v["v"] / r, v["alpha"]
    t, root = v["dt"] * v["steps"], np.sqrt(complex(v["alpha"] ** 2 - v["beta"] ** 2))
    c, s = (1, t) if root == 0 else (np.cosh(root * t), np.sinh(root * t) / root)
    there = φ * c + (rate + α * φ) * s
    speed = φ * root**2 * s + (rate + α * φ) * c - α * there
    return np.array([(np.exp(-α * t) * part).real for part in (there, speed)])


# --- compliant links ----------------------------------------------------------------------------------------


def relax(v, squared=True, memory=1.0, weighed=True, sign=1.0, at_once=False):
    """(x, λ) after one sweep over the links, the first one first."""
    x, λ, inverse = v["x"].copy(), v["lam"].copy(), v["inverse"]
    α = v["compliance"] / (v["dt"] ** 2 if squared else 1.0)
    seen = v["x"] if at_once else x
    for k in range(len(λ)):
        offset = seen[k + 1] - seen[k]
        size = np.linalg.norm(offset)
        both = inverse[k : k + 2] if weighed else np.ones(2) * (inverse[k : k + 2] > 0)
        change = -(size - v["length"] + memory * α * λ[k]) / (both.sum() + α)
        λ[k] += change
        x[k] -= sign * both[0] * change * offset / size
        x[k + 1] += sign * both[1] * change * offset / size
    return x, λ


def chain(v, predicted=False, kept=False, held=True, **how):
    """(x, v, λ) after one step of dt: free flight, sweeps from λ = 0, the velocity from the positions."""
    h, fixed = v["dt"], (v["inverse"] == 0)[:, None]
    free = np.where(fixed & held, v["v"], v["v"] + h * GRAVITY)
    x, λ = v["x"] + h * free, np.zeros(len(v["x"]) - 1)
    for _ in range(v["sweeps"]):
        λ = np.zeros_like(λ) if kept else λ
        links = {key: v[key] for key in ("inverse", "length", "compliance", "dt")}
        x, λ = relax({"x": x, "lam": λ, **links}, **how)
    return x, free if predicted else (x - v["x"]) / h, λ


def implicit(v):
    """The same step of a chain that hangs straight down, by one linear system: implicit Euler on springs.

    Each link pulls with (its stretch)/compliance. Unknown are the heights after the step.
    """
    h, inverse = v["dt"], v["inverse"]
    y, n = v["x"][:, 1], len(v["inverse"])
    D = np.diff(np.eye(n), axis=0)  # y[k+1] − y[k], which is −length at rest
    free = y + h * np.where(inverse > 0, v["v"][:, 1] - h * G, v["v"][:, 1])
    soft = h**2 / v["compliance"]
    system = np.eye(n) + soft * inverse[:, None] * (D.T @ D)
    after = np.linalg.solve(system, free - soft * inverse * (D.T @ np.full(n - 1, v["length"])))
    x = np.column_stack([v["x"][:, 0], after])
    λ = -soft * (-(D @ after) - v["length"])
    return x, (x - v["x"]) / h, λ


def hang(v, sign=1.0, power=2):
    """(stretch, tension) of each link at rest: the weight of all that hangs below it."""
    below = G * np.cumsum(v["mass"][::-1])[::-1]
    return v["compliance"] * below, sign * below * v["dt"] ** (2 - power)


# --- pymunk's corrections -----------------------------------------------------------------------------------

AWAY = np.array([-1.0, 1.0])


def share(left, dt, power=True):
    return 1 - (left**dt if power else left)


def pin(v, power=True, limit=True, weighed=True, order="old", gone=False, sign=-1.0, per_dt=True):
    """(x, v) after pymunk's steps with a PinJoint along a line: positions, then velocities, as it does."""
    x, u, dt = v["x"].copy(), v["v"].copy(), v["dt"]
    inverse = 1 / v["mass"] if weighed else np.ones(2)
    for _ in range(v["steps"]):
        x = x + dt * u if order == "old" else x
        back = sign * share(v["error_bias"], dt, power) * (x[1] - x[0] - v["length"]) / (dt if per_dt else 1)
        back = np.clip(back, -v["max_bias"], v["max_bias"]) if limit else back
        u = u + inverse / inverse.sum() * AWAY * (back - (u[1] - u[0]))
        x = x + dt * u if order == "new" else x
    if gone:
        u = np.full(2, v["mass"] @ u / v["mass"].sum())
    return x, u


def lift(v, power=True, slop=True, weighed=True, stays=False, order="old", pulls=False, depth=1.0):
    """(x, v) after pymunk's steps with two discs that overlap: what lifts them moves, and is forgotten."""
    x, u, dt, moving = v["x"].copy(), v["v"].copy(), v["dt"], np.zeros(2)
    inverse = 1 / v["mass"] if weighed else np.ones(2)
    part = inverse / inverse.sum() * AWAY
    for _ in range(v["steps"]):
        x = x + dt * (u + moving) if order == "old" else x
        moving = np.zeros(2)
        deep = depth * (2 * v["radius"] - (x[1] - x[0]))
        if deep > 0:
            back = share(v["bias"], dt, power) * max(0.0, deep - (v["slop"] if slop else 0.0)) / dt
            if stays:
                u = u + part * max(0.0, back - (u[1] - u[0]))
            else:
                closing = u[0] - u[1]
                u = u + part * (closing if pulls else max(0.0, closing))
                moving = part * back
        x = x + dt * (u + moving) if order == "new" else x
    return x, u
