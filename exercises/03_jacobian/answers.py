"""Right answers to the exercise of unit 03, and what typical mistakes would answer. Grader's side only."""

import numpy as np

import exercises

given = exercises.part("03_jacobian", "given")


def lead(v, turns=True):
    """m/rad."""
    return v["pitch"] / (2 * np.pi) if turns else v["pitch"]


# --- the screw ----------------------------------------------------------------------------------------------


def screw_row(v, thread=-1, turns=True, moment=1, side=1, arms="own"):
    """w = e·(velocity of j's point − that of i's) − (pitch/2π) e·(ω_j − ω_i)."""
    e, r_i, r_j = v["axis"], v["arm_i"], v["arm_j"]
    if arms == "swapped":
        r_i, r_j = r_j, r_i
    turn = thread * lead(v, turns) * e
    return side * np.concatenate([-e, -moment * np.cross(r_i, e) - turn, e, moment * np.cross(r_j, e) + turn])


def screw_motion(v, carried=1, gap=1, thread=1, turns=True, own=1, added=1):
    """(v_j, ω_j) of a body that turns along the screw of a body that moves."""
    e, r_i, r_j, ω_i = v["axis"], v["arm_i"], v["arm_j"], v["omega_i"]
    ω_j = added * ω_i + v["turn"] * e
    at_point = v["v_i"] + carried * np.cross(ω_i, r_i + gap * v["gap"] * e)
    at_point = at_point + thread * lead(v, turns) * v["turn"] * e
    return at_point - own * np.cross(ω_j, r_j), ω_j


def screw_rate(v, centripetal=1, coriolis=2, carried=1, thread=1, signs=1):
    """J̇ u: the second derivative of φ at u̇ = 0."""
    e, r_i, r_j, gap, u = v["axis"], v["arm_i"], v["arm_j"], v["gap"], v["u"]
    v_i, ω_i, v_j, ω_j = u[:3], u[3:6], u[6:9], u[9:]
    ė = np.cross(ω_i, e)
    Δv = v_j + np.cross(ω_j, r_j) - v_i - np.cross(ω_i, r_i)
    inward = signs * (np.cross(ω_j, np.cross(ω_j, r_j)) - np.cross(ω_i, np.cross(ω_i, r_i)))
    return float(
        centripetal * e @ inward
        + coriolis * ė @ Δv
        + carried * gap * np.cross(ω_i, ė) @ e
        - thread * lead(v) * ė @ (ω_j - ω_i)
    )


# --- finite differences -------------------------------------------------------------------------------------


def slope(v, step=None, there=1.0, back=-1.0, over=2.0, still=False):
    """(φ(h) − φ(−h)) / 2h along the motion."""
    h = v["h"] if step is None else step
    phi = v["phi"].build(given)
    u = v["u"] * np.tile([1.0, 1, 1, 0, 0, 0], 2) if still else v["u"]
    return float(
        (phi(given.moved(v["pose"], u, there * h)) - phi(given.moved(v["pose"], u, back * h))) / (over * h)
    )


def slope_exact(v):
    """φ̇, by Richardson's extrapolation of three central differences: to 1e-11 here."""
    h = 2e-2
    a, b, c = (slope(v, step=h / 2**k) for k in range(3))
    first, second = (4 * b - a) / 3, (4 * c - b) / 3
    return (16 * second - first) / 15


# --- the rope -----------------------------------------------------------------------------------------------


def rope_row(v, ratio=True, moment=1, sign=1, unit=True):
    """w = n_i·(velocity of i's point) + ratio n_j·(velocity of j's point)."""
    directions = [v[name] / (np.linalg.norm(v[name]) if unit else 1.0) for name in ("offset_i", "offset_j")]
    share = v["ratio"] if ratio else 1.0
    parts = []
    for n, arm, factor in zip(directions, (v["arm_i"], v["arm_j"]), (1.0, sign * share), strict=True):
        parts += [factor * n, factor * moment * np.cross(arm, n)]
    return np.concatenate(parts)


def rope(v, pull=-1, **row):
    """(w, forces): both ways through the row; λ = −tension."""
    J = rope_row(v, **row)
    return float(J @ v["u"]), pull * v["tension"] * J


# --- the gears ----------------------------------------------------------------------------------------------


def gears(v, sign=1, inverted=False, λ_sign=1, mass=True):
    """(ω_i, ω_j, λ) after the teeth have met: w = J ω with J = (R_i, R_j) becomes 0."""
    J = np.array([1.0, sign]) * (v["radii"][::-1] if inverted else v["radii"])
    inertia = v["inertia"] if mass else np.ones(2)
    λ = -(J @ v["omega"]) / (J @ (J / inertia))
    ω = v["omega"] + J * λ / inertia
    return float(ω[0]), float(ω[1]), float(λ_sign * λ)


def gears_halfway(v):
    """No λ: both pitch circles take the mean speed."""
    R, ω = v["radii"], v["omega"]
    rim = (R[0] * ω[0] - R[1] * ω[1]) / 2
    return float(rim / R[0]), float(-rim / R[1]), 0.0
