"""Right answers to the exercise of unit 04, and what typical mistakes would answer. Grader's side only."""

import numpy as np
from scipy.integrate import solve_ivp

import exercises
from exercises.grader.check import remember

given = exercises.part("04_embedding", "given")
CLOSED = 1e-13  # m


# --- the rope -----------------------------------------------------------------------------------------------


def rope(v, turning=1.0, side=1.0, unit=True, along=0.0):
    """J and J̇ u of φ = |x_1 − p_1| + |x_2 − p_2| − length."""
    offset, u = (v["x"] - v["pulleys"]).reshape(2, 2), v["u"].reshape(2, 2)
    r = np.linalg.norm(offset, axis=1)
    n = offset / r[:, None]
    across = np.sum(u**2, axis=1) - (1 - along) * np.sum(n * u, axis=1) ** 2
    J = (n if unit else offset) * np.array([[1.0], [side]])
    return J.ravel(), float(turning * np.sum(across / r))


def free_length(x, pulleys):
    return np.linalg.norm((x - pulleys).reshape(2, 2), axis=1).sum()


# --- A, b and λ ---------------------------------------------------------------------------------------------


def embed(v, rate=1.0, inverse=-1, weight=True):
    """A = J M⁻¹ Jᵀ and b = J M⁻¹ f + J̇ u."""
    J, mass = v["J"], v["mass"]
    b = J @ (v["force"] / mass if weight else v["force"])
    return (J * mass**inverse) @ J.T, b + rate * v["rate"]


def shortest(v, sign=-1.0, softening=0.0):
    """Of all λ with A λ + b = 0 the shortest."""
    A = v["A"] + softening * np.eye(len(v["A"]))
    return sign * np.linalg.pinv(A, rcond=1e-10, hermitian=True) @ v["b"]


def basic(v):
    """A λ with A λ + b = 0 that uses independent rows only, the first ones."""
    A, b, taken = v["A"], v["b"], []
    for k in range(len(b)):
        trial = [*taken, k]
        if np.linalg.matrix_rank(A[np.ix_(trial, trial)], tol=1e-8) == len(trial):
            taken = trial
    λ = np.zeros(len(b))
    λ[taken] = np.linalg.solve(A[np.ix_(taken, taken)], -b[taken])
    return λ


# --- one step -----------------------------------------------------------------------------------------------


def step(v, position="new", impulse=False, bias=1.0, force=1.0, times_dt=False):
    """One step of S9: the force, the velocities, the positions."""
    J, mass, dt = v["J"], v["mass"], v["dt"]
    free = v["u"] + force * dt * v["force"] / mass
    A = dt * (J / mass) @ J.T
    share = v["share"] * v["phi"] * (1.0 if times_dt else 1 / dt)
    λ = np.linalg.solve(A, -(J @ free + bias * share))
    u = free + dt * J.T @ λ / mass
    return v["x"] + dt * (u if position == "new" else v["u"]), u, λ * (dt if impulse else 1.0)


def project(v, metric=1.0, iterations=30, sides=(1.0, 1.0)):
    """Newton's method along M⁻¹ Jᵀ: the length is closed, and both masses move by their share."""
    x, mass = v["x"].copy(), v["mass"] ** metric
    for _ in range(iterations):
        φ = free_length(x, v["pulleys"]) - v["length"]
        if abs(φ) < CLOSED:
            break
        offset = (x - v["pulleys"]).reshape(2, 2)
        J = (offset / np.linalg.norm(offset, axis=1)[:, None] * np.array(sides)[:, None]).ravel()
        x = x - J / mass * φ / (J @ (J / mass))
    return x


# --- a run --------------------------------------------------------------------------------------------------


def swing(v, turning=1.0, side=1.0, held=False):
    """(x, u) after so many steps of RK4, λ at the level of accelerations in each stage."""
    mass, pulleys, f = v["mass"], v["pulleys"], given.weight(v["mass"])

    def tension(y):
        J, rate = rope({"x": y[:4], "u": y[4:], "pulleys": pulleys}, turning)
        λ = -(J @ (f / mass) + rate) / (J @ (J / mass))
        return J * np.repeat([1.0, side], 2) * λ

    y = np.concatenate([v["x"], v["u"]])
    for _ in range(v["steps"]):
        at_start = tension(y)
        y = given.rk4(
            lambda y, now=at_start: np.concatenate([y[4:], (f + (now if held else tension(y))) / mass]),
            y,
            v["dt"],
        )
    return y[:4], y[4:]


@remember
def swing_exact(v):
    """(x, u) by Lagrange's equations for the rope's length r on one side and both angles, by DOP853."""
    (m1, m2), g = v["mass"][::2], given.GRAVITY
    offset, u = (v["x"] - v["pulleys"]).reshape(2, 2), v["u"].reshape(2, 2)
    r = np.linalg.norm(offset, axis=1)
    angle = np.arctan2(offset[:, 0], -offset[:, 1])
    out = np.stack([np.sin(angle), -np.cos(angle)], axis=1)
    around = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    start = [r[0], *angle, np.sum(out * u, axis=1)[0], *(np.sum(around * u, axis=1) / r)]

    def rate(t, y):
        r, a, b, ṙ, ȧ, ḃ = y
        s = r_sum - r
        pull = m1 * r * ȧ**2 - m2 * s * ḃ**2 + m1 * g * np.cos(a) - m2 * g * np.cos(b)
        turns = (-g * np.sin(a) - 2 * ṙ * ȧ) / r, (-g * np.sin(b) + 2 * ṙ * ḃ) / s
        return [ṙ, ȧ, ḃ, pull / (m1 + m2), *turns]

    r_sum = r.sum()
    time = v["dt"] * v["steps"]
    end = solve_ivp(rate, (0, time), start, method="DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
    lengths, rates = np.array([end[0], r_sum - end[0]]), np.array([end[3], -end[3]])
    out = np.stack([np.sin(end[1:3]), -np.cos(end[1:3])], axis=1)
    around = np.stack([np.cos(end[1:3]), np.sin(end[1:3])], axis=1)
    x = v["pulleys"] + (lengths[:, None] * out).ravel()
    return x, (rates[:, None] * out + (lengths * end[4:])[:, None] * around).ravel()


# --- the gear train -----------------------------------------------------------------------------------------


def train(v, sign=1.0, impulse=False, coupled=True, late_drag=False, middle=True):
    """(ω, λ) after so many steps: three wheels, each in mesh with the next."""
    R, inertia, dt = v["radii"], v["inertia"], v["dt"]
    J = np.array([[R[0], sign * R[1], 0.0], [0.0, R[1] if middle else 0.0, sign * R[2]]])
    A = dt * (J / inertia) @ J.T
    if not coupled:
        A = np.diag(np.diag(A))
    ω, λ = v["omega"], np.zeros(2)
    for _ in range(v["steps"]):
        torque = np.array([v["drive"], 0.0, -v["drag"] * ω[2]])
        free = ω + dt * torque / inertia
        if late_drag:
            free[2] = ω[2] / (1 + dt * v["drag"] / inertia[2])
        λ = np.linalg.solve(A, -J @ free)
        ω = free + dt * J.T @ λ / inertia
    return ω, λ * (dt if impulse else 1.0)
